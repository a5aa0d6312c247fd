//! Transparent polygons: alone, and in one layer with splats.

use super::*;
use crate::scene::{LastLayer, Layers, Shading, Transition};

const RED: [f32; 4] = [1.0, 0.0, 0.0, 0.5];
const GREEN: [f32; 4] = [0.0, 1.0, 0.0, 0.25];

fn plain(epsilon: Epsilon) -> Settings {
    Settings {
        shading: Shading::Albedo,
        background: None,
        epsilon,
        layers: Layers::Fixed(256),
        ..settings(33)
    }
}

#[test]
fn every_pixel_of_a_transparent_square_has_one_layer_the_seam_of_its_triangles_too() {
    // The diagonal goes through pixel centers.
    let seen = picture(&meshes(vec![square(2.0, 1.0, RED)]), &plain(Epsilon::Length(0.0)));
    for (x, y, pixel) in pixels_at(&seen) {
        let inside = x.abs().max(y.abs()) < 0.5;
        assert_eq!(pixel.layers, u32::from(inside), "{x}, {y}");
        let expected = if inside { [1.0, 0.0, 0.0, 0.5] } else { [0.0; 4] };
        assert_color(pixel, expected);
        assert!(!pixel.polygon && pixel.weight == 0.0 && pixel.depth == f64::INFINITY);
    }
}

#[test]
fn polygons_within_epsilon_are_one_layer_of_plain_means() {
    for (apart, color, layers) in [
        (0.09, [0.5, 0.5, 0.0, 0.375], 1),
        // 1 − ½ · ¾ = 5/8; red ½, green ⅛.
        (0.11, [0.8, 0.2, 0.0, 0.625], 2),
    ] {
        let scene = meshes(vec![square(2.0 + apart, 2.0, GREEN), square(2.0, 2.0, RED)]);
        let pixel = middle(&scene, &plain(Epsilon::Length(0.1)));
        assert_color(&pixel, color);
        assert_eq!(pixel.layers, layers);
        assert!((pixel.epsilon_margin - 0.01 / 2.1).abs() < 1e-12, "{}", pixel.epsilon_margin);
    }
}

#[test]
fn epsilon_in_radii_is_the_mean_of_the_transparent_splats_that_can_be_drawn() {
    let squares = |apart: f64| vec![square(2.0 + apart, 2.0, GREEN), square(2.0, 2.0, RED)];
    let layers = |scene: &Scene, factor| middle(scene, &plain(Epsilon::Radii(factor))).layers;
    for (factor, apart, expected) in [(1.0, 0.99, 1), (1.0, 1.01, 2), (0.5, 0.49, 1), (0.5, 0.51, 2)] {
        // Beside the picture: radii ½ and 3/2, mean 1. One without a place, an opaque and an invisible one don't count.
        let aside = DVec3::new(100.0, 0.0, 2.0);
        let mut scene = objects(&[
            &[facing_disk(aside, 0.5, RED), facing_disk(DVec3::NAN, 7.0, RED)],
            &[(aside, Vec3::Y * 0.1, Vec3::X * 1.5, RED)],
            &[facing_disk(aside, 9.0, GRAY)],
            &[facing_disk(aside, 9.0, [1.0, 1.0, 1.0, 0.0])],
        ]);
        scene.meshes = squares(apart);
        assert_eq!(layers(&scene, factor), expected, "{factor}, {apart}");
    }
    // Without such splats it is 0.
    assert_eq!(layers(&meshes(squares(1e-9)), 1.0), 2);
    assert_eq!(layers(&meshes(squares(0.0)), 1.0), 1);
}

/// A splat that weighs `exp(−½)` in the middle, where it is at depth 3, turned by 30°.
fn turned(color: [f32; 4]) -> Ellipse {
    let (sin, cos) = (0.5, 0.75_f32.sqrt());
    (DVec3::new(0.0, 0.25, 3.0), Vec3::Y * 0.5, Vec3::new(cos, 0.0, sin) * 0.5, color)
}

#[test]
fn splats_and_polygons_of_a_layer_are_joined_by_the_transition() {
    let mut scene = ellipses(&[turned(GREEN)]);
    scene.meshes = vec![square(3.0, 2.0, RED)];
    let s = (-0.5_f64).exp();
    let with = |transition| {
        let shading = Shading::Lambert;
        middle(&scene, &Settings { transition, shading, ..plain(Epsilon::Length(0.1)) })
    };
    // Red faces the eye, green is lit by cos 30°; alphas ½ and ¼.
    let green_light = 0.1 + 0.9 * 0.75_f64.sqrt();
    let alpha = 0.5 * (1.0 - s) + 0.25 * s;
    let expected = [0.5 * (1.0 - s) / alpha, 0.25 * s * green_light / alpha, 0.0, alpha];
    assert_color(&with(Transition::Color), expected);
    assert_color(&with(Transition::Paper), expected);
    assert_color(&with(Transition::None), [1.0, 0.0, 0.0, 0.5]);
    let normal = DVec3::new(0.5 * s, 0.0, -(1.0 - s) - 0.75_f64.sqrt() * s).normalize();
    let light = 0.1 - 0.9 * normal.z;
    assert_color(&with(Transition::Attributes), [(1.0 - s) * light, s * light, 0.0, alpha]);
    assert_eq!(with(Transition::Color).layers, 1);
}

#[test]
fn the_last_layer_blends_polygons_with_weight_1() {
    let mut scene = ellipses(&[turned(GREEN)]);
    scene.meshes = vec![square(5.0, 3.0, RED)];
    let last_layer = LastLayer::Blend;
    let pixel =
        middle(&scene, &Settings { layers: Layers::Fixed(1), last_layer, ..plain(Epsilon::Length(0.1)) });
    let s = (-0.5_f64).exp();
    let sum = 0.5 + 0.25 * s;
    assert_color(&pixel, [0.5 / sum, 0.25 * s / sum, 0.0, sum / (1.0 + s)]);
    assert_eq!(pixel.layers, 2);
}

#[test]
fn polygons_hide_by_their_own_depth() {
    for (z, layers) in [(3.0, 1), (3.0 + 1e-9, 0), (2.0, 1)] {
        let mut scene = ellipses(&[facing_disk(DVec3::Z * z, 2.0, RED)]);
        scene.meshes = vec![square(3.0, 2.0, [0.0, 0.0, 1.0, 1.0])];
        let pixel = middle(&scene, &plain(Epsilon::Length(0.1)));
        assert_eq!((pixel.layers, pixel.polygon), (layers, true), "{z}");
        let seen = f64::from(layers) / 2.0;
        assert_color(&pixel, [seen, 0.0, 1.0 - seen, 1.0]);
        assert!((pixel.epsilon_margin - (z - 3.0).abs() / 3.0).abs() < 1e-12);
        // The same of a transparent polygon.
        let list = vec![square(z, 2.0, RED), square(3.0, 2.0, [0.0, 0.0, 1.0, 1.0])];
        assert_eq!(middle(&meshes(list), &plain(Epsilon::Length(0.1))).color, pixel.color, "{z}");
    }
}
