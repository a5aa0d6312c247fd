//! The nodes of an octree that are known, and what there is to check when more become known.

use std::{
    collections::{HashMap, HashSet},
    fmt,
};

use glam::DVec3;

/// The deepest level: beyond it a node's coordinates have no room in 32 bits.
pub(super) const MOST_LEVEL: u32 = 30;

/// Which cube of an octree: `2^level` along each axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct NodeKey {
    /// 0 for the root.
    pub level: u32,
    /// Along x, y and z, from 0 on.
    pub at: [u32; 3],
}

impl NodeKey {
    /// The cube of all.
    pub const ROOT: Self = Self { level: 0, at: [0; 3] };

    /// What a file calls by these numbers, if an octree has it.
    pub(super) fn new(level: i64, at: [i64; 3]) -> Option<Self> {
        let level = u32::try_from(level).ok().filter(|level| *level <= MOST_LEVEL)?;
        let inside = |at: i64| u32::try_from(at).ok().filter(|at| u64::from(*at) < 1 << level);
        let [x, y, z] = at.map(inside);
        Some(Self { level, at: [x?, y?, z?] })
    }

    /// A child, by the bits of its number: 4 for x, 2 for y, 1 for z.
    pub(super) fn child(self, number: u32) -> Option<Self> {
        let bits = [number >> 2 & 1, number >> 1 & 1, number & 1];
        let at = |axis: usize| i64::from(self.at[axis]) * 2 + i64::from(bits[axis]);
        Self::new(i64::from(self.level) + 1, [0, 1, 2].map(at))
    }

    fn parent(self) -> Option<Self> {
        Some(Self { level: self.level.checked_sub(1)?, at: self.at.map(|at| at / 2) })
    }

    fn is_within(self, other: Self) -> bool {
        self.level >= other.level && self.at.map(|at| at >> (self.level - other.level)) == other.at
    }
}

/// As COPC and others write it: level-x-y-z.
impl fmt::Display for NodeKey {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [x, y, z] = self.at;
        write!(f, "{}-{x}-{y}-{z}", self.level)
    }
}

/// Where a node is, and how dense its points are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OctreeNode {
    /// The middle of its box.
    pub center: DVec3,
    /// Half of the box's extent.
    pub half: DVec3,
    /// How far its points, and those of the nodes above it, are apart.
    pub spacing: f64,
}

impl OctreeNode {
    /// The radius of the ball around its box.
    pub fn radius(&self) -> f64 {
        self.half.length()
    }
}

/// Bytes of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Span {
    pub at: u64,
    pub bytes: u64,
}

impl Span {
    fn is_in(self, bytes: u64) -> bool {
        self.at.checked_add(self.bytes).is_some_and(|end| end <= bytes)
    }
}

/// What is known of a node.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Entry {
    /// It, and what is below, is told by a page.
    Page(Span),
    /// Its points.
    Node { points: u32, span: Span },
}

/// What is known of a level.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LevelOfOctree {
    /// Its nodes.
    pub nodes: u64,
    /// Their points.
    pub points: u64,
}

/// The nodes that are known.
pub(super) struct Tree {
    min: DVec3,
    extent: DVec3,
    /// Of the root.
    pub spacing: f64,
    nodes: HashMap<NodeKey, Entry>,
    /// Where pages begin that were read.
    pages: HashSet<u64>,
    page_bytes: u64,
    /// Pages that are named, and not read.
    unread: usize,
    /// Nodes that have points.
    filled: usize,
    points: u64,
    most_points: u64,
}

impl Tree {
    /// All of it in one page, within a box.
    pub fn new([min, max]: [DVec3; 2], spacing: f64, root: Span, most_points: u64) -> Self {
        Self {
            min,
            extent: max - min,
            spacing,
            nodes: [(NodeKey::ROOT, Entry::Page(root))].into(),
            pages: HashSet::new(),
            page_bytes: 0,
            unread: 1,
            filled: 0,
            points: 0,
            most_points,
        }
    }

    pub fn get(&self, key: NodeKey) -> Option<Entry> {
        self.nodes.get(&key).copied()
    }

    pub fn children(&self, key: NodeKey) -> impl Iterator<Item = NodeKey> {
        (0..8).filter_map(move |number| key.child(number)).filter(|child| self.nodes.contains_key(child))
    }

    /// Where a node is.
    pub fn node(&self, key: NodeKey) -> OctreeNode {
        let side = f64::from(key.level).exp2().recip();
        let half = 0.5 * side * self.extent;
        let [x, y, z] = key.at.map(f64::from);
        OctreeNode {
            center: self.min + side * self.extent * DVec3::new(x, y, z) + half,
            half,
            spacing: self.spacing * side,
        }
    }

    /// From the root down.
    pub fn levels(&self) -> Vec<LevelOfOctree> {
        let mut levels = Vec::new();
        for (key, entry) in &self.nodes {
            let Entry::Node { points, .. } = entry else { continue };
            if levels.len() <= key.level as usize {
                levels.resize(key.level as usize + 1, LevelOfOctree { nodes: 0, points: 0 });
            }
            let level = &mut levels[key.level as usize];
            level.nodes += 1;
            level.points += u64::from(*points);
        }
        levels
    }

    pub fn pages(&self) -> usize {
        self.pages.len()
    }

    /// Whether so many nodes with points are all there are.
    pub fn is_all(&self, nodes: usize) -> bool {
        self.unread == 0 && nodes == self.filled
    }

    /// Adds what a page tells of the node `root` and of nodes below. The files of the hierarchy and of the points have so many bytes.
    pub fn add(
        &mut self,
        root: NodeKey,
        page: Span,
        entries: Vec<(NodeKey, Entry)>,
        [hierarchy_bytes, node_bytes]: [u64; 2],
    ) -> Result<(), String> {
        self.page_bytes = self.page_bytes.saturating_add(page.bytes);
        if !self.pages.insert(page.at) || self.page_bytes > hierarchy_bytes {
            return Err("named twice; expected each page once".to_owned());
        }
        self.nodes.remove(&root);
        self.unread -= 1;
        for (number, (key, entry)) in entries.iter().enumerate() {
            let refuse = |problem: String| Err(format!("entry {number}, node {key}: {problem}"));
            if !key.is_within(root) {
                return refuse(format!("not in node {root}, of which the page is"));
            }
            match *entry {
                Entry::Page(_) if *key == root => {
                    return refuse("named as a page again; expected its points".to_owned());
                }
                Entry::Page(span) if span.bytes == 0 || !span.is_in(hierarchy_bytes) => {
                    let Span { at, bytes } = span;
                    return refuse(format!(
                        "a page of {bytes} bytes at byte {at}; expected some within {hierarchy_bytes}"
                    ));
                }
                Entry::Page(_) => self.unread += 1,
                Entry::Node { points: 0, .. } => {}
                Entry::Node { points, span } => {
                    if span.bytes == 0 || !span.is_in(node_bytes) {
                        let Span { at, bytes } = span;
                        return refuse(format!(
                            "{points} points in {bytes} bytes at byte {at}; expected some within {node_bytes}"
                        ));
                    }
                    self.filled += 1;
                    self.points += u64::from(points);
                    if self.points > self.most_points {
                        let (found, most) = (self.points, self.most_points);
                        return refuse(format!("{found} points with those before; expected {most} in all"));
                    }
                }
            }
            if self.nodes.insert(*key, *entry).is_some() {
                return refuse("named before; expected each node once".to_owned());
            }
        }
        if !self.nodes.contains_key(&root) {
            return Err(format!("without node {root}; expected that first"));
        }
        // Any order is allowed within a page.
        let has_parent = |key: &NodeKey| {
            let parent = key.parent().and_then(|parent| self.get(parent));
            *key == root || matches!(parent, Some(Entry::Node { .. }))
        };
        match entries.iter().find(|(key, _)| !has_parent(key)) {
            Some((key, _)) => Err(format!("node {key} without the node above it")),
            None => Ok(()),
        }
    }
}
