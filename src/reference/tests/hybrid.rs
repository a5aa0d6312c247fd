//! Opaque splats and polygons together.

use super::*;
use crate::scene::{Shading, Transition};

const RED: [f32; 4] = [1.0, 0.0, 0.0, 1.0];
const GREEN: [f32; 4] = [0.0, 1.0, 0.0, 1.0];
const BLUE: [f32; 4] = [0.0, 0.0, 1.0, 1.0];

fn hybrid(splats: &[Ellipse], polygons: Vec<MeshObject>) -> Scene {
    Scene { meshes: polygons, ..ellipses(splats) }
}

fn with(transition: Transition, shading: Shading) -> Settings {
    Settings { transition, shading, epsilon: Epsilon::Length(0.1), ..settings(33) }
}

/// A splat that weighs `exp(−½)` in the middle, where it is at depth 3, turned by 30°.
fn turned(color: [f32; 4]) -> Ellipse {
    let (sin, cos) = (0.5, 0.75_f32.sqrt());
    (DVec3::new(0.0, 0.25, 3.0), Vec3::Y * 0.5, Vec3::new(cos, 0.0, sin) * 0.5, color)
}

#[test]
fn each_transition_by_hand() {
    let scene = hybrid(&[turned(GREEN)], vec![square(3.0, 2.0, RED)]);
    let pixel = |transition| middle(&scene, &with(transition, Shading::Lambert));
    let s = (-0.5_f64).exp();
    let green_light = 0.1 + 0.9 * 0.75_f64.sqrt();
    for transition in [Transition::Color, Transition::Paper] {
        assert_color(&pixel(transition), [1.0 - s, s * green_light, 0.0, 1.0]);
    }
    let normal = DVec3::new(0.5 * s, 0.0, -(1.0 - s) - 0.75_f64.sqrt() * s).normalize();
    let light = 0.1 - 0.9 * normal.z;
    assert_color(&pixel(Transition::Attributes), [(1.0 - s) * light, s * light, 0.0, 1.0]);
    assert_color(&pixel(Transition::None), [1.0, 0.0, 0.0, 1.0]);
    for (_, transition) in Transition::NAMES {
        // The surface of the splats is theirs alone.
        let pixel = pixel(*transition);
        assert!((pixel.weight - s).abs() < 1e-7 && pixel.polygon, "{transition:?}");
        assert_eq!((pixel.albedo, pixel.fragments, pixel.layers), ([0.0, 1.0, 0.0], 1, 0));
        assert!((pixel.depth - 3.0).abs() < 1e-12);
    }
}

#[test]
fn weights_above_1_leave_nothing_of_the_polygon() {
    let scene = hybrid(&[turned(GREEN), turned(GREEN)], vec![square(3.0, 2.0, RED)]);
    let pixel = middle(&scene, &with(Transition::Color, Shading::Albedo));
    assert!(pixel.weight > 1.2);
    assert_eq!(pixel.color, [0.0, 1.0, 0.0, 1.0]);
    let pixel = middle(&scene, &with(Transition::None, Shading::Albedo));
    assert_eq!(pixel.color, [1.0, 0.0, 0.0, 1.0]);
}

#[test]
fn a_polygon_is_seen_up_to_epsilon_behind_the_splats() {
    let s = (-0.5_f64).exp();
    for (z, polygon) in [(3.05, true), (3.099, true), (3.101, false), (5.0, false)] {
        let disk = facing_disk(DVec3::new(0.0, 0.25, 3.0), 0.5, GREEN);
        let scene = hybrid(&[disk], vec![square(z, 4.0, RED)]);
        let pixel = middle(&scene, &with(Transition::Color, Shading::Albedo));
        assert_eq!(pixel.polygon, polygon, "{z}");
        assert_color(&pixel, if polygon { [1.0 - s, s, 0.0, 1.0] } else { [0.0, 1.0, 0.0, 1.0] });
        // 3.1 is what the polygon is compared with; where it is seen, the splat's 3/(3.1/3) with it.
        let of_polygon = (z - 3.1).abs() / 3.1;
        let of_splat = if polygon { (9.0 / 3.1 - z).abs() / z } else { f64::INFINITY };
        assert!((pixel.epsilon_margin - of_polygon.min(of_splat)).abs() < 1e-12, "{z}");
    }
}

#[test]
fn splats_are_seen_up_to_epsilon_behind_the_polygon() {
    // Shifted toward the eye the splat is at 3/(1 + 0.1/3) = 2.903 226.
    for (z, weight) in [(2.95, 1.0), (2.9033, 1.0), (2.9032, 0.0), (2.0, 0.0)] {
        let scene = hybrid(&[facing_disk(DVec3::Z * 3.0, 0.5, GREEN)], vec![square(z, 4.0, RED)]);
        for transition in [Transition::Color, Transition::Attributes, Transition::None, Transition::Paper] {
            let pixel = middle(&scene, &with(transition, Shading::Albedo));
            assert_eq!((pixel.weight, pixel.polygon), (weight, true), "{z}, {transition:?}");
            let is_splat = weight > 0.0 && transition != Transition::None;
            assert_eq!(pixel.color, if is_splat { [0.0, 1.0, 0.0, 1.0] } else { [1.0, 0.0, 0.0, 1.0] });
            let of_splat = (9.0 / 3.1 - z).abs() / z;
            let of_polygon = (z - 3.1).abs() / 3.1;
            assert!((pixel.epsilon_margin - of_splat.min(of_polygon)).abs() < 1e-12, "{z}, {transition:?}");
        }
    }
}

#[test]
fn a_polygon_that_is_not_seen_hides_nothing() {
    // At 3.15 the polygon is behind the first splat's 3.1. A second splat belongs to the first one's surface or not
    // by itself.
    for (z, weight) in [(3.09, 2.0), (3.11, 1.0)] {
        let disks = [facing_disk(DVec3::Z * 3.0, 0.5, GREEN), facing_disk(DVec3::Z * z, 0.5, BLUE)];
        let pixel =
            middle(&hybrid(&disks, vec![square(3.15, 4.0, RED)]), &with(Transition::Color, Shading::Albedo));
        assert_eq!((pixel.weight, pixel.polygon), (weight, false), "{z}");
    }
}

#[test]
fn both_conditions_decide_and_the_margin_is_of_those_that_matter() {
    // Splats at 3 and z, their surface reaches to 3.1; shifted, z² / (z + 0.1).
    let pixel = |z: f64, polygon: f64| {
        let disks = [facing_disk(DVec3::Z * 3.0, 0.5, GREEN), facing_disk(DVec3::Z * z, 0.5, BLUE)];
        middle(&hybrid(&disks, vec![square(polygon, 4.0, RED)]), &with(Transition::Color, Shading::Albedo))
    };
    let shifted = |z: f64| z * z / (z + 0.1);
    let relative = |z: f64, threshold: f64| (z - threshold).abs() / threshold;
    // Within both: the polygon, the nearest shifted, the other to both thresholds.
    let within = pixel(3.06, 3.0);
    assert_eq!(within.weight, 2.0);
    let margins =
        [relative(3.0, 3.1), relative(shifted(3.0), 3.0), relative(3.06, 3.1), relative(shifted(3.06), 3.0)];
    let least = margins.into_iter().fold(f64::INFINITY, f64::min);
    assert!((within.epsilon_margin - least).abs() < 1e-12);
    // Beyond both: the second splat is out even if one comparison turns.
    let beyond = pixel(3.11, 2.99);
    assert_eq!(beyond.weight, 1.0);
    let other = relative(3.11, 3.1).max(relative(shifted(3.11), 2.99));
    let least =
        [relative(2.99, 3.1), relative(shifted(3.0), 2.99), other].into_iter().fold(f64::INFINITY, f64::min);
    assert!((beyond.epsilon_margin - least).abs() < 1e-12, "{} {least}", beyond.epsilon_margin);
    assert!(other > relative(3.11, 3.1) + 1e-3);
    // Beyond the splats' threshold alone, by a hair.
    let hair = pixel(3.100_001, 3.09);
    assert_eq!(hair.weight, 1.0);
    assert!((hair.epsilon_margin - relative(3.100_001, 3.1)).abs() < 1e-12);
}

#[test]
fn paper_has_twice_the_epsilon_where_the_scene_has_an_opaque_mesh() {
    let aside = |alpha: f32| {
        let at = |x: f64, y: f64| (DVec3::new(50.0 + x, y, 9.0), Vec3::NEG_Z);
        mesh(&[at(0.0, 0.0), at(0.0, 1.0), at(1.0, 1.0)], &[[0, 1, 2]], [1.0, 0.0, 0.0, alpha])
    };
    // z/f ≤ 2.1: 2.2²/2.3 = 2.104 and 2.19²/2.29 = 2.094.
    for (z, in_paper) in [(2.05, 2.0), (2.19, 2.0), (2.2, 1.0)] {
        let disks = [facing_disk(DVec3::Z * 2.0, 0.5, GREEN), facing_disk(DVec3::Z * z, 0.5, BLUE)];
        let weight = |polygons, transition| {
            middle(&hybrid(&disks, polygons), &with(transition, Shading::Albedo)).weight
        };
        let in_color = if z < 2.1 { 2.0 } else { 1.0 };
        assert_eq!(weight(vec![aside(1.0)], Transition::Paper), in_paper, "{z}");
        assert_eq!(weight(vec![aside(1.0)], Transition::Color), in_color, "{z}");
        for polygons in [vec![], vec![aside(0.5)], vec![aside(0.0)]] {
            assert_eq!(weight(polygons, Transition::Paper), in_color, "{z}");
        }
        let pixel = middle(&hybrid(&disks, vec![aside(1.0)]), &with(Transition::Paper, Shading::Albedo));
        assert!((pixel.epsilon_margin - (z * z / (z + 0.1) - 2.1).abs() / 2.1).abs() < 1e-12, "{z}");
    }
}

#[test]
fn the_rim_of_a_splat_behind_a_polygon_is_none() {
    for (z, flagged) in [(1.5, true), (2.05, true), (3.0, false)] {
        let scene =
            hybrid(&[facing_disk(DVec3::Z * z, (0.3 * z) as f32, GREEN)], vec![square(2.0, 9.0, RED)]);
        for transition in [Transition::Color, Transition::Paper] {
            let settings = Settings { size_px: [400; 2], ..with(transition, Shading::Albedo) };
            let rims = picture(&scene, &settings).pixels.iter().filter(|pixel| pixel.rim).count();
            assert_eq!(rims > 0, flagged, "{z}, {transition:?}: {rims}");
        }
    }
}
