//! Levels of detail found from the root and by each node for itself, on random views of several models.

use glam::DVec3;

use super::settings;
use crate::{
    geometry::hierarchy::{Hierarchy, Projection, Selection, tests::models::models},
    reference::{Culling, Walk},
    scene::{Camera, Shapes, Splats},
};

/// Views of each model.
const VIEWS: u64 = 200;

const SIDE_PX: u32 = 256;

/// Random numbers from 0 to 1: a sequence of Weyl's, whose multiples of an irrational number spread evenly.
fn unit(seed: u64, dimension: u64) -> f64 {
    let irrational = [2.0_f64, 3.0, 5.0, 7.0, 11.0, 13.0, 17.0, 19.0][dimension as usize].sqrt();
    ((seed + 1) as f64 * irrational).fract()
}

fn direction(seed: u64, dimension: u64) -> DVec3 {
    let z = 2.0 * unit(seed, dimension) - 1.0;
    let (sin, cos) = (std::f64::consts::TAU * unit(seed, dimension + 1)).sin_cos();
    DVec3::new((1.0 - z * z).sqrt() * cos, (1.0 - z * z).sqrt() * sin, z)
}

/// From inside the model to ten times its radius away, toward somewhere in it; and a size from 0.5 to 50 pixels.
pub(super) fn view(splats: &Splats, seed: u64) -> (Camera, f64) {
    let bounds = splats.bounds().unwrap();
    let radius = bounds.radius();
    let eye = bounds.center() + radius * 0.1 * 100.0_f64.powf(unit(seed, 0)) * direction(seed, 1);
    let target = bounds.center() + 0.7 * radius * unit(seed, 3) * direction(seed, 4);
    let near = Some(1e-3 * radius);
    (Camera { eye, target, near, ..Camera::default() }, 0.5 * 100.0_f64.powf(unit(seed, 6)))
}

#[test]
fn each_node_decides_for_itself_as_a_walk_from_the_root_does() {
    for (name, splats) in models() {
        let hierarchy = Hierarchy::build(&splats, &()).unwrap();
        let (mut drawn_nodes, mut drawn_leaves, mut culled) = (0, 0, 0);
        for seed in 0..VIEWS {
            let (camera, tau_px) = view(&splats, seed);
            let projection = Projection::of_camera(&camera, SIDE_PX, &hierarchy);
            let alone = hierarchy.select(&projection, tau_px);
            let walk = |culling| Walk::new((&hierarchy, &splats), (&camera, [SIDE_PX; 2]), tau_px, culling);
            assert_eq!(walk(Culling::default()).selection(), alone, "{name}: view {seed}");
            let culling = Culling { outside: seed % 3 != 0, back_faces: seed % 3 != 1 };
            let walk = walk(culling);
            let visible = Selection {
                nodes: alone.nodes.iter().copied().filter(|&node| !walk.hides_node(node)).collect(),
                leaves: alone.leaves.iter().copied().filter(|&leaf| !walk.hides_leaf(leaf)).collect(),
            };
            assert_eq!(walk.selection(), visible, "{name}: view {seed}, {culling:?}");
            drawn_nodes += alone.nodes.len();
            drawn_leaves += alone.leaves.len();
            culled += alone.nodes.len() + alone.leaves.len() - visible.nodes.len() - visible.leaves.len();
        }
        println!("{name}: {drawn_nodes} nodes and {drawn_leaves} splats, {culled} of them culled");
        assert!(drawn_leaves > 0 && culled > 0, "{name}");
    }
}

#[test]
fn nothing_is_culled_that_would_be_seen() {
    for (name, splats) in models() {
        let hierarchy = Hierarchy::build(&splats, &()).unwrap();
        for seed in 0..50 {
            let (camera, tau_px) = view(&splats, seed);
            let culling = Culling { outside: true, back_faces: true };
            let walk = Walk::new((&hierarchy, &splats), (&camera, [SIDE_PX; 2]), tau_px, culling);
            for (i, node) in hierarchy.tree.iter().enumerate().filter(|(i, _)| walk.hides_node(*i as u32)) {
                assert!(
                    node.splats.clone().all(|place| walk.hides_leaf(place)),
                    "{name}: node {i}, view {seed}"
                );
            }
        }
    }
}

#[test]
fn no_ellipse_is_longer_in_the_picture_than_eight_times_its_size() {
    for (name, splats) in models() {
        let hierarchy = Hierarchy::build(&splats, &()).unwrap();
        let Shapes::Ellipses { s, t } = &hierarchy.nodes.shapes else { panic!("nodes are ellipses") };
        let size_px = settings(SIDE_PX).size_px;
        for i in 0..hierarchy.tree.len() {
            let center = hierarchy.nodes.positions[i];
            let radius = f64::from(hierarchy.bounds[i].error.radius);
            let eye = center + radius * (1.5 + 5.0 * unit(i as u64, 2)) * direction(i as u64, 0);
            let camera = Camera { eye, target: center, ..Camera::default() };
            let claimed =
                Projection::of_camera(&camera, SIDE_PX, &hierarchy).size_px(&hierarchy.bounds[i].error);
            let view = crate::reference::view::View::pinhole(&camera, size_px);
            let rim: Vec<_> = (0..32)
                .map(|k| {
                    let (sin, cos) = (std::f64::consts::TAU * f64::from(k) / 32.0).sin_cos();
                    let point = view.from_world.point(center + cos * s[i].as_dvec3() + sin * t[i].as_dvec3());
                    view.focal_px * point.truncate() / point.z
                })
                .collect();
            let longest = (0..16).map(|k| rim[k].distance(rim[k + 16])).fold(0.0, f64::max);
            // Half of it is at most 4 times as long as what is below spreads.
            let claimed = 8.0 * claimed;
            assert!(longest <= claimed, "{name}: node {i}: {longest} px, claimed {claimed}");
        }
    }
}
