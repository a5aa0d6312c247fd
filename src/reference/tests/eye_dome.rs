//! Eye-dome lighting by hand.

use super::*;
use crate::scene::{Light, Opacity, Shading};

fn edl(side_px: u32) -> Settings {
    Settings { shading: Shading::EyeDome, ..settings(side_px) }
}

/// The mean of the positive part of the cosine over the moves, for a slope along x: 2, 1, 1 and 2 of √5.
const ALONG_X: f64 = (2.0 + 1.0 + 1.0 + 2.0) / 8.0;

#[test]
fn a_plane_is_as_dark_as_it_is_tilted_in_any_size_and_unit() {
    for (side_px, unit) in [(65, 1.0), (257, 1.0), (65, 1000.0)] {
        for tilt_deg in [0.0_f64, 30.0, 60.0] {
            let tan = tilt_deg.to_radians().tan();
            let (s, t) = (DVec3::Y * 50.0 * unit, DVec3::new(1.0, 0.0, tan) * 50.0 * unit);
            let plane = (DVec3::Z * 2.0 * unit, s.as_vec3(), t.as_vec3(), GRAY);
            let pixel = middle(&ellipses(&[plane]), &edl(side_px));
            // ln z − ln z' over the angle is tan θ by first order; a move is 2.2 of the 32 pixels that a unit of the image has.
            let exact =
                [0.25, 0.5, 0.75].map(|albedo| albedo * (-0.7 * ALONG_X / 5.0_f64.sqrt() * tan).exp());
            let within = 0.25 * tan * tan * 5.0_f64.sqrt() / (0.5 * f64::from(side_px)) + 1e-7;
            for (got, expected) in pixel.color.iter().zip(exact) {
                assert!((got - expected).abs() < within, "{side_px} {unit} {tilt_deg}: {got} {expected}");
            }
        }
    }
}

#[test]
fn what_is_nearer_darkens_what_is_behind_it_within_a_knights_move_and_not_itself() {
    // A disk before a wall twice as far, both parallel to the screen: 10 pixels, of 32 a unit.
    let disk = facing_disk(DVec3::Z, 10.0 / 32.0, GRAY);
    let wall = facing_disk(DVec3::Z * 2.0, 100.0, GRAY);
    let seen = picture(&ellipses(&[disk, wall]), &Settings { epsilon: Epsilon::Length(0.1), ..edl(65) });
    let mut dark = 0;
    for (x, y, pixel) in pixels_at(&seen) {
        let from_rim_px = 32.5 * x.hypot(y) - 10.16;
        let is_plain = (pixel.color[1] - 0.5).abs() < 1e-9;
        if !(-0.1..=2.5).contains(&from_rim_px) {
            assert!(is_plain, "{x}, {y}: {pixel:?}");
        } else if (0.1..1.0).contains(&from_rim_px) {
            // One neighbor at least: a slope of ln 2 · 32.5 / √5 over 8.
            assert!(pixel.color[1] < 0.5 * (-0.7 * 2.0_f64.ln() * 32.5 / 5.0_f64.sqrt() / 8.0).exp() + 1e-6);
            dark += 1;
        }
    }
    assert!(dark > 40, "{dark}");
    // Nothing is behind the rim of what stands alone, and nothing before it.
    let alone = picture(&ellipses(&[disk]), &edl(65));
    assert!(alone.pixels.iter().all(|pixel| !pixel.is_covered() || (pixel.color[1] - 0.5).abs() < 1e-9));
    assert!(alone.pixels.iter().any(|pixel| pixel.color == [1.0; 4]));
}

#[test]
fn lights_change_nothing_and_what_is_transparent_or_of_triangles_is_refused() {
    let mut scene = ellipses(&[facing_disk(DVec3::Z, 1.0, GRAY)]);
    let before = middle(&scene, &edl(9)).color;
    scene.lights = vec![Light { color: [9.0, 0.0, 0.0], ..Light::DEFAULT }];
    assert_eq!(middle(&scene, &edl(9)).color, before);
    let refused = |scene: &Scene| render(scene, &camera(), &edl(9), &|_, _| ()).unwrap_err().to_string();
    let clear = ellipses(&[facing_disk(DVec3::Z, 1.0, [1.0, 1.0, 1.0, 0.5])]);
    assert_eq!(clear.objects[0].splats.colors.opacity(), Opacity::Transparent);
    assert!(refused(&clear).starts_with("--shading: edl: test is transparent"), "{}", refused(&clear));
    let mesh = meshes(vec![square(2.0, 1.0, GRAY)]);
    assert!(refused(&mesh).starts_with("--shading: edl: test is drawn as triangles"), "{}", refused(&mesh));
    let truth = crate::reference::ground_truth(&scene, &camera(), &edl(9), 2, &|_, _| ());
    assert!(truth.unwrap_err().to_string().starts_with("--shading: edl: "));
}
