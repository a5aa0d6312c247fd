//! The distance from a point to a mesh.

use glam::{DVec3, IVec3};
use std::collections::HashMap;

use crate::{geometry::corners, scene::Mesh};

/// Triangles in a grid.
pub(super) struct Distances {
    triangles: Vec<[DVec3; 3]>,
    grid: HashMap<IVec3, Vec<usize>>,
    step: f64,
    /// The diagonal of the mesh's box.
    pub size: f64,
}

impl Distances {
    pub(super) fn of(mesh: &Mesh) -> Self {
        let triangles: Vec<_> = mesh.triangles.iter().filter_map(|&t| corners(mesh, t)).collect();
        let all = || triangles.iter().flatten().copied();
        let low = all().fold(DVec3::INFINITY, DVec3::min);
        let high = all().fold(DVec3::NEG_INFINITY, DVec3::max);
        let edges: f64 = triangles.iter().map(|[a, b, _]| a.distance(*b)).sum();
        let step = 2.0 * edges / triangles.len() as f64;
        let mut grid = HashMap::<IVec3, Vec<usize>>::new();
        for (i, p) in triangles.iter().enumerate() {
            let from = (p.iter().copied().fold(DVec3::INFINITY, DVec3::min) / step).floor().as_ivec3();
            let to = (p.iter().copied().fold(DVec3::NEG_INFINITY, DVec3::max) / step).floor().as_ivec3();
            for (x, y) in (from.x..=to.x).flat_map(|x| (from.y..=to.y).map(move |y| (x, y))) {
                for z in from.z..=to.z {
                    grid.entry(IVec3::new(x, y, z)).or_default().push(i);
                }
            }
        }
        Self { triangles, grid, step, size: low.distance(high) }
    }

    pub(super) fn to(&self, q: DVec3) -> f64 {
        let at = (q / self.step).floor().as_ivec3();
        let mut best = f64::INFINITY;
        for ring in 0..64_i32 {
            // What is farther than the rings that were searched can't be nearer.
            if best <= f64::from(ring - 1) * self.step {
                break;
            }
            let range = || -ring..=ring;
            for (x, y) in range().flat_map(|x| range().map(move |y| (x, y))) {
                let on_side = x.abs() == ring || y.abs() == ring;
                let all: Vec<i32> = if on_side { range().collect() } else { vec![-ring, ring] };
                for z in all {
                    for &i in self.grid.get(&(at + IVec3::new(x, y, z))).into_iter().flatten() {
                        best = best.min(to_triangle(q, self.triangles[i]));
                    }
                }
            }
        }
        best
    }
}

fn to_triangle(q: DVec3, p: [DVec3; 3]) -> f64 {
    let normal = (p[1] - p[0]).cross(p[2] - p[0]).normalize();
    let sides = [0, 1, 2].map(|i| (p[i], p[(i + 1) % 3]));
    if sides.iter().all(|(a, b)| (*b - *a).cross(q - *a).dot(normal) >= 0.0) {
        return (q - p[0]).dot(normal).abs();
    }
    let to_side = |(a, b): (DVec3, DVec3)| {
        let share = ((q - a).dot(b - a) / (b - a).length_squared()).clamp(0.0, 1.0);
        a.lerp(b, share).distance(q)
    };
    sides.map(to_side).into_iter().fold(f64::INFINITY, f64::min)
}
