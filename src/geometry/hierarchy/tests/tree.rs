//! The tree itself, and what its nodes are made of.

use glam::{DQuat, DVec3, Vec3};
use rayon::ThreadPoolBuilder;

use super::models::{models, plate, random_ellipses};
use crate::{
    error::ErrorKind,
    geometry::hierarchy::{Hierarchy, LEAF_SPLATS, NO_NODE},
    load::builtin::relief,
    scene::{Colors, Shapes, Splats},
};

#[test]
fn each_splat_is_in_the_tree_once_and_no_path_is_long() {
    for (name, splats) in models() {
        let hierarchy = Hierarchy::build(&splats, &()).unwrap();
        let nodes = &hierarchy.tree;
        let mut order = hierarchy.order.clone();
        order.sort_unstable();
        assert!(order.iter().copied().eq(0..splats.len() as u32), "{name}");
        assert!(nodes.len() < splats.len(), "{name}");
        assert_eq!((nodes[0].parent, &nodes[0].splats), (NO_NODE, &(0..splats.len() as u32)), "{name}");
        for (i, node) in nodes.iter().enumerate() {
            let leaves: Vec<u32> = node.leaf_runs(nodes).flatten().collect();
            let children = &nodes[node.children.start as usize..node.children.end as usize];
            assert!(leaves.len() + children.len() >= 2 && leaves.len() <= LEAF_SPLATS, "{name}: node {i}");
            let below: usize = leaves.len() + children.iter().map(|child| child.splats.len()).sum::<usize>();
            assert_eq!(below, node.splats.len(), "{name}: node {i}");
            assert!(children.iter().all(|child| child.parent == i as u32), "{name}: node {i}");
            assert!(
                children.iter().all(|child| 4 * child.splats.len() <= 3 * node.splats.len()),
                "{name}: node {i}"
            );
            let parents = leaves.iter().map(|&leaf| hierarchy.leaf_parents[leaf as usize]);
            assert!(parents.into_iter().all(|parent| parent == i as u32), "{name}: node {i}");
        }
        assert_eq!(hierarchy.levels.iter().flat_map(|level| level.clone()).count(), nodes.len());
        assert!(hierarchy.levels.windows(2).all(|pair| pair[0].end == pair[1].start));
        assert!((hierarchy.levels.len() as f64) <= 2.5 * (splats.len() as f64).log2(), "{name}");
    }
}

#[test]
fn any_number_of_threads_makes_the_same_bytes() {
    // More splats than one thread looks at alone.
    for splats in [relief(40_000).splats, random_ellipses(3000, 1.0, 9)] {
        let [one, two] = [1, 2].map(|threads| {
            let pool = ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            // All of its digits, and the sign of zero.
            format!("{:?}", pool.install(|| Hierarchy::build(&splats, &()).unwrap()))
        });
        assert!(one == two);
    }
}

#[test]
fn means_are_by_area_and_colors_by_alpha_too() {
    // Four times the area, at the origin; and one that is half transparent.
    let shapes = Shapes::Disks { normals: vec![Vec3::Z; 2], radii: vec![2.0, 1.0] };
    let positions = vec![DVec3::ZERO, DVec3::new(10.0, 0.0, 0.0)];
    let colors = Colors::Each(vec![[0.5, 0.0, 0.0, 1.0], [0.0, 1.0, 0.0, 0.5]]);
    let hierarchy = Hierarchy::build(&Splats::new(positions, shapes, colors), &()).unwrap();
    assert!(hierarchy.nodes.positions[0].distance(DVec3::new(2.0, 0.0, 0.0)) < 1e-12);
    let expected = [4.0 * 0.5 / 4.5, 0.5 / 4.5, 0.0, 0.9];
    for (color, expected) in hierarchy.nodes.color(0).into_iter().zip(expected) {
        assert!((color - expected).abs() < 1e-6, "{:?}", hierarchy.nodes.color(0));
    }
    let opaque = Hierarchy::build(&plate(20, 0.1), &()).unwrap();
    assert!((0..opaque.tree.len()).all(|i| opaque.nodes.color(i)[3] == 1.0));
}

#[test]
fn a_node_lies_in_its_surface_and_faces_as_that_does() {
    let splats = relief(20_000).splats;
    let hierarchy = Hierarchy::build(&splats, &()).unwrap();
    let Shapes::Ellipses { s, t } = &hierarchy.nodes.shapes else { panic!("nodes are ellipses") };
    let mut nodes: Vec<f32> = (0..hierarchy.tree.len())
        .filter(|&i| hierarchy.tree[i].splats.len() <= 64)
        .map(|i| s[i].cross(t[i]).normalize().dot(hierarchy.nodes.positions[i].as_vec3().normalize()))
        .collect();
    nodes.sort_by(f32::total_cmp);
    // The relief is a ball that is carved: nothing of it faces the center.
    assert!(nodes[0] > 0.0 && nodes[nodes.len() / 2] > 0.8, "{} {}", nodes[0], nodes[nodes.len() / 2]);
    // Where both sides of a sheet are below a node, that lies in the sheet.
    let sheet = Hierarchy::build(&plate(20, 0.0), &()).unwrap();
    let Shapes::Ellipses { s, t } = &sheet.nodes.shapes else { panic!("nodes are ellipses") };
    assert!(s.iter().zip(t).all(|(s, t)| s.cross(*t).normalize().z.abs() > 0.999));
    // So it is at a plate's rim, the normals of which are all that does not cancel; turned, so that cuts do not lie between its sides.
    let turn = DQuat::from_rotation_y(0.7) * DQuat::from_rotation_x(0.6);
    let mut plate = plate(40, 0.02);
    plate.positions.iter_mut().for_each(|position| *position = turn * *position);
    let Shapes::Disks { normals, .. } = &mut plate.shapes else { panic!("a plate is of disks") };
    normals.iter_mut().for_each(|normal| *normal = turn.as_quat() * *normal);
    let across = (turn * DVec3::Z).as_vec3();
    let plate = Hierarchy::build(&plate, &()).unwrap();
    let Shapes::Ellipses { s, t } = &plate.nodes.shapes else { panic!("nodes are ellipses") };
    let wide = (0..s.len()).filter(|&i| plate.tree[i].splats.len() >= 64);
    for i in wide {
        assert!(s[i].cross(t[i]).normalize().dot(across).abs() > 0.9, "{}", plate.nodes.positions[i]);
    }
}

#[test]
fn nothing_is_made_of_nothing_and_what_cannot_be_drawn_is_refused() {
    let of = |mut splats: Splats, count: usize| {
        splats.keep(&(0..splats.len()).map(|i| i < count).collect::<Vec<_>>());
        Hierarchy::build(&splats, &())
    };
    let some = || random_ellipses(10, 1.0, 2);
    for count in [0, 1] {
        let hierarchy = of(some(), count).unwrap();
        assert_eq!((hierarchy.tree.len(), hierarchy.levels.len()), (0, 0));
        assert_eq!(hierarchy.leaf_parents, vec![NO_NODE; count]);
    }
    for position in [DVec3::NAN, DVec3::splat(f64::INFINITY), DVec3::splat(2e37)] {
        let mut splats = some();
        splats.positions[3] = position;
        let error = of(splats, 10).unwrap_err();
        assert!(matches!(error.kind(), ErrorKind::Input { .. }), "{error}");
    }
    // At the ends of what is accepted everything is still a number.
    for scale in [1e36, 1e-30] {
        let mut splats = some();
        splats.positions.iter_mut().for_each(|position| *position *= scale);
        let Shapes::Ellipses { s, t } = &mut splats.shapes else { panic!("ellipses") };
        s.iter_mut().chain(t).for_each(|axis| *axis *= scale as f32);
        let hierarchy = of(splats, 10).unwrap();
        assert!((0..hierarchy.tree.len()).all(|i| hierarchy.nodes.defect(i).is_none()), "{scale}");
    }
}
