//! A limited number of layers, and what becomes of the rest.

use super::*;
use crate::scene::{LastLayer, Layers, Shading};

fn sheets(alphas: [f32; 3]) -> Scene {
    let sheet = |i: usize, z: f64| {
        let mut color = [0.0, 0.0, 0.0, alphas[i]];
        color[i] = 1.0;
        facing_disk(DVec3::Z * z, 9.0, color)
    };
    ellipses(&[sheet(0, 2.0), sheet(1, 3.0), sheet(2, 4.0)])
}

fn plain(layers: u32, last_layer: LastLayer) -> Settings {
    Settings {
        shading: Shading::Albedo,
        background: None,
        epsilon: Epsilon::Length(0.01),
        layers: Layers::Fixed(layers),
        last_layer,
        ..settings(9)
    }
}

#[test]
fn drop_loses_what_is_behind_the_last_layer() {
    let scene = sheets([0.5, 0.5, 0.25]);
    let two = middle(&scene, &plain(2, LastLayer::Drop));
    assert_color(&two, [2.0 / 3.0, 1.0 / 3.0, 0.0, 0.75]);
    assert_eq!(two.layers, 3);
    assert_color(&middle(&scene, &plain(1, LastLayer::Drop)), [1.0, 0.0, 0.0, 0.5]);
    let all = [0.5 / 0.8125, 0.25 / 0.8125, 0.0625 / 0.8125, 0.8125];
    assert_color(&middle(&scene, &plain(3, LastLayer::Drop)), all);
}

#[test]
fn blend_puts_the_rest_into_the_last_layer_by_weight_times_alpha() {
    let scene = sheets([0.5, 0.5, 0.25]);
    // Green and blue: color (½ green + ¼ blue)/¾, alpha (½ + ¼)/2 = 3/8. Behind the half of red: green ½ · 3/8 · 2/3 =
    // 1/8, blue 1/16; alpha 1 − ½ · 5/8 = 11/16.
    let alpha = 0.6875;
    assert_color(
        &middle(&scene, &plain(2, LastLayer::Blend)),
        [0.5 / alpha, 0.125 / alpha, 0.0625 / alpha, alpha],
    );
    // All three: Σα = 5/4.
    assert_color(&middle(&scene, &plain(1, LastLayer::Blend)), [0.4, 0.4, 0.2, 1.25 / 3.0]);
    // As many layers as there are: the last one is alone in its own.
    assert_eq!(
        middle(&scene, &plain(3, LastLayer::Blend)).color,
        middle(&scene, &plain(256, LastLayer::Drop)).color
    );
}

#[test]
fn within_the_last_layer_clear_splats_do_not_color_those_that_are_seen() {
    // One surface: the clear red splat counts in its albedo by weight. In the last layer it does not.
    let sheet = |color| facing_disk(DVec3::Z * 2.0, 9.0, color);
    let scene = ellipses(&[sheet([1.0, 0.0, 0.0, 0.0]), sheet([0.0, 1.0, 0.0, 0.5])]);
    assert_color(&middle(&scene, &plain(1, LastLayer::Drop)), [0.5, 0.5, 0.0, 0.25]);
    assert_color(&middle(&scene, &plain(1, LastLayer::Blend)), [0.0, 1.0, 0.0, 0.25]);
    assert_color(&middle(&scene, &plain(2, LastLayer::Blend)), [0.5, 0.5, 0.0, 0.25]);
}

#[test]
fn a_last_layer_without_alpha_adds_nothing() {
    let pixel = middle(&sheets([0.5, 0.0, 0.0]), &plain(2, LastLayer::Blend));
    assert_eq!(pixel.color, [1.0, 0.0, 0.0, 0.5]);
    let clear = ellipses(&[
        facing_disk(DVec3::Z, 9.0, [1.0, 0.0, 0.0, 0.0]),
        facing_disk(DVec3::Z * -2.0, 1.0, GRAY),
    ]);
    assert_eq!(middle(&clear, &plain(1, LastLayer::Blend)).color, [0.0; 4]);
}

#[test]
fn splats_of_the_last_layer_are_lit_at_their_centers() {
    // The center is seen along (1, 0, 2), the pixel along the axis.
    let scene = ellipses(&[facing_disk(DVec3::new(1.0, 0.0, 2.0), 3.0, [1.0, 1.0, 1.0, 0.5])]);
    let lit = |last_layer| Settings { shading: Shading::Lambert, ..plain(1, last_layer) };
    assert_color(&middle(&scene, &lit(LastLayer::Drop)), [1.0, 1.0, 1.0, 0.5]);
    let light = 0.1 + 0.9 * 2.0 / 5.0_f64.sqrt();
    assert_color(&middle(&scene, &lit(LastLayer::Blend)), [light, light, light, 0.5]);
    // And each by itself: two that face half to the left and half to the right, whose mean faces the eye.
    let turned = |x: f32| (DVec3::Z * 2.0, Vec3::Y, Vec3::new(0.75_f32.sqrt(), 0.0, x), [1.0, 1.0, 1.0, 0.5]);
    let scene = ellipses(&[turned(0.5), turned(-0.5)]);
    assert_color(&middle(&scene, &lit(LastLayer::Drop)), [1.0, 1.0, 1.0, 0.5]);
    let light = 0.1 + 0.9 * 0.75_f64.sqrt();
    assert_color(&middle(&scene, &lit(LastLayer::Blend)), [light, light, light, 0.5]);
}

#[test]
fn auto_is_the_same_picture_as_fixed() {
    let scene = sheets([0.5, 0.5, 0.25]);
    for last_layer in [LastLayer::Drop, LastLayer::Blend] {
        for most in 1..=4 {
            let fixed = plain(most, last_layer);
            let auto = Settings { layers: Layers::Auto(most), ..fixed.clone() };
            assert_eq!(picture(&scene, &fixed).pixels, picture(&scene, &auto).pixels);
        }
    }
}

#[test]
fn a_center_at_the_eye_or_at_the_end_of_the_numbers_has_a_direction() {
    for (center, expected) in [
        (DVec3::ZERO, DVec3::Z),
        (DVec3::new(0.0, 3e300, 4e300), DVec3::new(0.0, 0.6, 0.8)),
        (DVec3::new(0.0, 3e-200, -4e-200), DVec3::new(0.0, 0.6, -0.8)),
    ] {
        let (splat, _) = drawn((center, Vec3::X, Vec3::Y, GRAY), &settings(9));
        assert!((splat.toward_center().normalize() - expected).length() < 1e-12, "{center}");
    }
    // A center behind the eye: the light that would come from there is that at the eye.
    let scene = ellipses(&[(DVec3::new(0.0, 0.5, -2.0), Vec3::X * 9.0, Vec3::Z * 9.0, [1.0, 1.0, 1.0, 0.5])]);
    let seen = picture(&scene, &Settings { shading: Shading::Lambert, ..plain(1, LastLayer::Blend) });
    let light = 0.1 + 0.9 * 0.5 / 4.25_f64.sqrt();
    assert_color(seen.pixel(4, 8).unwrap(), [light, light, light, 0.5]);
}
