//! What is drawn of a mesh in levels of detail (Guennebaud, Barthe, Paulin 2006, section 5.2): at a leaf of the octree that is under-sampled its polygons, else its splats; of the
//! list of transitions those splats that share a leaf drawn as splats.
//!
//! A cell is under-sampled where its splats would spread by more than τ on the screen. Where a coarser node stands for a splat, that is drawn in its place
//! (Pajarola, Sainz, Guidotti 2003, section 5.1).

use super::view::View;
use crate::scene::{Camera, ErrorBall, HybridLevels, NodeBalls};

/// The numbers of what is drawn, rising.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct HybridChoice {
    /// Of the nodes.
    pub nodes: Vec<u32>,
    /// Of the leaves.
    pub leaves: Vec<u32>,
    /// Of the cells whose polygons are drawn: those that are under-sampled, and below splats those that meet such a cell.
    pub cells: Vec<u32>,
}

/// What is drawn for a largest size of `tau_px`, in an image of this size, if nothing is outside of the view.
pub fn hybrid_choice(
    levels: &HybridLevels,
    (camera, size_px): (&Camera, [u32; 2]),
    tau_px: f64,
) -> HybridChoice {
    let splats = &levels.splats;
    let view = View::pinhole(camera, size_px);
    let size_px = |ErrorBall { center, radius, spread }: &ErrorBall| {
        let center = view.from_world.point(splats.origin + center.as_dvec3());
        view.focal_px * f64::from(*spread) / (center.length() - f64::from(*radius)).max(view.near)
    };
    let is_small = |ball: u32| size_px(&splats.balls[ball as usize]) <= tau_px;
    let is_under_sampled = |cell: &u32| !is_small(levels.cells[*cell as usize].ball);
    let of_leaf = |leaf: &u32| {
        let cells = levels.cells_of_leaf(*leaf as usize);
        !cells.iter().all(is_under_sampled) && !is_small(splats.leaf_parents[*leaf as usize])
    };
    let of_node = |node: &u32| {
        let NodeBalls { own, parent } = splats.node_balls[*node as usize];
        is_small(own) && !is_small(parent)
    };
    let of_cell = |cell: &u32| {
        is_under_sampled(cell) || levels.cells[*cell as usize].neighbors.iter().any(is_under_sampled)
    };
    HybridChoice {
        nodes: (0..splats.nodes.len() as u32).filter(of_node).collect(),
        leaves: (0..splats.leaves.len() as u32).filter(of_leaf).collect(),
        cells: (0..levels.cells.len() as u32).filter(of_cell).collect(),
    }
}
