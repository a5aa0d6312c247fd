//! Which surface is seen: N8, N9, N15, N16.

use glam::{DQuat, DVec3};
use surfel::scene::{Epsilon, Filter, Settings};

use super::of_size;
use crate::common::{
    assert_agrees, assert_same_bits,
    builder::{Builder, camera, settings},
    render,
    scenes::{Hard, sphere},
    shared,
};
use surfel::scene::Scene;

const NEAR: [f32; 4] = [1.0, 0.25, 0.0, 1.0];
const FAR: [f32; 4] = [0.0, 0.25, 1.0, 1.0];

#[test]
fn n08_of_two_disks_a_hundred_thousandth_apart_the_nearer_is_seen_at_every_distance() {
    let mut headless = shared();
    let near = 1e-3;
    for exponent in 0..=7 {
        // A little beyond the near plane, so that both are seen.
        let distance = 1.01 * near * 10.0_f64.powi(exponent);
        for nearer_first in [true, false] {
            let mut disks = [(distance, NEAR), (distance * (1.0 + 1e-5), FAR)];
            if !nearer_first {
                disks.reverse();
            }
            let mut builder = Builder::default();
            for (z, color) in disks {
                builder.disk(DVec3::new(0.0, 0.0, -z), DVec3::Z, 0.3 * distance, color);
            }
            let mut camera = camera([0.0; 3], [0.0, 0.0, -1.0]);
            camera.near = Some(near);
            let settings = Settings { epsilon: Epsilon::Length(0.0), ..of_size(64) };
            let frame =
                render(&mut headless, &Hard { name: "range", scene: builder.scene(false), camera, settings });
            let covered: Vec<_> = (0..frame.weight.len()).filter(|i| frame.weight[*i] > 0.0).collect();
            assert!(covered.len() > 1000, "{distance}: {} pixels", covered.len());
            // The farther disk's rim lies inside the nearer one's, so that it is seen nowhere.
            for i in covered {
                assert!(
                    (frame.albedo[i][0] - 1.0).abs() < 1e-4 && frame.albedo[i][2] < 1e-4,
                    "{distance}: {i}"
                );
                let depth = f64::from(frame.depth[i]);
                assert!((depth / distance - 1.0).abs() < 2e-6, "{distance}: depth {depth}");
            }
        }
    }
}

#[test]
fn n09_a_scene_moved_by_a_representable_offset_gives_the_same_bits() {
    let mut headless = shared();
    let at = |offset: DVec3| {
        let mut camera = camera([0.5, 0.25, 3.0], [0.0; 3]);
        camera.eye += offset;
        camera.target += offset;
        let scene = Scene { objects: vec![sphere(1000, offset)], ..Scene::default() };
        Hard { name: "moved", scene, camera, settings: settings() }
    };
    let here = render(&mut headless, &at(DVec3::ZERO));
    for offset in [[500_000.0, 4_000_000.0, 100.0], [-849_000.0, 4.88e6, -3.0]] {
        let there = render(&mut headless, &at(offset.into()));
        assert_same_bits(&here, &there, &format!("{offset:?}"));
    }
}

#[test]
fn n15_parallel_sheets_within_epsilon_are_one_surface_and_beyond_it_two() {
    let mut headless = shared();
    for (distance, epsilon) in [(0.02, 0.001), (3.0, 0.01), (1000.0, 0.1)] {
        for k in [0.5, 0.9, 0.99, 1.01, 1.1, 2.0] {
            let mut builder = Builder::default();
            for (z, color) in [(0.0, NEAR), (k * epsilon, FAR)] {
                builder.disk(DVec3::new(0.0, 0.0, -distance - z), DVec3::Z, 10.0 * distance, color);
            }
            let camera = camera([0.0; 3], [0.0, 0.0, -1.0]);
            let settings = Settings { epsilon: Epsilon::Length(epsilon), ..of_size(64) };
            let hard = Hard { name: "parallel sheets", scene: builder.scene(false), camera, settings };
            // Nearer to the threshold than 1e-4 of the depth every pixel is exempt: the closed form below is left.
            let exempt = (k - 1.0_f64).abs() * epsilon < 1.1e-4 * distance;
            let (frame, _) = assert_agrees(&mut headless, &hard, if exempt { 0 } else { 1000 });
            for (i, albedo) in frame.albedo.iter().enumerate() {
                // Both fill the view and have nearly the same weight there.
                let [red, _, blue, _] = *albedo;
                let blended = (red - 0.5).abs() < 0.05 && (blue - 0.5).abs() < 0.05;
                let alone = red > 0.999 && blue < 0.001;
                assert!(if k < 1.0 { blended } else { alone }, "{distance} {k}: pixel {i}: {albedo:?}");
            }
        }
    }
}

#[test]
fn n16_crossing_disks_meet_in_their_line_of_intersection() {
    let mut headless = shared();
    // Turned about a line in both, which is not the image's middle: x = 0.3, z = 0.2, along y.
    let line = DVec3::new(0.3, 0.0, 0.2);
    let mut builder = Builder::default();
    for (angle, color) in [(-0.6, NEAR), (0.9, FAR)] {
        let turn = DQuat::from_rotation_y(angle);
        // The line is not through the centers.
        builder.disk(line + turn * DVec3::new(0.2, 0.0, 0.0), turn * DVec3::Z, 2.0, color);
    }
    let settings = Settings { epsilon: Epsilon::Length(0.0), filter: Filter::None, ..of_size(256) };
    let camera = camera([0.0, 0.0, 3.0], [0.0; 3]);
    let focal_px = camera.focal_px(256);
    let hard = Hard { name: "crossing disks", scene: builder.scene(false), camera, settings };
    let (frame, _) = assert_agrees(&mut headless, &hard, 1000);
    let line_px = 128.0 + focal_px * line.x / (3.0 - line.z);
    for row in 64..192 {
        // A disk turned by a positive angle about y comes nearer on its left side (x < the line).
        for column in 64..224 {
            let x_px = f64::from(column) + 0.5;
            if (x_px - line_px).abs() <= 1.0 {
                continue;
            }
            let color = frame.albedo[(row * 256 + column) as usize];
            let expected = if x_px < line_px { FAR } else { NEAR };
            assert!((color[0] - expected[0]).abs() < 1e-3, "row {row}, column {column}: {color:?}");
        }
    }
}
