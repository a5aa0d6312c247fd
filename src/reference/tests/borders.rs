//! How near a pixel is to the border of a polygon.

use super::*;

const RED: [f32; 4] = [1.0, 0.0, 0.0, 1.0];

/// A square whose sides are `side_px` from the middle of a picture of 32 pixels; at depth 2.
fn sides_at(side_px: f64, color: [f32; 4]) -> MeshObject {
    square(2.0, 2.0 * side_px / 16.0, color)
}

/// From a pixel's center to the nearest side of that square, in pixels; from inside and outside.
fn to_side(x: f64, y: f64, side_px: f64) -> f64 {
    (16.0 * x.abs().max(y.abs()) - side_px).abs()
}

#[test]
fn the_distance_to_the_border_is_told_inside_and_outside_and_the_seam_is_none() {
    // Pixel centers are at ½ and so on from the middle, on the diagonal too.
    for (offset, rim) in [(0.003, true), (-0.003, true), (0.005, false), (-0.05, false), (0.1, false)] {
        for alpha in [1.0, 0.5] {
            let side_px = 8.5 + offset;
            let seen = picture(&meshes(vec![sides_at(side_px, [1.0, 0.0, 0.0, alpha])]), &settings(32));
            let mut near = 0;
            for (x, y, pixel) in pixels_at(&seen) {
                let expected = to_side(x, y, side_px);
                if expected < 1.0 / 16.0 {
                    assert!(
                        (pixel.border_px - expected).abs() < 1e-9,
                        "{offset}: {x}, {y}: {}",
                        pixel.border_px
                    );
                    assert_eq!(pixel.rim, rim, "{offset}: {x}, {y}");
                    near += 1;
                } else {
                    assert_eq!((pixel.border_px, pixel.rim), (f64::INFINITY, false), "{offset}: {x}, {y}");
                }
            }
            assert_eq!(near > 60, offset < 0.1, "{near}");
        }
    }
}

#[test]
fn an_edge_whose_vertices_are_not_shared_is_a_border() {
    let mut object = sides_at(40.0, RED);
    let corners = object.mesh.positions.clone();
    object.mesh.positions.extend(corners);
    object.mesh.normals = Some(vec![Vec3::NEG_Z; 8]);
    object.mesh.triangles[1] = [4, 6, 7];
    let seen = picture(&meshes(vec![object]), &settings(32));
    for (x, y, pixel) in pixels_at(&seen) {
        assert_eq!(pixel.rim, x == y, "{x}, {y}");
        assert!(pixel.polygon);
    }
}

#[test]
fn a_fold_is_a_border_and_a_bend_is_none() {
    // Two triangles at the edge x = −1/32, z = 2, that goes through the column at −½ px. The second one goes on to the
    // right, or back to the left behind the first.
    for (to, folded) in [(DVec3::new(5.0, 0.0, 2.5), false), (DVec3::new(-5.0, 0.0, 2.5), true)] {
        let edge = |y: f64| (DVec3::new(-1.0 / 16.0, y, 2.0), Vec3::NEG_Z);
        let vertices = [edge(-9.0), edge(9.0), (DVec3::new(-9.0, 0.0, 2.0), Vec3::NEG_Z), (to, Vec3::NEG_Z)];
        let object = mesh(&vertices, &[[0, 2, 1], [0, 1, 3]], RED);
        let seen = picture(&meshes(vec![object]), &settings(32));
        assert_eq!(seen.pixel(15, 16).unwrap().rim, folded);
        assert!(!seen.pixel(14, 16).unwrap().rim);
    }
}

#[test]
fn a_hidden_border_is_none() {
    let side = 8.501;
    for (wall, hidden) in [(1.9, true), (2.1, false)] {
        let list = vec![sides_at(side, RED), square(wall, 9.0, RED)];
        let polygons = picture(&meshes(list), &settings(32));
        let mut behind_splats = meshes(vec![sides_at(side, RED)]);
        let disk = facing_disk(DVec3::Z * wall, 9.0, GRAY);
        behind_splats.objects = ellipses(&[disk]).objects;
        let settings = Settings { epsilon: Epsilon::Length(0.01), ..settings(32) };
        let splats = picture(&behind_splats, &settings);
        let mut transparent = behind_splats.clone();
        transparent.meshes = vec![sides_at(side, [1.0, 0.0, 0.0, 0.5])];
        let transparent = picture(&transparent, &settings);
        for seen in [polygons, splats, transparent] {
            let near = seen.pixels.iter().filter(|pixel| pixel.border_px < 0.01).count();
            assert_eq!(near == 0, hidden, "{wall}: {near}");
        }
    }
}

#[test]
fn a_triangle_seen_from_its_edge_covers_nothing_and_is_a_border() {
    // In the plane x = 1/32 z, in which the centers of column 16 are.
    let at = |y: f64, z: f64| (DVec3::new(z / 32.0, y, z), Vec3::NEG_X);
    let object = mesh(&[at(-1.0, 2.0), at(1.0, 2.0), at(0.0, 4.0)], &[[0, 1, 2]], RED);
    let hidden = picture(&meshes(vec![object.clone(), square(1.5, 9.0, RED)]), &settings(32));
    assert!(!hidden.pixel(16, 16).unwrap().rim);
    let seen = picture(&meshes(vec![object]), &settings(32));
    assert!(seen.pixel(16, 16).unwrap().rim);
    for (i, pixel) in seen.pixels.iter().enumerate() {
        assert!(i % 32 == 16 || !(pixel.rim || pixel.polygon), "{i}");
    }
}
