//! The two affine maps: where they are exact, and where they are not.

use glam::{DMat2, DVec2, DVec3, Vec3};

use super::*;
use crate::reference::affine::ImageEllipse;
use crate::reference::filter::{orthogonalized, projected};

const AFFINE: [Rasterizer; 2] = [Rasterizer::AffineCenter, Rasterizer::AffineContour];

fn with(rasterizer: Rasterizer) -> Settings {
    Settings { rasterizer, ..settings(64) }
}

fn at_center(center: DVec3, s: DVec3, t: DVec3) -> ImageEllipse {
    let (s, t) = orthogonalized(center, s, t);
    ImageEllipse::exact_at_center(center, s, t)
}

fn tangents((center, s, t, _): Ellipse) -> (DVec3, DVec3, DVec3) {
    (center, s.as_dvec3(), t.as_dvec3())
}

/// The image point of the rim at `angle_rad`.
fn rim((center, s, t): (DVec3, DVec3, DVec3), angle_rad: f64) -> DVec2 {
    let q = center + angle_rad.cos() * s + angle_rad.sin() * t;
    q.truncate() / q.z
}

#[test]
fn a_splat_parallel_to_the_screen_is_the_same_under_every_map() {
    let ellipse = (DVec3::new(0.7, -0.4, 2.0), Vec3::new(0.5, 0.1, 0.0), Vec3::new(0.3, -0.9, 0.0), GRAY);
    let (exact, view) = drawn(ellipse, &with(Rasterizer::Perspective));
    for rasterizer in AFFINE {
        let (affine, _) = drawn(ellipse, &with(rasterizer));
        for step in 0..100 {
            let ray = view.ray(step * 7 % 64, step * 11 % 64);
            let (a, b) = (affine.hit(ray, view.near).unwrap(), exact.hit(ray, view.near).unwrap());
            assert!(
                (a.r2() - b.r2()).abs() < 1e-13 * b.r2().max(1.0) && a.z == b.z,
                "{rasterizer:?}: {a:?} {b:?}"
            );
        }
    }
}

#[test]
fn the_contour_is_that_of_the_splat_and_the_other_map_misses_it() {
    let mut random = Random(11);
    let mut worst_at_center = 0.0_f64;
    for case in 0..1000 {
        // |s|, |t| ≤ 0.6 z: depth radius at most 0.85 z.
        let splat = tangents(random_ellipse(&mut random, 0.6, 2.0));
        let (center, s, t) = splat;
        let contour = ImageEllipse::exact_contour(center, s, t);
        let other = at_center(center, s, t);
        // r² feels a rounding of x by as much as it is over the semi-minor axis.
        let tolerance = 1e-13 * (1.0 + 2.0 / contour.lengths[1]);
        for step in 0..12 {
            let x = rim(splat, f64::from(step));
            let r2 = contour.uv(x).length_squared();
            assert!((r2 - 1.0).abs() < tolerance, "case {case}: {:e}", r2 - 1.0);
            worst_at_center = worst_at_center.max((other.uv(x).length_squared() - 1.0).abs());
        }
    }
    assert!(worst_at_center > 0.5, "{worst_at_center}");
}

#[test]
fn the_contour_is_that_of_the_definition() {
    // Without the rearrangement; at these sizes the difference keeps its digits.
    let mut random = Random(12);
    for _ in 0..200 {
        let (center, s, t) = tangents(random_ellipse(&mut random, 0.5, 1.5));
        let q = |i: usize, j: usize| s[i] * s[j] + t[i] * t[j] - center[i] * center[j];
        let e = DVec2::new(q(0, 2), q(1, 2)) / q(2, 2);
        let entry = |i: usize, j: usize| e[i] * e[j] - q(i, j) / q(2, 2);
        let shape = DMat2::from_cols_array(&[entry(0, 0), entry(0, 1), entry(0, 1), entry(1, 1)]);
        let contour = ImageEllipse::exact_contour(center, s, t);
        assert!((contour.center - e).length() < 1e-14);
        let [a, b] = [0, 1].map(|i| contour.directions[i] * contour.lengths[i]);
        let built = DMat2::from_cols(a * a.x + b * b.x, a * a.y + b * b.y);
        let difference = built - shape;
        let worst = difference.to_cols_array().map(f64::abs).into_iter().fold(0.0, f64::max);
        assert!(worst < 1e-12, "{worst:e}");
    }
}

#[test]
fn a_tiny_splat_is_the_same_under_every_map() {
    // Radius over distance 1e-9. The definition's own difference would keep no digit: 2⁻⁵³/1e-18.
    let mut random = Random(13);
    for case in 0..200 {
        let (center, s, t) = tangents(random_ellipse(&mut random, 1e-9, 3.0));
        let (contour, other) = (ImageEllipse::exact_contour(center, s, t), at_center(center, s, t));
        for i in 0..2 {
            let ratio = contour.lengths[i] / other.lengths[i];
            // The maps differ by the depth over the splat, 1e-9; the tilt of some multiplies that.
            assert!((ratio - 1.0).abs() < 1e-6, "case {case}: {ratio}");
        }
        assert!((contour.center - other.center).length() < 1e-15, "case {case}");
    }
}

#[test]
fn at_the_center_the_map_and_its_derivatives_are_exact() {
    let mut random = Random(14);
    for case in 0..300 {
        let (center, s, t) = tangents(random_ellipse(&mut random, 0.3, 2.0));
        let map = at_center(center, s, t);
        let c = center.truncate() / center.z;
        // [a b]⁻¹ in its own words: u = δ×b / a×b, v = a×δ / a×b.
        let (a, b) = (projected(center, s), projected(center, t));
        for step in 0..8 {
            let (u, v) = (f64::from(step).cos(), f64::from(step).sin());
            let delta = a * u + b * v;
            assert!((map.uv(c + delta).length_squared() - 1.0).abs() < 1e-9, "case {case}");
            // The point of the splat's own (u, v), a millionth of it: the map is wrong in second order only.
            let small = 1e-6;
            let q = center + small * (u * s + v * t);
            let r = map.uv(q.truncate() / q.z).length() / small;
            // |d²x| ≲ 2 (|s_z| + |t_z|)/z · |dx|, and a thin ellipse multiplies it by its aspect.
            let tolerance = 1e-6 * (1.0 + 4.0 * map.lengths[0] / map.lengths[1]) + 1e-9 / map.lengths[1];
            assert!((r - 1.0).abs() < tolerance, "case {case}: {r}");
        }
    }
}

#[test]
fn the_depth_is_that_of_the_plane_and_an_edge_shows_nothing() {
    let tilted = (DVec3::new(0.2, 0.1, 2.0), Vec3::new(0.6, 0.0, 0.7), Vec3::new(0.0, 0.8, 0.2), GRAY);
    let exact = picture(&ellipses(&[tilted]), &with(Rasterizer::Perspective));
    for rasterizer in AFFINE {
        let affine = picture(&ellipses(&[tilted]), &with(rasterizer));
        let mut both = 0;
        for (a, b) in affine.pixels.iter().zip(&exact.pixels) {
            if a.is_covered() && b.is_covered() {
                assert!((a.depth - b.depth).abs() < 1e-14);
                both += 1;
            }
        }
        assert!(both > 100, "{both}");
        let center = DVec3::new(0.25, 0.5, 1.0);
        let edge_on = ellipses(&[(center, center.as_vec3() * 0.5, Vec3::X, GRAY)]);
        for side_px in [64, 65] {
            assert_eq!(covered(&picture(&edge_on, &Settings { rasterizer, ..settings(side_px) })), 0);
        }
    }
}

#[test]
fn beyond_its_range_an_affine_map_hands_over_to_the_exact_one() {
    // The depth radius is 0.9 of the depth at t_z = 1.8.
    for (t_z, hands_over) in [(1.79, false), (1.81, true), (2.5, true)] {
        let scene = ellipses(&[(DVec3::Z * 2.0, Vec3::X * 0.5, Vec3::new(0.0, 0.6, t_z), GRAY)]);
        let exact = picture(&scene, &with(Rasterizer::Perspective));
        for rasterizer in AFFINE {
            let affine = picture(&scene, &with(rasterizer));
            assert_eq!(affine.pixels == exact.pixels, hands_over, "{t_z} {rasterizer:?}");
        }
        let ewa = Settings { filter: Filter::Ewa, ..settings(64) };
        assert_eq!(picture(&scene, &ewa).pixels == exact.pixels, hands_over, "{t_z} ewa");
    }
}

#[test]
fn all_the_other_rasterizers_draw_the_same_picture() {
    use Rasterizer::{PerspectivePaper, Quad, Raycast, Triangle};
    let mut random = Random(15);
    let list: Vec<_> = (0..30).map(|_| random_ellipse(&mut random, 0.3, 2.0)).collect();
    let expected = picture(&ellipses(&list), &with(Rasterizer::Perspective));
    for rasterizer in [PerspectivePaper, Quad, Raycast, Triangle] {
        assert_eq!(picture(&ellipses(&list), &with(rasterizer)).pixels, expected.pixels, "{rasterizer:?}");
    }
    for rasterizer in AFFINE {
        assert_ne!(picture(&ellipses(&list), &with(rasterizer)).pixels, expected.pixels, "{rasterizer:?}");
    }
}
