//! The low-pass filter by tangent adjustment (Guennebaud, Barthe, Paulin 2006, section 4.1).
//!
//! The paper adjusts each tangent vector by itself, which holds only where their projections are orthogonal, and
//! makes the short ones as long as the filter. Here the parametrization is rotated first, so that they are
//! orthogonal, for disks and ellipses alike; and an axis becomes as long as that of the convolution of kernel and
//! filter, whose covariances add. Lengths and directions are those of the affine approximation of the projection at
//! the center.

use glam::{DVec2, DVec3};

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

/// How much thicker a surface of transparent splats is in a pixel, in radii, where a filter of radius `h` (image plane) lengthens
/// the minor axis of their images from l to L = √(l² + h²), at most to so many times l. A splat whose center is L away, where the surface
/// is r L / l deeper, makes up r of that by its slant: fragments are up to r (L / l − 1) off, to either side.
///
/// This is L / l.
pub(super) fn lengthened(center: DVec3, s: DVec3, t: DVec3, h: f64, most: f64) -> f64 {
    let minor = minor_axis(projected(center, s), projected(center, t));
    if minor > 0.0 { (1.0 + (h / minor).powi(2)).sqrt().min(most) } else { most }
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
/// of `new` (tangent vectors, at the center), at most 1 and at least `least`.
pub(super) fn area_share(center: DVec3, old: (DVec3, DVec3), new: (DVec3, DVec3), least: f64) -> f64 {
    let area = |(s, t)| projected(center, s).perp_dot(projected(center, t)).abs();
    let share = area(old) / area(new);
    // Written so that 0/0 is the least share.
    if share >= least { share.min(1.0) } else { least }
}

/// Below this many `h` an axis loses its depth as it vanishes: which of its ends is nearer can't be told where it
/// projects to nothing.
const OWN_DEPTH: f64 = 1.0 / 16.0;

/// How much of the square of the axis, and of the filter's, is drawn: a little less than all of it.
const PART_OF_AXIS: f64 = 250.0 / 251.0;
const PART_OF_FILTER: f64 = 609.0 / 610.0;

/// The projected semi-axis that is drawn in place of one of length `l`: `√(l² + h²)` but for 0.2%, `h` below `h`/24, and
/// `l` from 16 `h` on.
pub(super) fn widened(l: f64, h: f64) -> f64 {
    (PART_OF_AXIS * l * l + PART_OF_FILTER * h * h).sqrt().max(l).max(h)
}

/// The tangent vectors that are drawn in place of `s` and `t`: each of the ellipse's projected semi-axes is [`widened`]
/// (image-plane units). All in view space; `center.z` must be above 0.
pub(super) fn adjust(center: DVec3, s: DVec3, t: DVec3, h: f64) -> (DVec3, DVec3) {
    let (s, t) = orthogonalized(center, s, t);
    let (a, b) = (projected(center, s), projected(center, t));
    let long = a.try_normalize().unwrap_or(DVec2::X);
    // The short axis' own direction; it exists even where the disk is seen exactly from its edge.
    let short = if long.perp_dot(b) < 0.0 { -long.perp() } else { long.perp() };
    let axis = |v: DVec3, length: f64, direction: DVec2| {
        // Eq. 9 would have z = 0. The vector with this depth whose projection is the drawn axis:
        let z = v.z * (length / (OWN_DEPTH * h)).min(1.0);
        (direction * (widened(length, h) * center.z) + center.truncate() / center.z * z).extend(z)
    };
    (axis(s, a.length(), long), axis(t, b.length(), short))
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
    fn the_drawn_ellipse_has_the_widened_axes_in_the_same_directions() {
        let mut random = Random(1);
        let h = 0.01;
        let mut magnified = [0; 3];
        for case in 0..4000 {
            let center =
                DVec3::new(random.within(-3.0, 3.0), random.within(-3.0, 3.0), random.within(0.5, 8.0));
            let first = random.direction();
            let second = first.cross(random.direction()).normalize();
            let size = center.z * h * 10.0_f64.powf(random.within(-2.0, 3.0));
            let aspect = random.within(1.0, 50.0);
            let mix_rad = random.within(0.0, 6.3);
            // Tangent vectors that are not the ellipse's axes, and not orthogonal.
            let (major, minor) = (first * size, second * (size / aspect));
            let (sin, cos) = mix_rad.sin_cos();
            let (s, t) = (cos * major + sin * minor, cos * minor - sin * major);

            let (drawn_s, drawn_t) = adjust(center, s, t, h);
            let (large, small, direction) = eigen(ellipse(center, s, t));
            let expected = (widened(large.sqrt(), h), widened(small.max(0.0).sqrt(), h));
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

            magnified[usize::from(large.sqrt() >= h) + usize::from(small.sqrt() >= h)] += 1;
        }
        assert!(magnified.iter().all(|&n| n > 100), "every kind occurs: {magnified:?}");
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
    fn a_widened_axis_is_nearly_the_sum_of_covariances_and_grows_without_a_step() {
        let h = 0.01;
        assert_eq!(widened(0.0, h), h);
        let mut before = h;
        for i in 1..=4000 {
            let l = h * f64::from(i) / 100.0;
            let drawn = widened(l, h);
            assert!(drawn >= l && drawn >= before && drawn - before < 0.011 * h, "{i}");
            // Shortest where it ends: 16 / √257.
            let ratio = drawn / l.hypot(h);
            assert!((0.998..=1.0).contains(&ratio), "{i}: {ratio}");
            before = drawn;
        }
        assert_eq!(widened(17.0 * h, h), 17.0 * h);
    }

    #[test]
    fn a_widened_axis_keeps_its_depth_until_it_all_but_vanishes() {
        let (center, h) = (DVec3::new(3.0, -2.0, 100.0), 0.01);
        // Of length l on the screen, the shorter one.
        let drawn = |l: f64| {
            let depth = 0.3;
            let t = (DVec2::Y * (l * center.z) + center.truncate() / center.z * depth).extend(depth);
            let (s, t) = adjust(center, DVec3::X * (5.0 * h * center.z), t, h);
            assert!((s - DVec3::X * (widened(5.0 * h, h) * center.z)).length() < 1e-12, "{s}");
            t
        };
        for l in [0.1 * h, h, 3.9 * h] {
            let t = drawn(l);
            assert!((t.z - 0.3).abs() < 1e-12, "{l}: {t}");
            assert!((projected(center, t) - DVec2::Y * widened(l, h)).length() < 1e-12, "{l}: {t}");
        }
        assert!((drawn(h / 32.0).z - 0.15).abs() < 1e-12);
        assert!((drawn(-h / 32.0).z - 0.15).abs() < 1e-12);
        // Across the edge-on position nothing jumps: t turns around, with what little depth it has.
        let (below, above) = (drawn(-1e-9 * h), drawn(1e-9 * h));
        assert!((below + above).length() < 1e-5 * h, "{below} {above}");
    }

    #[test]
    fn an_edge_on_disk_becomes_a_band_of_the_filters_width() {
        // Its plane holds the eye: t points along the ray and projects to nothing.
        let center = DVec3::new(0.0, 0.0, 2.0);
        let (s, t) = adjust(center, DVec3::X, DVec3::Z, 0.01);
        assert!((s.abs() - DVec3::X * widened(0.5, 0.01) * 2.0).length() < 1e-15, "{s}");
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
