use glam::{DQuat, Vec3};

use super::*;
use crate::{
    hard_scenes::sphere,
    load::builtin::relief,
    scene::{Colors, Shapes},
};

/// A sheet of disks on a grid, so many radii apart, turned somehow.
fn sheet(side: i32, apart: f64, ellipses: bool) -> Splats {
    let turned = DQuat::from_rotation_y(0.7) * DQuat::from_rotation_x(0.4);
    let places = (0..side).flat_map(|y| (0..side).map(move |x| (x, y)));
    let positions = places.map(|(x, y)| turned * (apart * DVec3::new(x.into(), y.into(), 0.0)));
    let positions: Vec<DVec3> = positions.collect();
    let count = positions.len();
    let vector = |v: DVec3| (turned * v).as_vec3();
    let shapes = match ellipses {
        // Longer along x by a quarter, skew.
        true => Shapes::Ellipses {
            s: vec![vector(DVec3::new(1.25, 0.2, 0.0)); count],
            t: vec![vector(DVec3::Y); count],
        },
        false => Shapes::Disks { normals: vec![vector(DVec3::Z); count], radii: vec![1.0; count] },
    };
    Splats::new(positions, shapes, Colors::Uniform([1.0; 4]))
}

#[test]
fn the_outer_rows_of_a_sheet_are_at_its_border_and_no_other() {
    for (apart, ellipses) in [(0.667, false), (1.0, false), (0.4, false), (0.8, true)] {
        let side = 20;
        let found = at_border(&sheet(side, apart, ellipses)).unwrap();
        for (i, at) in found.iter().enumerate() {
            let [x, y] = [i as i32 % side, i as i32 / side];
            let is_outer = [x, y].iter().any(|i| *i == 0 || *i == side - 1);
            // What is denser than that reaches the border from further inside.
            let may_be = is_outer || apart < 0.5 && [x, y].iter().any(|i| *i == 1 || *i == side - 2);
            assert!(!is_outer || *at, "{apart} {ellipses} {x} {y}");
            assert!(may_be || !at, "{apart} {ellipses} {x} {y}");
        }
    }
}

#[test]
fn what_is_closed_has_no_border_and_what_is_open_has() {
    for count in [1000, 20_000] {
        assert!(at_border(&sphere(count, DVec3::ZERO).splats).is_none(), "{count}");
    }
    let relief = relief(20_000).splats;
    let count = at_border(&relief).unwrap().iter().filter(|at| **at).count();
    println!("{count} of {}", relief.len());
    assert!(count < relief.len() / 10, "{count}");
}

/// A hole of one splat in a large sheet is no border.
#[test]
fn a_few_gaps_are_no_border() {
    let mut splats = sphere(5000, DVec3::ZERO).splats;
    splats.positions.swap_remove(700);
    let Shapes::Disks { normals, radii } = &mut splats.shapes else { panic!("disks") };
    normals.swap_remove(700);
    radii.swap_remove(700);
    assert!(at_border(&splats).is_none());
}

/// Both sides of an edge end there, for each is another surface.
#[test]
fn sides_of_a_box_have_borders_where_they_meet() {
    let mut splats = sheet(10, 0.667, false);
    let other: Vec<DVec3> = splats.positions.iter().map(|at| DVec3::new(at.x, at.z, at.y)).collect();
    let Shapes::Disks { normals, radii } = &mut splats.shapes else { panic!("disks") };
    normals.extend(normals.clone().into_iter().map(|n| -Vec3::new(n.x, n.z, n.y)));
    radii.extend(radii.clone());
    splats.positions.extend(other);
    let alone = at_border(&sheet(10, 0.667, false)).unwrap();
    let beside = at_border(&splats).unwrap();
    assert_eq!(&beside[..100], &alone[..]);
}
