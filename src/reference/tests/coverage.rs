//! Which pixels a splat covers.

use std::f64::consts::PI;

use glam::{DVec3, Vec3};

use super::*;
use crate::reference::filter::widened;
use crate::reference::intersect::r2_margin;
use crate::reference::kernel::limit_r2;
use crate::reference::search_box::SearchBox;
use crate::reference::splat::{DrawnSplat, prepare};
use crate::reference::view::View;

#[test]
fn a_disk_parallel_to_the_screen_covers_its_area() {
    let settings = settings(255);
    let radius_px = 80.0;
    // At depth 2 a focal length of 127.5 pixels shows 63.75 pixels a unit.
    let scene = ellipses(&[facing_disk(DVec3::new(0.1, -0.2, 2.0), (radius_px / 63.75) as f32, GRAY)]);
    let picture = picture(&scene, &settings);
    let area_px = covered(&picture) as f64;
    // Lattice points in a circle: off by less than a few times the square root of the radius.
    assert!((area_px - PI * radius_px * radius_px).abs() < 40.0, "{area_px}");
}

#[test]
fn every_covered_pixel_is_inside_the_circle_and_every_empty_one_outside() {
    let (center, radius) = (DVec3::new(0.3, 0.2, 2.0), 0.75_f64);
    // h is √2 pixels, 2√2/101 in the image plane and twice that at depth 2.
    let widened = widened(radius, 4.0 * 2.0_f64.sqrt() / 101.0);
    let filtered = Settings { filter: Filter::Adjust, ..settings(101) };
    for (settings, radius) in [(settings(101), radius), (filtered, widened)] {
        let picture = picture(&ellipses(&[facing_disk(center, 0.75, GRAY)]), &settings);
        for (x, y, pixel) in pixels_at(&picture) {
            let inside = (2.0 * x - 0.3).hypot(2.0 * y - 0.2) <= radius;
            assert_eq!(pixel.is_covered(), inside, "{x}, {y}");
        }
        assert!(covered(&picture) > 1000);
    }
}

#[test]
fn a_center_off_screen_on_each_side_and_corner_hides_nothing() {
    let settings = settings(64);
    for (dx, dy) in [(1_i32, 0_i32), (-1, 0), (0, 1), (0, -1), (1, 1), (1, -1), (-1, 1), (-1, -1)] {
        for outside_px in [1.0, 10.0, 50.0, 200.0] {
            // At depth 1 a pixel is 1/32 wide; the disk reaches 10 pixels into the image.
            let distance = 1.0 + outside_px / 32.0;
            let center = DVec3::new(f64::from(dx) * distance, f64::from(dy) * distance, 1.0);
            let corner = f64::from(dx.abs() + dy.abs()).sqrt();
            let radius = ((outside_px * corner + 10.0) / 32.0) as f32;
            let picture = picture(&ellipses(&[facing_disk(center, radius, GRAY)]), &settings);
            for (x, y, pixel) in pixels_at(&picture) {
                let inside = (x - center.x).hypot(y - center.y) <= f64::from(radius);
                assert_eq!(pixel.is_covered(), inside, "{dx},{dy} at {outside_px} px: {x}, {y}");
            }
            assert!(covered(&picture) >= 50, "{dx},{dy} at {outside_px} px");
        }
    }
}

#[test]
fn a_disk_larger_than_everything_covers_every_pixel() {
    let scene = ellipses(&[facing_disk(DVec3::new(3.0, 1.0, 1.0), 100.0, GRAY)]);
    assert_eq!(covered(&picture(&scene, &settings(64))), 64 * 64);
}

#[test]
fn with_the_filter_no_splat_falls_between_pixel_centers_and_without_it_does() {
    let settings = Settings { filter: Filter::Adjust, ..settings(32) };
    for radius in [1e-9, 1e-6, 1e-3_f32] {
        for step in 0..100 {
            // Depth 1: a pixel is 1/16 wide. Every place within a pixel, on a grid of tenths.
            let place = |n: i32| (f64::from(n) + 0.3) / 160.0;
            let center = DVec3::new(place(step % 10), place(step / 10), 1.0);
            let scene = ellipses(&[facing_disk(center, radius, GRAY)]);
            let seen = covered(&picture(&scene, &settings));
            // A circle of radius √2: area 2π.
            assert!((4..=9).contains(&seen), "radius {radius}, step {step}: {seen}");
            let unfiltered = Settings { filter: Filter::None, ..settings.clone() };
            assert_eq!(covered(&picture(&scene, &unfiltered)), 0, "radius {radius}, step {step}");
        }
    }
}

#[test]
fn the_kernels_cutoff_shrinks_the_covered_disk() {
    // exp(−r²/2σ²) = 2⁻²⁴ at r = σ √(48 ln 2) = 0.5768 for σ = 0.1.
    let settings = Settings { kernel: Kernel::Gaussian { sigma: 0.1 }, ..settings(101) };
    let picture = picture(&ellipses(&[facing_disk(DVec3::Z, 0.9, GRAY)]), &settings);
    for (x, y, pixel) in pixels_at(&picture) {
        assert_eq!(pixel.is_covered(), x.hypot(y) / f64::from(0.9_f32) <= 0.576_810_7, "{x}, {y}");
    }
    assert!(covered(&picture) > 1000);
}

/// Random splats: in front, large, tilted, reaching behind the eye.
fn random_splats(random: &mut Random, count: usize) -> Vec<Ellipse> {
    (0..count)
        .map(|_| {
            let size = 10.0_f64.powf(random.within(-3.0, 0.7));
            let first = random.direction();
            let second =
                first.cross(random.direction()).normalize() * 10.0_f64.powf(random.within(-1.3, 1.3));
            let center =
                DVec3::new(random.within(-3.0, 3.0), random.within(-3.0, 3.0), random.within(-1.0, 5.0));
            (center, (first * size).as_vec3(), (second * size).as_vec3(), GRAY)
        })
        .collect()
}

#[test]
fn the_search_box_holds_the_projected_rim() {
    let mut random = Random(2);
    let settings = Settings { filter: Filter::Adjust, ..settings(64) };
    let view = View::pinhole(&camera(), settings.size_px);
    let (splats, _) = prepare(&ellipses(&random_splats(&mut random, 500)), &view, &settings);
    let mut inside_the_image = 0;
    for (i, splat) in splats.iter().enumerate() {
        let search = SearchBox::of(splat, 1.0, &view);
        for step in 0..720 {
            let (sin, cos) = (f64::from(step) * PI / 360.0).sin_cos();
            let q = splat.center + cos * splat.s + sin * splat.t;
            if q.z < view.near {
                continue;
            }
            let (column, row) = (32.0 * q.x / q.z + 32.0, 32.0 * q.y / q.z + 32.0);
            if (0.0..64.0).contains(&column) && (0.0..64.0).contains(&row) {
                inside_the_image += 1;
                assert!(search.columns.contains(&(column as u32)), "splat {i}, step {step}");
                assert!(search.rows.contains(&(row as u32)), "splat {i}, step {step}");
            }
        }
    }
    assert!(inside_the_image > 10_000, "{inside_the_image}");
}

#[test]
fn no_pixel_outside_the_search_box_is_covered_or_near_the_rim() {
    use Rasterizer::{AffineCenter, AffineContour, Perspective, RaycastApproximate};
    let methods = [
        (Perspective, Filter::None),
        (Perspective, Filter::Max),
        (Perspective, Filter::Ewa),
        (AffineCenter, Filter::None),
        (AffineContour, Filter::Max),
        (AffineContour, Filter::Ewa),
        (RaycastApproximate, Filter::Adjust),
    ];
    for (rasterizer, filter) in methods {
        let mut random = Random(3);
        let settings = Settings { rasterizer, filter, ..settings(48) };
        let view = View::pinhole(&camera(), settings.size_px);
        let (splats, _) = prepare(&ellipses(&random_splats(&mut random, 300)), &view, &settings);
        let limit_r2 = limit_r2(settings.kernel);
        let concerns = |splat: &DrawnSplat, column, row| {
            let [x_px, y_px] = view.offset_px(column, row);
            let ray = view.ray(column, row);
            splat.fragment(ray, &view, settings.kernel).is_some()
                || splat.rim(ray, x_px.hypot(y_px), limit_r2, &view).is_some()
        };
        let (mut concerned, mut smaller_boxes) = (0, 0);
        for (i, splat) in splats.iter().enumerate() {
            let search = SearchBox::of(splat, limit_r2, &view);
            smaller_boxes += usize::from(search.columns.len() * search.rows.len() < 48 * 48);
            for row in 0..48 {
                for column in 0..48 {
                    if concerns(splat, column, row) {
                        concerned += 1;
                        let found = search.columns.contains(&column) && search.rows.contains(&row);
                        assert!(found, "{rasterizer:?} {filter:?}: splat {i} at {column}, {row}");
                    }
                }
            }
        }
        assert!(
            concerned > 5000 && smaller_boxes > 50,
            "{rasterizer:?} {filter:?}: {concerned}, {smaller_boxes}"
        );
    }
}

#[test]
fn the_margin_of_a_large_splat_is_the_floor_and_that_of_a_thin_one_grows() {
    assert_eq!(r2_margin(100.0, 50.0), 1e-3);
    let thin = r2_margin(128.0, 1e-3);
    assert!((thin - 16.0 * 128.0 / 1e-3 / 16_777_216.0).abs() < 1e-12);
    // The plane of this one holds the eye: no width at all.
    assert_eq!(r2_margin(128.0, 0.0), f64::INFINITY);
}

#[test]
fn an_ellipse_given_by_slanted_tangents_covers_the_ellipse() {
    // x = u + v, y = v: v = y, u = x − y.
    let center = DVec3::new(0.0, 0.0, 2.0);
    let scene = ellipses(&[(center, Vec3::X * 0.5, Vec3::new(0.5, 0.5, 0.0), GRAY)]);
    let picture = picture(&scene, &settings(101));
    for (x, y, pixel) in pixels_at(&picture) {
        let (u, v) = ((2.0 * x - 2.0 * y) / 0.5, 2.0 * y / 0.5);
        assert_eq!(pixel.is_covered(), u * u + v * v <= 1.0, "{x}, {y}");
    }
    assert!(covered(&picture) > 400);
}
