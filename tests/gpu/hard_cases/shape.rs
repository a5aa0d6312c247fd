//! Where a splat's image lies and how large it is: N1–N5, N7, N20, N24, N25.

use glam::{DQuat, DVec3};
use surfel::scene::{Epsilon, Filter, FilterWeight, Settings};

use super::{GRAY, hard, of_size};
use crate::common::{
    assert_agrees,
    builder::{Builder, Random, camera, settings},
    render,
    scenes::{self, Hard},
    shared,
};

/// Everything is one surface: each splat shows in the weights, whatever lies before it.
const ALL_ONE: Epsilon = Epsilon::Length(1e4);

#[test]
fn n01_an_edge_on_splat_shrinks_to_a_line_and_never_grows() {
    let mut headless = shared();
    let (radius, distance) = (0.5, 3.0);
    for filter in [Filter::None, Filter::Adjust] {
        // With an odd size the line runs through pixel centers, with an even one between them.
        for side_px in [255, 256] {
            for (turn, turned) in [("level", 0.0), ("turned", 0.3)] {
                let focal_px = 0.5 * f64::from(side_px) / 22.5_f64.to_radians().tan();
                let length_px = 2.0 * radius / distance * focal_px;
                for side in [1.0, -1.0] {
                    let mut before = f64::INFINITY;
                    for k in 1..=9 {
                        // The ninth is exactly edge-on.
                        let tilt = if k == 9 { 0.0 } else { side * 10.0_f64.powi(-k).to_radians() };
                        let up = DQuat::from_rotation_z(turned) * DVec3::Y;
                        let mut builder = Builder::default();
                        builder.disk(DVec3::ZERO, up * tilt.cos() + DVec3::Z * tilt.sin(), radius, GRAY);
                        let settings = Settings { filter, ..of_size(side_px) };
                        let frame = render(&mut headless, &hard("edge-on", builder, settings));
                        let area = frame.weight.iter().filter(|weight| **weight > 0.0).count() as f64;
                        assert!(frame.weight.iter().all(|weight| weight.is_finite()));
                        // The filter's band is as wide at every angle, with a pixel more or less at its border where the
                        // disk still has depth.
                        let more = if filter == Filter::Adjust { 4.0 } else { 0.0 };
                        // Without a filter the line's ends are rounding once the cosine has lost its digits: by 2 pixels each.
                        let longest = if k >= 5 { length_px + 4.0 } else { 0.0 };
                        assert!(
                            area <= f64::max(before + more, longest),
                            "{filter:?} {side_px} {turn} 1e-{k}: {area} after {before}"
                        );
                        before = area;
                        // A line one pixel wide; with the filter a band as wide as its diameter, √8 pixels.
                        let most = match filter {
                            Filter::None if k >= 3 => 1.2 * length_px,
                            Filter::None => f64::INFINITY,
                            _ => (length_px + 3.0) * 2.6,
                        };
                        assert!(area <= most, "{filter:?} {side_px} {turn} 1e-{k}: {area} > {most}");
                        // π/4 · length · 2√2, but for the pixels at its border.
                        let least = if filter == Filter::Adjust { length_px * 1.8 } else { 0.0 };
                        assert!(area >= least, "{filter:?} {side_px} {turn} 1e-{k}: {area} < {least}");
                    }
                    if filter == Filter::None {
                        assert_eq!(before, 0.0, "a disk whose plane holds the eye has no area");
                    }
                }
            }
        }
    }
}

#[test]
fn n02_disks_through_the_eye_and_around_it_agree() {
    let mut headless = shared();
    for filter in [Filter::None, Filter::Adjust] {
        let mut random = Random(20);
        let eye = DVec3::new(0.0, 0.0, 3.0);
        let mut builder = Builder::default();
        for i in 0..16 {
            let normal = random.direction();
            // The eye over the disk, near its middle or its rim. A normal in f32 puts the plane wrong by 6e-8 of the
            // radius: of a height of 0.01 that is 6e-6.
            let along = normal.cross(random.direction()).normalize() * random.between(0.0, 0.9);
            let above = [0.3, 0.1, 0.03, 0.01][i % 4];
            builder.disk((eye + along + normal * above).as_vec3().as_dvec3(), normal, 1.0, random.color());
        }
        let mut hard = hard("around the eye", builder, Settings { filter, epsilon: ALL_ONE, ..settings() });
        hard.camera.near = Some(1e-3);
        assert_agrees(&mut headless, &hard, 1000);

        // The eye in the plane, but for rounding: a line at most. Its pixels have no reference, since f32 does not hold on
        // which side the eye is.
        for _ in 0..8 {
            let normal = random.direction();
            let along = normal.cross(random.direction()).normalize() * random.between(0.0, 0.9);
            let mut builder = Builder::default();
            builder.disk(eye + along, normal, 1.0, GRAY);
            hard.scene = builder.scene(false);
            hard.settings.filter = Filter::None;
            let frame = render(&mut headless, &hard);
            assert!(frame.weight.iter().chain(frame.normal.iter().flatten()).all(|value| value.is_finite()));
            let area = frame.weight.iter().filter(|weight| **weight > 0.0).count();
            assert!(area <= 300, "{area} pixels");
        }
    }
}

/// The center of such a disk projects to infinity: what its fragments get must not depend on where.
#[test]
fn n02_a_center_in_the_plane_of_the_eye_agrees() {
    let mut headless = shared();
    for depth in [0.0, 1e-7, -1e-7, 1e-6, -1e-6, 1e-5, -1e-4, 1e-3] {
        for turn in [0.1, 1.7, 3.3, 4.9] {
            let around = DQuat::from_rotation_z(turn);
            let mut builder = Builder::default();
            let center = around * DVec3::new(0.4, 0.05, 0.0) + DVec3::Z * (3.0 - depth);
            let normal = around * DVec3::new(1.0, 0.2, -0.3).normalize();
            builder.disk(center, normal, 2.0, GRAY);
            let mut hard = hard("center beside the eye", builder, of_size(128));
            hard.camera.near = Some(1e-4);
            assert_agrees(&mut headless, &hard, 1000);
        }
    }
}

#[test]
fn n03_boxes_come_from_the_contour_not_from_the_center() {
    let mut headless = shared();
    let mut random = Random(30);
    let mut builder = Builder::default();
    // Nearly as deep as they are far: the projected center is far from the middle of the ellipse.
    for _ in 0..60 {
        let position = DVec3::new(random.between(-1.0, 1.0), random.between(-1.0, 1.0), 1.0);
        let normal = (random.direction() * DVec3::new(1.0, 1.0, 0.3)).normalize();
        let radius = random.between(0.5, 2.2);
        builder.disk(position.as_vec3().as_dvec3(), normal, radius, random.color());
    }
    let hard = hard("strong perspective", builder, Settings { epsilon: ALL_ONE, ..settings() });
    assert_agrees(&mut headless, &hard, 1000);
}

#[test]
fn n04_a_radius_of_a_hundred_distances_agrees() {
    let mut headless = shared();
    for tilt in [0.0, 0.5, 1.2, 1.5] {
        let mut builder = Builder::default();
        builder.disk(DVec3::ZERO, DQuat::from_rotation_x(tilt) * DVec3::Z, 300.0, GRAY);
        assert_agrees(&mut headless, &hard("radius 100 distances", builder, of_size(128)), 1000);
    }
}

#[test]
fn n05_a_center_beyond_each_side_and_corner_hides_nothing() {
    let mut headless = shared();
    let pixel = 3.0 * 22.5_f64.to_radians().tan() / 64.0;
    for (x, y) in [(1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1), (0, -1), (1, -1)] {
        for beyond_px in [0.5, 1.0, 7.0, 50.0, 200.0] {
            let to = (64.0 + beyond_px) * pixel;
            let mut builder = Builder::default();
            let position = DVec3::new(f64::from(x) * to, f64::from(y) * to, 0.0).as_vec3().as_dvec3();
            // Reaches 20 pixels into the image, from a corner too.
            let radius = (beyond_px + 20.0) * pixel * 2.0_f64.sqrt();
            builder.disk(position, DVec3::new(0.02, -0.01, 1.0).normalize(), radius, GRAY);
            assert_agrees(&mut headless, &hard("center off-screen", builder, of_size(128)), 100);
        }
    }
}

#[test]
fn n07_subpixel_splats_are_all_seen_and_none_weighs_more_than_another() {
    let mut headless = shared();
    // 32 × 32 disks, 8 pixels apart, each at another place within its pixel.
    let pixel = 3.0 * 22.5_f64.to_radians().tan() / 128.0;
    for radius_px in [1e-6, 1e-3, 0.1, 0.5, 1.0] {
        let mut builder = Builder::default();
        for i in 0..32 {
            for j in 0..32 {
                let at =
                    |i: i32, j: i32| pixel * (f64::from(8 * i - 124) + f64::from(i + 5 * j) / 32.0 % 1.0);
                builder.disk(DVec3::new(at(i, j), at(j, i), 0.0), DVec3::Z, radius_px * pixel, GRAY);
            }
        }
        let hard = hard("subpixel", builder, settings());
        // The drawn radius h' and the share of its weight: that of `adjust`, whose axes become √(l² + h²) long.
        let drawn_px2 = 2.0 + radius_px * radius_px;
        let share = radius_px * radius_px / drawn_px2;
        for (filter_weight, share) in [(FilterWeight::Unit, 1.0), (FilterWeight::Area, share)] {
            let hard = Hard { settings: Settings { filter_weight, ..hard.settings.clone() }, ..hard.clone() };
            let frame = render(&mut headless, &hard);
            let mut sums = vec![0.0; 32 * 32];
            for (pixel, weight) in frame.weight.iter().enumerate() {
                sums[pixel / 256 / 8 * 32 + pixel % 256 / 8] += f64::from(*weight);
            }
            // ∫ exp(−2 r²/h'²) over the disk of radius h': π h'²/2 · (1 − e⁻²).
            let expected = share * 0.5 * std::f64::consts::PI * drawn_px2 * (1.0 - (-2.0_f64).exp());
            let mean = sums.iter().sum::<f64>() / 1024.0;
            println!("radius {radius_px} px: mean weight {:.4} of the integral", mean / expected);
            assert!((mean / expected - 1.0).abs() < 0.01, "{radius_px}: {mean}, expected {expected}");
            assert!(sums.iter().all(|sum| (0.75..1.25).contains(&(sum / expected))), "{radius_px}");
        }
    }
}

#[test]
fn n20_needles_agree() {
    let mut headless = shared();
    let mut random = Random(200);
    let mut builder = Builder::default();
    for i in 0..200 {
        let s = random.direction() * random.between(0.1, 0.6);
        let t = s.cross(random.direction()) * 10.0_f64.powi(-(i % 7));
        let position = DVec3::new(random.between(-1.0, 1.0), random.between(-1.0, 1.0), 0.0);
        builder.ellipse(position.as_vec3().as_dvec3(), s, t, random.color());
    }
    let hard = hard("needles", builder, Settings { epsilon: ALL_ONE, ..settings() });
    assert_agrees(&mut headless, &hard, 1000);
}

#[test]
fn n24_slanted_and_left_handed_tangents_agree() {
    let mut headless = shared();
    for filter in [Filter::None, Filter::Adjust] {
        let mut random = Random(240);
        let mut builder = Builder::default();
        for i in 0..200 {
            let s = random.direction() * random.between(0.1, 0.3);
            let t = random.direction() * random.between(0.1, 0.3) + 0.8 * s;
            let position = DVec3::new(random.between(-1.0, 1.0), random.between(-1.0, 1.0), 0.0);
            let (s, t) = if i % 2 == 0 { (s, t) } else { (t, s) };
            builder.ellipse(position.as_vec3().as_dvec3(), s, t, random.color());
        }
        let hard = hard("slanted tangents", builder, Settings { filter, ..settings() });
        assert_agrees(&mut headless, &hard, 1000);
    }
}

#[test]
fn n25_fields_of_view_from_1_to_170_degrees_agree() {
    let mut headless = shared();
    for (name, fov_deg, distance) in [
        ("1 degree", 1.0, 150.0),
        ("60 degrees", 60.0, 2.6),
        ("120 degrees", 120.0, 1.5),
        ("170 degrees", 170.0, 1.05),
    ] {
        let ellipses = scenes::random_ellipses(Filter::Adjust);
        let mut camera = camera([0.0, 0.0, distance], [0.0; 3]);
        camera.fov_y_rad = f64::to_radians(fov_deg);
        assert_agrees(&mut headless, &Hard { name, camera, ..ellipses }, 1000);
    }
}
