//! What is drawn covers every splat once, computed in f64 and as a device computes it.

use glam::{DVec3, Vec3};

use super::models::models;
use crate::{
    geometry::hierarchy::{ErrorBall, Hierarchy, Levels, Projection, Selection},
    math::random::SplitMix,
};

/// Views of each model.
const VIEWS: usize = 200;

/// From within the root's ball to far outside; every fourth in parallel projection.
fn projections(hierarchy: &Hierarchy) -> Vec<(Projection, f64)> {
    let root = &hierarchy.bounds[0].error;
    let mut random = SplitMix(17);
    (0..VIEWS)
        .map(|i| {
            let mut unit = || 2.0 * random.unit() - 1.0;
            let distance = f64::from(root.radius) * 10.0_f64.powf(1.5 * unit());
            let eye = root.center.as_dvec3() + distance * DVec3::new(unit(), unit(), unit()).normalize();
            let tau_px = 10.0 * 10.0_f64.powf(unit());
            match i % 4 {
                0 => (Projection::Parallel { px_per_unit: 200.0 / distance }, tau_px),
                _ => (Projection::Perspective { eye, focal_px: 500.0, near: 1e-6 * distance }, tau_px),
            }
        })
        .collect()
}

/// By how many drawn nodes, and itself, each splat is stood for.
fn times_drawn(hierarchy: &Hierarchy, selection: &Selection) -> Vec<u32> {
    let mut times = vec![0; hierarchy.order.len()];
    for &node in &selection.nodes {
        let splats = &hierarchy.tree[node as usize].splats;
        times[splats.start as usize..splats.end as usize].iter_mut().for_each(|times| *times += 1);
    }
    selection.leaves.iter().for_each(|&leaf| times[leaf as usize] += 1);
    times
}

#[test]
fn each_splat_is_drawn_once_by_itself_or_a_node_above_it() {
    for (name, splats) in models() {
        let hierarchy = Hierarchy::build(&splats, &()).unwrap();
        for (i, (projection, tau_px)) in projections(&hierarchy).into_iter().enumerate() {
            let selection = hierarchy.select(&projection, tau_px);
            assert!(times_drawn(&hierarchy, &selection).iter().all(|&times| times == 1), "{name}: view {i}");
        }
    }
}

/// Of what is drawn at once on a path, where nodes blend with those below them.
#[test]
fn weights_of_blended_nodes_add_up_to_1_on_every_path() {
    for (name, splats) in models() {
        let hierarchy = Hierarchy::build(&splats, &()).unwrap();
        let mut blended = 0;
        for (i, (projection, tau_px)) in projections(&hierarchy).into_iter().enumerate().step_by(8) {
            let weight = |levels: Levels| projection.weight(&levels, tau_px, 1.4);
            let nodes: Vec<f64> =
                (0..hierarchy.tree.len()).map(|node| weight(hierarchy.node_levels(node))).collect();
            assert!(nodes.iter().all(|weight| *weight >= 0.0), "{name}: view {i}");
            blended += nodes.iter().filter(|weight| (0.01..0.99).contains(*weight)).count();
            for leaf in 0..hierarchy.order.len() {
                let mut sum = weight(hierarchy.leaf_levels(leaf));
                let mut node = hierarchy.leaf_parents[leaf];
                while let Some(above) = hierarchy.tree.get(node as usize) {
                    sum += nodes[node as usize];
                    node = above.parent;
                }
                assert!((sum - 1.0).abs() < 1e-12, "{name}: view {i}, splat {leaf}: {sum}");
            }
        }
        assert!(blended > 0 || hierarchy.tree.len() < 10, "{name}");
    }
}

#[test]
fn so_it_is_in_f32() {
    for (name, splats) in models() {
        let hierarchy = Hierarchy::build(&splats, &()).unwrap();
        for (i, (projection, tau_px)) in projections(&hierarchy).into_iter().enumerate() {
            let draws = |levels: Levels| {
                size_px_f32(&projection, &levels.own) <= tau_px as f32
                    && size_px_f32(&projection, &levels.parent) > tau_px as f32
            };
            let nodes = (0..hierarchy.tree.len()).filter(|&i| draws(hierarchy.node_levels(i)));
            let leaves = (0..hierarchy.order.len()).filter(|&i| draws(hierarchy.leaf_levels(i)));
            let selection = Selection {
                nodes: nodes.map(|i| i as u32).collect(),
                leaves: leaves.map(|i| i as u32).collect(),
            };
            assert!(times_drawn(&hierarchy, &selection).iter().all(|&times| times == 1), "{name}: view {i}");
            for (i, node) in hierarchy.tree.iter().enumerate().skip(1) {
                let [own, parent] = [i, node.parent as usize]
                    .map(|node| size_px_f32(&projection, &hierarchy.bounds[node].error));
                assert!(own <= parent, "{name}: node {i}");
            }
        }
    }
}

/// As a device may compute it.
fn size_px_f32(projection: &Projection, ball: &ErrorBall) -> f32 {
    match *projection {
        Projection::Perspective { eye, focal_px, near } => {
            let to_eye: Vec3 = eye.as_vec3() - ball.center;
            let distance = to_eye.length() - ball.radius;
            focal_px as f32 * ball.spread / distance.max(near as f32)
        }
        Projection::Parallel { px_per_unit } => px_per_unit as f32 * ball.spread,
    }
}

#[test]
fn a_size_of_0_draws_the_splats_and_one_without_end_the_root() {
    for (name, splats) in models() {
        let hierarchy = Hierarchy::build(&splats, &()).unwrap();
        let all = Selection { nodes: Vec::new(), leaves: (0..splats.len() as u32).collect() };
        let root = Selection { nodes: vec![0], leaves: Vec::new() };
        for (projection, _) in projections(&hierarchy) {
            assert_eq!(hierarchy.select(&projection, 0.0), all, "{name}");
            assert_eq!(hierarchy.select(&projection, f64::MAX), root, "{name}");
        }
    }
}
