//! Cells and the nodes above them put together, as a device draws them.

use std::ops::Range;

use glam::DVec3;

use super::{Part, sampled::Sampled};
use crate::{
    geometry::{
        hierarchy::{NO_NODE, TopNode},
        overlaps::Overlaps,
    },
    scene::{
        Colors, ErrorBall, HybridLevels, LeveledObject, NodeBalls, Opacity, PolygonCell, Shapes, Splats,
    },
};

/// Cells, and the nodes above.
pub(super) struct Joined<'a> {
    pub sampled: &'a Sampled,
    pub overlaps: &'a Overlaps,
    pub parts: &'a [Part],
    pub part_parents: Vec<Option<usize>>,
    pub top: Vec<TopNode>,
    pub origin: DVec3,
}

impl Joined<'_> {
    /// All of it, as of the scene's first mesh.
    pub fn levels(&self, name: String, cells: &[Range<usize>], closed: bool) -> HybridLevels {
        let Self { sampled, overlaps, parts, part_parents, top, origin } = self;
        // Balls: of the nodes above; of each cell its own, then its nodes'.
        let mut balls: Vec<ErrorBall> = top.iter().map(|node| node.error).collect();
        let mut cell_balls = Vec::new();
        for part in *parts {
            cell_balls.push(balls.len() as u32);
            balls.push(part.ball);
            balls
                .extend(part.hierarchy.bounds[..part.hierarchy.tree.len()].iter().map(|bounds| bounds.error));
        }
        let above = balls.len() as u32;
        balls.push(ErrorBall::ABOVE_ROOT);
        let parent_ball = |parent: Option<usize>| parent.map_or(above, |parent| parent as u32);

        let mut node_balls: Vec<NodeBalls> =
            (0..).zip(top).map(|(own, node)| NodeBalls { own, parent: parent_ball(node.parent) }).collect();
        let (mut leaf_parents, mut numbers) = (Vec::new(), Vec::new());
        for ((part, first), parent) in parts.iter().zip(&cell_balls).zip(part_parents) {
            let ball_of = |node: u32| if node == NO_NODE { parent_ball(*parent) } else { first + 1 + node };
            let nodes = (0..).zip(&part.hierarchy.tree);
            node_balls.extend(
                nodes.map(|(own, node)| NodeBalls { own: first + 1 + own, parent: ball_of(node.parent) }),
            );
            leaf_parents.extend(part.hierarchy.leaf_parents.iter().map(|parent| ball_of(*parent)));
            numbers.extend(part.hierarchy.order.iter().map(|i| part.numbers[*i as usize]));
        }
        let leaves = || numbers.iter().map(|number| *number as usize);
        let mut leaf_cells = Vec::new();
        let leaf_cell_ends = leaves().map(|number| {
            leaf_cells.extend(&sampled.cells[number]);
            leaf_cells.len() as u32
        });
        let leaf_cell_ends = leaf_cell_ends.collect();
        let (nodes, weights) = self.nodes();
        let cells = cells.iter().zip(&cell_balls).zip(&sampled.neighbors);
        let cells = cells.map(|((cell, ball), neighbors)| PolygonCell {
            triangles: cell.start as u32..cell.end as u32,
            ball: *ball,
            neighbors: neighbors.clone(),
        });
        let splats = LeveledObject {
            name,
            closed,
            opacity: Opacity::Opaque,
            overlap: overlaps.mean,
            origin: *origin,
            radius: balls[0].radius.into(),
            leaves: sampled.splats.picked(leaves()),
            leaf_parents,
            inverse_overlaps: Some(leaves().map(|number| overlaps.inverse[number]).collect()),
            nodes,
            node_balls,
            weights,
            balls,
        };
        HybridLevels { mesh: 0, splats, leaf_cell_ends, leaf_cells, cells: cells.collect() }
    }

    /// The splats of all nodes, and what each weighs.
    fn nodes(&self) -> (Splats, Vec<f32>) {
        let mut below = vec![0.0; self.top.len()];
        for (part, parent) in self.parts.iter().zip(&self.part_parents) {
            parent.iter().for_each(|parent| below[*parent] += part.area);
        }
        for (number, node) in self.top.iter().enumerate().rev() {
            node.parent.iter().for_each(|parent| below[*parent] += below[number]);
        }
        let (mut positions, mut s, mut t) = (Vec::new(), Vec::new(), Vec::new());
        let (mut colors, mut weights) = (Vec::new(), Vec::new());
        for (node, below) in self.top.iter().zip(below) {
            let [along_s, along_t] = node.axes;
            positions.push(node.center);
            s.push(along_s);
            t.push(along_t);
            colors.push(node.color);
            weights.push((below / along_s.as_dvec3().cross(along_t.as_dvec3()).length()) as f32);
        }
        for part in self.parts {
            let nodes = part.hierarchy.drawn_nodes(0..part.hierarchy.tree.len());
            let Shapes::Ellipses { s: of_s, t: of_t } = &nodes.shapes else { continue };
            positions.extend(&nodes.positions);
            s.extend(of_s);
            t.extend(of_t);
            colors.extend((0..of_s.len()).map(|i| nodes.color(i)));
            weights.extend(&part.weights);
        }
        let colors = match self.sampled.splats.colors {
            Colors::Uniform(color) => Colors::Uniform(color),
            Colors::Each(_) => Colors::Each(colors),
        };
        (Splats::new(positions, Shapes::Ellipses { s, t }, colors), weights)
    }
}
