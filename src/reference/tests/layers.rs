//! Transparent splats: which are one layer, and what is seen through them.

use super::*;
use crate::scene::{Backfaces, LastLayer, Layers, Shading};

const RED: [f32; 3] = [1.0, 0.0, 0.0];
const GREEN: [f32; 3] = [0.0, 1.0, 0.0];
const BLUE: [f32; 3] = [0.0, 0.0, 1.0];

/// A sheet that faces the eye and covers the picture.
fn sheet(z: f64, [red, green, blue]: [f32; 3], alpha: f32) -> Ellipse {
    facing_disk(DVec3::Z * z, 3.0 * z as f32, [red, green, blue, alpha])
}

/// Exact layers of plain colors on black.
fn plain(epsilon: f64) -> Settings {
    Settings {
        shading: Shading::Albedo,
        background: Some([0.0; 3]),
        epsilon: Epsilon::Length(epsilon),
        layers: Layers::Fixed(256),
        ..settings(9)
    }
}

#[test]
fn sheets_lie_over_each_other_in_every_pixel() {
    // Listed from the middle one on.
    let scene = ellipses(&[sheet(3.0, GREEN, 0.25), sheet(2.0, RED, 0.5), sheet(4.0, BLUE, 0.75)]);
    let seen = picture(&scene, &plain(0.01));
    for pixel in &seen.pixels {
        // Through red ½, through green ¾ of that.
        assert_color(pixel, [0.5, 0.5 * 0.25, 0.5 * 0.75 * 0.75, 1.0]);
        assert_eq!((pixel.layers, pixel.weight, pixel.depth), (3, 0.0, f64::INFINITY));
    }
    // The rest of the light, 0.5 · 0.75 · 0.25, is that of the background.
    let white = Settings { background: Some([1.0; 3]), ..plain(0.01) };
    let through = 0.093_75;
    assert_color(&middle(&scene, &white), [0.5 + through, 0.125 + through, 0.281_25 + through, 1.0]);
}

#[test]
fn without_a_background_the_color_is_not_multiplied_by_alpha() {
    let none = Settings { background: None, ..plain(0.01) };
    let two = middle(&ellipses(&[sheet(2.0, RED, 0.5), sheet(3.0, GREEN, 0.25)]), &none);
    // 1 − ½ · ¾; (½, ⅛) over it.
    assert_color(&two, [0.8, 0.2, 0.0, 0.625]);
    let clear = middle(&ellipses(&[sheet(2.0, RED, 0.0), sheet(3.0, GREEN, 0.25)]), &none);
    assert_color(&clear, [0.0, 1.0, 0.0, 0.25]);
    let small = facing_disk(DVec3::Z * 2.0, 0.1, [1.0, 0.0, 0.0, 0.5]);
    let beside = *picture(&ellipses(&[small]), &none).pixel(0, 0).unwrap();
    assert_eq!((beside.color, beside.layers), ([0.0; 4], 0));
}

#[test]
fn sheets_up_to_epsilon_apart_are_one_layer_and_those_beyond_are_two() {
    for k in [0.0, 0.5, 0.999_999, 1.000_001, 1.5] {
        let scene = ellipses(&[sheet(2.0 + 0.1 * k, BLUE, 1.0), sheet(2.0, RED, 0.5)]);
        let pixel = middle(&scene, &plain(0.1));
        // Together: albedo (½, 0, ½), alpha ¾. Apart: half of the blue one is seen.
        let (color, layers) = if k <= 1.0 { (0.375, 1) } else { (0.5, 2) };
        assert_color(&pixel, [color, 0.0, color, 1.0]);
        assert_eq!(pixel.layers, layers, "{k}");
        // The threshold is at 2.1.
        let margin = 0.1 * (k - 1.0_f64).abs() / 2.1;
        assert!((pixel.epsilon_margin - margin).abs() < 1e-9, "{k}: {}", pixel.epsilon_margin);
    }
}

#[test]
fn a_layer_reaches_epsilon_behind_its_nearest_fragment_and_not_on_from_there() {
    let scene = ellipses(&[sheet(2.18, BLUE, 0.5), sheet(2.09, GREEN, 0.5), sheet(2.0, RED, 0.5)]);
    let pixel = middle(&scene, &plain(0.1));
    assert_color(&pixel, [0.25, 0.25, 0.25, 1.0]);
    assert_eq!(pixel.layers, 2);
    // In the first layer 2.09 against 2.1; in the second one 2.18 is alone.
    assert!((pixel.epsilon_margin - 0.01 / 2.1).abs() < 1e-12, "{}", pixel.epsilon_margin);
}

#[test]
fn the_margin_is_that_of_the_closest_decision_in_any_layer() {
    // 3.104 is not of the second layer by 0.004, of 3.1.
    let scene = ellipses(&[sheet(2.0, RED, 0.5), sheet(3.0, RED, 0.5), sheet(3.104, RED, 0.5)]);
    let all = middle(&scene, &plain(0.1));
    assert_eq!(all.layers, 3);
    assert!((all.epsilon_margin - 0.004 / 3.1).abs() < 1e-12, "{}", all.epsilon_margin);
    // A layer that is not drawn decides nothing: 3 and more are behind 2.1.
    for (layers, last_layer) in [(1, LastLayer::Drop), (2, LastLayer::Blend)] {
        let settings = Settings { layers: Layers::Fixed(layers), last_layer, ..plain(0.1) };
        let pixel = middle(&scene, &settings);
        assert_eq!(pixel.layers, 3);
        assert!((pixel.epsilon_margin - 0.9 / 2.1).abs() < 1e-12, "{}", pixel.epsilon_margin);
    }
}

#[test]
fn without_epsilon_sheets_at_one_place_are_one_layer_and_a_hair_apart_two() {
    let pixel =
        |apart: f64| middle(&ellipses(&[sheet(2.0, RED, 0.5), sheet(2.0 + apart, GREEN, 0.5)]), &plain(0.0));
    let together = pixel(0.0);
    assert_color(&together, [0.25, 0.25, 0.0, 1.0]);
    assert_eq!((together.layers, together.epsilon_margin), (1, 0.0));
    let apart = pixel(1e-9);
    assert_color(&apart, [0.5, 0.25, 0.0, 1.0]);
    assert_eq!(apart.layers, 2);
}

#[test]
fn weights_mix_albedo_and_alpha_within_a_layer() {
    // Weights exp(−2/16) and exp(−18/16): shares 1/(1 + e⁻¹) and the rest.
    let scene = ellipses(&[
        facing_disk(DVec3::new(-0.125, 0.0, 1.0), 0.5, [1.0, 0.0, 0.0, 1.0]),
        facing_disk(DVec3::new(0.375, 0.0, 1.0), 0.5, [0.0, 1.0, 0.0, 0.0]),
    ]);
    let pixel = middle(&scene, &Settings { background: None, ..plain(0.01) });
    let share = 0.731_058_578_630_004_9;
    assert_color(&pixel, [share, 1.0 - share, 0.0, share]);
}

#[test]
fn alpha_0_is_a_layer_that_shows_nothing_and_alpha_1_hides_all_behind() {
    let clear_first = ellipses(&[sheet(2.0, RED, 0.0), sheet(3.0, GREEN, 1.0), sheet(4.0, BLUE, 0.5)]);
    let pixel = middle(&clear_first, &plain(0.01));
    assert_eq!(pixel.color, [0.0, 1.0, 0.0, 1.0]);
    assert_eq!(pixel.layers, 3);
    // The layer of alpha 0 takes one of the layers that are drawn.
    let one = Settings { layers: Layers::Fixed(1), last_layer: LastLayer::Drop, ..plain(0.01) };
    assert_eq!(middle(&clear_first, &one).color, [0.0, 0.0, 0.0, 1.0]);
}

#[test]
fn an_object_of_alpha_0_is_not_there() {
    let scene = objects(&[&[sheet(2.0, RED, 0.0), sheet(2.5, RED, 0.0)], &[sheet(3.0, GREEN, 1.0)]]);
    let alone = ellipses(&[sheet(3.0, GREEN, 1.0)]);
    assert_eq!(picture(&scene, &plain(0.01)).pixels, picture(&alone, &plain(0.01)).pixels);
}

#[test]
fn sixty_four_layers() {
    let list: Vec<_> = (0..64).map(|i| sheet(2.0 + 0.1 * f64::from(i), RED, 0.125)).collect();
    let settings = Settings { background: None, ..plain(0.01) };
    let pixel = middle(&ellipses(&list), &settings);
    assert_eq!(pixel.layers, 64);
    // 1 − (7/8)⁶⁴, in logarithms 64 · ln 0.875 = −8.546 009 6.
    let alpha = 1.0 - (-8.546_009_6_f64).exp();
    assert_color(&pixel, [1.0, 0.0, 0.0, alpha]);
}

#[test]
fn what_is_opaque_hides_what_is_behind_its_shifted_depth() {
    for (z, color, layers) in [
        (2.0, [0.5, 0.5, 0.0, 1.0], 1),
        (3.0, [0.5, 0.5, 0.0, 1.0], 1),
        (3.09, [0.5, 0.5, 0.0, 1.0], 1),
        (3.11, [0.0, 1.0, 0.0, 1.0], 0),
    ] {
        let scene = objects(&[&[sheet(z, RED, 0.5)], &[sheet(3.0, GREEN, 1.0)]]);
        let pixel = middle(&scene, &plain(0.1));
        assert_color(&pixel, color);
        assert_eq!((pixel.layers, pixel.weight, pixel.depth, pixel.alpha), (layers, 1.0, 3.0, 1.0), "{z}");
        assert!((pixel.epsilon_margin - (z - 3.1).abs() / 3.1).abs() < 1e-12, "{z}");
    }
}

#[test]
fn an_opaque_splat_and_a_transparent_one_are_never_one_layer() {
    // As one object they would be: here only one of them is transparent.
    let scene = objects(&[&[sheet(2.0, RED, 0.5)], &[sheet(2.0, GREEN, 1.0)]]);
    let pixel = middle(&scene, &plain(0.1));
    assert_eq!((pixel.weight, pixel.albedo, pixel.layers), (1.0, [0.0, 1.0, 0.0], 1));
    let one = middle(&ellipses(&[sheet(2.0, RED, 0.5), sheet(2.0, GREEN, 1.0)]), &plain(0.1));
    assert_color(&one, [0.375, 0.375, 0.0, 1.0]);
    assert_eq!((one.weight, one.layers), (0.0, 1));
}

#[test]
fn a_hidden_transparent_rim_is_none_and_a_visible_one_is() {
    for (z, flagged) in [(1.5, true), (3.0, false)] {
        let scene = objects(&[
            &[facing_disk(DVec3::Z * z, (0.3 * z) as f32, [1.0, 0.0, 0.0, 0.5])],
            &[sheet(2.0, GREEN, 1.0)],
        ]);
        let settings = Settings { epsilon: Epsilon::Length(0.01), ..settings(400) };
        let rims = picture(&scene, &settings).pixels.iter().filter(|pixel| pixel.rim).count();
        assert_eq!(rims > 0, flagged, "{z}: {rims}");
    }
}

/// Splats of a sphere of radius 2, that overlap, with normals outward.
fn sphere(center: DVec3, alpha: f32) -> Scene {
    let mut random = Random(7);
    let list: Vec<_> = (0..6000)
        .map(|_| {
            let out = random.direction();
            let s = out.any_orthonormal_vector();
            let t = out.cross(s);
            (center + 2.0 * out, (0.15 * s).as_vec3(), (0.15 * t).as_vec3(), [0.5, 0.5, 0.5, alpha])
        })
        .collect();
    let mut scene = ellipses(&list);
    scene.objects[0].closed = true;
    scene
}

#[test]
fn an_eye_within_a_transparent_sphere_sees_it_once_from_inside() {
    let settings = Settings { background: None, epsilon: Epsilon::Radii(1.0), ..plain(0.0) };
    let normals = Settings { shading: Shading::Normals, ..settings.clone() };
    let seen = picture(&sphere(DVec3::ZERO, 0.5), &normals);
    for (x, y, pixel) in pixels_at(&seen) {
        assert_eq!(pixel.layers, 1, "{x}, {y}");
        // The normal turned to the eye is the way back along the ray.
        let back = -DVec3::new(x, y, 1.0).normalize();
        let expected = 0.5 * DVec3::new(back.x, -back.y, -back.z) + 0.5;
        let color = DVec3::new(pixel.color[0], pixel.color[1], pixel.color[2]);
        assert!((color - expected).length() < 0.03 && (pixel.color[3] - 0.5).abs() < 1e-12, "{x}, {y}");
    }
    // An opaque closed one is culled from inside.
    let opaque = picture(&sphere(DVec3::ZERO, 1.0), &settings);
    assert!(opaque.pixels.iter().all(|pixel| pixel.color == [0.0; 4]));
}

#[test]
fn from_outside_a_closed_transparent_sphere_shows_its_far_side_unless_all_are_culled() {
    let settings = Settings { background: None, epsilon: Epsilon::Radii(1.0), ..plain(0.0) };
    for (backfaces, layers, alpha) in
        [(Backfaces::Auto, 2, 0.75), (Backfaces::Flip, 2, 0.75), (Backfaces::Cull, 1, 0.5)]
    {
        let settings = Settings { backfaces, ..settings.clone() };
        let pixel = middle(&sphere(DVec3::Z * 6.0, 0.5), &settings);
        assert_eq!(pixel.layers, layers, "{backfaces:?}");
        assert_color(&pixel, [0.5, 0.5, 0.5, alpha]);
    }
}
