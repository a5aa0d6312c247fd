//! Radii of disks at the vertices that leave no hole.
//!
//! **The rule.** Give every point of a triangle to its nearest corner. A corner's disk must then reach the farthest of
//! its points; that is the least that covers the triangle when each corner covers the points nearest to it. In a
//! triangle without an obtuse angle this is the circumcenter, at distance `R` from all three corners. With an obtuse
//! angle at A the circumcenter is outside; the farthest points are where the bisectors of AB and AC meet the edge BC,
//! at `c/(2 cos B)` from B and `b/(2 cos C)` from C, the farther of which is A's.
//!
//! The disk lies in the vertex's tangent plane, at an angle θ to the triangle. Seen along the triangle's normal its
//! shorter half axis is `r cos θ`: dividing the reach by `cos θ` makes it cover what it must from there. θ is taken as
//! at most 60°: beyond that, at sharp edges, disks would stick out far.

use glam::DVec3;

use super::corners;
use crate::scene::Mesh;

/// cos 60°.
pub(super) const MIN_COS_TILT: f64 = 0.5;

/// For each vertex the smallest radius that leaves no hole; 0 without faces. `normals` are unit or zero.
pub(super) fn hole_free_radii(mesh: &Mesh, normals: &[DVec3]) -> Vec<f64> {
    let mut radii = vec![0.0_f64; mesh.positions.len()];
    for &triangle in &mesh.triangles {
        let Some(p) = corners(mesh, triangle) else { continue };
        let normal = (p[1] - p[0]).cross(p[2] - p[0]).normalize();
        for (vertex, reach) in triangle.into_iter().zip(reaches(p)) {
            let vertex = vertex as usize;
            let cos_tilt = normals[vertex].dot(normal).abs().max(MIN_COS_TILT);
            radii[vertex] = radii[vertex].max(reach / cos_tilt);
        }
    }
    radii
}

/// The smallest radius that corner `place` of one triangle needs of a disk with that unit normal.
pub(super) fn hole_free_radius(p: [DVec3; 3], place: usize, normal: DVec3) -> f64 {
    let face = (p[1] - p[0]).cross(p[2] - p[0]).normalize();
    reaches(p)[place] / normal.dot(face).abs().max(MIN_COS_TILT)
}

/// How far each corner's disk must reach in the triangle's plane.
fn reaches(p: [DVec3; 3]) -> [f64; 3] {
    // Edge i is opposite to corner i.
    let edges = [p[2] - p[1], p[0] - p[2], p[1] - p[0]];
    let lengths = edges.map(DVec3::length);
    // |AB||AC| cos A at each corner.
    let dots = [-edges[1].dot(edges[2]), -edges[2].dot(edges[0]), -edges[0].dot(edges[1])];
    match dots.iter().position(|&dot| dot < 0.0) {
        None => {
            let doubled_area = edges[0].cross(edges[1]).length();
            [lengths[0] * lengths[1] * lengths[2] / (2.0 * doubled_area); 3]
        }
        Some(a) => {
            let (b, c) = ((a + 1) % 3, (a + 2) % 3);
            // c/(2 cos B) = c · c·a / (2 c·a cos B), with c the edge from A to B.
            let reach = |corner: usize, to_a: usize| {
                lengths[to_a] * lengths[to_a] * lengths[a] / (2.0 * dots[corner])
            };
            let mut reaches = [0.0; 3];
            reaches[b] = reach(b, c);
            reaches[c] = reach(c, b);
            reaches[a] = reaches[b].max(reaches[c]);
            reaches
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The definition itself, sampled: the farthest point among those nearest to each corner.
    fn sampled_reaches(p: [DVec3; 3], steps: u32) -> [f64; 3] {
        let mut farthest = [0.0_f64; 3];
        for i in 0..=steps {
            for j in 0..=steps - i {
                let (u, v) = (f64::from(i) / f64::from(steps), f64::from(j) / f64::from(steps));
                let q = p[0] + u * (p[1] - p[0]) + v * (p[2] - p[0]);
                let distances = p.map(|corner| corner.distance(q));
                let nearest = distances.iter().copied().fold(f64::INFINITY, f64::min);
                for (far, d) in farthest.iter_mut().zip(distances) {
                    if d <= nearest * (1.0 + 1e-9) {
                        *far = far.max(d);
                    }
                }
            }
        }
        farthest
    }

    #[test]
    fn reaches_are_those_of_the_definition() {
        let triangles = [
            [DVec3::ZERO, DVec3::X, DVec3::new(0.5, 0.8, 0.3)],
            [DVec3::ZERO, DVec3::X, DVec3::Y],
            [DVec3::ZERO, DVec3::X, DVec3::new(0.4, 0.1, 0.0)],
            [DVec3::new(0.9, 0.05, 0.0), DVec3::ZERO, DVec3::X],
            [DVec3::ZERO, DVec3::new(-0.5, 0.2, 0.0), DVec3::new(3.0, 0.0, 1.0)],
        ];
        for p in triangles {
            let (exact, sampled) = (reaches(p), sampled_reaches(p, 600));
            for (e, s) in exact.into_iter().zip(sampled) {
                assert!(s <= e * (1.0 + 1e-9) && s >= 0.98 * e, "{p:?}: {exact:?} {sampled:?}");
            }
        }
    }
}
