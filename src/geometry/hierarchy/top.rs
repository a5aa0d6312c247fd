//! The nodes above parts, each of which is a hierarchy of its own: where the whole does not fit into memory.
//!
//! What a part adds to the nodes above it is known before it is built: the sums of its disks ([`PartSums`]). So the ellipses of those nodes
//! are known, too, but for their sizes, which grow over the disks of one part after the other ([`Top::add`]). Only then their bounds are.

use std::ops::Range;

use glam::{DVec3, Vec3};

use super::{Bounds, Hierarchy, disks::Disk, disks::Disks, ellipse::Ellipse, sums::Sums};
use crate::scene::{ErrorBall, Splats};

/// How many disks are looked at in one go: what they take beside the splats is then little.
const DISKS_AT_ONCE: usize = 1 << 16;

/// What some splats add to all nodes above them.
#[derive(Clone, Copy, Debug)]
pub struct PartSums(Sums);

/// A child of a node above parts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Child {
    /// A node, of a larger number than its parent.
    Node(usize),
    /// A part.
    Part(usize),
}

/// The nodes above parts, while these are built.
pub struct Top {
    nodes: Vec<Grown>,
    /// The parent of each part.
    part_parents: Vec<Option<usize>>,
    /// What each part has at its root, once it was built.
    roots: Vec<Option<Root>>,
    origin: DVec3,
}

/// A node above parts, of which all is known.
#[derive(Clone, Copy, Debug)]
pub struct TopNode {
    /// The center of its ellipse, in world space.
    pub center: DVec3,
    /// The ellipse's axes; it is drawn as a whole.
    pub axes: [Vec3; 2],
    /// Linear mean color and alpha.
    pub color: [f32; 4],
    /// By what it is drawn.
    pub error: ErrorBall,
    /// As [`Hierarchy::weights`].
    pub weight: f32,
    /// Its parent; `None` of the root.
    pub parent: Option<usize>,
}

struct Grown {
    parent: Option<usize>,
    children: Vec<Child>,
    sums: Sums,
    ellipse: Ellipse,
    spread: f64,
    /// f² over the disks of all parts so far.
    square: f64,
}

/// What is at the root of a part: its node, or its only splat.
enum Root {
    Node(Bounds),
    Splat(Disk),
}

impl PartSums {
    /// Of these splats; `None` of none.
    pub fn of(splats: &Splats) -> Option<Self> {
        let disks = disks(splats, 0..splats.len());
        let sums: Vec<Sums> = disks.0.iter().map(|disk| Sums::of_disk(disk, &splats.colors)).collect();
        (!sums.is_empty()).then(|| Self(Sums::of_parts(&sums)))
    }

    /// Of all splats of these; `None` of none.
    pub fn of_all(parts: &[Self]) -> Option<Self> {
        let sums: Vec<Sums> = parts.iter().map(|part| part.0).collect();
        (!sums.is_empty()).then(|| Self(Sums::of_parts(&sums)))
    }
}

/// These splats as disks, in their order.
fn disks(splats: &Splats, which: Range<usize>) -> Disks {
    let numbers: Vec<u32> = which.map(|i| i as u32).collect();
    Disks::of(splats, &numbers)
}

impl Top {
    /// Of nodes with these children, the first of which is the root, above parts with these sums, all of which are below it; no node where
    /// there is one part. Bounds are counted from `origin`.
    pub fn new(children: &[Vec<Child>], parts: &[PartSums], origin: DVec3) -> Self {
        let mut part_parents = vec![None; parts.len()];
        let mut parents = vec![None; children.len()];
        let mut sums: Vec<Option<Sums>> = vec![None; children.len()];
        for (number, children) in children.iter().enumerate().rev() {
            let below: Vec<Sums> = children
                .iter()
                .filter_map(|child| match *child {
                    Child::Node(node) => {
                        parents[node] = Some(number);
                        sums[node]
                    }
                    Child::Part(part) => {
                        part_parents[part] = Some(number);
                        Some(parts[part].0)
                    }
                })
                .collect();
            sums[number] = (!below.is_empty()).then(|| Sums::of_parts(&below));
        }
        let grown = |((sums, children), parent): ((Option<Sums>, &Vec<Child>), Option<usize>)| {
            let sums = sums?;
            let (ellipse, spread) = sums.ellipse();
            Some(Grown { parent, children: children.clone(), sums, ellipse, spread, square: 0.0 })
        };
        let nodes = sums.into_iter().zip(children).zip(parents).filter_map(grown).collect();
        Self { nodes, part_parents, roots: parts.iter().map(|_| None).collect(), origin }
    }

    /// The parent of a part; `None` where the part is the whole.
    pub fn parent_of(&self, part: usize) -> Option<usize> {
        self.part_parents[part]
    }

    /// Adds a part that was built: nodes above it grow until they hide its disks. `splats`: those from which `hierarchy` was built.
    pub fn add(&mut self, part: usize, splats: &Splats, hierarchy: &Hierarchy) {
        for first in (0..splats.len()).step_by(DISKS_AT_ONCE) {
            let disks = disks(splats, first..splats.len().min(first + DISKS_AT_ONCE));
            let mut above = self.part_parents[part];
            while let Some(number) = above {
                let node = &mut self.nodes[number];
                node.square = node.square.max(node.ellipse.square_around(&disks.0));
                above = node.parent;
            }
        }
        let lone = || disks(splats, 0..splats.len().min(1)).0.first().copied().map(Root::Splat);
        self.roots[part] = hierarchy.bounds.first().copied().map(Root::Node).or_else(lone);
    }

    /// All nodes, once all parts are added.
    pub fn finish(self) -> Vec<TopNode> {
        let mut bounds: Vec<Bounds> = vec![Bounds::NONE; self.nodes.len()];
        let mut finished = Vec::new();
        for (number, node) in self.nodes.iter().enumerate().rev() {
            let (s, t) = node.ellipse.axes_of(node.square);
            let (mut below, mut leaves) = (Vec::new(), Vec::new());
            for child in &node.children {
                match *child {
                    Child::Node(node) => below.push(bounds[node]),
                    Child::Part(part) => match &self.roots[part] {
                        Some(Root::Node(bounds)) => below.push(*bounds),
                        Some(Root::Splat(disk)) => leaves.push(*disk),
                        None => {}
                    },
                }
            }
            let center = node.sums.center;
            let own = (center - self.origin, node.ellipse.normal, s.length());
            let size = (node.spread, node.sums.contrast());
            bounds[number] = Bounds::around(own, size, &below, self.origin, leaves.iter());
            let axes = [s.as_vec3(), t.as_vec3()];
            let area = axes[0].as_dvec3().cross(axes[1].as_dvec3()).length();
            finished.push(TopNode {
                center,
                axes,
                color: node.sums.mean_color(),
                error: bounds[number].error,
                weight: (node.sums.moments.weight / area) as f32,
                parent: node.parent,
            });
        }
        finished.reverse();
        finished
    }
}
