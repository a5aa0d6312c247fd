//! The ground truth against closed forms.

use std::sync::Mutex;

use glam::{DVec3, Vec3};

use super::*;
use crate::reference::{GroundTruth, ground_truth};
use crate::scene::Shading;

/// 256 samples a pixel.
const SAMPLES: u32 = 16;

fn truth(scene: &Scene, settings: &Settings) -> GroundTruth {
    ground_truth(scene, &camera(), settings, SAMPLES, &|_, _| ()).unwrap()
}

/// The share of a Gaussian of standard deviation 1 below `x`: its integral from −8 by Simpson's rule.
fn normal_share(x: f64) -> f64 {
    let density = |x: f64| (-0.5 * x * x).exp() / std::f64::consts::TAU.sqrt();
    let steps = 4000;
    let step = (x + 8.0) / f64::from(steps);
    let term = |i: i32| {
        let factor = if i == 0 || i == steps {
            1.0
        } else if i % 2 == 1 {
            4.0
        } else {
            2.0
        };
        factor * density(-8.0 + f64::from(i) * step)
    };
    (0..=steps).map(term).sum::<f64>() * step / 3.0
}

#[test]
fn the_coverage_along_an_edge_is_the_share_of_the_gaussian() {
    // 16 pixels, 8 a unit. The edge is between two samples, each share that of a whole number of them.
    for (kernel, sigma) in [
        (Kernel::Gaussian { sigma: 0.5 }, 0.5),
        (Kernel::Gaussian { sigma: 1.25 }, 1.25),
        (Kernel::PsiE { a: 6.0, b: 1.5, n: 3.0 }, 0.5),
    ] {
        for sixteenths in [0, 5, 8] {
            let edge_px = 8.0 + f64::from(sixteenths) / 16.0;
            // The kernel ψ_E ends before the rim.
            let reach = super::super::kernel::limit_r2(kernel).sqrt();
            // Over a picture of 16 pixels its border bends by 1e-6.
            let radius = 2.0_f64.powi(20);
            let center = DVec3::new((edge_px - 8.0) / 8.0 - radius * reach, 0.0, 1.0);
            let scene = ellipses(&[facing_disk(center, radius as f32, GRAY)]);
            let picture = truth(&scene, &Settings { kernel, shading: Shading::Albedo, ..settings(16) });
            for column in 0..16 {
                let pixel = &picture.pixels[7 * 16 + column];
                let distance_px = edge_px - (column as f64 + 0.5);
                let expected = normal_share(distance_px / (sigma * 2.0_f64.sqrt()));
                // The cut at 4 deviations leaves out 6e-5, the midpoint rule is right to 1e-4.
                let difference = (pixel.coverage - expected).abs();
                // The color is that of the part that is there.
                if pixel.coverage > 0.0 {
                    assert!((pixel.color[2] - 0.75).abs() < 1e-12 && pixel.albedo == pixel.color);
                }
                assert!(difference < 2e-4, "{kernel:?} {sixteenths} {column}: {} {expected}", pixel.coverage);
            }
        }
    }
}

#[test]
fn a_uniform_scene_is_unchanged_up_to_the_border() {
    let scene = ellipses(&[facing_disk(DVec3::Z * 2.0, 100.0, GRAY)]);
    let picture = truth(&scene, &Settings { shading: Shading::Albedo, ..settings(9) });
    assert_eq!((picture.size_px, picture.pixels.len()), ([9, 9], 81));
    for pixel in &picture.pixels {
        let values = pixel.albedo.iter().chain(&pixel.color);
        for (got, expected) in values.zip([0.25, 0.5, 0.75, 0.25, 0.5, 0.75]) {
            assert!((got - expected).abs() < 1e-12);
        }
        assert!((pixel.coverage - 1.0).abs() < 1e-12 && (pixel.depth - 2.0).abs() < 1e-12);
        assert!(
            (DVec3::from(pixel.normal) - DVec3::NEG_Z).length() < 1e-12 && (pixel.alpha - 1.0).abs() < 1e-12
        );
    }
    // A filter narrower than the distance of samples, of which there are two at a pixel's middle.
    let narrow = Settings { kernel: Kernel::Gaussian { sigma: 0.01 }, ..settings(9) };
    let scene = ellipses(&[facing_disk(DVec3::Z * 2.0, 1e4, GRAY)]);
    for samples in [2, 3] {
        let picture = ground_truth(&scene, &camera(), &narrow, samples, &|_, _| ()).unwrap();
        assert!(picture.pixels.iter().all(|pixel| pixel.coverage == 1.0));
    }
    let nothing = truth(&Scene::default(), &settings(9));
    for pixel in &nothing.pixels {
        assert_eq!((pixel.coverage, pixel.color, pixel.depth), (0.0, [0.0; 3], f64::INFINITY));
    }
}

#[test]
fn a_checkerboard_far_above_the_pixels_frequency_becomes_its_mean() {
    // 16 pixels with 8 × 8 splats each, black and white in turn, and two more pixels around the picture.
    let mut list = Vec::new();
    let pitch = 1.0 / 64.0;
    for i in -96_i32..96 {
        for j in -96_i32..96 {
            let center = DVec3::new((f64::from(i) + 0.5) * pitch, (f64::from(j) + 0.5) * pitch, 1.0);
            let value = if (i + j) % 2 == 0 { 1.0 } else { 0.0 };
            list.push(facing_disk(center, 0.75 * pitch as f32, [value, value, value, 1.0]));
        }
    }
    let picture = truth(&ellipses(&list), &Settings { shading: Shading::Albedo, ..settings(16) });
    for pixel in &picture.pixels {
        assert!((pixel.coverage - 1.0).abs() < 1e-12);
        for (albedo, color) in pixel.albedo.iter().zip(&pixel.color) {
            assert!((albedo - 0.5).abs() < 0.01 && (color - 0.5).abs() < 0.01, "{albedo} {color}");
        }
    }
    // Without the low-pass filter the pixel centers, all at the corners of four squares, show what they hit; moved
    // by half a square all of them see one color.
    let moved: Vec<_> =
        list.iter().map(|e| (e.0 + DVec3::new(0.5 * pitch, 0.5 * pitch, 0.0), e.1, e.2, e.3)).collect();
    let aliased = picture_of(&moved);
    assert!(aliased.iter().all(|albedo| (albedo - 0.5).abs() > 0.3), "{aliased:?}");
}

fn picture_of(list: &[Ellipse]) -> Vec<f64> {
    let picture = picture(&ellipses(list), &settings(16));
    picture.pixels.iter().map(|pixel| pixel.albedo[0]).collect()
}

#[test]
fn where_the_surface_is_smooth_it_is_the_picture_and_half_the_variance_of_its_curvature() {
    // Two Gaussians of 80 pixels, overlapping all over the picture of 48.
    let scene = ellipses(&[
        facing_disk(DVec3::new(-1.0, 0.3, 1.0), 2.5, [0.0, 0.1, 0.0, 1.0]),
        facing_disk(DVec3::new(0.9, -0.2, 1.0), 2.5, [1.0, 0.9, 0.2, 1.0]),
    ]);
    let settings = Settings { shading: Shading::Albedo, ..settings(48) };
    let (picture, truth) = (picture(&scene, &settings), truth(&scene, &settings));
    let mut largest = 0.0_f64;
    for row in 1..47 {
        for column in 1..47 {
            let at = |x: usize, y: usize| picture.pixels[y * 48 + x].albedo[0];
            let (plain, filtered) = (at(column, row), truth.pixels[row * 48 + column].albedo[0]);
            let curvature =
                at(column - 1, row) + at(column + 1, row) + at(column, row - 1) + at(column, row + 1)
                    - 4.0 * plain;
            // σ² = ½ px². The cut at 4 deviations takes a thousandth of σ², and the difference quotient is wrong by
            // as little: of the 3e-5 that the filter changes, 3e-8 each.
            let expected = plain + 0.25 * curvature;
            assert!((filtered - expected).abs() < 2e-7, "{column}, {row}: {filtered} {expected}");
            assert!((picture.pixels[row * 48 + column].color[0] - plain).abs() < 1e-15);
            largest = largest.max((filtered - plain).abs());
        }
    }
    assert!(largest > 2e-5, "{largest:e}");
}

#[test]
fn every_filter_has_the_same_ground_truth() {
    let mut random = Random(41);
    let list: Vec<_> = (0..40).map(|_| random_ellipse(&mut random, 0.1, 2.0)).collect();
    let scene = ellipses(&list);
    let expected = truth(&scene, &settings(12));
    assert!(expected.pixels.iter().any(|pixel| pixel.coverage > 0.1 && pixel.coverage < 0.9));
    for filter in [Filter::Adjust, Filter::Max, Filter::Ewa] {
        assert_eq!(truth(&scene, &Settings { filter, ..settings(12) }).pixels, expected.pixels, "{filter:?}");
    }
    let rasterizer = Rasterizer::AffineContour;
    let area =
        Settings { rasterizer, filter: Filter::Adjust, filter_weight: FilterWeight::Area, ..settings(12) };
    assert_eq!(truth(&scene, &area).pixels, expected.pixels);
}

#[test]
fn a_pixel_does_not_depend_on_the_pictures_size() {
    // Taller than a band, and wider; the same pixels in the middle of both.
    let mut random = Random(42);
    let list: Vec<_> = (0..60).map(|_| random_ellipse(&mut random, 0.08, 2.0)).collect();
    let scene = ellipses(&list);
    let four = |camera: &Camera, size_px| {
        ground_truth(&scene, camera, &Settings { size_px, ..settings(0) }, 4, &|_, _| ()).unwrap()
    };
    let small = four(&camera(), [10, 16]);
    let large = four(&Camera { fov_y_rad: 2.0 * 5.0_f64.atan(), ..camera() }, [20, 80]);
    let mut covered = 0;
    for row in 0..16 {
        for column in 0..10 {
            let (a, b) = (&small.pixels[row * 10 + column], &large.pixels[(row + 32) * 20 + column + 5]);
            assert!((a.coverage - b.coverage).abs() < 1e-12, "{column}, {row}");
            assert!((a.color[1] - b.color[1]).abs() < 1e-9, "{column}, {row}");
            covered += usize::from(a.coverage > 0.0);
        }
    }
    assert!(covered > 100, "{covered}");
}

#[test]
fn samples_are_shaded_before_they_are_low_passed() {
    // A ridge along the edge of two half planes that face left and right by 60°: the mean normal faces the eye,
    // neither half does.
    let (sin, cos) = 60.0_f32.to_radians().sin_cos();
    let far = |side: f32| {
        let (s, t) = (Vec3::Y * 50.0, Vec3::new(cos, 0.0, side * sin) * 50.0);
        (DVec3::new(f64::from(side * cos) * 50.0, 0.0, 2.0 + f64::from(sin) * 50.0), s, t, [1.0; 4])
    };
    let settings = Settings { shading: Shading::Lambert, epsilon: Epsilon::Length(1e-3), ..settings(17) };
    let picture = truth(&ellipses(&[far(-1.0), far(1.0)]), &settings);
    let pixel = &picture.pixels[8 * 17 + 8];
    assert!(DVec3::from(pixel.normal).z < -0.99, "{pixel:?}");
    // 0.1 + 0.9 cos of 60° and a few more or less.
    assert!(pixel.color[0] > 0.45 && pixel.color[0] < 0.65, "{pixel:?}");
}

#[test]
fn what_can_not_be_sampled_is_refused_and_the_rest_reported() {
    let ask = |settings: &Settings, samples| {
        let error = ground_truth(&Scene::default(), &camera(), settings, samples, &|_, _| ());
        let error = error.unwrap_err();
        assert_eq!(error.exit_code(), 1);
        error.to_string()
    };
    assert!(ask(&settings(8), 0).starts_with("--samples: 0: expected 1 to 256"));
    assert!(ask(&settings(8), 257).starts_with("--samples"));
    assert!(ask(&settings(65_536), 16).starts_with("--size: 65536x65536 with 16 samples"));
    let wide = Settings { kernel: Kernel::Gaussian { sigma: 12.0 }, ..settings(8) };
    assert!(ask(&wide, 16).starts_with("--kernel: gaussian: σ is 12"));

    let scene = ellipses(&[facing_disk(DVec3::NAN, 1.0, GRAY)]);
    let seen = Mutex::new(Vec::new());
    let progress = |done, total| seen.lock().unwrap().push((done, total));
    let tall = Settings { size_px: [3, 70], ..settings(0) };
    assert_eq!(ground_truth(&scene, &camera(), &tall, 1, &progress).unwrap().defects.total(), 1);
    let mut seen = seen.into_inner().unwrap();
    seen.sort_unstable();
    assert_eq!((seen.first(), seen.last(), seen.len()), (Some(&(0, 70)), Some(&(70, 70)), 4));
}

#[test]
fn one_sample_under_a_filter_without_width_is_the_picture_without_a_filter() {
    // σ = 0.01: the filter reaches a 20th of a pixel, and the kernel a twentieth of a radius.
    let kernel = Kernel::Gaussian { sigma: 0.01 };
    let mut random = Random(43);
    // Tilted, thin, across the near plane, behind the eye.
    let mut list: Vec<_> = (0..300).map(|_| random_ellipse(&mut random, 3.0, 10.0)).collect();
    for splat in &mut list {
        splat.0.z -= 0.5;
    }
    // A wall beside the eye: on a row it has one end alone.
    list.push((DVec3::X, Vec3::Y * 40.0, Vec3::Z * 40.0, GRAY));
    let settings = Settings { kernel, epsilon: Epsilon::Radii(0.1), ..settings(150) };
    let scene = ellipses(&list);
    let plain = picture(&scene, &settings);
    let sampled = ground_truth(&scene, &camera(), &settings, 1, &|_, _| ()).unwrap();
    let mut compared = 0;
    for (a, b) in sampled.pixels.iter().zip(&plain.pixels) {
        assert_eq!(a.coverage, f64::from(u8::from(b.is_covered())));
        if b.is_covered() {
            compared += 1;
            assert_eq!((a.albedo, a.depth, a.alpha), (b.albedo, b.depth, b.alpha));
            assert_eq!(a.color, [b.color[0], b.color[1], b.color[2]]);
            assert!((DVec3::from(a.normal) - DVec3::from(b.normal)).length() < 1e-15);
        }
    }
    assert!(compared > 2000, "{compared}");
}
