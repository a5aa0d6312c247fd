//! Weights, albedo, normals, alpha, colors.

use glam::{DVec3, Vec3};

use super::*;
use crate::scene::Shading;

#[test]
fn the_weight_falls_off_by_the_kernel() {
    // Depth 1, radius ½: r = 2 |x|.
    let picture = picture(&ellipses(&[facing_disk(DVec3::Z, 0.5, GRAY)]), &settings(65));
    assert_eq!(picture.pixel(32, 32).unwrap().weight, 1.0);
    for (x, y, pixel) in pixels_at(&picture).filter(|(.., pixel)| pixel.is_covered()) {
        // σ = ½: exp(−r²/2σ²) = exp(−2 r²) = exp(−8 |x|²).
        let expected = (-8.0 * (x * x + y * y)).exp();
        assert!((pixel.weight / expected - 1.0).abs() < 1e-12, "{x}, {y}");
    }
}

#[test]
fn one_splat_keeps_its_albedo_to_the_rim() {
    let color = [0.125, 0.5, 0.875, 1.0];
    for kernel in [Kernel::default(), Kernel::PsiE { a: 6.0, b: 1.5, n: 3.0 }] {
        let settings = Settings { kernel, ..settings(65) };
        let picture = picture(&ellipses(&[facing_disk(DVec3::Z, 0.7, color)]), &settings);
        let mut smallest = f64::INFINITY;
        for pixel in picture.pixels.iter().filter(|pixel| pixel.is_covered()) {
            let close = |a: f64, b: f32| (a - f64::from(b)).abs() < 1e-15;
            assert!((0..3).all(|i| close(pixel.albedo[i], color[i])) && close(pixel.alpha, color[3]));
            assert!((DVec3::from(pixel.normal) - DVec3::NEG_Z).length() < 1e-15);
            smallest = smallest.min(pixel.weight);
        }
        // ψ_E has pixels that only its faint rim covers.
        assert!(smallest < if kernel == Kernel::default() { 0.15 } else { 1e-4 }, "{smallest}");
    }
}

#[test]
fn two_splats_mix_by_their_weights() {
    // The pixel at x = 0 lies ¼ radius from one center and ¾ from the other: weights exp(−2/16), exp(−18/16).
    let scene = ellipses(&[
        facing_disk(DVec3::new(-0.125, 0.0, 1.0), 0.5, [1.0, 0.0, 0.0, 1.0]),
        facing_disk(DVec3::new(0.375, 0.0, 1.0), 0.5, [0.0, 1.0, 0.0, 1.0]),
    ]);
    let pixel = *picture(&scene, &settings(65)).pixel(32, 32).unwrap();
    let (near, far) = ((-0.125_f64).exp(), (-1.125_f64).exp());
    assert!((pixel.weight - near - far).abs() < 1e-14);
    // 1 / (1 + e⁻¹).
    let share = 0.731_058_578_630_004_9;
    assert!((pixel.albedo[0] - share).abs() < 1e-14 && (pixel.albedo[1] - 1.0 + share).abs() < 1e-14);
    assert!((pixel.alpha - 1.0).abs() < 1e-14);
}

#[test]
fn normals_are_summed_by_weight_and_normalized() {
    // Two disks through one point, turned by ±30° about y: the mean faces the eye again.
    let (sin, cos) = 30.0_f32.to_radians().sin_cos();
    let center = DVec3::Z * 2.0;
    let turned = |sign: f32| (center, Vec3::Y, Vec3::new(cos, 0.0, sign * sin), GRAY);
    let one = *picture(&ellipses(&[turned(1.0)]), &settings(33)).pixel(16, 16).unwrap();
    // s × t = (0,1,0) × (cos, 0, sin) = (sin, 0, −cos).
    let expected = DVec3::new(0.5, 0.0, -0.75_f64.sqrt());
    assert!((DVec3::from(one.normal) - expected).length() < 1e-7);
    let both = *picture(&ellipses(&[turned(1.0), turned(-1.0)]), &settings(33)).pixel(16, 16).unwrap();
    assert!((DVec3::from(both.normal) - DVec3::NEG_Z).length() < 1e-7);
    assert!((DVec3::from(both.normal).length() - 1.0).abs() < 1e-15);
}

#[test]
fn normals_that_cancel_become_the_view_direction() {
    // Both planes hold the center's ray, so neither faces away; the filter draws them all the same.
    let center = DVec3::Z * 2.0;
    let scene = ellipses(&[
        (center, Vec3::Y * 0.1, Vec3::Z * 0.1, GRAY),
        (center, Vec3::Z * 0.1, Vec3::Y * 0.1, GRAY),
    ]);
    let settings = Settings { filter: Filter::Adjust, ..settings(33) };
    let pixel = *picture(&scene, &settings).pixel(16, 16).unwrap();
    assert!((pixel.weight - 2.0).abs() < 1e-12);
    assert_eq!(pixel.normal, [0.0, 0.0, -1.0]);
}

#[test]
fn the_color_is_shaded_from_the_normalized_surface() {
    // Off the axis: the pixel at x = ½, y = 0 of a disk that faces the screen.
    let scene = ellipses(&[facing_disk(DVec3::Z, 3.0, GRAY)]);
    let settings = Settings { shading: Shading::Lambert, ..settings(64) };
    let picture = picture(&scene, &settings);
    for (x, y, pixel) in pixels_at(&picture) {
        let n_dot_l = 1.0 / (1.0 + x * x + y * y).sqrt();
        for (color, albedo) in pixel.color.iter().zip(&GRAY[..3]) {
            let expected = f64::from(*albedo) * (0.1 + 0.9 * n_dot_l);
            assert!((color - expected).abs() < 1e-14, "{x}, {y}");
        }
        assert_eq!(pixel.color[3], 1.0);
    }
}

#[test]
fn empty_pixels_show_the_background_as_linear_light() {
    let scene = ellipses(&[facing_disk(DVec3::Z, 0.1, GRAY)]);
    let on_gray = Settings { background: Some([0.0, 0.5, 1.0]), ..settings(32) };
    let corner = *picture(&scene, &on_gray).pixel(0, 0).unwrap();
    assert!((corner.color[1] - 0.214_041_140_482_232_55).abs() < 1e-15);
    assert_eq!([corner.color[0], corner.color[2], corner.color[3]], [0.0, 1.0, 1.0]);
    assert_eq!((corner.weight, corner.depth, corner.alpha), (0.0, f64::INFINITY, 0.0));
    let transparent = Settings { background: None, ..settings(32) };
    assert_eq!(picture(&scene, &transparent).pixel(0, 0).unwrap().color, [0.0; 4]);
}

#[test]
fn the_heavier_splat_turns_the_normal_more() {
    // Turned by ±30° about x, whose axis holds both centers: the weights at x = 0 are exp(−1/8) and exp(−9/8).
    let (sin, cos) = 30.0_f32.to_radians().sin_cos();
    let turned = |x: f64, sign: f32| {
        (DVec3::new(x, 0.0, 1.0), Vec3::new(0.0, cos, sign * sin) * 0.5, Vec3::X * 0.5, GRAY)
    };
    let scene = ellipses(&[turned(-0.125, 1.0), turned(0.375, -1.0)]);
    let pixel = *picture(&scene, &settings(65)).pixel(32, 32).unwrap();
    // (0, cos, ±sin) × x = (0, ±½, −√¾), mixed with the weights 1 and e⁻¹.
    let fade = (-1.0_f64).exp();
    let expected = DVec3::new(0.0, 0.5 * (1.0 - fade), -0.75_f64.sqrt() * (1.0 + fade)).normalize();
    assert!((DVec3::from(pixel.normal) - expected).length() < 1e-7, "{:?}", pixel.normal);
}
