//! The low-pass filter by tangent adjustment (Guennebaud, Barthe, Paulin 2006, section 4.1).
//!
//! The paper adjusts each tangent vector by itself, which holds only where their projections are orthogonal. Here
//! the parametrization is rotated first, so that they are, for disks and ellipses alike; lengths and directions are
//! those of the affine approximation of the projection at the center.

use glam::{DVec2, DVec3};

use crate::scene::LEAST_SHARE;

/// The image-plane motion of a view-space point `at` that moves along `v`: the Jacobian of `(X/Z, Y/Z)`.
pub(super) fn projected(at: DVec3, v: DVec3) -> DVec2 {
    (v.truncate() - at.truncate() / at.z * v.z) / at.z
}

/// The shorter semi-axis of the ellipse `{u a + v b : u² + v² = 1}`.
pub(super) fn minor_axis(a: DVec2, b: DVec2) -> f64 {
    // The singular values of [a b] have the product |det| and the larger one loses nothing to cancellation.
    let major = (0.5
        * (a.length_squared()
            + b.length_squared()
            + (a.length_squared() - b.length_squared()).hypot(2.0 * a.dot(b))))
    .sqrt();
    if major > 0.0 { a.perp_dot(b).abs() / major } else { 0.0 }
}

/// `s` and `t` after the rotation of the parametrization that makes their projections orthogonal, the first one the
/// longer. It moves the rim along itself: the disk stays.
pub(super) fn orthogonalized(center: DVec3, s: DVec3, t: DVec3) -> (DVec3, DVec3) {
    let (a, b) = (projected(center, s), projected(center, t));
    let theta_rad = 0.5 * (2.0 * a.dot(b)).atan2(a.length_squared() - b.length_squared());
    let (sin, cos) = theta_rad.sin_cos();
    (cos * s + sin * t, cos * t - sin * s)
}

/// The share of its weight that an adjusted splat keeps under a weight by area: the projected area of `old` over that
/// of `new` (tangent vectors, at the center), at most 1 and at least [`LEAST_SHARE`].
pub(super) fn area_share(center: DVec3, old: (DVec3, DVec3), new: (DVec3, DVec3)) -> f64 {
    let area = |(s, t)| projected(center, s).perp_dot(projected(center, t)).abs();
    let share = area(old) / area(new);
    // Written so that 0/0 is the least share.
    if share >= LEAST_SHARE { share.min(1.0) } else { LEAST_SHARE }
}

/// The tangent vectors that are drawn in place of `s` and `t`: none of the ellipse's projected semi-axes is shorter
/// than `h` (image-plane units). All in view space; `center.z` must be above 0.
pub(super) fn adjust(center: DVec3, s: DVec3, t: DVec3, h: f64) -> (DVec3, DVec3) {
    let (s, t) = orthogonalized(center, s, t);
    let (a, b) = (projected(center, s), projected(center, t));
    let long = a.try_normalize().unwrap_or(DVec2::X);
    // The short axis' own direction but for the sign, which the symmetric disk does not show; it exists even
    // where the disk is seen exactly from its edge.
    let short = long.perp();
    // eq. 9: parallel to the screen, of projected length h.
    let parallel = |direction: DVec2| direction.extend(0.0) * (center.z * h);
    (if a.length() < h { parallel(long) } else { s }, if b.length() < h { parallel(short) } else { t })
}

#[cfg(test)]
mod tests {
    use glam::DMat2;

    use super::super::tests::Random;
    use super::*;

    /// The ellipse as the matrix `a aᵀ + b bᵀ`: the same for every parametrization.
    fn ellipse(center: DVec3, s: DVec3, t: DVec3) -> DMat2 {
        let (a, b) = (projected(center, s), projected(center, t));
        DMat2::from_cols(a * a.x + b * b.x, a * a.y + b * b.y)
    }

    /// Eigenvalues (larger first) and the unit eigenvector of the larger.
    fn eigen(m: DMat2) -> (f64, f64, DVec2) {
        let (p, q, r) = (m.x_axis.x, m.x_axis.y, m.y_axis.y);
        let root = (0.5 * (p - r)).hypot(q);
        let large = 0.5 * (p + r) + root;
        let small = (p * r - q * q) / large;
        // Of the two forms of the eigenvector, the one without cancellation.
        let v = if p >= r { DVec2::new(large - r, q) } else { DVec2::new(q, large - p) };
        (large, small, v.normalize())
    }

    #[test]
    fn the_drawn_ellipse_has_the_clamped_axes_in_the_same_directions() {
        let mut random = Random(1);
        let h = 0.01;
        let mut clamped = [0; 3];
        for case in 0..4000 {
            let center =
                DVec3::new(random.within(-3.0, 3.0), random.within(-3.0, 3.0), random.within(0.5, 8.0));
            let first = random.direction();
            let second = first.cross(random.direction()).normalize();
            let size = center.z * h * 10.0_f64.powf(random.within(-2.0, 1.5));
            let aspect = random.within(1.0, 50.0);
            let mix_rad = random.within(0.0, 6.3);
            // Tangent vectors that are not the ellipse's axes, and not orthogonal.
            let (major, minor) = (first * size, second * (size / aspect));
            let (sin, cos) = mix_rad.sin_cos();
            let (s, t) = (cos * major + sin * minor, cos * minor - sin * major);

            let (drawn_s, drawn_t) = adjust(center, s, t, h);
            let (large, small, direction) = eigen(ellipse(center, s, t));
            let expected = (large.sqrt().max(h), small.max(0.0).sqrt().max(h));
            let drawn = ellipse(center, drawn_s, drawn_t);
            let along = |v: DVec2| v.dot(drawn * v).sqrt();
            // A near-circle has no directions to check; its axes are equal in all of them.
            let tolerance = 1e-10 * expected.0;
            if large - small > 1e-4 * large {
                assert!((along(direction) - expected.0).abs() < tolerance, "case {case}");
                assert!((along(direction.perp()) - expected.1).abs() < tolerance, "case {case}");
            }
            let (drawn_large, drawn_small, _) = eigen(drawn);
            assert!((drawn_large.sqrt() - expected.0).abs() < tolerance, "case {case}");
            assert!((drawn_small.sqrt() - expected.1).abs() < tolerance, "case {case}");
            let (a, b) = (projected(center, drawn_s), projected(center, drawn_t));
            assert!((minor_axis(a, b) - expected.1).abs() < tolerance, "case {case}");

            let count = usize::from(large.sqrt() < h) + usize::from(small.sqrt() < h);
            clamped[count] += 1;
            if count == 0 {
                // The disk itself is untouched: s sᵀ + t tᵀ stays.
                let probe = random.direction();
                let support = |s: DVec3, t: DVec3| s.dot(probe).hypot(t.dot(probe));
                assert!((support(s, t) - support(drawn_s, drawn_t)).abs() < 1e-12 * size, "case {case}");
            }
        }
        assert!(clamped.iter().all(|&n| n > 100), "every kind occurs: {clamped:?}");
    }

    #[test]
    fn the_jacobian_is_the_difference_quotient_of_the_projection() {
        let mut random = Random(5);
        for _ in 0..100 {
            let at = DVec3::new(random.within(-3.0, 3.0), random.within(-3.0, 3.0), random.within(0.5, 8.0));
            let v = random.direction();
            let image = |step: f64| (at + step * v).truncate() / (at + step * v).z;
            let quotient = (image(1e-5) - image(-1e-5)) / 2e-5;
            assert!((projected(at, v) - quotient).length() < 1e-7);
        }
    }

    #[test]
    fn an_adjusted_axis_is_parallel_to_the_screen() {
        // Far away and tilted: both axes are replaced.
        let center = DVec3::new(3.0, -2.0, 100.0);
        let (s, t) = adjust(center, DVec3::new(1e-3, 0.0, 1e-3), DVec3::new(0.0, 1e-3, 0.0), 0.01);
        assert_eq!((s.z, t.z), (0.0, 0.0));
        assert!((s.length() - 1.0).abs() < 1e-12 && (t.length() - 1.0).abs() < 1e-12);
    }

    #[test]
    fn an_edge_on_disk_becomes_a_band_of_the_filters_width() {
        // Its plane holds the eye: t points along the ray and projects to nothing.
        let center = DVec3::new(0.0, 0.0, 2.0);
        let (s, t) = adjust(center, DVec3::X, DVec3::Z, 0.01);
        assert_eq!(s.abs(), DVec3::X);
        assert!((t.abs() - DVec3::new(0.0, 0.02, 0.0)).length() < 1e-16);
    }

    #[test]
    fn a_splat_that_projects_to_nothing_takes_the_pixel_axes() {
        let center = DVec3::new(1.0, 1.0, 2.0);
        let nothing = 1e-200;
        let (s, t) = adjust(center, DVec3::X * nothing, DVec3::Y * nothing, 0.01);
        assert_eq!((s.abs(), t.abs()), (DVec3::X * 0.02, DVec3::Y * 0.02));
    }
}
