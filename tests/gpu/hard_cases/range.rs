//! Scenes whose lengths are far apart: no digit is lost to a stray point, no product to the range of f32.

use glam::DVec3;
use surfel::scene::{Camera, Epsilon, FilterWeight, Kernel, Settings};

use super::numbers::assert_finite;
use crate::common::{
    assert_agrees,
    builder::{self, Builder, camera},
    render,
    scenes::{self, Hard},
    shared,
};

/// A scan of a centimetre in UTM metres, and one stray point at the origin, as scanners leave them: it costs nothing.
#[test]
fn n09_a_stray_point_far_away_takes_no_digit_from_the_others() {
    let mut headless = shared();
    let place = DVec3::new(500_000.0, 4_600_000.0, 300.0);
    for size in [1.0, 0.01] {
        let sphere = scenes::sphere(3000, DVec3::ZERO).splats;
        let mut builder = Builder::default();
        for (i, position) in sphere.positions.iter().enumerate() {
            let color = sphere.color(i);
            builder.disk(place + size * *position, *position, size * sphere.major_radius(i), color);
        }
        builder.disk(DVec3::ZERO, DVec3::Z, 0.1, [1.0; 4]);
        let mut camera = camera([0.0, 0.0, 3.2 * size], [0.0; 3]);
        camera.eye += place;
        camera.target += place;
        let hard =
            Hard { name: "stray point", scene: builder.scene(true), camera, ..scenes::sphere_of_disks() };
        assert_agrees(&mut headless, &hard, 30_000);
    }
}

/// near / z below the square root of f32's smallest number: nothing may become NaN, nothing may vanish.
#[test]
fn n08_a_near_plane_at_the_end_of_f32_still_agrees() {
    let mut headless = shared();
    for near in [1e-15, 1e-20, 1e-30] {
        let base = scenes::sphere_of_disks();
        let hard = Hard { name: "tiny near", camera: Camera { near: Some(near), ..base.camera }, ..base };
        let (frame, _) = assert_agrees(&mut headless, &hard, 30_000);
        assert_finite(&frame, "tiny near");
    }
}

/// Seen from so far that ε is less than a step of f32, a surface still holds together: every pixel has the weights of
/// all that overlap there, not of the frontmost alone.
#[test]
fn n15_seen_from_very_far_a_surface_does_not_hide_itself() {
    let mut headless = shared();
    let base = scenes::sphere_of_disks();
    let seen_from = |headless: &mut _, distance: f64| {
        let camera = Camera {
            eye: DVec3::Z * distance,
            fov_y_rad: 2.0 * (0.4 * 3.2 / distance).atan(),
            near: Some(0.1 * distance),
            ..base.camera
        };
        let hard =
            Hard { name: "far eye", scene: base.scene.clone(), camera, settings: base.settings.clone() };
        let frame = render(headless, &hard);
        let covered = frame.weight.iter().filter(|weight| **weight > 0.0).count();
        frame.weight.iter().map(|weight| f64::from(*weight)).sum::<f64>() / covered as f64
    };
    let near = seen_from(&mut headless, 1e3);
    for distance in [1e6, 1e8, 1e10] {
        let far = seen_from(&mut headless, distance);
        println!("mean weight at 1e3: {near:.3}, at {distance:e}: {far:.3}");
        // Beyond 1e6 a step of f32 is as deep as the sphere, so that front and back are one surface: at least as much.
        assert!(far > 0.98 * near, "{distance:e}: {far} {near}");
    }
}

#[test]
fn an_epsilon_beyond_f32_takes_all_as_one_surface() {
    let mut headless = shared();
    for epsilon in [Epsilon::Length(1e39), Epsilon::Length(1e300), Epsilon::Radii(1e39)] {
        let mut hard = scenes::sphere_of_disks();
        hard.settings.epsilon = epsilon;
        assert_agrees(&mut headless, &hard, 30_000);
    }
}

#[test]
fn an_eye_almost_at_its_target_agrees() {
    let mut headless = shared();
    let mut hard = scenes::sphere_of_disks();
    hard.camera.target = hard.camera.eye - 1e-14 * DVec3::Z;
    assert_ne!(hard.camera.eye, hard.camera.target);
    let (frame, _) = assert_agrees(&mut headless, &hard, 30_000);
    assert_finite(&frame, "eye at target");
}

/// A pixel's center on a splat's own center, and a kernel steeper than f32: infinity times 0 must not come about.
#[test]
fn n14_kernels_steeper_than_f32_leave_no_nan() {
    let mut headless = shared();
    for kernel in [
        Kernel::Gaussian { sigma: 1e-20 },
        Kernel::Gaussian { sigma: 1e-25 },
        Kernel::PsiE { a: 3e38, b: 1.5, n: 3.0 },
    ] {
        let mut builder = Builder::default();
        builder.disk(DVec3::ZERO, DVec3::Z, 1.0, [0.5, 0.25, 1.0, 1.0]);
        let settings =
            Settings { size_px: [65, 65], kernel, filter_weight: FilterWeight::Unit, ..builder::settings() };
        let camera = camera([0.0, 0.0, 3.2], [0.0; 3]);
        let frame = render(
            &mut headless,
            &Hard { name: "steep kernel", scene: builder.scene(false), camera, settings },
        );
        assert_finite(&frame, "steep kernel");
        let covered = frame.weight.iter().filter(|weight| **weight > 0.0).count();
        assert_eq!((covered, frame.weight[32 * 65 + 32]), (1, 1.0), "{kernel:?}");
    }
}
