//! What the splats of a surface sum to where it is whole: at the centers of some of them, the median of what all of them leave there.

use glam::{DVec2, DVec3};

use super::clip::removes;
use super::kernel::{limit_r2, weight};
use super::tangents::tangents;
use crate::scene::{ClipTest, Kernel, Splats};

/// The most centers.
const SAMPLES: usize = 512;

/// The kernel under which it is summed; for another it is carried over by the kernels' integrals, since splats lie about evenly.
const KERNEL: Kernel = Kernel::Gaussian { sigma: 0.5 };

/// The overlap of an object's surface under a kernel. Every sample is compared with every splat.
pub(super) fn overlap(splats: &Splats, kernel: Kernel) -> f64 {
    let count = splats.len();
    let samples = count.min(SAMPLES);
    let mut sums: Vec<f64> = (0..samples)
        .map(|i| i * count / samples)
        .filter(|&i| splats.defect(i).is_none() && !is_cut_off(splats, i, DVec2::ZERO))
        .map(|i| sum_at(splats, splats.positions[i], i))
        .collect();
    sums.sort_by(f64::total_cmp);
    let median = sums.get(sums.len() / 2).map_or(1.0, |sum| sum.max(1.0));
    1.0 + (median - 1.0) * integral(kernel) / integral(KERNEL)
}

fn is_cut_off(splats: &Splats, i: usize, place: DVec2) -> bool {
    removes(&splats.clips.get(i), place, ClipTest::Conic)
}

/// Σ of the weights at a place on splat `of`, of splats that face the side that it faces.
fn sum_at(splats: &Splats, place: DVec3, of: usize) -> f64 {
    let normal_of = |i: usize| {
        let (s, t) = tangents(&splats.shapes, i);
        s.cross(t).normalize()
    };
    let facing = normal_of(of);
    let all = (0..splats.len()).filter(|&i| splats.defect(i).is_none());
    all.map(|i| {
        let q = place - splats.positions[i];
        if q.abs().max_element() > splats.major_radius(i) {
            return 0.0;
        }
        let (s, t) = tangents(&splats.shapes, i);
        let normal = s.cross(t).normalize();
        // q = u s + v t + h n, solved by Cramer's rule.
        let volume = s.cross(t).dot(normal);
        let (u, v) = (q.cross(t).dot(normal) / volume, s.cross(q).dot(normal) / volume);
        let counts = normal.dot(facing) > 0.0 && !is_cut_off(splats, i, DVec2::new(u, v));
        if counts { weight(KERNEL, u * u + v * v) } else { 0.0 }
    })
    .sum()
}

/// Of the kernel over the unit disk, by the midpoint rule.
fn integral(kernel: Kernel) -> f64 {
    const STEPS: u32 = 4096;
    let step = limit_r2(kernel) / f64::from(STEPS);
    (0..STEPS).map(|i| step * weight(kernel, (f64::from(i) + 0.5) * step)).sum()
}
