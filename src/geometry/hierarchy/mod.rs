//! Levels of detail of splats: a point octree, the nodes of which are elliptical splats (Pajarola, Sainz, Guidotti, "Object-space
//! blending and splatting of points", 2003, sections 3.2 to 3.4 and 5.1).
//!
//! **The tree** (`split`) is cut at the mean of the centers. Whatever the input, it has fewer nodes than splats, and a path of it at most
//! `2.5 log2 n` nodes. It is made level by level, not depth-first as in the paper: the same cuts, and the order that a device wants.
//!
//! **A node's splat** (`ellipse`) is an ellipse in the plane through the surface's centroid below it: its axes are those of the surface's
//! covariance (`moments`), its size the least that hides all disks below from up to 45° to its normal. All means weigh by area
//! (`sums`). Drawn is a part of it, whose kernel spreads about as those below do together.
//!
//! **Any node decides alone whether it is drawn** (`bounds`, `select`): each has a ball and a length that make its size on the screen
//! never larger than its parent's, from wherever it is seen. The length grows with how much what is below differs (`contrast`).

mod bounds;
mod clipped;
mod contrast;
mod disks;
mod ellipse;
mod farthest;
mod leveled;
mod moments;
mod select;
mod split;
mod sums;
mod top;

#[cfg(test)]
pub(crate) mod tests;

use std::ops::Range;

use glam::DVec3;
use rayon::prelude::*;

pub use crate::scene::ErrorBall;
pub(crate) use bounds::rounded_up;
pub use bounds::{Bounds, NormalCone};
pub use clipped::left_by_clips;
pub use leveled::by_spread;
pub use select::{Projection, Selection};
pub use top::{Child, PartSums, Top, TopNode};

use crate::{
    error::{Error, Result},
    progress::Progress,
    scene::{Colors, Shapes, Splats},
};
use disks::Disks;
use sums::NodeSplat;

/// The two steps of [`Hierarchy::build`], as they are told to its progress.
pub const STEPS: [&str; 2] = ["cut into an octree", "fit ellipses of nodes"];

/// Splats in a tree, each node of which is a splat that stands for all those below it.
///
/// Nodes are numbered by level from the root, and within a level along the tree; splats lie along the tree, too, so that what is below a
/// node is a run of [`Self::order`], and neighbors in number are neighbors in space.
///
/// A node takes 128 bytes here (112 with one color for all), a splat 8 beside its own.
#[derive(Clone, Debug)]
pub struct Hierarchy {
    /// An ellipse for each node, in world space: every line at up to 45° to its normal that meets a disk below meets it. Linear mean color and alpha by area; one
    /// color for all where the input has one. The normal is the mean normal, where normals agree.
    pub nodes: Splats,
    /// What parts of the axes of each node's ellipse are drawn: so long that its kernel spreads about as those below do together, of few splats.
    pub drawn: Vec<[f32; 2]>,
    /// Where each node lies in the tree.
    pub tree: Vec<Node>,
    /// What bounds each node and all below it. Lengths and places are counted from [`Self::origin`].
    pub bounds: Vec<Bounds>,
    /// The nodes of each level, from that of the root.
    pub levels: Vec<Range<usize>>,
    /// The numbers of the input's splats along the tree.
    pub order: Vec<u32>,
    /// The parent of each splat, by its place in [`Self::order`]; [`NO_NODE`] of a single splat.
    pub leaf_parents: Vec<u32>,
    /// Where [`Self::bounds`] have their origin, in world space: the mean of all centers.
    pub origin: DVec3,
}

/// The number of no node: the root's parent.
pub const NO_NODE: u32 = u32::MAX;

/// Up to so many splats a node is not cut further: the fan-out of an octree, as in the paper's figure 3.
pub const LEAF_SPLATS: usize = 8;

/// The largest coordinate and radius of what a hierarchy is made of: ellipses are f32, and no square or product of two squares leaves
/// f64.
pub const LARGEST_COORDINATE: f64 = 1e37;

/// Where a node lies in the tree. It has two splats below it at least, and two children or more: nodes, and splats that lie between the
/// runs of those nodes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Node {
    /// [`NO_NODE`] for the root.
    pub parent: u32,
    /// All splats below it, as places in [`Hierarchy::order`].
    pub splats: Range<u32>,
    /// The children that are nodes, in the order of their splats.
    pub children: Range<u32>,
}

/// What a node or a splat is drawn by: its own size and its parent's. See [`Projection::draws`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Levels {
    /// [`ErrorBall::LEAF`] for a splat of the input.
    pub own: ErrorBall,
    /// [`ErrorBall::ABOVE_ROOT`] where there is no parent.
    pub parent: ErrorBall,
}

impl Hierarchy {
    /// Puts splats into a tree, and finds what its nodes look like, in two [`STEPS`]. The same splats give the same bytes, however many threads there are; time is O(n log n) for any input,
    /// also where all centers are equal.
    ///
    /// Memory while it is built: 64 bytes a splat and 330 a node, of which there are a third as many on surfaces, and fewer always.
    ///
    /// # Errors
    /// [`crate::error::ErrorKind::Input`] for a splat with a [`crate::scene::Defect`] or a clip curve ([`left_by_clips`] has none), a coordinate or radius above
    /// [`LARGEST_COORDINATE`], and more than 2³² − 1 splats.
    pub fn build(splats: &Splats, progress: &dyn Progress) -> Result<Self> {
        Self::build_around(splats, None, progress)
    }

    /// As [`Self::build`], of a part of a larger whole: with bounds that are counted from the whole's origin.
    ///
    /// # Errors
    /// As [`Self::build`].
    pub fn build_part(splats: &Splats, origin: DVec3, progress: &dyn Progress) -> Result<Self> {
        Self::build_around(splats, Some(origin), progress)
    }

    fn build_around(splats: &Splats, origin: Option<DVec3>, progress: &dyn Progress) -> Result<Self> {
        check(splats)?;
        let (tree, mean) = split::split(splats, progress);
        let origin = origin.unwrap_or(mean);
        let disks = Disks::of(splats, &tree.order);
        let (nodes, bounds) = sums::node_splats(&tree, &disks, &splats.colors, origin, progress);
        let split::Tree { nodes: tree, levels, order, leaf_parents } = tree;
        let drawn = nodes.iter().map(|node| node.drawn).collect();
        let nodes = as_splats(&nodes, &splats.colors);
        Ok(Self { nodes, drawn, tree, bounds, levels, order, leaf_parents, origin })
    }

    /// Bytes of memory that it needs beside the splats: for a node [`Self::nodes`] as splats need, 20 for its place in the tree, 36 for
    /// its bounds and 8 for what is drawn of it; for a splat 8.
    pub fn bytes(&self) -> u64 {
        let node = size_of::<Node>() + size_of::<Bounds>() + size_of::<[f32; 2]>();
        let (nodes, leaves) = (self.tree.len() * node, self.order.len() * 2 * size_of::<u32>());
        self.nodes.bytes() + (nodes + leaves) as u64
    }

    /// By what node `i` is drawn.
    pub fn node_levels(&self, i: usize) -> Levels {
        Levels { own: self.bounds[i].error, parent: self.error_of(self.tree[i].parent) }
    }

    /// By what the splat at place `i` of [`Self::order`] is drawn.
    pub fn leaf_levels(&self, i: usize) -> Levels {
        Levels { own: ErrorBall::LEAF, parent: self.error_of(self.leaf_parents[i]) }
    }

    /// Some nodes as they are drawn.
    pub fn drawn_nodes(&self, which: impl Iterator<Item = usize> + Clone) -> Splats {
        drawn_parts(self.nodes.picked(which.clone()), which.map(|i| self.drawn[i]))
    }

    fn error_of(&self, parent: u32) -> ErrorBall {
        self.bounds.get(parent as usize).map_or(ErrorBall::ABOVE_ROOT, |bounds| bounds.error)
    }
}

impl Node {
    /// The runs of splats that are its children themselves, given all nodes of the tree; some are empty.
    pub fn leaf_runs<'a>(&self, nodes: &'a [Self]) -> impl Iterator<Item = Range<u32>> + use<'a> {
        let children = &nodes[self.children.start as usize..self.children.end as usize];
        let begins = std::iter::once(self.splats.start).chain(children.iter().map(|child| child.splats.end));
        let ends = children.iter().map(|child| child.splats.start).chain([self.splats.end]);
        begins.zip(ends).map(|(begin, end)| begin..end)
    }
}

fn check(splats: &Splats) -> Result<()> {
    let refused = |problem: String| Err(Error::input("splats", "", problem));
    if u32::try_from(splats.len()).is_err() {
        return refused(format!("{} splats; expected fewer than 2³²", splats.len()));
    }
    if !splats.clips.is_empty() {
        let clipped = splats.clips.count();
        return refused(format!(
            "{clipped} with clip curves, which levels of detail do not have; expected splats without: of a mesh those of --resample, or write a .ply"
        ));
    }
    let unusable = (0..splats.len()).into_par_iter().find_first(|&i| {
        let largest = splats.positions[i].abs().max_element();
        splats.defect(i).is_some() || largest.max(splats.major_radius(i)) > LARGEST_COORDINATE
    });
    match unusable {
        Some(i) if splats.defect(i).is_some() => refused(format!("splat {i} can't be drawn")),
        Some(i) => refused(format!("splat {i} is beyond 1e37")),
        None => Ok(()),
    }
}

/// Of ellipses those with such parts of their axes.
fn drawn_parts(mut nodes: Splats, drawn: impl Iterator<Item = [f32; 2]>) -> Splats {
    if let Shapes::Ellipses { s, t } = &mut nodes.shapes {
        for ((s, t), [of_s, of_t]) in s.iter_mut().zip(t).zip(drawn) {
            (*s, *t) = (of_s * *s, of_t * *t);
        }
    }
    nodes
}

fn as_splats(nodes: &[NodeSplat], colors: &Colors) -> Splats {
    Splats::new(
        nodes.iter().map(|node| node.center).collect(),
        Shapes::Ellipses {
            s: nodes.iter().map(|node| node.s).collect(),
            t: nodes.iter().map(|node| node.t).collect(),
        },
        match colors {
            Colors::Uniform(color) => Colors::Uniform(*color),
            Colors::Each(_) => Colors::Each(nodes.iter().map(|node| node.color).collect()),
        },
    )
}
