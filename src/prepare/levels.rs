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
    geometry::hierarchy::{ErrorBall, Hierarchy, Levels, Node},
    progress::Progress,
    scene::{Colors, Object, Shapes, Splats},
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
    hierarchy: Hierarchy,
    space: LevelSpace,
    /// The object's own splats, the largest parents first.
    pub leaves: Object,
    /// Their places along the tree.
    places: Vec<u32>,
    /// The nodes, the largest first.
    pub nodes: Object,
    /// Their numbers.
    numbers: Vec<u32>,
    /// What each node weighs: the area of the disks below over its own.
    weights: Vec<f32>,
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
    pub fn new(object: &Object, progress: &dyn Progress) -> Result<Option<Self>> {
        let hierarchy = Hierarchy::build(&object.splats, progress)?;
        let Some(root) = hierarchy.bounds.first() else { return Ok(None) };
        let unit = f64::from(root.error.radius).log2().ceil().clamp(-100.0, 100.0).exp2();
        let space = LevelSpace { origin: hierarchy.origin, scale: unit.recip() };
        let spread = |node: u32| {
            hierarchy.bounds.get(node as usize).map_or(f32::INFINITY, |bounds| bounds.error.spread)
        };
        let places = by_spread(hierarchy.order.len(), |place| spread(hierarchy.leaf_parents[place]));
        let numbers = by_spread(hierarchy.tree.len(), |node| spread(node as u32));
        let weights = weights(&hierarchy, &object.splats);
        let of = |splats: Splats| Object { name: object.name.clone(), splats, closed: object.closed };
        Ok(Some(Self {
            space,
            leaves: of(picked(
                &object.splats,
                places.iter().map(|place| hierarchy.order[*place as usize] as usize),
            )),
            nodes: of(picked(&hierarchy.nodes, numbers.iter().map(|number| *number as usize))),
            weights,
            places,
            numbers,
            hierarchy,
        }))
    }

    /// What a chunk of it holds.
    pub fn chunk(&self, nodes: bool) -> ChunkLevels {
        ChunkLevels { space: self.space, nodes }
    }

    /// What splat `i` of the leaves or the nodes weighs.
    pub fn weight(&self, levels: ChunkLevels, i: usize) -> f64 {
        if levels.nodes { self.weights[self.numbers[i] as usize].into() } else { 1.0 }
    }

    /// The balls of splat `i` of the leaves or the nodes, as a device has them.
    pub fn push(&self, levels: ChunkLevels, i: usize, floats: &mut Vec<f32>) {
        let Levels { own, parent } = match levels.nodes {
            true => self.hierarchy.node_levels(self.numbers[i] as usize),
            false => self.hierarchy.leaf_levels(self.places[i] as usize),
        };
        let scale = self.space.scale as f32;
        let mut push = |ball: ErrorBall| {
            floats.extend((scale * ball.center).to_array());
            floats.extend([scale * ball.radius, scale * ball.spread]);
        };
        push(parent);
        if levels.nodes {
            push(own);
        }
    }
}

/// Where nodes are drawn for splats, weights add up to what those would leave there: each node weighs by the area of the disks below it.
fn weights(hierarchy: &Hierarchy, splats: &Splats) -> Vec<f32> {
    let mut area = 0.0;
    let mut areas_before = vec![area];
    areas_before.extend(hierarchy.order.iter().map(|i| {
        area += area_of(splats, *i as usize);
        area
    }));
    let below =
        |node: &Node| areas_before[node.splats.end as usize] - areas_before[node.splats.start as usize];
    let nodes = (0..).zip(&hierarchy.tree);
    nodes.map(|(i, node)| (below(node) / area_of(&hierarchy.nodes, i)) as f32).collect()
}

/// Over π.
fn area_of(splats: &Splats, i: usize) -> f64 {
    match &splats.shapes {
        Shapes::Disks { radii, .. } => f64::from(radii[i]).powi(2),
        Shapes::Ellipses { s, t } => s[i].as_dvec3().cross(t[i].as_dvec3()).length(),
    }
}

/// Steps of spread by which splats are told apart: half of one and a half.
const STEPS_AN_OCTAVE: f32 = 2.0;

/// Numbers below `count` from the largest spread to the least, in steps; in each step in their order. What a camera sees at one distance is
/// then of few blocks, of which the others are known to have nothing to draw.
fn by_spread(count: usize, spread: impl Fn(usize) -> f32) -> Vec<u32> {
    let step = |i: &u32| (STEPS_AN_OCTAVE * spread(*i as usize).log2()).clamp(-1e3, 1e3).floor() as i32;
    let mut numbers: Vec<u32> = (0..count as u32).collect();
    numbers.sort_by_cached_key(|i| std::cmp::Reverse(step(i)));
    numbers
}

/// Some splats of these.
fn picked(splats: &Splats, which: impl Iterator<Item = usize> + Clone) -> Splats {
    fn of<T: Copy>(all: &[T], which: impl Iterator<Item = usize>) -> Vec<T> {
        which.map(|i| all[i]).collect()
    }
    Splats {
        positions: of(&splats.positions, which.clone()),
        shapes: match &splats.shapes {
            Shapes::Disks { normals, radii } => {
                Shapes::Disks { normals: of(normals, which.clone()), radii: of(radii, which.clone()) }
            }
            Shapes::Ellipses { s, t } => {
                Shapes::Ellipses { s: of(s, which.clone()), t: of(t, which.clone()) }
            }
        },
        colors: match &splats.colors {
            Colors::Uniform(color) => Colors::Uniform(*color),
            Colors::Each(colors) => Colors::Each(of(colors, which)),
        },
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
