//! Input that is wrong, extreme, or too much of the same.

use glam::{DVec3, Vec3};

use super::*;
use crate::scene::{Ball, Defect};

/// Nothing but an empty pixel's depth and margin may be infinite, and nothing NaN.
fn assert_sane(picture: &Picture) {
    for pixel in &picture.pixels {
        let sums = [pixel.weight, pixel.alpha];
        let values = sums.iter().chain(&pixel.albedo).chain(&pixel.normal).chain(&pixel.color);
        assert!(values.into_iter().all(|value| value.is_finite()), "{pixel:?}");
        assert!(pixel.depth.is_finite() == pixel.is_covered() && !pixel.depth.is_nan(), "{pixel:?}");
        assert!(pixel.epsilon_margin >= 0.0, "{pixel:?}");
    }
}

#[test]
fn defective_splats_are_left_out_and_counted_over_all_objects() {
    let good = (DVec3::Z, Vec3::NEG_Z, 0.5_f32, GRAY);
    let disks = [
        good,
        (DVec3::new(f64::NAN, 0.0, 1.0), good.1, good.2, good.3),
        (DVec3::new(0.0, 0.0, f64::INFINITY), good.1, good.2, good.3),
        (good.0, Vec3::ZERO, good.2, good.3),
        (good.0, Vec3::NAN, good.2, good.3),
        (good.0, good.1, 0.0, good.3),
        (good.0, good.1, -1.0, good.3),
        (good.0, good.1, f32::INFINITY, good.3),
        (good.0, good.1, good.2, [f32::NAN, 0.0, 0.0, 1.0]),
    ];
    let disks = Splats::new(
        disks.iter().map(|d| d.0).collect(),
        Shapes::Disks {
            normals: disks.iter().map(|d| d.1).collect(),
            radii: disks.iter().map(|d| d.2).collect(),
        },
        Colors::Each(disks.iter().map(|d| d.3).collect()),
    );
    let mut scene = ellipses(&[(DVec3::Z, Vec3::X, Vec3::X, GRAY), (DVec3::Z, Vec3::ZERO, Vec3::X, GRAY)]);
    scene.objects.push(Object { name: "disks".into(), splats: disks, closed: false });

    for filter in [Filter::None, Filter::Adjust] {
        let settings = Settings { filter, ..settings(33) };
        let mixed = picture(&scene, &settings);
        let of = |defect| mixed.defects.of(defect);
        assert_eq!((of(Defect::Position), of(Defect::Normal), of(Defect::Radius)), (2, 2, 3));
        assert_eq!((of(Defect::Tangents), of(Defect::Color), mixed.defects.total()), (2, 1, 10));
        let alone = picture(&ellipses(&[facing_disk(DVec3::Z, 0.5, GRAY)]), &settings);
        for (a, b) in mixed.pixels.iter().zip(&alone.pixels) {
            assert!((a.weight - b.weight).abs() < 1e-14);
        }
        assert_sane(&mixed);
    }
}

#[test]
fn extreme_but_legal_splats_leave_every_pixel_finite() {
    let mut list = Vec::new();
    for z in [1e-300, 1e-7, 1.0, 1e9, 1e30, 1e300] {
        for size in [1e-45_f32, 1e-38, 1e-3, 1.0, 1e9, 3e38] {
            for place in [DVec3::ZERO, DVec3::new(0.3, -0.2, 0.0), DVec3::new(1e12, 0.0, 0.0)] {
                let center = place + DVec3::Z * z;
                list.push((center, Vec3::Y * size, Vec3::X * size, GRAY));
                list.push((center, Vec3::Y * size, Vec3::Z * size, GRAY));
                list.push((center, Vec3::new(0.6, 0.0, 0.8) * size, Vec3::Y * (size * 0.01), GRAY));
            }
        }
    }
    for filter in [Filter::None, Filter::Adjust] {
        for epsilon in [Epsilon::Radii(1.0), Epsilon::Length(0.0), Epsilon::Length(1e300)] {
            let settings = Settings { filter, epsilon, ..settings(17) };
            assert_sane(&picture(&ellipses(&list), &settings));
            for one in &list {
                assert_sane(&picture(&ellipses(&[*one]), &settings));
            }
        }
    }
}

#[test]
fn a_needle_is_drawn_as_a_band_of_the_filters_width() {
    let needle = (DVec3::Z, Vec3::X * 0.5, Vec3::Y * 1e-7, GRAY);
    let scene = ellipses(&[needle]);
    assert!(covered(&picture(&scene, &settings(128))) == 0);
    let filtered = picture(&scene, &Settings { filter: Filter::Adjust, ..settings(128) });
    // Half axes 32 and √2 pixels.
    let area_px = std::f64::consts::PI * 32.0 * 2.0_f64.sqrt();
    assert!((covered(&filtered) as f64 - area_px).abs() < 0.2 * area_px, "{}", covered(&filtered));
}

#[test]
fn many_coincident_disks_give_the_color_of_one() {
    let disk = facing_disk(DVec3::new(0.1, 0.0, 2.0), 0.4, GRAY);
    let (one, many) =
        (picture(&ellipses(&[disk]), &settings(64)), picture(&ellipses(&[disk; 3000]), &settings(64)));
    for (a, b) in one.pixels.iter().zip(&many.pixels) {
        assert!((3000.0 * a.weight - b.weight).abs() <= 1e-11 * b.weight);
        assert!((0..3).all(|i| (a.albedo[i] - b.albedo[i]).abs() < 1e-12));
        assert!(a.depth == b.depth || (a.depth - b.depth).abs() < 1e-11);
    }
    assert!(covered(&one) > 100);
}

#[test]
fn points_all_at_one_place_are_fitted_and_seen() {
    let disk = facing_disk(DVec3::new(5e5, 4.6e6, 300.0), 1e-3, GRAY);
    let scene = ellipses(&[disk; 5]);
    let size_px = [40, 30];
    let settings = Settings { size_px, filter: Filter::Adjust, ..settings(0) };
    for ball in [scene.ball().unwrap(), Ball { center: disk.0, radius: 0.0 }] {
        let picture =
            render(&scene, &Camera::fit(&ball, size_px, Camera::DEFAULT_FOV_Y_RAD), &settings, &|_, _| ())
                .unwrap();
        assert!(picture.pixel(20, 15).unwrap().is_covered());
        assert_sane(&picture);
    }
}

#[test]
fn an_empty_scene_and_a_single_pixel_are_pictures() {
    let empty = picture(&Scene::default(), &settings(5));
    assert_eq!((covered(&empty), empty.pixels.len()), (0, 25));
    let one = picture(&ellipses(&[facing_disk(DVec3::Z, 0.1, GRAY)]), &settings(1));
    assert_eq!((covered(&one), one.pixels.len()), (1, 1));
}

#[test]
fn options_and_cameras_out_of_range_are_refused() {
    let scene = ellipses(&[facing_disk(DVec3::Z, 0.5, GRAY)]);
    let bad = [
        Settings { size_px: [0, 4], ..settings(4) },
        Settings { kernel: Kernel::Gaussian { sigma: 0.0 }, ..settings(4) },
        Settings { epsilon: Epsilon::Radii(f64::NAN), ..settings(4) },
    ];
    for settings in bad {
        let error = render(&scene, &camera(), &settings, &|_, _| ()).unwrap_err();
        assert_eq!(error.exit_code(), 1, "{error}");
    }
    let camera = Camera { target: DVec3::ZERO, ..camera() };
    assert_eq!(render(&scene, &camera, &settings(4), &|_, _| ()).unwrap_err().exit_code(), 1);
}
