//! How much the surface around each splat overlaps itself, by which a sum of weights tells what part of a pixel is covered
//! (`glsl/inc/edges.glsl`).
//!
//! A splat's *crowd* K is Σ exp(−2 (u² + v²)) at its center, over itself and the splats that face the same way (normals within 90°), are
//! no smaller than half of it and whose disks are there: u² + v² ≤ 1, no farther away than their larger radius, not cut off by a clip. With weights over
//! K, splats sum to about the same all over a surface, however densely they lie: independent samples of a surface vary by a quarter of the mean
//! as they are, by an eighth so. What they sum to in the mean, μ, is found at places spread over the disks of some splats, by area. The
//! overlap of a splat is K μ: so the sum is 1 in the mean.
//!
//! Seen at a slant a disk that lies off its surface by h is off its place in the image by h times the slant's tangent, so that sums of a noisy surface vary
//! the more the flatter it is seen, and pixels inside of it would let through what is behind. What disks have that stand like the slats of a blind, with normals that are not
//! the surface's, is no noise: their heights cancel at each one's center. So the *roughness* ρ of a surface is the mean square of what the heights of a center over the disks there are in the mean, over the
//! root of the mean square of h at the same places as above, all by the disks' weights, and over their size. It is 0.01 of balls, 0.03 of a wire of slats, 0.05 of points with noise of a twelfth of their
//! disks' radii and of folds some splats wide, 0.08 of noise of a sixth and of folds that are narrower. From ROUGH on, to twice that, K μ is less, up to ROUGH_SUM times: their outlines, which are as rough, reach
//! out by 0.3 pixels for it. What curves cut has a rule of its own.

pub(super) mod grids;

use std::sync::atomic::{AtomicU32, Ordering};

use glam::{DVec2, DVec3};
use rayon::prelude::*;

use self::grids::{Grids, Search};
use super::clip::removes;
use crate::scene::{Shapes, Splats};

/// So many cells are a task.
pub(super) const CELLS_AT_ONCE: usize = 1024;

/// Splats near whose centers the mean sum is looked for.
const SAMPLES: usize = 1024;

/// The roughness from which on sums vary too much.
const ROUGH: f64 = 0.04;

/// How many times as much a surface sums to that is twice as rough, or more.
const ROUGH_SUM: f64 = 1.5;

/// How much the surface around each of some splats overlaps itself.
pub struct Overlaps {
    /// One over the overlap of each, above 0; 1 of what can't be drawn.
    pub inverse: Vec<f32>,
    /// That of what stands for all of them evenly: one over the mean of the inverse ones, by area; 1 of none.
    pub mean: f64,
}

impl Overlaps {
    /// Those of the surface that these splats are.
    pub fn of(splats: &Splats) -> Self {
        let grids = Grids::new(splats);
        // Each is written once, by one thread, where it belongs: no list of them beside.
        let crowds: Vec<AtomicU32> = (0..splats.len()).map(|_| AtomicU32::new(1.0_f32.to_bits())).collect();
        (0..grids.len().div_ceil(CELLS_AT_ONCE)).into_par_iter().for_each(|task| {
            let mut search = Search::default();
            for cell in task * CELLS_AT_ONCE..grids.len().min((task + 1) * CELLS_AT_ONCE) {
                grids.crowds_in(splats, cell, &mut search, |splat, crowd| {
                    crowds[splat as usize].store((crowd.recip() as f32).to_bits(), Ordering::Relaxed);
                });
            }
        });
        let mut inverse: Vec<f32> =
            crowds.into_iter().map(|crowd| f32::from_bits(crowd.into_inner())).collect();
        let sum = sum_of_whole(&grids, splats, &inverse) as f32;
        let (mut area, mut over) = (0.0, 0.0);
        for i in grids.numbers().into_iter().map(|number| number as usize) {
            inverse[i] /= sum;
            area += area_of(splats, i);
            over += area_of(splats, i) * f64::from(inverse[i]);
        }
        Self { inverse, mean: ratio(area, over) }
    }
}

/// What weights over crowds sum to where a surface is whole: the mean over area, from some splats, and less of what is rough.
fn sum_of_whole(grids: &Grids, splats: &Splats, inverse: &[f32]) -> f64 {
    let numbers = grids.numbers();
    let count = numbers.len().min(SAMPLES);
    let sample = |n: usize| {
        let i = numbers[n * numbers.len() / count] as usize;
        let frame = dual_frame(splats, i);
        let from_center = from_center(n, frame);
        if removes(&splats.clips.get(i), DVec2::new(frame[0].dot(from_center), frame[1].dot(from_center))) {
            return [0.0; 4];
        }
        let place = splats.positions[i] + from_center;
        let (area, inverse_of) = (area_of(splats, i), |of: u32| f64::from(inverse[of as usize]));
        let [sum, _, squares] = grids.sums_on(splats, i, place, inverse_of);
        let [at_center, heights, _] = grids.sums_on(splats, i, splats.positions[i], inverse_of);
        let own = area * f64::from(inverse[i]);
        [own * sum, own, own * squares / area, own * sum * (heights / at_center).powi(2) / area]
    };
    let all: Vec<[f64; 4]> = (0..count).into_par_iter().map(sample).collect();
    let [sum, own, squares, means] =
        all.iter().fold([0.0; 4], |sum, of| std::array::from_fn(|i| sum[i] + of[i]));
    let is_rough = splats.clips.is_empty() && squares > 0.0;
    let roughness = if is_rough { means / (sum * squares).sqrt() } else { 0.0 };
    ratio(sum, own) / more_of_rough(roughness)
}

/// How many times as much weights of so rough a surface count.
fn more_of_rough(roughness: f64) -> f64 {
    let t = ((roughness - ROUGH) / ROUGH).clamp(0.0, 1.0);
    1.0 + (ROUGH_SUM - 1.0) * t * t * (3.0 - 2.0 * t)
}

/// 1 of nothing, and of what is beyond numbers.
fn ratio(a: f64, b: f64) -> f64 {
    if a > 0.0 && b > 0.0 && (a / b).is_normal() { a / b } else { 1.0 }
}

/// Over π.
pub fn area_of(splats: &Splats, i: usize) -> f64 {
    match &splats.shapes {
        Shapes::Disks { radii, .. } => f64::from(radii[i]).powi(2),
        Shapes::Ellipses { s, t } => s[i].as_dvec3().cross(t[i].as_dvec3()).length(),
    }
}

/// The `n`th of places spread over disks, in the one of this dual frame: in a direction, seen along its normal, and at a radius of the
/// three-dimensional sequence of Roberts (2018, "The unreasonable effectiveness of quasirandom sequences"), so that they do not depend on
/// how tangent vectors are chosen.
fn from_center(n: usize, [to_u, to_v, normal]: [DVec3; 3]) -> DVec3 {
    let [r2, height, turn] = [0.819_172_513_396_164_4, 0.671_043_606_703_789_2, 0.549_700_477_901_970_3]
        .map(|step| (0.5 + step * n as f64).fract());
    let (angle_rad, z) = (std::f64::consts::TAU * turn, 2.0 * height - 1.0);
    let direction = DVec3::new(angle_rad.cos(), angle_rad.sin(), 0.0) * (1.0 - z * z).sqrt() + z * DVec3::Z;
    let along = direction.reject_from_normalized(normal);
    let rim = along / to_u.dot(along).hypot(to_v.dot(along));
    if rim.is_finite() { r2.sqrt() * rim } else { DVec3::ZERO }
}

/// What gives u and v of a place when it is multiplied by them, counted from the center of splat `i`; and the unit normal.
pub(super) fn dual_frame(splats: &Splats, i: usize) -> [DVec3; 3] {
    match &splats.shapes {
        Shapes::Disks { normals, radii } => {
            let normal = normals[i].as_dvec3().normalize();
            let (u, v) = normal.any_orthonormal_pair();
            let inverse = f64::from(radii[i]).recip();
            [inverse * u, inverse * v, normal]
        }
        Shapes::Ellipses { s, t } => {
            let (s, t) = (s[i].as_dvec3(), t[i].as_dvec3());
            let normal = s.cross(t).normalize();
            // The dual basis in the plane.
            let area = s.cross(t).dot(normal);
            [t.cross(normal) / area, normal.cross(s) / area, normal]
        }
    }
}

#[cfg(test)]
mod tests;
