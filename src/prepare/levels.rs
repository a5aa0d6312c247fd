//! Levels of detail of an object: its own splats, and the nodes of their hierarchy (`geometry/hierarchy`), each with what tells a device
//! whether it is drawn (`level_words.rs`). Both go to the device by how far their parents spread, in steps, and within a step in the order of the tree, along which neighbors
//! in number are neighbors in space: so of many blocks nothing is drawn, or all.

use glam::DVec3;

use super::level_bounds::{BallBounds, LevelBounds};
use crate::{
    geometry::hierarchy::by_spread,
    scene::{ErrorBall, HybridLevels, LeveledObject, NodeBalls, Object, Opacity, Splats},
    shaders::config::BLOCK_SPLATS,
};

/// The space in which balls are told.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LevelSpace {
    /// In world space.
    pub origin: DVec3,
    /// Of world lengths: a power of two.
    pub scale: f64,
}

/// What a chunk with levels of detail holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ChunkLevels {
    /// Where balls are told.
    pub space: LevelSpace,
    /// What its splats are.
    pub part: LevelPart,
}

/// What splats of a chunk are in a hierarchy.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LevelPart {
    /// The object's own, which nothing takes the place of that is smaller.
    Own,
    /// Nodes, which stand for others.
    Nodes,
    /// Splats that polygons take the place of where their cells are large.
    OfCells,
}

impl LevelPart {
    /// Whether they are drawn in place of what is smaller: they have balls of their own.
    pub fn stands_for_others(self) -> bool {
        self != Self::Own
    }
}

/// What decides about the splats of a block.
#[derive(Clone, Copy, Debug)]
pub struct BlockLevels {
    /// Of all of them.
    pub bounds: LevelBounds,
    /// Of the splats' own spreads, from the least on, those at each `RANK`th place behind the first; infinite behind the last.
    pub least_own: [f32; RANKS],
    /// Of their parents', one for each splat, from the largest on, alike; 0 behind the last.
    pub largest_parents: [f32; RANKS],
}

/// Places between spreads of a block that are kept, and how many these are.
const RANK: usize = 16;
pub const RANKS: usize = BLOCK_SPLATS as usize / RANK - 1;

/// An object in levels.
pub(super) struct Leveled {
    /// The numbers of the leaves in the object as it came, where they are known.
    pub numbers: Option<Vec<u32>>,
    space: LevelSpace,
    balls: Vec<ErrorBall>,
    /// The object's own splats.
    pub leaves: Object,
    /// Their parents' balls.
    leaf_parents: Vec<u32>,
    /// Of a hybrid the balls of the cells that each leaf is drawn for.
    leaf_cells: Vec<Vec<u32>>,
    /// One over the overlap of each, where it is known.
    pub inverse_overlaps: Option<Vec<f32>>,
    /// The nodes.
    pub nodes: Object,
    /// Their balls and their parents'.
    node_balls: Vec<NodeBalls>,
    /// What each node weighs: the area of the disks below over its own.
    weights: Vec<f32>,
    /// Some of the object is transparent.
    pub transparent: bool,
    /// The sum of weights that the object leaves inside of its surface; 1 or more.
    pub overlap: f64,
}

impl LevelSpace {
    /// A ball in it.
    pub(super) fn ball(&self, ball: &ErrorBall) -> ErrorBall {
        let scale = self.scale as f32;
        ErrorBall { center: scale * ball.center, radius: scale * ball.radius, spread: scale * ball.spread }
    }
}

impl ChunkLevels {
    /// Bytes of a scene that a splat takes in levels of detail, beside its own: what finds its parent, of a node its balls, too.
    pub fn scene_bytes_each(&self) -> u64 {
        if self.part == LevelPart::Nodes { 56 } else { 8 }
    }
}

impl Leveled {
    /// What there is of an object in levels. `numbers`: of its own splats in the object as it came, where they are known.
    /// `hybrid`: whose splats these are.
    pub fn of(object: &LeveledObject, numbers: Option<&[u32]>, hybrid: Option<&HybridLevels>) -> Self {
        let spread = |ball: u32| object.balls[ball as usize].spread;
        let sorted = |count: usize, parent: &dyn Fn(usize) -> u32| -> Vec<usize> {
            let sorted = by_spread(count, |i| spread(parent(i)));
            sorted.into_iter().map(|(number, _)| number as usize).collect()
        };
        let leaves = sorted(object.leaves.len(), &|i| object.leaf_parents[i]);
        let nodes = sorted(object.nodes.len(), &|i| object.node_balls[i].parent);
        let of = |splats: Splats| Object { name: object.name.clone(), splats, closed: object.closed };
        Self {
            space: Self::space(object),
            balls: object.balls.clone(),
            leaf_parents: leaves.iter().map(|i| object.leaf_parents[*i]).collect(),
            leaf_cells: hybrid.map_or_else(Vec::new, |hybrid| {
                let balls = |i: &usize| {
                    hybrid.cells_of_leaf(*i).iter().map(|cell| hybrid.ball_of_cell(*cell)).collect()
                };
                leaves.iter().map(balls).collect()
            }),
            inverse_overlaps: object
                .inverse_overlaps
                .as_ref()
                .map(|inverse| leaves.iter().map(|i| inverse[*i]).collect()),
            numbers: numbers.map(|numbers| leaves.iter().map(|i| numbers[*i]).collect()),
            leaves: of(object.leaves.picked(leaves.into_iter())),
            node_balls: nodes.iter().map(|i| object.node_balls[*i]).collect(),
            weights: nodes.iter().map(|i| object.weights[*i]).collect(),
            nodes: of(object.nodes.picked(nodes.into_iter())),
            transparent: object.opacity == Opacity::Transparent,
            overlap: object.overlap,
        }
    }

    /// The space in which the balls of an object are told.
    pub fn space(object: &LeveledObject) -> LevelSpace {
        let unit = object.radius.log2().ceil().clamp(-100.0, 100.0).exp2();
        LevelSpace { origin: object.origin, scale: unit.recip() }
    }

    /// What a chunk of its nodes, or of its leaves, holds.
    pub fn chunk(&self, nodes: bool) -> ChunkLevels {
        let of_leaves = if self.leaf_cells.is_empty() { LevelPart::Own } else { LevelPart::OfCells };
        ChunkLevels { space: self.space, part: if nodes { LevelPart::Nodes } else { of_leaves } }
    }

    /// What splat `i` of the leaves or the nodes weighs.
    pub fn weight(&self, levels: ChunkLevels, i: usize) -> f64 {
        if levels.part == LevelPart::Nodes { self.weights[i].into() } else { 1.0 }
    }

    /// The number of the parent of splat `i` of the leaves or the nodes.
    pub fn parent(&self, levels: ChunkLevels, i: usize) -> &u32 {
        if levels.part == LevelPart::Nodes { &self.node_balls[i].parent } else { &self.leaf_parents[i] }
    }

    /// The numbers of the balls of splat `i` of the leaves or the nodes that are its own: one of them has to be small.
    pub fn own_balls(&self, levels: ChunkLevels, i: usize) -> &[u32] {
        match levels.part {
            LevelPart::Own => &[],
            LevelPart::Nodes => std::slice::from_ref(&self.node_balls[i].own),
            LevelPart::OfCells => &self.leaf_cells[i],
        }
    }

    /// The larger half axis of splat `i` of the leaves or the nodes, in the space of levels.
    pub fn half_axis(&self, levels: ChunkLevels, i: usize) -> f64 {
        let of = if levels.part == LevelPart::Nodes { &self.nodes } else { &self.leaves };
        of.splats.major_radius(i) * self.space.scale
    }

    /// The ball with this number, in the space of levels.
    pub fn ball(&self, number: u32) -> ErrorBall {
        self.space.ball(&self.balls[number as usize])
    }
}

impl BlockLevels {
    /// How many splats at most have own spreads up to the one length and parents' spreads above the other. `has_own`: they have own ones.
    pub fn most_between(&self, has_own: bool, own: f64, parent: f64, count: u32) -> u32 {
        let up_to = |place: Option<usize>| place.map_or(count, |place| ((place + 1) * RANK) as u32);
        let of_own = self.least_own.iter().position(|spread| has_own && f64::from(*spread) > own);
        let of_parents = self.largest_parents.iter().position(|spread| f64::from(*spread) <= parent);
        up_to(of_own).min(up_to(of_parents)).min(count)
    }

    /// Around all balls of some splats, and their parents', each with how many of these splats are its children.
    pub(crate) fn around(own: &[ErrorBall], parents: &[(ErrorBall, u32)], longest: f64) -> Self {
        let mut least: Vec<f32> = own.iter().map(|ball| ball.spread).collect();
        least.sort_unstable_by(f32::total_cmp);
        let each = |(ball, children): &(ErrorBall, u32)| std::iter::repeat_n(ball.spread, *children as usize);
        let mut largest: Vec<f32> = parents.iter().flat_map(each).collect();
        largest.sort_unstable_by(|a, b| b.total_cmp(a));
        let at =
            |spreads: &[f32], rank: usize, behind| spreads.get((rank + 1) * RANK).copied().unwrap_or(behind);
        let parents: Vec<ErrorBall> = parents.iter().map(|(ball, _)| *ball).collect();
        // The root's parent is nowhere.
        let balls = own.iter().chain(&parents).filter(|ball| ball.spread.is_finite());
        let [lo, hi] = balls.fold([DVec3::INFINITY, DVec3::NEG_INFINITY], |[lo, hi], ball| {
            let place = ball.center.as_dvec3();
            [lo.min(place), hi.max(place)]
        });
        let center = if lo.is_finite() { 0.5 * (lo + hi) } else { DVec3::ZERO };
        let of = |balls: &[ErrorBall]| BallBounds::of(center, balls.iter());
        Self {
            bounds: LevelBounds { center, own: of(own), parent: of(&parents), longest },
            least_own: std::array::from_fn(|rank| at(&least, rank, f32::INFINITY)),
            largest_parents: std::array::from_fn(|rank| at(&largest, rank, 0.0)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        geometry::{
            Overlaps,
            hierarchy::{Hierarchy, tests::models::random_ellipses},
        },
        scene::Object,
    };

    /// Found once of all splats, they stay with them: as found of the sorted ones, but for the mean, which is looked for at other places.
    #[test]
    fn overlaps_are_those_of_the_splats_as_they_lie() {
        let object = |splats| Object { name: String::new(), splats, closed: false };
        let splats = random_ellipses(2000, 1.0, 5);
        let whole = Hierarchy::build(&splats, &()).unwrap().leveled(object(splats), None);
        let leveled = Leveled::of(&whole, None, None);
        let (known, found) =
            (leveled.inverse_overlaps.unwrap(), Overlaps::of(&leveled.leaves.splats).inverse);
        let ratio = f64::from(known[0] / found[0]);
        assert!(known.iter().any(|overlap| (overlap / known[0] - 1.0).abs() > 0.2));
        for (i, (known, found)) in known.iter().zip(&found).enumerate() {
            let own = f64::from(known / found);
            assert!((own / ratio - 1.0).abs() < 1e-5, "splat {i}: {own}, the first {ratio}");
        }
    }
}
