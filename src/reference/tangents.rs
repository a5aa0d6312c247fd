//! The tangent vectors of a splat, as the scene tells of it.

use glam::DVec3;

use crate::scene::Shapes;

/// The scaled tangent vectors in world space, with `s × t` along the outward normal.
pub(super) fn tangents(shapes: &Shapes, i: usize) -> (DVec3, DVec3) {
    match shapes {
        Shapes::Disks { normals, radii } => {
            let normal = normals[i].as_dvec3().normalize();
            // The coordinate axis farthest from the normal is never parallel to it.
            let n = normal.abs();
            let axis = if n.x <= n.y && n.x <= n.z {
                DVec3::X
            } else if n.y <= n.z {
                DVec3::Y
            } else {
                DVec3::Z
            };
            let first = axis.cross(normal).normalize();
            let radius = f64::from(radii[i]);
            (radius * first, radius * normal.cross(first))
        }
        Shapes::Ellipses { s, t } => (s[i].as_dvec3(), t[i].as_dvec3()),
    }
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;

    #[test]
    fn the_tangents_of_a_disk_are_right_handed_for_every_normal() {
        // Axes and diagonals, at the ends of the f32 range too.
        for x in [-1.0, -0.0, 0.0, 1.0] {
            for y in [-1.0, -0.0, 0.0, 1.0] {
                for z in [-1.0, 0.0, 1.0] {
                    for length in [1e-38_f32, 1.0, 1e38] {
                        let normal = Vec3::new(x, y, z) * length;
                        if normal == Vec3::ZERO {
                            continue;
                        }
                        let shapes = Shapes::Disks { normals: vec![normal], radii: vec![2.0] };
                        let (s, t) = tangents(&shapes, 0);
                        assert!((s.length() - 2.0).abs() < 1e-14 && (t.length() - 2.0).abs() < 1e-14);
                        assert!(s.dot(t).abs() < 1e-14);
                        let expected = normal.as_dvec3().normalize();
                        assert!((s.cross(t) / 4.0 - expected).length() < 1e-14, "{normal}");
                    }
                }
            }
        }
    }
}
