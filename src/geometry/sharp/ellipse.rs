//! From a triangle to the ellipse through its corners (Ivo et al. 2012, section 5.1): the image of the circle around an equilateral triangle
//! under the affine map that makes it the triangle. No ellipse around the triangle has less area.

use glam::DVec3;

/// Center and orthogonal semi-axes, with s × t along the triangle's normal. `None` of a triangle without area.
pub(super) fn ellipse(p: [DVec3; 3]) -> Option<(DVec3, DVec3, DVec3)> {
    let center = (p[0] + p[1] + p[2]) / 3.0;
    let normal = (p[1] - p[0]).cross(p[2] - p[0]).try_normalize()?;
    // The map T of the unit circle: conjugate half axes to a corner and along the opposite side. Its axes are those of T Tᵀ (equations 17, 18).
    let (to_corner, along) = (p[0] - center, (p[1] - p[2]) / 3.0_f64.sqrt());
    let x = along.try_normalize()?;
    let y = normal.cross(x);
    let [a, b] = [to_corner, along].map(|v| [v.dot(x), v.dot(y)]);
    let entry = |i: usize, j: usize| a[i] * a[j] + b[i] * b[j];
    let (xx, xy, yy) = (entry(0, 0), entry(0, 1), entry(1, 1));
    let angle = 0.5 * (2.0 * xy).atan2(xx - yy);
    let (sin, cos) = angle.sin_cos();
    let major = (0.5 * (xx + yy) + (0.5 * (xx - yy)).hypot(xy)).sqrt();
    // By the area, which is that of the map: a difference would lose it.
    let minor = (a[0] * b[1] - a[1] * b[0]).abs() / major;
    let (s, t) = (major * (cos * x + sin * y), minor * (cos * y - sin * x));
    (s.is_finite() && t.is_finite() && minor > 0.0).then_some((center, s, t))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ellipse_passes_through_the_corners_and_is_centered() {
        let triangles = [
            [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.5, 0.75_f64.sqrt(), 0.0]],
            [[1.0, 2.0, 3.0], [4.0, -1.0, 0.5], [0.0, 0.1, 9.0]],
            [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.3, 1e-5, 0.0]],
            [[1e6, 0.0, 0.0], [1e6 + 1.0, 0.0, 0.0], [1e6, 2.0, 0.0]],
        ];
        for corners in triangles {
            let p = corners.map(DVec3::from);
            let (center, s, t) = ellipse(p).unwrap();
            let area = 0.5 * (p[1] - p[0]).cross(p[2] - p[0]).length();
            for corner in p {
                let (u, v) = ((corner - center).dot(s), (corner - center).dot(t));
                let r2 = (u / s.length_squared()).powi(2) + (v / t.length_squared()).powi(2);
                assert!((r2 - 1.0).abs() < 1e-6, "{p:?}: {r2}");
            }
            assert!(s.cross(t).dot((p[1] - p[0]).cross(p[2] - p[0])) > 0.0);
            assert!((s.cross(t).length() / area - 4.0 / 27.0_f64.sqrt()).abs() < 1e-6);
        }
        assert_eq!(ellipse([DVec3::ZERO, DVec3::X, 2.0 * DVec3::X]), None);
    }
}
