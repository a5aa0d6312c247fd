//! What the splats of a surface sum to where it is whole, near each of them, by looking at each pair of splats.
//!
//! A splat's crowd is the sum of weights at its center, its own among them, over the splats that face the same way, are no smaller than half of
//! it, and whose disks are there: a ball of its larger radius around each holds the center, which no clip cuts off. What weights over crowds sum to in the mean over the surface is found at 1024 places: the overlap is the
//! crowd times that mean. Of a rough surface it is less: its roughness is ⟨m²⟩ / √⟨h²⟩, over those places, with h the height above each disk there, by their weights, and m the mean height of the splat's center above
//! the disks at it, both over the splat's own size; from 0.04 on, to 0.08, the mean sum is divided by up to one and a half. Not where a curve cuts any.

use glam::DVec3;

use super::among::{Among, all_along_x};
use super::clip::removes;
use super::covering::smooth_step;
use super::kernel::{limit_r2, weight};
use super::tangents::tangents;
use crate::scene::{ClipTest, Kernel, Splats};

/// The most places.
const PLACES: usize = 1024;

/// The kernel under which it is summed; for another it is carried over by the kernels' integrals.
const KERNEL: Kernel = Kernel::Gaussian { sigma: 0.5 };

/// The least overlap under another kernel, as a share of that under [`KERNEL`].
const LEAST: f64 = 0.25;

/// The overlap of the surface at each splat of an object under a kernel; 1 of what can't be drawn.
pub(super) fn overlaps(splats: &Splats, kernel: Kernel) -> Vec<f64> {
    let all = all_along_x(splats);
    let largest = all.iter().map(|splat| splat.radius).fold(0.0, f64::max);
    let near = |place: DVec3| {
        let first = all.partition_point(|other| other.center.x < place.x - largest);
        all[first..].iter().take_while(move |other| other.center.x <= place.x + largest)
    };
    let mut overlaps = vec![1.0; splats.len()];
    for of in &all {
        let crowd: f64 = near(of.center).map(|other| weight_at(other, of, of.center)).sum();
        overlaps[of.number] = crowd.max(1.0);
    }
    let mut numbers: Vec<usize> = (0..all.len()).collect();
    numbers.sort_by_key(|i| all[*i].number);
    let places = all.len().min(PLACES);
    let (mut sum, mut area, mut rough, mut uneven) = (0.0, 0.0, 0.0, 0.0);
    for n in 0..places {
        let of = &all[numbers[n * all.len() / places]];
        let place = place_on(of, n);
        if is_cut_off(of, place) {
            continue;
        }
        let (mut there, mut heights) = (0.0, 0.0);
        for other in near(place) {
            let part = weight_at(other, of, place) / overlaps[other.number];
            there += part;
            heights += part * (place - other.center).dot(other.normal).powi(2);
        }
        let (mut at_center, mut above) = (0.0, 0.0);
        for other in near(of.center) {
            let part = weight_at(other, of, of.center) / overlaps[other.number];
            at_center += part;
            above += part * (of.center - other.center).dot(other.normal);
        }
        let size2 = of.s.cross(of.t).length();
        let own = size2 / overlaps[of.number];
        sum += own * there;
        area += own;
        rough += own * heights / size2;
        uneven += own * there * (above / at_center).powi(2) / size2;
    }
    let is_rough = rough > 0.0 && splats.clips.is_empty();
    let roughness = if is_rough { uneven / sum / (rough / sum).sqrt() } else { 0.0 };
    let whole = if area > 0.0 { sum / area } else { 1.0 };
    let mean = whole / (1.0 + 0.5 * smooth_step((roughness - 0.04) / 0.04));
    let under = (integral(kernel) / integral(KERNEL)).max(LEAST);
    all.iter().for_each(|of| overlaps[of.number] *= mean * under);
    overlaps
}

/// One overlap for all, with which a whole surface has the sum that each splat's own gives it: one over the mean of the inverse ones, by area.
pub(super) fn evened(splats: &Splats, overlaps: Vec<f64>) -> Vec<f64> {
    let (mut area, mut over) = (0.0, 0.0);
    for i in (0..splats.len()).filter(|i| splats.defect(*i).is_none()) {
        let (s, t) = tangents(&splats.shapes, i);
        area += s.cross(t).length();
        over += s.cross(t).length() / overlaps[i];
    }
    let mean = if over > 0.0 { area / over } else { 1.0 };
    vec![mean; overlaps.len()]
}

/// A splat of a surface that curves end, as it is seen.
pub(super) struct SharpSplat {
    /// By how much the surface turns away over what the splat reaches toward there (`near_surfaces.rs`).
    pub turn: f64,
    /// Between normal and ray.
    pub cosine: f64,
    /// The filter's radius at its depth, in what it reaches toward where the surface turns away.
    pub filter_radii: f64,
    /// The minor semi-axis of the image of the surface around it, over the filter's radius.
    pub minor: f64,
}

impl SharpSplat {
    /// How many times its weights count.
    pub fn sum(&self) -> f64 {
        1.0 + 0.35 * self.goes_on()
    }

    /// How surely the surface goes on around it, from 0 to 1: sums fall toward ridges and corners of triangles, where the curves tell what is covered. Not where the
    /// surface ends by turning away: on one that turns by τ a radius, an outline that is half of the splat and of the filter away has the cosine f with f² = τ (f + h).
    /// What is narrower than the filter may be a side that is seen edge-on, whose sum says how wide it is; but not where it faces the eye.
    pub fn goes_on(&self) -> f64 {
        let half = 0.5 * self.turn;
        let outline = half + (half * half + self.turn * self.filter_radii).sqrt();
        let goes_on = match outline > 0.0 {
            true => smooth_step(self.cosine / outline - 1.0),
            false => 1.0,
        };
        let is_wide = smooth_step((self.minor - 0.3) / 0.7);
        let faces = smooth_step((self.cosine - 0.3) / 0.3);
        faces.max(goes_on * is_wide)
    }
}

/// Whether the splat's own clip removes a place.
fn is_cut_off(splat: &Among, place: DVec3) -> bool {
    removes(&splat.clip, splat.seen_at(place), ClipTest::Conic)
}

/// What a splat weighs at a place of another one.
fn weight_at(splat: &Among, of: &Among, place: DVec3) -> f64 {
    let r2 = splat.seen_at(place).length_squared();
    let is_there = r2 <= 1.0 && place.distance(splat.center) <= splat.radius && !is_cut_off(splat, place);
    let counts = splat.radius >= 0.5 * of.radius && splat.normal.dot(of.normal) > 0.0;
    if is_there && counts { weight(KERNEL, r2) } else { 0.0 }
}

/// The `n`th place of a sequence that is spread evenly over a splat: a direction on the unit sphere, seen along the normal, and a share of
/// the way to the rim, whose square is spread evenly. The sequence is that of multiples of the powers of 1/g, g⁴ = g + 1.
fn place_on(splat: &Among, n: usize) -> DVec3 {
    let mut g = 1.0_f64;
    for _ in 0..64 {
        g = (1.0 + g).powf(0.25);
    }
    let fraction = |power: i32| (0.5 + n as f64 * g.powi(-power)).fract();
    let (share, height, turn) = (fraction(1).sqrt(), 2.0 * fraction(2) - 1.0, fraction(3));
    let (sin, cos) = (std::f64::consts::TAU * turn).sin_cos();
    let across = (1.0 - height * height).sqrt();
    let direction = DVec3::new(across * cos, across * sin, height);
    let in_plane = direction - direction.dot(splat.normal) * splat.normal;
    let volume = splat.s.cross(splat.t).dot(splat.normal);
    let u = in_plane.cross(splat.t).dot(splat.normal) / volume;
    let v = splat.s.cross(in_plane).dot(splat.normal) / volume;
    splat.center + share / u.hypot(v) * in_plane
}

/// Of the kernel over the unit disk, by the midpoint rule.
fn integral(kernel: Kernel) -> f64 {
    const STEPS: u32 = 4096;
    let step = limit_r2(kernel) / f64::from(STEPS);
    (0..STEPS).map(|i| step * weight(kernel, (f64::from(i) + 0.5) * step)).sum()
}
