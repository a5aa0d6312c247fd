//! Triangles alone: where they are, how deep, and of what color.

use super::*;
use crate::scene::{Backfaces, Shading};

const RED: [f32; 4] = [1.0, 0.0, 0.0, 1.0];

/// A floor half a unit below the eye, from before to far behind it; its normal points up.
fn floor(color: [f32; 4]) -> MeshObject {
    let at = |x: f64, z: f64| (DVec3::new(x, 0.5, z), Vec3::NEG_Y);
    mesh(&[at(-1e3, -1e3), at(-1e3, 1e3), at(1e3, 1e3), at(1e3, -1e3)], &[[0, 1, 2], [0, 2, 3]], color)
}

fn albedo(side_px: u32) -> Settings {
    Settings { shading: Shading::Albedo, background: Some([0.0; 3]), ..settings(side_px) }
}

#[test]
fn a_square_covers_what_is_inside_and_of_its_border_the_left_and_the_top() {
    // Its sides go through the centers of columns and rows 4 and 12.
    let seen = picture(&meshes(vec![square(2.0, 2.0 * 4.0 / 16.5, RED)]), &albedo(33));
    let half = |column: usize| (column as f64 - 16.0).abs();
    for (i, pixel) in seen.pixels.iter().enumerate() {
        if half(i % 33).max(half(i / 33)) != 4.0 {
            assert_eq!(pixel.polygon, half(i % 33).max(half(i / 33)) < 4.0, "{i}");
        }
    }
    // In numbers without rounding: a focal length of 64 pixels for a picture of 32.
    let camera = Camera { fov_y_rad: 2.0 * 0.25_f64.atan(), ..camera() };
    let view = View::pinhole(&camera, [32, 32]);
    assert_eq!(view.focal_px, 64.0);
    let corner = |column: u32, row: u32| (view.ray(column, row), Vec3::NEG_Z);
    let corners = [corner(4, 4), corner(4, 12), corner(12, 12), corner(12, 4)];
    let scene = meshes(vec![mesh(&corners, &[[0, 1, 2], [0, 2, 3]], RED)]);
    let seen = render(&scene, &camera, &albedo(32), &|_, _| ()).unwrap();
    for (i, pixel) in seen.pixels.iter().enumerate() {
        let inside = |place: usize| (4..12).contains(&place);
        assert_eq!(pixel.polygon, inside(i % 32) && inside(i / 32), "{i}");
    }
}

#[test]
fn a_mesh_alone_has_a_color_and_no_splat_surface() {
    let seen = picture(&meshes(vec![square(2.0, 1.0, [0.25, 0.5, 0.75, 1.0])]), &settings(33));
    for (x, y, pixel) in pixels_at(&seen) {
        let inside = x.abs().max(y.abs()) < 0.5;
        assert_eq!(
            (pixel.polygon, pixel.weight, pixel.layers, pixel.rim),
            (inside, 0.0, 0, false),
            "{x}, {y}"
        );
        assert_eq!((pixel.albedo, pixel.depth, pixel.alpha), ([0.0; 3], f64::INFINITY, 0.0));
        // Only the near plane, at 1e-6, is compared with.
        assert!(pixel.epsilon_margin > 1.9e6, "{}", pixel.epsilon_margin);
        if inside {
            // Phong, with the light at the eye: n·l = cos, r·v = cos of the double angle.
            let cos = 1.0 / (1.0 + x * x + y * y).sqrt();
            let highlight = 0.2 * (2.0 * cos * cos - 1.0).max(0.0).powi(32);
            let expected = [0.25, 0.5, 0.75].map(|c| c * (0.1 + 0.9 * cos) + highlight);
            assert_color(pixel, [expected[0], expected[1], expected[2], 1.0]);
        } else {
            assert_eq!(pixel.color, [1.0; 4]);
        }
    }
}

#[test]
fn attributes_are_linear_on_the_surface_not_in_the_image() {
    // A floor from depth 1 to 9: red and alpha grow with depth, green to the right.
    let mut object = floor(RED);
    let at = |x: f64, z: f64| DVec3::new(x, 0.5, z);
    object.mesh.positions = vec![at(-4.0, 1.0), at(-4.0, 9.0), at(4.0, 9.0), at(4.0, 1.0)];
    let color = |red: f32, green: f32| [red, green, 0.0, 0.25 + 0.5 * red];
    object.mesh.colors =
        Colors::Each(vec![color(0.0, 0.0), color(1.0, 0.0), color(1.0, 1.0), color(0.0, 1.0)]);
    let settings = Settings { background: None, ..albedo(64) };
    let transparent = picture(&meshes(vec![object.clone()]), &settings);
    let mut inside = 0;
    for (x, y, pixel) in pixels_at(&transparent) {
        let z = 0.5 / y;
        if z > 1.0 && z < 9.0 && (x * z).abs() < 4.0 {
            let (red, green) = ((z - 1.0) / 8.0, (x * z + 4.0) / 8.0);
            assert_color(pixel, [red, green, 0.0, 0.25 + 0.5 * red]);
            inside += 1;
        } else {
            assert_eq!(pixel.layers, 0, "{x}, {y}");
        }
    }
    assert!(inside > 500, "{inside}");
}

#[test]
fn normals_are_interpolated_and_unit() {
    let mut object = square(2.0, 2.0, RED);
    // Half to the left at the left side, half to the right at the right.
    let lean = |x: f32| Vec3::new(x, 0.0, -(1.0 - x * x).sqrt());
    object.mesh.normals = Some(vec![lean(-0.6), lean(-0.6), lean(0.6), lean(0.6)]);
    let settings = Settings { shading: Shading::Normals, ..settings(33) };
    for (x, y, pixel) in pixels_at(&picture(&meshes(vec![object]), &settings)) {
        let normal = DVec3::new(0.6 * x, 0.0, -0.8).normalize();
        assert_color(pixel, [0.5 + 0.5 * normal.x, 0.5, 0.5 - 0.5 * normal.z, 1.0]);
        assert!(pixel.polygon, "{x}, {y}");
    }
}

#[test]
fn flip_turns_the_normals_cull_drops_the_triangles_and_auto_asks_whether_light_comes_through() {
    let object = |alpha: f32, closed| {
        let mut object = square(2.0, 2.0, [1.0, 1.0, 1.0, alpha]);
        object.mesh.triangles.iter_mut().for_each(|triangle| triangle.swap(1, 2));
        object.mesh.normals = Some(vec![Vec3::Z; 4]);
        MeshObject { closed, ..object }
    };
    let with = |backfaces, alpha, closed| {
        let settings = Settings { backfaces, shading: Shading::Normals, background: None, ..settings(33) };
        middle(&meshes(vec![object(alpha, closed)]), &settings).color
    };
    for (backfaces, closed) in [(Backfaces::Flip, false), (Backfaces::Flip, true), (Backfaces::Auto, false)] {
        assert_eq!(with(backfaces, 1.0, closed), [0.5, 0.5, 1.0, 1.0], "{backfaces:?}, {closed}");
        assert_eq!(with(backfaces, 0.5, closed), [0.5, 0.5, 1.0, 0.5], "{backfaces:?}, {closed}");
    }
    assert_eq!(with(Backfaces::Auto, 0.5, true), [0.5, 0.5, 1.0, 0.5]);
    for (backfaces, closed) in [(Backfaces::Cull, false), (Backfaces::Cull, true), (Backfaces::Auto, true)] {
        assert_eq!(with(backfaces, 1.0, closed), [0.0; 4], "{backfaces:?}, {closed}");
    }
    assert_eq!(with(Backfaces::Cull, 0.5, false), [0.0; 4]);
    // What faces the eye stays.
    let front = meshes(vec![MeshObject { closed: true, ..square(2.0, 2.0, RED) }]);
    assert!(middle(&front, &settings(33)).polygon);
}

#[test]
fn a_normal_that_vanishes_is_toward_the_eye_on_either_side() {
    for turned in [false, true] {
        let mut object = square(2.0, 2.0, RED);
        object.mesh.normals = Some(vec![Vec3::ZERO; 4]);
        if turned {
            object.mesh.triangles.iter_mut().for_each(|triangle| triangle.swap(1, 2));
        }
        let settings = Settings { shading: Shading::Normals, ..settings(33) };
        assert_eq!(middle(&meshes(vec![object]), &settings).color, [0.5, 0.5, 1.0, 1.0]);
    }
}

#[test]
fn what_has_no_color_is_gray_and_what_has_alpha_0_is_not_there() {
    let mut gray = square(2.0, 2.0, RED);
    gray.mesh.colors = Colors::unknown();
    // 204/255 = 0.8: ((0.8 + 0.055)/1.055)^2.4.
    let level = 0.603_827_338;
    assert_color(&middle(&meshes(vec![gray]), &albedo(9)), [level, level, level, 1.0]);
    let clear = square(2.0, 2.0, [1.0, 0.0, 0.0, 0.0]);
    assert_eq!(middle(&meshes(vec![clear]), &albedo(9)), Pixel::empty([0.0, 0.0, 0.0, 1.0]));
}

#[test]
fn triangles_without_area_or_with_a_corner_that_is_none_are_left_out() {
    let good = square(2.0, 1.0, RED);
    let mut bad = good.clone();
    let mesh = &mut bad.mesh;
    let first = mesh.positions.len() as u32;
    // Nearer than the good ones, so that they would be seen.
    let near = |x: f64, y: f64| DVec3::new(x, y, 1.0);
    mesh.positions.extend([
        DVec3::new(f64::NAN, 0.0, 1.0),
        DVec3::new(0.0, f64::INFINITY, 1.0),
        near(-1.0, -1.0),
        near(0.0, 0.0),
        near(1.0, 1.0),
        near(-1.0, 1.0),
        near(1.0, -1.0),
    ]);
    let [nan, infinite, a, between, b, c, d] = [0, 1, 2, 3, 4, 5, 6].map(|i| first + i);
    let count = mesh.positions.len();
    let mut normals = vec![Vec3::NEG_Z; count];
    normals[d as usize] = Vec3::NAN;
    mesh.normals = Some(normals);
    let mut colors = vec![RED; count];
    colors[c as usize] = [f32::NAN, 0.0, 0.0, 1.0];
    mesh.colors = Colors::Each(colors);
    mesh.triangles.extend([
        [nan, a, b],
        [a, infinite, b],
        [a, b, 1000],
        [a, a, b],
        [a, a, a],
        [a, between, b],
        [a, c, b],
        [a, b, d],
    ]);
    let expected = picture(&meshes(vec![good]), &albedo(33));
    assert_eq!(picture(&meshes(vec![bad]), &albedo(33)).pixels, expected.pixels);
    assert!(expected.pixels.iter().any(|pixel| pixel.polygon));
}

#[test]
fn extreme_coordinates_leave_every_pixel_finite() {
    for size in [1e-300, 1e-160, 1e-30, 1e-3, 1e30, 1e150, 1e300] {
        for center in [DVec3::Z, DVec3::Z * size, DVec3::ZERO, DVec3::new(size, size, -size)] {
            for alpha in [0.5, 1.0] {
                let at = |x: f64, y: f64, z: f64| (center + size * DVec3::new(x, y, z), Vec3::NEG_Z);
                let vertices =
                    [at(-1.0, -1.0, 0.0), at(-1.0, 1.0, 0.5), at(1.0, 0.0, 0.2), at(0.0, 0.0, -3.0)];
                let triangles = [[0, 1, 2], [0, 1, 3], [1, 2, 3]];
                let object = mesh(&vertices, &triangles, [0.5, 0.5, 0.5, alpha]);
                for pixel in picture(&meshes(vec![object]), &settings(17)).pixels {
                    assert!(pixel.color.iter().all(|c| c.is_finite()), "{size}, {center}: {pixel:?}");
                    assert!(pixel.epsilon_margin >= 0.0 && pixel.border_px >= 0.0);
                }
            }
        }
    }
}

#[test]
fn a_floor_that_passes_under_the_eye_is_seen_from_the_near_plane_to_the_horizon() {
    let camera = Camera { near: Some(0.8), ..camera() };
    for alpha in [1.0, 0.5] {
        let scene = meshes(vec![floor([1.0, 0.0, 0.0, alpha])]);
        let seen = render(&scene, &camera, &albedo(64), &|_, _| ()).unwrap();
        let mut cut = 0;
        for (x, y, pixel) in pixels_at(&seen) {
            let z = 0.5 / y;
            let expected = z >= 0.8;
            assert_eq!(pixel.polygon || pixel.layers == 1, expected, "{x}, {y}");
            assert_color(pixel, [if expected { f64::from(alpha) } else { 0.0 }, 0.0, 0.0, 1.0]);
            cut += usize::from(y > 0.0 && !expected);
            if y > 0.0 {
                // How near it is to be cut off, or not to be.
                assert!((pixel.epsilon_margin / ((z - 0.8).abs() / 0.8) - 1.0).abs() < 1e-9, "{x}, {y}");
            }
        }
        assert!(cut > 500, "{cut}");
    }
}

#[test]
fn a_mesh_behind_the_eye_or_before_the_near_plane_is_not_seen() {
    assert!(!middle(&meshes(vec![square(-2.0, 1.0, RED)]), &settings(9)).polygon);
    for (near, seen) in [(0.99, true), (1.0, true), (1.01, false)] {
        let camera = Camera { near: Some(near), ..camera() };
        let drawn = render(&meshes(vec![square(1.0, 1.0, RED)]), &camera, &settings(9), &|_, _| ()).unwrap();
        assert_eq!(drawn.pixel(4, 4).unwrap().polygon, seen, "{near}");
    }
}

#[test]
fn the_nearest_polygon_is_seen_and_of_two_at_one_depth_the_first() {
    let green = [0.0, 1.0, 0.0, 1.0];
    for (red, first) in [(1.99, true), (2.0, true), (2.02, false)] {
        let scene = meshes(vec![square(red, 1.0, RED), square(2.0, 1.0, green)]);
        let pixel = middle(&scene, &albedo(9));
        assert_eq!(pixel.color, if first { [1.0, 0.0, 0.0, 1.0] } else { [0.0, 1.0, 0.0, 1.0] }, "{red}");
        let margin = (red - 2.0_f64).abs() / red.min(2.0);
        assert!((pixel.epsilon_margin - margin).abs() < 1e-12, "{red}");
    }
    // Of three: the nearest and the second one, in whatever order.
    for order in [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]] {
        let list = order.map(|i| square([2.0, 3.0, 5.0][i], 3.0, RED)).to_vec();
        assert!((middle(&meshes(list), &albedo(9)).epsilon_margin - 0.5).abs() < 1e-12, "{order:?}");
    }
}
