//! Which nodes of a hierarchy are drawn, found as in the paper: by walking down from the root (Pajarola, Sainz, Guidotti 2003, section 5.1).
//!
//! At each node: nothing of it is drawn if its ball is outside the view, or all normals in its cone face away from the eye, as seen from all
//! points of its ball. If it is larger on the screen than τ its children are looked at; else it is drawn. Splats at the end are of no size.

use glam::DVec3;

use super::{tangents::tangents, view::View};
use crate::{
    geometry::hierarchy::{Bounds, Hierarchy, Selection},
    scene::{Camera, Splats},
};

/// What is not drawn although it is small enough.
#[derive(Clone, Copy, Debug, Default)]
pub struct Culling {
    /// What is outside the view.
    pub outside: bool,
    /// What faces away.
    pub back_faces: bool,
}

/// Walks down a hierarchy.
pub struct Walk<'a> {
    hierarchy: &'a Hierarchy,
    splats: &'a Splats,
    view: View,
    tau_px: f64,
    culling: Culling,
}

impl<'a> Walk<'a> {
    /// Over a hierarchy of these splats, for an image of this size, to nodes of `tau_px` at most.
    pub fn new(
        (hierarchy, splats): (&'a Hierarchy, &'a Splats),
        (camera, size_px): (&Camera, [u32; 2]),
        tau_px: f64,
        culling: Culling,
    ) -> Self {
        Self { hierarchy, splats, view: View::pinhole(camera, size_px), tau_px, culling }
    }

    /// All that is drawn, as [`Hierarchy::select`] numbers it.
    pub fn selection(&self) -> Selection {
        let mut selection = Selection::default();
        if self.hierarchy.tree.is_empty() {
            let splats = 0..self.splats.len() as u32;
            selection.leaves = splats.filter(|&place| !self.hides_leaf(place)).collect();
        } else {
            self.visit(0, &mut selection);
        }
        selection.nodes.sort_unstable();
        selection.leaves.sort_unstable();
        selection
    }

    /// No path is longer than 2.5 log2 of the number of splats, which the stack holds.
    fn visit(&self, node: u32, selection: &mut Selection) {
        if self.hides_node(node) {
            return;
        }
        if self.size_px(&self.hierarchy.bounds[node as usize]) <= self.tau_px {
            selection.nodes.push(node);
            return;
        }
        let nodes = &self.hierarchy.tree;
        let node = &nodes[node as usize];
        node.children.clone().for_each(|child| self.visit(child, selection));
        let leaves = node.leaf_runs(nodes).flatten();
        selection.leaves.extend(leaves.filter(|&place| !self.hides_leaf(place)));
    }

    /// The spread of the surface below it, if that were seen at right angles at the nearest point of its ball.
    fn size_px(&self, bounds: &Bounds) -> f64 {
        let (center, radius) = self.ball(bounds);
        let nearest = (center.length() - radius).max(self.view.near);
        self.view.focal_px * f64::from(bounds.error.spread) / nearest
    }

    /// In view space.
    fn ball(&self, bounds: &Bounds) -> (DVec3, f64) {
        let center = self.hierarchy.origin + bounds.error.center.as_dvec3();
        (self.view.from_world.point(center), f64::from(bounds.error.radius))
    }

    /// Whether nothing below a node is drawn, whatever its size.
    pub fn hides_node(&self, node: u32) -> bool {
        let bounds = &self.hierarchy.bounds[node as usize];
        let (center, radius) = self.ball(bounds);
        let axis = self.view.from_world.rotation * bounds.cone.axis.as_dvec3().normalize();
        let half_angle = f64::from(bounds.cone.cos).acos();
        let turn = axis.angle_between(center);
        // The least of `n · x` over the cone's normals n and the ball's points x.
        let faces_away = || {
            let least = center.length() * (turn + half_angle).min(std::f64::consts::PI).cos();
            least > radius
        };
        (self.culling.outside && self.is_outside(center, radius)) || (self.culling.back_faces && faces_away())
    }

    /// Whether a splat, by its place along the tree, is not drawn.
    pub fn hides_leaf(&self, place: u32) -> bool {
        let i = self.hierarchy.order[place as usize] as usize;
        let center = self.view.from_world.point(self.splats.positions[i]);
        let (s, t) = tangents(&self.splats.shapes, i);
        let normal = self.view.from_world.rotation * s.cross(t);
        (self.culling.outside && self.is_outside(center, self.splats.major_radius(i)))
            || (self.culling.back_faces && normal.dot(center) > 0.0)
    }

    /// Whether a ball lies wholly beyond one of the planes of the view.
    fn is_outside(&self, center: DVec3, radius: f64) -> bool {
        let view = &self.view;
        let beyond = |inward: DVec3| inward.normalize().dot(center) < -radius;
        // Where the image begins and ends, in the plane z = 1.
        let [left, top] = view.middle_px.map(|at| -at / view.focal_px);
        let [right, bottom] =
            [0, 1].map(|i| (f64::from(view.size_px[i]) - view.middle_px[i]) / view.focal_px);
        beyond(DVec3::new(1.0, 0.0, -left))
            || beyond(DVec3::new(-1.0, 0.0, right))
            || beyond(DVec3::new(0.0, 1.0, -top))
            || beyond(DVec3::new(0.0, -1.0, bottom))
            || center.z + radius < view.near
    }
}
