//! Every node of every model holds what it must of every disk below it.

use std::f64::consts::TAU;

use glam::DVec3;

use super::{contrast::factor_of, models::models};
use crate::{
    geometry::hierarchy::{Hierarchy, disks::Disks},
    scene::{Shapes, Splats},
};

/// Points of each disk's rim that are looked at.
const RIM: usize = 24;

/// Directions from which each of them is looked at.
const SIDES: usize = 8;

#[test]
fn every_node_bounds_every_disk_below_it() {
    for (name, splats) in models() {
        let hierarchy = Hierarchy::build(&splats, &()).unwrap();
        let disks = Disks::of(&splats, &hierarchy.order).0;
        let (s, t) = axes(&hierarchy.nodes);
        // The size of an ellipse over the least that its shape could have.
        let mut slack = Vec::new();
        for (i, node) in hierarchy.tree.iter().enumerate() {
            let (center, s, t) = (hierarchy.nodes.positions[i], s[i], t[i]);
            let bounds = &hierarchy.bounds[i];
            let ball = bounds.error.center.as_dvec3();
            let radius = f64::from(bounds.error.radius);
            let axis = bounds.cone.axis.as_dvec3().normalize();
            let normal_of_plane = s.cross(t).normalize();
            let mut farthest: f64 = 0.0;
            let (mut squares, mut area) = (0.0, 0.0);
            let below = &disks[node.splats.start as usize..node.splats.end as usize];
            for disk in below {
                let normal = disk.area_normal().normalize();
                squares += disk.area_normal().length() * disk.center.distance_squared(center);
                area += disk.area_normal().length();
                assert!(normal.dot(axis).max(-1.0) >= f64::from(bounds.cone.cos), "{name}: node {i}, cone");
                for corner in 0..RIM {
                    let (sin, cos) = (TAU * corner as f64 / RIM as f64).sin_cos();
                    // From near by: coordinates in world space would round it away.
                    let rim = |from: DVec3| from + cos * disk.s.as_dvec3() + sin * disk.t.as_dvec3();
                    let from_origin = rim(disk.center - hierarchy.origin);
                    assert!(from_origin.distance(ball) <= radius, "{name}: node {i}, ball");
                    let from_center = rim(disk.center - center);
                    // Where lines at 45° to the normal through it meet the plane.
                    let height = normal_of_plane.dot(from_center);
                    for side in 0..SIDES {
                        let (sin, cos) = (TAU * side as f64 / SIDES as f64).sin_cos();
                        let met = from_center + height * (cos * s.normalize() + sin * t.normalize());
                        let [u, v] = [s, t].map(|axis| axis.dot(met) / axis.length_squared());
                        farthest = farthest.max(u.hypot(v));
                    }
                }
            }
            assert!(farthest <= 1.0, "{name}: node {i}: {farthest}");
            slack.push(1.0 / farthest);
            // How far what is below spreads, times how much it differs: exactly where no child does more.
            let factor = factor_of(below, &splats.colors);
            let spread = (factor * (squares / area).sqrt()).max(0.25 * s.length().max(t.length()));
            assert!(f64::from(bounds.error.spread) >= (1.0 - 1e-6) * spread, "{name}: node {i}, spread");
            if node.children.is_empty() {
                assert!(f64::from(bounds.error.spread) <= (1.0 + 1e-5) * spread, "{name}: node {i}, spread");
            }
            assert!(s.length() >= t.length() && s.dot(t).abs() <= 1e-6 * s.length() * t.length());
        }
        slack.sort_by(f64::total_cmp);
        let at = |part: f64| slack[((slack.len() - 1) as f64 * part) as usize];
        println!(
            "{name}: {} nodes, f over its least: median {:.4}, 99% {:.4}, most {:.4}",
            slack.len(),
            at(0.5),
            at(0.99),
            at(1.0)
        );
        // Where the surface is flat, f is the least but for what 24 points of a rim leave out: 1/cos 7.5°.
        assert!(at(0.5) <= 1.25 && (at(1.0) <= 1.01 || name != "sheet of two sides"), "{name}");
    }
}

#[test]
fn bounds_of_children_lie_within_those_of_their_parents() {
    for (name, splats) in models() {
        let hierarchy = Hierarchy::build(&splats, &()).unwrap();
        for (i, node) in hierarchy.tree.iter().enumerate().skip(1) {
            let (own, parent) = (&hierarchy.bounds[i], &hierarchy.bounds[node.parent as usize]);
            let apart = own.error.center.as_dvec3().distance(parent.error.center.as_dvec3());
            assert!(apart + f64::from(own.error.radius) < f64::from(parent.error.radius), "{name}: node {i}");
            assert!(own.error.spread < parent.error.spread && own.error.spread > 0.0, "{name}: node {i}");
            let [own_rad, parent_rad] = [own, parent].map(|bounds| f64::from(bounds.cone.cos).acos());
            let turn = own.cone.axis.as_dvec3().angle_between(parent.cone.axis.as_dvec3());
            assert!(parent.cone.cos == -1.0 || turn + own_rad <= parent_rad, "{name}: node {i}");
        }
    }
}

fn axes(nodes: &Splats) -> (Vec<DVec3>, Vec<DVec3>) {
    let Shapes::Ellipses { s, t } = &nodes.shapes else { panic!("nodes are ellipses") };
    (s.iter().map(|s| s.as_dvec3()).collect(), t.iter().map(|t| t.as_dvec3()).collect())
}
