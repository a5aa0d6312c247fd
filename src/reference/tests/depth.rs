//! The depth of the normalized surface.

use glam::{DVec3, Vec3};

use super::*;

/// An ellipse around `center` whose plane contains y and is turned about it by `angle_deg` from the screen.
fn tilted(center: DVec3, angle_deg: f32, radius: f32, color: [f32; 4]) -> Ellipse {
    let (sin, cos) = angle_deg.to_radians().sin_cos();
    (center, Vec3::Y * radius, Vec3::new(cos, 0.0, sin) * radius, color)
}

#[test]
fn a_disk_parallel_to_the_screen_has_one_depth() {
    let picture = picture(&ellipses(&[facing_disk(DVec3::new(0.0, 0.0, 3.5), 2.0, GRAY)]), &settings(64));
    for pixel in &picture.pixels {
        let expected = if pixel.is_covered() { 3.5 } else { f64::INFINITY };
        assert!(pixel.depth == expected || (pixel.depth - expected).abs() < 1e-14, "{}", pixel.depth);
    }
    assert!(covered(&picture) > 500);
}

#[test]
fn a_tilted_disk_has_the_depth_of_its_plane() {
    for angle_deg in [-80.0_f32, -45.0, -10.0, 30.0, 60.0, 85.0] {
        let center = DVec3::new(0.2, -0.1, 4.0);
        let splat = tilted(center, angle_deg, 1.5, GRAY);
        let slope = f64::from(splat.2.z) / f64::from(splat.2.x);
        let picture = picture(&ellipses(&[splat]), &settings(128));
        for (x, y, pixel) in pixels_at(&picture).filter(|(.., pixel)| pixel.is_covered()) {
            // Z = 4 + slope (X − 0.2) with X = x Z.
            let expected = (4.0 - 0.2 * slope) / (1.0 - slope * x);
            assert!((pixel.depth / expected - 1.0).abs() < 1e-12, "{angle_deg}°: {x}, {y}");
        }
        assert!(covered(&picture) > 50, "{angle_deg}°");
    }
}

#[test]
fn two_crossing_disks_meet_in_their_line_of_intersection() {
    let (red, blue) = ([1.0, 0.0, 0.0, 1.0], [0.0, 0.0, 1.0, 1.0]);
    // ε = 0: the nearer plane wins. The planes cross where X = 0.3, Z = 3: at x = 0.1.
    let center = DVec3::new(0.3, 0.0, 3.0);
    let scene = ellipses(&[tilted(center, 45.0, 2.0, red), tilted(center, -45.0, 2.0, blue)]);
    let settings =
        Settings { epsilon: Epsilon::Length(0.0), shading: crate::scene::Shading::Albedo, ..settings(200) };
    let picture = picture(&scene, &settings);
    // The color changes within one pixel of the line: a pixel is 0.01 wide.
    let mut checked = 0;
    for (x, y, pixel) in pixels_at(&picture) {
        if y.abs() < 0.3 && (x - 0.1).abs() < 0.3 {
            // Red recedes to the right: it is in front on the left.
            let expected = if x < 0.1 { red } else { blue };
            if (x - 0.1).abs() > 0.01 {
                assert_eq!(pixel.color, expected.map(f64::from), "{x}, {y}");
                checked += 1;
            }
        }
    }
    assert!(checked > 3000, "{checked}");
}

#[test]
fn the_depth_of_a_mixture_is_the_weighted_mean() {
    // Two sheets within ε; at the middle pixel both weigh 1.
    let scene = ellipses(&[facing_disk(DVec3::Z * 2.0, 0.5, GRAY), facing_disk(DVec3::Z * 2.1, 0.5, GRAY)]);
    let picture = picture(&scene, &settings(65));
    let middle = picture.pixel(32, 32).unwrap();
    assert!((middle.weight - 2.0).abs() < 1e-14 && (middle.depth - 2.05).abs() < 1e-14);
}

#[test]
fn a_scene_far_from_the_origin_gives_the_same_picture() {
    let mut random = Random(4);
    // Positions on a grid of 2⁻²⁰, so that the shift itself loses nothing.
    let grid = |value: f64| (value * 1_048_576.0).round() / 1_048_576.0;
    let list: Vec<Ellipse> = (0..300)
        .map(|_| {
            let normal = random.direction();
            let s = normal.cross(DVec3::new(0.3, 0.5, 0.7)).normalize();
            let center = DVec3::new(0.0, 0.0, 4.0) + normal;
            let center = DVec3::new(grid(center.x), grid(center.y), grid(center.z));
            (center, (0.2 * s).as_vec3(), (0.2 * normal.cross(s)).as_vec3(), GRAY)
        })
        .collect();
    let settings = Settings { filter: Filter::Adjust, ..settings(128) };
    let near = picture(&ellipses(&list), &settings);

    let offset = DVec3::new(500_000.0, 4_600_000.0, 300.0);
    let moved: Vec<Ellipse> = list.iter().map(|e| (e.0 + offset, e.1, e.2, e.3)).collect();
    let camera = Camera { eye: offset, target: offset + DVec3::Z, ..camera() };
    let far = render(&ellipses(&moved), &camera, &settings, &|_, _| ()).unwrap();
    assert_eq!(near.pixels, far.pixels);
    assert!(covered(&near) > 500);
}
