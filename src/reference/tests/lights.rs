//! Lights of a scene, seen by a camera that is turned.

use super::*;
use crate::scene::{Light, LightKind, MOST_LIGHTS, Shading};

fn directional(direction: DVec3, color: [f32; 3]) -> Light {
    Light { kind: LightKind::Directional(direction), color }
}

fn lit(lights: Vec<Light>, shading: Shading) -> Pixel {
    let scene = Scene { lights, ..ellipses(&[facing_disk(DVec3::Z, 0.5, GRAY)]) };
    middle(&scene, &Settings { shading, ..settings(9) })
}

#[test]
fn a_directional_light_by_hand() {
    // It shines away from the eye and down by 60°: n·l = ½.
    let light = directional(DVec3::new(0.0, 0.75_f64.sqrt(), 0.5) * 7.0, [1.0, 0.5, 0.0]);
    let lambert = |c: f64, light: f64| c * (0.1 + 0.9 * 0.5 * light);
    let diffuse = [lambert(0.25, 1.0), lambert(0.5, 0.5), lambert(0.75, 0.0), 1.0];
    assert_color(&lit(vec![light], Shading::Lambert), diffuse);
    // r·v = n·l = ½ for a normal toward the eye: 0.2 / 2³².
    let highlight = 0.2 / 4_294_967_296.0;
    let pixel = lit(vec![light], Shading::Phong);
    for c in 0..3 {
        let expected = diffuse[c] + highlight * [1.0, 0.5, 0.0][c];
        assert!((pixel.color[c] - expected).abs() < 1e-15, "{:?}", pixel.color);
    }
    // Shading that is none asks for no light.
    assert_eq!(lit(vec![light], Shading::Albedo).color, [0.25, 0.5, 0.75, 1.0]);
}

#[test]
fn lights_add_up_and_one_behind_the_surface_gives_nothing() {
    let front = directional(DVec3::Z, [0.5, 0.0, 0.0]);
    let back = directional(DVec3::new(0.1, 0.0, -1.0), [9.0; 3]);
    let eye = Light { kind: LightKind::Eye, color: [0.0, 0.25, 0.0] };
    let lambert = |c: f64, light: f64| c * (0.1 + 0.9 * light);
    let expected = [lambert(0.25, 0.5), lambert(0.5, 0.25), lambert(0.75, 0.0), 1.0];
    assert_color(&lit(vec![front, back, eye], Shading::Lambert), expected);
    let [red, green, blue, alpha] = expected;
    assert_color(&lit(vec![front, back, eye], Shading::Phong), [red + 0.1, green + 0.05, blue, alpha]);
    assert_color(&lit(vec![back], Shading::Phong), [0.025, 0.05, 0.075, 1.0]);
}

#[test]
fn without_lights_there_is_a_white_one_at_the_eye() {
    let scene = ellipses(&[facing_disk(DVec3::new(0.2, 0.1, 1.0), 0.9, GRAY)]);
    let with = Scene { lights: vec![Light::DEFAULT], ..scene.clone() };
    assert_eq!(picture(&scene, &settings(17)).pixels, picture(&with, &settings(17)).pixels);
}

#[test]
fn directions_are_in_world_space() {
    // The camera looks along x; the light too.
    let camera = Camera { target: DVec3::X, ..camera() };
    let disk = (DVec3::X, Vec3::Y * 0.5, Vec3::Z * 0.5, GRAY);
    for (direction, light) in
        [(DVec3::X, 1.0), (DVec3::Y, 0.0), (DVec3::NEG_X, 0.0), (DVec3::new(3.0, 0.0, 4.0), 0.6)]
    {
        let scene = Scene { lights: vec![directional(direction, [1.0; 3])], ..ellipses(&[disk]) };
        let settings = Settings { shading: Shading::Lambert, ..settings(9) };
        let seen = render(&scene, &camera, &settings, &|_, _| ()).unwrap();
        let expected = [0.25, 0.5, 0.75].map(|c| c * (0.1 + 0.9 * light));
        assert_color(seen.pixel(4, 4).unwrap(), [expected[0], expected[1], expected[2], 1.0]);
    }
}

#[test]
fn polygons_are_lit_alike_and_bad_lights_are_refused() {
    let lights = vec![directional(DVec3::new(0.0, 0.8, 0.6), [0.5; 3])];
    let scene = Scene { lights, ..meshes(vec![square(2.0, 1.0, GRAY)]) };
    let settings = Settings { shading: Shading::Lambert, ..settings(9) };
    let expected = [0.25, 0.5, 0.75].map(|c| c * (0.1 + 0.9 * 0.3));
    assert_color(&middle(&scene, &settings), [expected[0], expected[1], expected[2], 1.0]);
    let refused =
        |lights| render(&Scene { lights, ..Scene::default() }, &camera(), &settings, &|_, _| ()).is_err();
    assert!(refused(vec![directional(DVec3::ZERO, [1.0; 3])]));
    assert!(refused(vec![Light::DEFAULT; MOST_LIGHTS + 1]));
}
