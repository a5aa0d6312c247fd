//! Sums of weights, by the definition of kernels.

use glam::DVec3;

use crate::{
    geometry::neighbors::{Point, Tree},
    scene::{Shapes, Splats},
};

pub(in super::super) type Kernel = fn(f64) -> f64;

/// The default kernels.
pub(super) const KERNELS: [(&str, Kernel); 2] = [("Gaussian", gaussian), ("ψ_E", psi_e)];

/// σ = ½, cut at 1.
pub(in super::super) fn gaussian(r: f64) -> f64 {
    if r <= 1.0 { (-2.0 * r * r).exp() } else { 0.0 }
}

/// ψ_E with a = 6, n = 3.
pub(in super::super) fn psi_e(r: f64) -> f64 {
    let q = r * r * r;
    if q < 1.0 { (-6.0 * q / (1.0 - q)).exp() } else { 0.0 }
}

/// Σw at each point of the surface, seen along each splat's normal.
pub(super) fn sums(splats: &Splats, w: Kernel, at: &[DVec3]) -> Vec<f64> {
    let Shapes::Disks { normals, radii } = &splats.shapes else { panic!("disks") };
    // Splats from left to right, so that only a strip of them is looked at for each point.
    let mut order: Vec<usize> = (0..splats.len()).collect();
    order.sort_by(|&a, &b| splats.positions[a].x.total_cmp(&splats.positions[b].x));
    let reach = 1.5 * f64::from(radii.iter().copied().fold(0.0, f32::max));
    let weight = |i: usize, at: DVec3| {
        let (away, radius, normal) = (at - splats.positions[i], f64::from(radii[i]), normals[i].as_dvec3());
        let near = away.length() <= 1.5 * radius;
        if near { w((away - normal * away.dot(normal)).length() / radius) } else { 0.0 }
    };
    let strip = |at: DVec3| {
        let from = order.partition_point(|&i| splats.positions[i].x < at.x - reach);
        order[from..].iter().take_while(move |&&i| splats.positions[i].x <= at.x + reach)
    };
    at.iter().map(|&at| strip(at).map(|&i| weight(i, at)).sum()).collect()
}

/// The distance from each point to the nearest of `places`.
pub(super) fn distances(points: &[DVec3], places: &[DVec3]) -> Vec<f64> {
    let numbered = (0..).zip(places).map(|(number, &position)| Point { position, number });
    let tree = Tree::new(numbered.collect());
    let nearest =
        |&point: &DVec3| tree.nearest_to(point, f64::INFINITY).map_or(f64::INFINITY, |n| n.distance);
    points.iter().map(nearest).collect()
}
