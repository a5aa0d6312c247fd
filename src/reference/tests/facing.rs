//! Splats that face away from the eye.

use glam::{DVec3, Vec3};

use super::*;
use crate::scene::{Backfaces, ClipBox};

/// A disk that faces away.
fn averted(center: DVec3) -> Ellipse {
    (center, Vec3::X, Vec3::Y, GRAY)
}

#[test]
fn flip_turns_the_normal_cull_drops_the_splat_and_auto_asks_the_object() {
    let scene = |closed| {
        let mut scene = ellipses(&[averted(DVec3::Z * 2.0)]);
        scene.objects[0].closed = closed;
        scene
    };
    let with = |backfaces, closed| picture(&scene(closed), &Settings { backfaces, ..settings(33) });
    for (backfaces, closed) in [(Backfaces::Flip, false), (Backfaces::Flip, true), (Backfaces::Auto, false)] {
        let pixel = *with(backfaces, closed).pixel(16, 16).unwrap();
        assert_eq!((pixel.weight, pixel.normal), (1.0, [0.0, 0.0, -1.0]), "{backfaces:?}, {closed}");
    }
    for (backfaces, closed) in [(Backfaces::Cull, false), (Backfaces::Cull, true), (Backfaces::Auto, true)] {
        assert_eq!(covered(&with(backfaces, closed)), 0, "{backfaces:?}, {closed}");
    }
}

/// What is closed is seen from inside where a plane cuts it open, and not where all planes leave all of it.
#[test]
fn backs_of_closed_objects_are_seen_where_a_plane_cuts_something() {
    let mut scene = ellipses(&[averted(DVec3::Z * 2.0)]);
    scene.objects[0].closed = true;
    let from = |x: f64| {
        let clip_box = ClipBox(Some([[x, -9.0, -9.0], [9.0; 3]]));
        covered(&picture(&scene, &Settings { backfaces: Backfaces::Auto, clip_box, ..settings(33) }))
    };
    assert_eq!(from(-9.0), 0);
    assert!(from(-0.5) > 0);
}

#[test]
fn facing_is_judged_along_the_ray_to_the_center_not_along_the_axis() {
    // The normal (−0.8, 0, 0.6) leans away from the screen's normal but toward an eye left of the splat.
    let tilted = |x: f64| (DVec3::new(x, 0.0, 2.0), Vec3::Y * 0.5, Vec3::new(-0.6, 0.0, -0.8) * 0.5, GRAY);
    let cull = Settings { backfaces: Backfaces::Cull, ..settings(65) };
    // n·p = −0.8 x + 1.2: away for x < 1.5.
    assert_eq!(covered(&picture(&ellipses(&[tilted(1.4)]), &cull)), 0);
    assert!(covered(&picture(&ellipses(&[tilted(1.8)]), &cull)) > 0);
    let flip = picture(&ellipses(&[tilted(0.0)]), &settings(65));
    let normal = DVec3::from(flip.pixel(32, 32).unwrap().normal);
    assert!((normal - DVec3::new(0.8, 0.0, -0.6)).length() < 1e-7, "{normal}");
}

#[test]
fn a_sphere_of_disks_culled_or_flipped_shows_the_same_front() {
    let mut scene = sphere(3000, 0.08);
    let settings = settings(96);
    let flipped = picture(&scene, &settings);
    scene.objects[0].closed = true;
    let culled = picture(&scene, &settings);
    let mut compared = 0;
    for ((x, y, a), b) in pixels_at(&flipped).zip(&culled.pixels) {
        // Well inside the silhouette, sin = 1/3: the back is more than ε behind the front.
        if x.hypot(y) < 0.33 {
            assert!(a.is_covered(), "hole at {x}, {y}");
            assert_eq!(a.albedo, b.albedo);
            let normal = DVec3::from(a.normal);
            // The normal of the unit sphere about (0, 0, 3) at the pixel's depth.
            let on_sphere = a.depth * DVec3::new(x, y, 1.0) - DVec3::Z * 3.0;
            assert!(normal.dot(on_sphere.normalize()) > 0.99, "{x}, {y}");
            compared += 1;
        }
    }
    assert!(compared > 700, "{compared}");
}

/// Disks on the unit sphere about (0, 0, 3), by the golden angle.
fn sphere(count: u32, radius: f32) -> Scene {
    let golden_rad = std::f64::consts::PI * (3.0 - 5.0_f64.sqrt());
    let normals: Vec<DVec3> = (0..count)
        .map(|i| {
            let z = 1.0 - (2.0 * f64::from(i) + 1.0) / f64::from(count);
            let (sin, cos) = (golden_rad * f64::from(i)).sin_cos();
            DVec3::new((1.0 - z * z).sqrt() * cos, (1.0 - z * z).sqrt() * sin, z)
        })
        .collect();
    let splats = Splats::new(
        normals.iter().map(|n| DVec3::Z * 3.0 + *n).collect(),
        Shapes::Disks {
            normals: normals.iter().map(|n| n.as_vec3()).collect(),
            radii: vec![radius; count as usize],
        },
        Colors::Uniform(GRAY),
    );
    Scene { objects: vec![Object { name: "sphere".into(), splats, closed: false }], ..Scene::default() }
}

#[test]
fn scene_and_camera_turned_together_give_the_same_picture() {
    let (sin, cos) = 0.7_f64.sin_cos();
    let turn = |v: DVec3| DVec3::new(cos * v.x + sin * v.z, v.y, cos * v.z - sin * v.x);
    let turn_f32 = |v: Vec3| turn(v.as_dvec3()).as_vec3();
    let list = [
        facing_disk(DVec3::new(0.3, 0.1, 2.0), 0.7, GRAY),
        (
            DVec3::new(-0.5, 0.2, 2.5),
            Vec3::new(0.3, 0.5, 0.2),
            Vec3::new(0.6, -0.2, 0.4),
            [1.0, 0.0, 0.0, 1.0],
        ),
    ];
    let turned = list.map(|(center, s, t, color)| (turn(center), turn_f32(s), turn_f32(t), color));
    let camera = Camera { target: turn(DVec3::Z), up: turn(DVec3::NEG_Y), ..camera() };
    let settings = settings(64);
    let expected = picture(&ellipses(&list), &settings);
    let picture = render(&ellipses(&turned), &camera, &settings, &|_, _| ()).unwrap();
    for (a, b) in expected.pixels.iter().zip(&picture.pixels).filter(|(a, _)| !a.rim) {
        // The turned tangents are rounded to f32.
        assert!((a.weight - b.weight).abs() < 1e-5);
        assert!(a.depth == b.depth || (a.depth - b.depth).abs() < 1e-5);
        assert!((DVec3::from(a.normal) - DVec3::from(b.normal)).length() < 1e-5);
    }
    assert!(covered(&picture) > 300);
}
