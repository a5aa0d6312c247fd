//! Which nodes are drawn: as many pixels large as asked for at most (Pajarola et al. 2003, section 5.1), decided by each for itself.
//!
//! The paper's size is the area of the projected ellipse. Here it is the *spread* of the surface below, the root of the mean squared distance from
//! centers below from the node's: what merging displaces, whatever ellipse holds it; up to twice that where it differs in what is
//! seen of it (`contrast`). A picture whose nodes spread by no more than the filter does loses little by them.
//!
//! The paper walks down from the root. Here a node or splat is drawn if and only if its own size on the screen is at most τ and its
//! parent's is above τ. **Exactly one on each path from the root to a splat is drawn, for every eye:** sizes never grow along the path.
//! In perspective the size is `focal · spread / max(d − r, near)`, where d is the distance from the eye to the middle of the node's ball and r
//! its radius. The ball lies within the parent's, so D − R ≤ d − r (the parent's; the nearest point of a larger ball is no farther),
//! hence also of both with `near`; and the parent's spread is no smaller. In parallel projection it is the spread alone. The path begins above
//! the root with a size of infinity, which is above τ, and ends at a splat with size 0, which is not. So there is one step where sizes
//! pass τ, and what is below it is drawn. For τ = 0 all splats are drawn, and nothing else, for every node's size is above 0.
//!
//! Where rounding breaks the order, sizes still pass τ on every path: something might be drawn twice, nothing left out. The room within
//! bounds (`bounds`) excludes that for f32, too.

use glam::DVec3;

use super::{ErrorBall, Hierarchy, Levels};
use crate::scene::Camera;

/// How lengths become sizes on the screen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Projection {
    /// As a pinhole camera sees it.
    Perspective {
        /// From [`Hierarchy::origin`].
        eye: DVec3,
        /// Pixels per unit of the image plane, above 0.
        focal_px: f64,
        /// No size is larger than at this distance, above 0.
        near: f64,
    },
    /// Along one direction, whichever.
    Parallel {
        /// Pixels per world unit, above 0.
        px_per_unit: f64,
    },
}

/// What is drawn.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Selection {
    /// Nodes, rising.
    pub nodes: Vec<u32>,
    /// Splats by their place in [`Hierarchy::order`], rising.
    pub leaves: Vec<u32>,
}

impl Projection {
    /// That of a camera, for an image of this height.
    pub fn of_camera(camera: &Camera, height_px: u32, hierarchy: &Hierarchy) -> Self {
        if camera.is_orthographic() {
            return Self::Parallel { px_per_unit: camera.focal_px(height_px) };
        }
        Self::Perspective {
            eye: camera.eye - hierarchy.origin,
            focal_px: camera.focal_px(height_px),
            near: camera.near(),
        }
    }

    /// The size on the screen in pixels: how far what is below spreads, by its ball, in a picture in the middle of which it is, if it were seen at right
    /// angles. One pixel is as far as the low-pass filter itself spreads what it sees: its standard deviation is √½ along each axis.
    pub fn size_px(&self, ball: &ErrorBall) -> f64 {
        let spread = f64::from(ball.spread);
        match *self {
            Self::Perspective { eye, focal_px, near } => {
                let distance = eye.distance(ball.center.as_dvec3()) - f64::from(ball.radius);
                focal_px * spread / distance.max(near)
            }
            Self::Parallel { px_per_unit } => px_per_unit * spread,
        }
    }

    /// Where nodes blend with those below them from `blended_size` times `tau_px` on, above 1: the part of the weight on its path that what
    /// has these levels has, 0 where it is not drawn. It is what its parent is larger than it, of sizes that are 0 up to τ and 1 where
    /// nothing so large is drawn: on a path these differences add up to 1.
    pub fn weight(&self, levels: &Levels, tau_px: f64, blended_size: f64) -> f64 {
        let part = |ball| ((self.size_px(ball) / tau_px - 1.0) / (blended_size - 1.0)).clamp(0.0, 1.0);
        part(&levels.parent) - part(&levels.own)
    }

    /// Whether what has these levels is drawn for a largest size of `tau_px`, at least 0.
    pub fn draws(&self, levels: &Levels, tau_px: f64) -> bool {
        self.size_px(&levels.own) <= tau_px && self.size_px(&levels.parent) > tau_px
    }
}

impl Hierarchy {
    /// All that is drawn for a largest size of `tau_px`, if nothing is outside the view.
    pub fn select(&self, projection: &Projection, tau_px: f64) -> Selection {
        let nodes = (0..self.tree.len()).filter(|&i| projection.draws(&self.node_levels(i), tau_px));
        let leaves = (0..self.order.len()).filter(|&i| projection.draws(&self.leaf_levels(i), tau_px));
        Selection { nodes: nodes.map(|i| i as u32).collect(), leaves: leaves.map(|i| i as u32).collect() }
    }
}
