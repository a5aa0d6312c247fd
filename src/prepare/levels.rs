//! Levels of detail of an object: its own splats, and the nodes of their hierarchy (`geometry/hierarchy`), each with what tells a device
//! whether it is drawn. Both go to the device by how far what decides about them spreads, in steps, and within a step in the order of the tree, along which neighbors
//! in number are neighbors in space.
//!
//! Beside a splat lies the ball of its parent, beside a node's its own, too: center, radius, spread, 5 floats each, from the hierarchy's own origin and
//! scaled by a power of two. These are the same bits wherever they lie, so that of a parent and its child exactly one is drawn, whatever chunks
//! they are in.

use glam::DVec3;

use crate::{
    error::Result,
    geometry::hierarchy::{Hierarchy, by_spread},
    progress::Progress,
    scene::{ErrorBall, LeveledObject, NodeBalls, Object, Opacity, Splats},
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
    /// It holds nodes, which stand for others; else the object's own splats.
    pub nodes: bool,
}

/// Floats of a ball.
pub(super) const BALL_FLOATS: usize = 5;

/// The bounds of what decides about the splats of a block, in the space of levels. Distances are from `center`.
#[derive(Clone, Copy, Debug)]
pub struct BlockLevels {
    /// About in the middle of their centers.
    pub center: DVec3,
    /// Of the splats' own balls; all 0 where they are the object's.
    pub own: BallBounds,
    /// Of their parents'.
    pub parent: BallBounds,
    /// No splat's larger half axis is more times its own ball's spread; 0 where they are the object's.
    pub longest: f64,
}

/// Bounds of balls around a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BallBounds {
    /// The largest distance of a ball's farthest point.
    pub reach: f64,
    /// The largest distance of a ball's center, less its radius; may be below 0.
    pub far: f64,
    /// The least and the largest spread.
    pub spreads: [f64; 2],
}

/// An object in levels.
pub(super) struct Leveled {
    space: LevelSpace,
    balls: Vec<ErrorBall>,
    /// The object's own splats, the largest parents first.
    pub leaves: Object,
    /// Their parents' balls.
    leaf_parents: Vec<u32>,
    /// The nodes, the largest first.
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

impl ChunkLevels {
    /// Bytes of a splat's balls.
    pub fn bytes_each(&self) -> u64 {
        4 * (self.floats_each() as u64)
    }

    fn floats_each(&self) -> usize {
        if self.nodes { 2 * BALL_FLOATS } else { BALL_FLOATS }
    }
}

impl Leveled {
    /// Puts an object without defects into levels; `None` of one that has less than two splats.
    ///
    /// # Errors
    /// As [`Hierarchy::build`].
    pub fn new(object: Object, progress: &dyn Progress) -> Result<Option<Self>> {
        let hierarchy = Hierarchy::build(&object.splats, progress)?;
        Ok((!hierarchy.tree.is_empty()).then(|| Self::of(&hierarchy.leveled(object))))
    }

    /// What there is of an object in levels.
    pub fn of(object: &LeveledObject) -> Self {
        let unit = object.radius.log2().ceil().clamp(-100.0, 100.0).exp2();
        let spread = |ball: u32| object.balls[ball as usize].spread;
        let numbers = |sorted: Vec<(u32, i32)>| -> Vec<usize> {
            sorted.into_iter().map(|(number, _)| number as usize).collect()
        };
        let leaves = numbers(by_spread(object.leaves.len(), |i| spread(object.leaf_parents[i])));
        let nodes = numbers(by_spread(object.nodes.len(), |i| spread(object.node_balls[i].own)));
        let of = |splats: Splats| Object { name: object.name.clone(), splats, closed: object.closed };
        Self {
            space: LevelSpace { origin: object.origin, scale: unit.recip() },
            balls: object.balls.clone(),
            leaf_parents: leaves.iter().map(|i| object.leaf_parents[*i]).collect(),
            leaves: of(object.leaves.picked(leaves.into_iter())),
            node_balls: nodes.iter().map(|i| object.node_balls[*i]).collect(),
            weights: nodes.iter().map(|i| object.weights[*i]).collect(),
            nodes: of(object.nodes.picked(nodes.into_iter())),
            transparent: object.opacity == Opacity::Transparent,
            overlap: object.overlap,
        }
    }

    /// What a chunk of it holds.
    pub fn chunk(&self, nodes: bool) -> ChunkLevels {
        ChunkLevels { space: self.space, nodes }
    }

    /// What splat `i` of the leaves or the nodes weighs.
    pub fn weight(&self, levels: ChunkLevels, i: usize) -> f64 {
        if levels.nodes { self.weights[i].into() } else { 1.0 }
    }

    /// The balls of splat `i` of the leaves or the nodes, as a device has them.
    pub fn push(&self, levels: ChunkLevels, i: usize, floats: &mut Vec<f32>) {
        let scale = self.space.scale as f32;
        let mut push = |ball: u32| {
            let ball = &self.balls[ball as usize];
            floats.extend((scale * ball.center).to_array());
            floats.extend([scale * ball.radius, scale * ball.spread]);
        };
        match levels.nodes {
            true => {
                push(self.node_balls[i].parent);
                push(self.node_balls[i].own);
            }
            false => push(self.leaf_parents[i]),
        }
    }
}

impl BlockLevels {
    /// The bounds of a block's balls, as a device has them. `half_axes`: the larger ones of its splats, world space.
    pub(super) fn around(levels: ChunkLevels, floats: &[f32], half_axes: impl Iterator<Item = f64>) -> Self {
        let each = levels.floats_each();
        let ball = |floats: &[f32]| {
            let [x, y, z, radius, spread] = [0, 1, 2, 3, 4].map(|i| f64::from(floats[i]));
            (DVec3::new(x, y, z), radius, spread)
        };
        let parents = || floats.chunks_exact(each).map(|floats| ball(&floats[..BALL_FLOATS]));
        let own =
            || floats.chunks_exact(each).filter(|_| levels.nodes).map(|floats| ball(&floats[BALL_FLOATS..]));
        // The root's parent is nowhere.
        let places = || own().chain(parents()).filter(|(_, _, spread)| spread.is_finite()).map(|ball| ball.0);
        let [lo, hi] = places()
            .fold([DVec3::INFINITY, DVec3::NEG_INFINITY], |[lo, hi], place| [lo.min(place), hi.max(place)]);
        let center = if lo.is_finite() { 0.5 * (lo + hi) } else { DVec3::ZERO };
        let ratios =
            own().zip(half_axes).map(|((.., spread), half_axis)| half_axis * levels.space.scale / spread);
        let longest = ratios.fold(0.0, f64::max);
        Self {
            center,
            own: BallBounds::of(center, own()),
            parent: BallBounds::of(center, parents()),
            longest,
        }
    }
}

impl BallBounds {
    fn of(center: DVec3, balls: impl Iterator<Item = (DVec3, f64, f64)>) -> Self {
        let none = Self { reach: 0.0, far: f64::NEG_INFINITY, spreads: [f64::INFINITY, 0.0] };
        let bounds = balls.fold(none, |bounds, (place, radius, spread)| {
            let distance = center.distance(place);
            let [least, most] = bounds.spreads;
            Self {
                reach: bounds.reach.max(distance + radius),
                far: bounds.far.max(distance - radius),
                spreads: [least.min(spread), most.max(spread)],
            }
        });
        // Of none: as if of one that is nothing.
        if bounds.far == f64::NEG_INFINITY {
            Self { reach: 0.0, far: 0.0, spreads: [0.0; 2] }
        } else {
            bounds
        }
    }
}
