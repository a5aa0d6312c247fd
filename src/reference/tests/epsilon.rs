//! Which fragments are one surface.

use glam::DVec3;

use super::*;
use crate::scene::Shading;

const RED: [f32; 4] = [1.0, 0.0, 0.0, 1.0];
const BLUE: [f32; 4] = [0.0, 0.0, 1.0, 1.0];

/// Two sheets `distance` apart, the nearer one red at depth `z`.
fn sheets(z: f64, distance: f64, radius: f32) -> Scene {
    ellipses(&[facing_disk(DVec3::Z * (z + distance), radius, BLUE), facing_disk(DVec3::Z * z, radius, RED)])
}

#[test]
fn parallel_sheets_blend_up_to_epsilon_apart_and_not_beyond() {
    for z in [0.1, 1.0, 1000.0] {
        let epsilon = 0.01 * z;
        for k in [0.5, 0.9, 0.999_999, 1.000_001, 1.1, 1.5, 2.0] {
            let settings = Settings { epsilon: Epsilon::Length(epsilon), ..settings(33) };
            let picture = picture(&sheets(z, k * epsilon, 0.3 * z as f32), &settings);
            let middle = picture.pixel(16, 16).unwrap();
            let (weight, albedo) = if k <= 1.0 { (2.0, [0.5, 0.0, 0.5]) } else { (1.0, [1.0, 0.0, 0.0]) };
            assert!((middle.weight - weight).abs() < 1e-12, "k {k}, z {z}: {}", middle.weight);
            assert_eq!(middle.albedo, albedo, "k {k}, z {z}");
            // By hand: the threshold is z + ε, the far sheet at z + kε.
            let margin = (k - 1.0_f64).abs() * 0.01 / 1.01;
            assert!((middle.epsilon_margin - margin).abs() < 1e-9 * margin.max(1e-5), "k {k}, z {z}");
        }
    }
}

#[test]
fn epsilon_in_radii_is_that_of_the_larger_radius_before_the_filter() {
    // A needle 0.2 long and far below a pixel wide: the filter widens it, ε stays 0.2.
    let needle = |z: f64, color| (DVec3::Z * z, glam::Vec3::Y * 0.2, glam::Vec3::X * 1e-4, color);
    let settings = Settings { filter: Filter::Adjust, ..settings(33) };
    for (distance, weight) in [(0.199, 2.0), (0.201, 1.0)] {
        let scene = ellipses(&[needle(3.0, RED), needle(3.0 + distance, BLUE)]);
        let middle = *picture(&scene, &settings).pixel(16, 16).unwrap();
        assert!((middle.weight - weight).abs() < 1e-12, "{distance}: {}", middle.weight);
    }
    for (factor, weight) in [(0.9, 1.0), (1.1, 2.0)] {
        let scene = ellipses(&[needle(3.0, RED), needle(3.2, BLUE)]);
        let settings = Settings { epsilon: Epsilon::Radii(factor), ..settings.clone() };
        let middle = *picture(&scene, &settings).pixel(16, 16).unwrap();
        assert!((middle.weight - weight).abs() < 1e-12, "{factor}: {}", middle.weight);
    }
}

#[test]
fn without_epsilon_only_the_nearest_depth_counts_and_equals_count_together() {
    let settings = Settings { epsilon: Epsilon::Length(0.0), ..settings(33) };
    let apart = *picture(&sheets(2.0, 1e-9, 0.5), &settings).pixel(16, 16).unwrap();
    assert_eq!((apart.weight, apart.albedo), (1.0, [1.0, 0.0, 0.0]));
    let together = *picture(&sheets(2.0, 0.0, 0.5), &settings).pixel(16, 16).unwrap();
    assert_eq!((together.weight, together.albedo), (2.0, [0.5, 0.0, 0.5]));
}

#[test]
fn a_splat_nearer_than_epsilon_is_shifted_to_twice_its_depth() {
    // f = 1 + ε/max(p_z, ε) = 2: the threshold is at 2 · 0.5.
    let settings = Settings { epsilon: Epsilon::Length(100.0), ..settings(33) };
    for (z, weight) in [(0.99, 2.0), (1.01, 1.0)] {
        let middle = *picture(&sheets(0.5, z - 0.5, 0.3), &settings).pixel(16, 16).unwrap();
        assert!((middle.weight - weight).abs() < 1e-12, "{z}");
    }
}

#[test]
fn a_fragment_below_the_smallest_weight_hides_nothing() {
    // The red disk's kernel has faded out at the middle pixel, though the disk reaches it.
    let kernel = Kernel::Gaussian { sigma: 0.1 };
    let settings =
        Settings { kernel, epsilon: Epsilon::Length(0.0), shading: Shading::Albedo, ..settings(33) };
    for (shift, albedo) in [(0.58, [0.0, 0.0, 1.0]), (0.57, [1.0, 0.0, 0.0])] {
        let scene = ellipses(&[
            facing_disk(DVec3::new(shift, 0.0, 1.0), 1.0, RED),
            facing_disk(DVec3::Z * 2.0, 1.0, BLUE),
        ]);
        assert_eq!(picture(&scene, &settings).pixel(16, 16).unwrap().albedo, albedo, "{shift}");
    }
}

#[test]
fn a_thin_wall_mixes_its_sides_unless_it_is_known_to_be_closed() {
    // Front faces the eye, back faces away, 0.1 apart, ε = radius = 0.5.
    let front = facing_disk(DVec3::Z * 2.0, 0.5, RED);
    let back = (DVec3::Z * 2.1, glam::Vec3::X * 0.5, glam::Vec3::Y * 0.5, BLUE);
    let mut scene = ellipses(&[front, back]);
    let radius = Settings { epsilon: Epsilon::Radii(1.0), ..settings(33) };
    let open = *picture(&scene, &radius).pixel(16, 16).unwrap();
    assert_eq!(open.albedo, [0.5, 0.0, 0.5]);
    assert_eq!(open.normal, [0.0, 0.0, -1.0]);
    // Half of 0.1 has no room for both.
    let fits = *picture(&scene, &Settings { epsilon: Epsilon::Auto, ..settings(33) }).pixel(16, 16).unwrap();
    assert_eq!(fits.albedo, [1.0, 0.0, 0.0]);
    scene.objects[0].closed = true;
    let closed = *picture(&scene, &radius).pixel(16, 16).unwrap();
    assert_eq!(closed.albedo, [1.0, 0.0, 0.0]);
}

#[test]
fn the_shift_goes_by_the_depth_of_the_center_not_by_its_distance() {
    // Off the axis: depth 1, distance 1.7. The threshold is 1 + ε.
    let settings = Settings { epsilon: Epsilon::Length(0.1), ..settings(32) };
    for (distance, weight) in [(0.099, 2.0), (0.101, 1.0)] {
        let place = DVec3::new(0.984_375, 0.984_375, 1.0);
        let scene =
            ellipses(&[facing_disk(place, 0.5, RED), facing_disk(place * (1.0 + distance), 0.5, BLUE)]);
        let last = *picture(&scene, &settings).pixel(31, 31).unwrap();
        assert!((last.weight.round() - weight).abs() < 1e-12 && last.weight > 0.9 * weight, "{distance}");
    }
}
