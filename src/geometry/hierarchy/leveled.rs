//! A hierarchy as what a device draws: splats that decide alone.

use super::{Hierarchy, Node, drawn_parts};
use crate::{
    geometry::overlaps::{Overlaps, area_of},
    scene::{ErrorBall, LeveledObject, NodeBalls, Object, Splats},
};

/// Steps of spread by which splats are told apart: half of one and a half.
const STEPS_AN_OCTAVE: f32 = 2.0;

/// The step of spread that a splat is in.
pub(super) fn step(spread: f32) -> i32 {
    (STEPS_AN_OCTAVE * spread.log2()).clamp(-1e3, 1e3).floor() as i32
}

/// Numbers below `count` from the largest spread to the least, in steps; in each step in their order. What a camera sees at one distance is
/// then of few blocks, of which the others are known to have nothing to draw. Gives each with its step.
pub fn by_spread(count: usize, spread: impl Fn(usize) -> f32) -> Vec<(u32, i32)> {
    let mut numbers: Vec<(u32, i32)> = (0..count).map(|i| (i as u32, step(spread(i)))).collect();
    numbers.sort_by_key(|(_, step)| std::cmp::Reverse(*step));
    numbers
}

impl Hierarchy {
    /// What a frame may draw, of an object from whose splats this was built, without defects. The balls of nodes are as they are numbered; one
    /// more is that above the root. `left`: what clips leave of its splats, where there are any.
    pub fn leveled(self, object: Object, left: Option<&Splats>) -> LeveledObject {
        let Object { name, splats, closed } = object;
        let above = self.tree.len() as u32;
        let mut balls: Vec<ErrorBall> = self.bounds.iter().map(|bounds| bounds.error).collect();
        balls.push(ErrorBall::ABOVE_ROOT);
        let overlaps = Overlaps::of(&splats);
        let weights = self.weights(left.unwrap_or(&splats), (&overlaps, overlaps.mean));
        let own = (0..).zip(&self.tree);
        LeveledObject {
            name,
            closed,
            opacity: splats.colors.opacity(),
            overlap: overlaps.mean,
            origin: self.origin,
            radius: self.bounds.first().map_or(0.0, |root| root.error.radius.into()),
            node_balls: own.map(|(own, node)| NodeBalls { own, parent: node.parent.min(above) }).collect(),
            leaves: splats.picked(self.order.iter().map(|i| *i as usize)),
            leaf_parents: self.leaf_parents.iter().map(|parent| (*parent).min(above)).collect(),
            inverse_overlaps: Some(self.order.iter().map(|i| overlaps.inverse[*i as usize]).collect()),
            balls,
            nodes: drawn_parts(self.nodes, self.drawn.into_iter()),
            weights,
        }
    }

    /// Where nodes are drawn for splats, weights add up to what those would leave there: each node weighs by the area of the disks below
    /// it, each over its overlap, times `overlap`, over the area that is drawn of it. `splats`: those from which this was built, with their overlaps.
    pub fn weights(&self, splats: &Splats, (overlaps, overlap): (&Overlaps, f64)) -> Vec<f32> {
        let mut area = 0.0;
        let mut areas_before = vec![area];
        areas_before.extend(self.order.iter().map(|i| {
            area += area_of(splats, *i as usize) * overlap * f64::from(overlaps.inverse[*i as usize]);
            area
        }));
        let below =
            |node: &Node| areas_before[node.splats.end as usize] - areas_before[node.splats.start as usize];
        let drawn = |i: usize| {
            let [of_s, of_t] = self.drawn[i].map(f64::from);
            of_s * of_t * area_of(&self.nodes, i)
        };
        let nodes = (0..).zip(&self.tree);
        nodes.map(|(i, node)| (below(node) / drawn(i)) as f32).collect()
    }
}
