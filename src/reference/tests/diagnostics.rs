//! The two flags that say how close a pixel is to another outcome, and the frame around the picture.

use std::sync::Mutex;

use glam::DVec3;

use super::*;

#[test]
fn the_rim_is_where_r2_is_within_the_margin_of_one() {
    // Depth 1, radius 0.6, half-axis 300 px: margin 1e-3.
    let picture = picture(&ellipses(&[facing_disk(DVec3::Z, 0.6, GRAY)]), &settings(1000));
    let mut flagged = [0; 2];
    for (x, y, pixel) in pixels_at(&picture) {
        let r2 = (x * x + y * y) / (f64::from(0.6_f32) * f64::from(0.6_f32));
        assert_eq!(pixel.rim, (r2 - 1.0).abs() <= 1e-3, "{x}, {y}");
        if pixel.rim {
            flagged[usize::from(pixel.is_covered())] += 1;
        }
    }
    assert!(flagged[0] > 100 && flagged[1] > 100, "on both sides: {flagged:?}");
}

#[test]
fn the_rim_follows_the_kernels_cutoff() {
    let kernel = Kernel::Gaussian { sigma: 0.1 };
    let limit = 0.02 * 24.0 * std::f64::consts::LN_2;
    let picture =
        picture(&ellipses(&[facing_disk(DVec3::Z, 0.9, GRAY)]), &Settings { kernel, ..settings(800) });
    let rims: Vec<f64> =
        pixels_at(&picture).filter(|(.., pixel)| pixel.rim).map(|(x, y, _)| (x * x + y * y) / 0.81).collect();
    assert!(rims.len() > 100 && rims.iter().all(|r2| (r2 - limit).abs() < 1.001e-3));
}

#[test]
fn a_hidden_splat_has_no_rim_and_one_in_front_has() {
    for (z, rim) in [(3.0, false), (1.5, true)] {
        let scene = ellipses(&[
            facing_disk(DVec3::Z * 2.0, 1.9, GRAY),
            facing_disk(DVec3::Z * z, (0.3 * z) as f32, GRAY),
        ]);
        let settings = Settings { epsilon: Epsilon::Length(0.01), ..settings(500) };
        let picture = picture(&scene, &settings);
        let flagged = pixels_at(&picture).filter(|(x, y, pixel)| pixel.rim && x.hypot(*y) < 0.5).count();
        assert_eq!(flagged > 50, rim, "{z}: {flagged}");
    }
}

#[test]
fn the_fragment_that_sets_the_threshold_is_never_close_to_it() {
    let one = ellipses(&[facing_disk(DVec3::Z * 2.0, 1e-5, GRAY)]);
    let settings = Settings { filter: Filter::Adjust, ..settings(33) };
    assert_eq!(picture(&one, &settings).pixel(16, 16).unwrap().epsilon_margin, f64::INFINITY);
    // A second one at the same place is: its depth is below the threshold by ε = 1e-5 of 2.
    let disk = facing_disk(DVec3::Z * 2.0, 1e-5, GRAY);
    let two = picture(&ellipses(&[disk, disk]), &settings);
    let margin = two.pixel(16, 16).unwrap().epsilon_margin;
    assert!((margin / 5e-6 - 1.0).abs() < 1e-5, "{margin}");
}

#[test]
fn the_size_of_the_picture_does_not_change_a_pixel() {
    // Several bands and one; the middle 20 pixels of a taller picture with the same focal length.
    let scene = ellipses(&[
        facing_disk(DVec3::new(0.1, 0.0, 2.0), 0.7, GRAY),
        facing_disk(DVec3::new(-0.2, 0.1, 1.9), 0.5, [1.0, 0.0, 0.0, 1.0]),
    ]);
    let small = picture(&scene, &Settings { size_px: [40, 20], ..settings(0) });
    let camera = Camera { fov_y_rad: 2.0 * 5.0_f64.atan(), ..camera() };
    let tall = render(&scene, &camera, &Settings { size_px: [40, 100], ..settings(0) }, &|_, _| ()).unwrap();
    assert!(covered(&small) > 30);
    for row in 0..20 {
        for column in 0..40 {
            let (a, b) = (small.pixel(column, row).unwrap(), tall.pixel(column, row + 40).unwrap());
            assert_eq!(a.is_covered(), b.is_covered());
            assert!((a.weight - b.weight).abs() < 1e-12, "{column}, {row}");
        }
    }
    assert!(small.pixel(40, 0).is_none() && small.pixel(0, 20).is_none());
}

#[test]
fn progress_counts_every_row_once() {
    let seen = Mutex::new(Vec::new());
    let settings = Settings { size_px: [8, 50], ..settings(0) };
    render(&Scene::default(), &camera(), &settings, &|done, total| seen.lock().unwrap().push((done, total)))
        .unwrap();
    let mut seen = seen.into_inner().unwrap();
    seen.sort_unstable();
    assert_eq!(seen.first(), Some(&(0, 50)));
    assert_eq!(seen.last(), Some(&(50, 50)));
    assert_eq!(seen.len(), 5, "four bands and the start");
}
