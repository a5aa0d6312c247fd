use glam::EulerRot;

use super::*;
use crate::scene::{Colors, Defect};

/// Normals along axes and diagonals, of several lengths, and a few between.
fn normals() -> Vec<Vec3> {
    let mut normals = Vec::new();
    for x in -1..=1 {
        for y in -1..=1 {
            for z in -1..=1 {
                normals.push(Vec3::new(x as f32, y as f32, z as f32));
            }
        }
    }
    normals.retain(|normal| *normal != Vec3::ZERO);
    normals.extend([Vec3::new(0.1, -0.7, 0.3), Vec3::new(-1e-30, 0.0, 1e-30), Vec3::new(3e8, 2e8, -1e8)]);
    normals
}

fn disks() -> Splats {
    let normals = normals();
    Splats::new(
        (0..normals.len()).map(|i| DVec3::new(0.3 * i as f64, 5e6, -0.1 * i as f64)).collect(),
        Shapes::Disks { radii: vec![0.25; normals.len()], normals },
        Colors::Uniform([0.5; 4]),
    )
}

/// What N24 asks for, and others: (matrix, is a similarity, mirrors).
fn maps() -> Vec<(DMat3, bool, bool)> {
    let turn = DMat3::from_euler(EulerRot::XYZ, 0.3, -1.1, 2.0);
    let shear = DMat3::from_cols(DVec3::X, DVec3::new(0.7, 1.0, 0.0), DVec3::new(-0.2, 0.4, 1.0));
    let scale = |x: f64, y: f64, z: f64| DMat3::from_diagonal(DVec3::new(x, y, z));
    vec![
        (DMat3::IDENTITY, true, false),
        (3.0 * turn, true, false),
        (scale(1.0, -1.0, 1.0), true, true),
        (turn * scale(-2.0, -2.0, -2.0), true, true),
        (scale(1.0, 1.0, 0.01), false, false),
        (turn * scale(1.0, 1.0, -0.01), false, true),
        (shear, false, false),
        (scale(-1.0, 1.0, 1.0) * shear * turn, false, true),
    ]
}

fn affine(matrix: DMat3) -> DAffine3 {
    DAffine3 { matrix3: matrix, translation: DVec3::new(-2.0, 4e6, 0.5) }
}

/// The points of the disk's rim, and a point above its outside, one after the other through the map in f64.
#[test]
fn the_image_of_a_disk_is_the_image_of_its_points() {
    for (matrix, similarity, mirrors) in maps() {
        let (before, map) = (disks(), affine(matrix));
        assert!(is_invertible(&map));
        let after = before.clone().transformed(&map);
        assert_eq!(matches!(after.shapes, Shapes::Disks { .. }), similarity, "{matrix}");
        assert_eq!(Linear::of(&matrix).mirrors(), mirrors, "{matrix}");
        for (i, normal) in normals().into_iter().enumerate() {
            assert_eq!(after.defect(i), None, "{matrix} {normal}");
            let normal = normal.as_dvec3().normalize();
            assert_eq!(after.positions[i], map.transform_point3(before.positions[i]));
            // The disk's plane under the map, by the textbook's inverse transpose.
            let expected = (matrix.inverse().transpose() * normal).normalize();
            let [s, t, outward] = frame(&after.shapes, i);
            assert!(outward.angle_between(expected) < 1e-6, "{matrix} {normal}: {outward} {expected}");
            assert!(outward.dot(matrix * normal) > 0.0, "what is outside stays outside");
            let (a, b) = normal.any_orthonormal_pair();
            for k in 0..24 {
                let (sin, cos) = (f64::from(k) * 0.26).sin_cos();
                let rim = 0.25 * matrix * (cos * a + sin * b);
                // Its (u, v) in the image's own tangents: on the unit circle, in the plane.
                let (u, v) = solve(s, t, rim);
                let off = (rim - u * s - v * t).length() / s.length().max(t.length());
                assert!((u.hypot(v) - 1.0).abs() < 1e-5 && off < 1e-6, "{matrix} {normal}: {u} {v} {off}");
            }
        }
    }
}

/// Tangent vectors and normal of a splat, in f64.
fn frame(shapes: &Shapes, i: usize) -> [DVec3; 3] {
    match shapes {
        Shapes::Disks { normals, radii } => {
            let normal = normals[i].as_dvec3();
            let (s, t) = normal.normalize().any_orthonormal_pair();
            [f64::from(radii[i]) * s, f64::from(radii[i]) * t, normal]
        }
        Shapes::Ellipses { s, t } => {
            let (s, t) = (s[i].as_dvec3(), t[i].as_dvec3());
            [s, t, s.cross(t).normalize()]
        }
    }
}

/// Least squares: `u s + v t` next to a point.
fn solve(s: DVec3, t: DVec3, point: DVec3) -> (f64, f64) {
    let (ss, st, tt) = (s.dot(s), s.dot(t), t.dot(t));
    let (sp, tp) = (s.dot(point), t.dot(point));
    let det = ss * tt - st * st;
    ((tt * sp - st * tp) / det, (ss * tp - st * sp) / det)
}

#[test]
fn ellipses_stay_ellipses_and_keep_their_side() {
    let ellipse = Splats::new(
        vec![DVec3::ONE],
        Shapes::Ellipses { s: vec![Vec3::new(2.0, 0.0, 0.0)], t: vec![Vec3::new(1.0, 0.5, 0.0)] },
        Colors::Uniform([1.0; 4]),
    );
    let after = ellipse.transformed(&DAffine3::from_scale(DVec3::new(1.0, -1.0, 1.0)));
    let Shapes::Ellipses { s, t } = &after.shapes else { panic!("disks") };
    assert_eq!((s[0], t[0]), (Vec3::new(1.0, -0.5, 0.0), Vec3::new(2.0, 0.0, 0.0)));
    assert!(s[0].cross(t[0]).z > 0.0);
    assert_eq!(after.positions, [DVec3::new(1.0, -1.0, 1.0)]);
}

#[test]
fn a_defect_stays_one_and_a_map_that_is_none_makes_them() {
    let mut splats = disks();
    let Shapes::Disks { normals: of_splats, radii } = &mut splats.shapes else { panic!() };
    of_splats[0] = Vec3::ZERO;
    of_splats[1] = Vec3::NAN;
    (radii[2], radii[3]) = (-1.0, f32::INFINITY);
    splats.positions[4].x = f64::NAN;
    for (matrix, similarity, _) in maps() {
        let after = splats.clone().transformed(&affine(matrix));
        let expected = match similarity {
            true => [Defect::Normal, Defect::Normal, Defect::Radius, Defect::Radius, Defect::Position],
            false => [[Defect::Tangents; 4].as_slice(), &[Defect::Position]].concat().try_into().unwrap(),
        };
        assert_eq!([0, 1, 2, 3, 4].map(|i| after.defect(i).unwrap()), expected, "{matrix}");
        assert_eq!(after.defect(5), None);
    }
    for flat in [DVec3::new(1.0, 0.0, 1.0), DVec3::ZERO, DVec3::splat(f64::NAN)] {
        let map = DAffine3::from_scale(flat);
        assert!(!is_invertible(&map));
        let after = splats.clone().transformed(&map);
        for (i, normal) in normals().into_iter().enumerate() {
            // Seen along y, disks that stand upright are lines.
            assert!(after.defect(i).is_some() || (flat.x == 1.0 && normal.y != 0.0), "{flat} {normal}");
        }
    }
    let plane = DMat3::from_cols(DVec3::X, DVec3::Y, DVec3::new(1.0, 1.0, 1e-14));
    assert!(!is_invertible(&affine(plane)));
    // Extreme, but a map.
    assert!(is_invertible(&DAffine3::from_scale(DVec3::new(1e-300, 1e-300, 1e300))));
}

#[test]
fn a_meshs_triangles_and_normals_stay_on_the_outside() {
    // The faces at the corner of a box; the outside is where x, y and z are negative.
    let corner = Mesh {
        positions: vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z],
        normals: Some(vec![-Vec3::ONE, -Vec3::X, -2.0 * Vec3::Y, Vec3::ZERO]),
        colors: Colors::unknown(),
        triangles: vec![[0, 2, 1], [0, 3, 2], [0, 1, 3]],
    };
    for (matrix, ..) in maps() {
        let map = affine(matrix);
        let after = corner.clone().transformed(&map);
        for (i, position) in corner.positions.iter().enumerate() {
            assert_eq!(after.positions[i], map.transform_point3(*position));
        }
        let outside = matrix * -DVec3::ONE;
        for i in 0..3 {
            let [a, b, c] = after.corners(i).unwrap();
            let face = (b - a).cross(c - a);
            assert!(face.dot(outside) > 0.0, "{matrix}: counterclockwise seen from outside");
            let before = corner.corners(i).unwrap();
            let old = (before[1] - before[0]).cross(before[2] - before[0]);
            let expected = matrix.inverse().transpose() * old;
            assert!(face.angle_between(expected) < 1e-7, "{matrix}");
        }
        let normals = after.normals.unwrap();
        for (normal, old) in normals.iter().zip(corner.normals.as_ref().unwrap()).take(3) {
            let expected = matrix.inverse().transpose() * old.as_dvec3();
            assert!((normal.length() - 1.0).abs() < 1e-6);
            assert!(normal.as_dvec3().angle_between(expected) < 1e-6, "{matrix}");
        }
        assert_eq!(normals[3], Vec3::ZERO);
    }
}
