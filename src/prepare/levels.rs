//! Levels of detail of an object: its own splats, and the nodes of their hierarchy (`geometry/hierarchy`), each with what tells a device
//! whether it is drawn. Both go to the device in the order of the tree, along which neighbors in number are neighbors in space and of one level.
//!
//! Beside a splat lies the ball of its parent, beside a node's its own, too: center, radius, extent, 5 floats each, from the hierarchy's own origin and
//! scaled by a power of two. These are the same bits wherever they lie, so that of a parent and its child exactly one is drawn, whatever chunks
//! they are in.

use glam::DVec3;

use crate::{
    error::Result,
    geometry::hierarchy::{ErrorBall, Hierarchy, Levels},
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
}

/// Bounds of balls around a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BallBounds {
    /// The largest distance of a ball's farthest point.
    pub reach: f64,
    /// The largest distance of a ball's center, less its radius; may be below 0.
    pub far: f64,
    /// The least and the largest extent.
    pub extents: [f64; 2],
}

/// An object in levels.
pub(super) struct Leveled {
    hierarchy: Hierarchy,
    pub space: LevelSpace,
    /// The object's own splats, in the order of the tree.
    pub leaves: Object,
    /// The nodes.
    pub nodes: Object,
    /// The nodes of one level, the one that has most.
    pub largest_level: Splats,
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
        let leaves = picked(&object.splats, hierarchy.order.iter().map(|i| *i as usize));
        let level = hierarchy.levels.iter().max_by_key(|level| level.len()).cloned().unwrap_or_default();
        let largest_level = picked(&hierarchy.nodes, level);
        let space = LevelSpace { origin: hierarchy.origin, scale: unit.recip() };
        let of = |splats: Splats| Object { name: object.name.clone(), splats, closed: object.closed };
        let nodes = of(hierarchy.nodes.clone());
        Ok(Some(Self { space, leaves: of(leaves), nodes, largest_level, hierarchy }))
    }

    /// The balls of splat `i` of the leaves or the nodes, as a device has them.
    pub fn push(&self, levels: ChunkLevels, i: usize, floats: &mut Vec<f32>) {
        let Levels { own, parent } =
            if levels.nodes { self.hierarchy.node_levels(i) } else { self.hierarchy.leaf_levels(i) };
        let scale = self.space.scale as f32;
        let mut push = |ball: ErrorBall| {
            floats.extend((scale * ball.center).to_array());
            floats.extend([scale * ball.radius, scale * ball.extent]);
        };
        push(parent);
        if levels.nodes {
            push(own);
        }
    }
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
    /// The bounds of a block's balls, as a device has them.
    pub(super) fn around(levels: ChunkLevels, floats: &[f32]) -> Self {
        let each = levels.floats_each();
        let ball = |floats: &[f32]| {
            let [x, y, z, radius, extent] = [0, 1, 2, 3, 4].map(|i| f64::from(floats[i]));
            (DVec3::new(x, y, z), radius, extent)
        };
        let parents = || floats.chunks_exact(each).map(|floats| ball(&floats[..BALL_FLOATS]));
        let own =
            || floats.chunks_exact(each).filter(|_| levels.nodes).map(|floats| ball(&floats[BALL_FLOATS..]));
        // The root's parent is nowhere.
        let places = || own().chain(parents()).filter(|(_, _, extent)| extent.is_finite()).map(|ball| ball.0);
        let [lo, hi] = places()
            .fold([DVec3::INFINITY, DVec3::NEG_INFINITY], |[lo, hi], place| [lo.min(place), hi.max(place)]);
        let center = if lo.is_finite() { 0.5 * (lo + hi) } else { DVec3::ZERO };
        Self { center, own: BallBounds::of(center, own()), parent: BallBounds::of(center, parents()) }
    }
}

impl BallBounds {
    fn of(center: DVec3, balls: impl Iterator<Item = (DVec3, f64, f64)>) -> Self {
        let none = Self { reach: 0.0, far: f64::NEG_INFINITY, extents: [f64::INFINITY, 0.0] };
        let bounds = balls.fold(none, |bounds, (place, radius, extent)| {
            let distance = center.distance(place);
            let [least, most] = bounds.extents;
            Self {
                reach: bounds.reach.max(distance + radius),
                far: bounds.far.max(distance - radius),
                extents: [least.min(extent), most.max(extent)],
            }
        });
        // Of none: as if of one that is nothing.
        if bounds.far == f64::NEG_INFINITY {
            Self { reach: 0.0, far: 0.0, extents: [0.0; 2] }
        } else {
            bounds
        }
    }
}
