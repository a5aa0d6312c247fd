//! Splats that reach the near plane, the plane of the eye, or pass behind it.

use glam::{DVec3, Vec3};

use super::*;
use crate::reference::splat::prepare;
use crate::reference::view::View;

#[test]
fn a_ground_disk_under_the_eye_covers_all_below_the_horizon() {
    // Height ½ below the eye, the center in the plane of the eye (depth 0).
    let scene = ellipses(&[(DVec3::Y * 0.5, Vec3::X * 1e4, Vec3::Z * 1e4, GRAY)]);
    for filter in [Filter::None, Filter::Adjust] {
        let settings = Settings { filter, ..settings(64) };
        let picture = picture(&scene, &settings);
        for (x, y, pixel) in pixels_at(&picture) {
            assert_eq!(pixel.is_covered(), y > 0.0, "{x}, {y}");
            if y > 0.0 {
                assert!((pixel.depth * y / 0.5 - 1.0).abs() < 1e-12, "{x}, {y}");
                assert!((DVec3::from(pixel.normal) - DVec3::NEG_Y).length() < 1e-15);
            }
        }
    }
}

#[test]
fn a_center_behind_the_eye_hides_nothing_of_what_is_before_it() {
    let scene = ellipses(&[(DVec3::new(0.0, 0.5, -3.0), Vec3::X * 5.0, Vec3::Z * 5.0, GRAY)]);
    let settings = Settings { filter: Filter::Adjust, ..settings(64) };
    let picture = picture(&scene, &settings);
    for (x, y, pixel) in pixels_at(&picture) {
        // Z = 0.5/y, X = x Z; inside iff X² + (Z + 3)² ≤ 25.
        let z = 0.5 / y;
        let inside = y > 0.0 && (x * z).powi(2) + (z + 3.0).powi(2) <= 25.0;
        assert_eq!(pixel.is_covered(), inside, "{x}, {y}");
    }
    assert!(covered(&picture) > 500);
}

#[test]
fn a_wall_beside_the_eye_is_cut_at_the_near_plane_fragment_by_fragment() {
    // The plane X = 1, center beside the eye; a 130° view and near = ⅔: depth 1/x ≥ ⅔ for x ≤ 1.5.
    let scene = ellipses(&[(DVec3::X, Vec3::Y * 3.0, Vec3::Z * 3.0, GRAY)]);
    let camera = Camera { fov_y_rad: 130.0_f64.to_radians(), near: Some(2.0 / 3.0), ..camera() };
    let settings = Settings { filter: Filter::Adjust, ..settings(80) };
    let picture = render(&scene, &camera, &settings, &|_, _| ()).unwrap();
    let scale = 65.0_f64.to_radians().tan();
    let (mut cut, mut seen) = (0, 0);
    for (x, y, pixel) in pixels_at(&picture) {
        let (x, y) = (x * scale, y * scale);
        let z = 1.0 / x;
        let inside = x > 0.0 && (y * z).powi(2) + z * z <= 9.0;
        let expected = inside && z >= 2.0 / 3.0;
        assert_eq!(pixel.is_covered(), expected, "{x}, {y}");
        cut += usize::from(inside && !expected);
        seen += usize::from(expected);
    }
    assert!(cut > 200 && seen > 500, "{cut} cut, {seen} seen");
}

#[test]
fn an_eye_inside_the_disk_sees_the_half_in_front() {
    // The disk's plane passes a hair below the eye, tilted: corners of its square have depths of both signs.
    let (sin, cos) = 20.0_f32.to_radians().sin_cos();
    let scene = ellipses(&[(DVec3::Y * 0.01, Vec3::new(cos, sin, 0.0), Vec3::Z, GRAY)]);
    let picture = picture(&scene, &settings(64));
    let normal = DVec3::new(-f64::from(sin), f64::from(cos), 0.0);
    let mut seen = 0;
    for (x, y, pixel) in pixels_at(&picture) {
        // The plane n·q = 0.01 cos: depth = 0.01 cos / (n·ray).
        let z = 0.01 * f64::from(cos) / normal.dot(DVec3::new(x, y, 1.0));
        let inside = z > 0.0 && (z * DVec3::new(x, y, 1.0) - DVec3::Y * 0.01).length() <= 1.0 - 1e-6;
        if inside {
            assert!((pixel.depth / z - 1.0).abs() < 1e-6, "{x}, {y}");
            seen += 1;
        }
        if z <= 0.0 {
            assert!(!pixel.is_covered(), "{x}, {y}");
        }
    }
    assert!(seen > 1000, "{seen}");
}

#[test]
fn a_splat_behind_the_eye_or_before_the_near_plane_is_not_seen() {
    let behind = facing_disk(DVec3::Z * -1.0, 0.5, GRAY);
    assert_eq!(covered(&picture(&ellipses(&[behind]), &settings(32))), 0);
    let close = ellipses(&[facing_disk(DVec3::Z, 0.5, GRAY)]);
    for (near, seen) in [(0.99, true), (1.0, true), (1.01, false)] {
        let camera = Camera { near: Some(near), ..camera() };
        let picture = render(&close, &camera, &settings(32), &|_, _| ()).unwrap();
        assert_eq!(covered(&picture) > 0, seen, "{near}");
    }
}

#[test]
fn no_filter_acts_on_a_splat_whose_center_is_not_in_front() {
    // A ground disk so close below the eye that its projection at the center would be thinner than the filter.
    for z in [-0.5, 0.0, 5e-7] {
        let scene = ellipses(&[(DVec3::new(0.0, 0.001, z), Vec3::X * 2.0, Vec3::Z * 2.0, GRAY)]);
        let with = |filter| picture(&scene, &Settings { filter, ..settings(64) });
        let (none, adjusted) = (with(Filter::None), with(Filter::Adjust));
        assert!(covered(&none) > 1000);
        assert_eq!(none.pixels, adjusted.pixels, "{z}");
    }
}

#[test]
fn the_margin_of_a_splat_that_reaches_the_near_plane_is_that_at_the_fragment() {
    // A ground disk of radius 10, 1e-4 below the eye, seen where its depth is 10: y = 1e-5. There the axes project
    // to 10/10 and 10 y/10; of the second, 64 pixels a unit, the disk is 6.4e-4 pixels wide.
    let view = View::pinhole(&camera(), [128, 128]);
    let settings = Settings { filter: Filter::None, ..settings(128) };
    for z in [0.0, 0.5] {
        let scene = ellipses(&[(DVec3::new(0.0, 1e-4, z), Vec3::X * 10.0, Vec3::Z * 10.0, GRAY)]);
        let (splats, _) = prepare(&scene, &view, &settings);
        let margin = splats[0].r2_margin(DVec3::new(0.0, 1e-5, 1.0), 10.0, 64.0, &view);
        let expected = 16.0 * 64.0 / 16_777_216.0 / 6.4e-4;
        assert!((margin / expected - 1.0).abs() < 1e-9, "{z}: {margin}, {expected}");
    }
}
