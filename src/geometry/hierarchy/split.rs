//! The tree: which splats are below which node (Pajarola et al. 2003, section 3.2).
//!
//! A node with more than [`LEAF_SPLATS`] splats is cut at the mean of their centers into up to eight octants. An octant of a single splat
//! is no node: the splat itself is the child. Where the mean leaves more than ¾ of the splats in one octant, the node is cut in two
//! equal halves instead, at the median of the axis along which the centers spread widest, and splats at the same place by their order.
//! So each child has at most ¾ of its parent's splats whatever the input: 2.5 log2 n levels at most, each of O(n) steps. Splats that all
//! lie at one point need no case of their own.

use std::ops::Range;

use glam::DVec3;
use rayon::prelude::*;

use super::{LEAF_SPLATS, NO_NODE, Node, STEPS};
use crate::{progress::Progress, scene::Splats};

/// The tree without what its nodes look like; see [`super::Hierarchy`].
pub(super) struct Tree {
    pub nodes: Vec<Node>,
    pub levels: Vec<Range<usize>>,
    pub order: Vec<u32>,
    pub leaf_parents: Vec<u32>,
}

/// A splat, while it finds its place.
#[derive(Clone, Copy)]
struct Point {
    center: DVec3,
    number: u32,
}

/// The tree, and the mean of all centers.
pub(super) fn split(splats: &Splats, progress: &dyn Progress) -> (Tree, DVec3) {
    let point = |(i, &center): (usize, &DVec3)| Point { center, number: i as u32 };
    let mut points: Vec<Point> = splats.positions.par_iter().enumerate().map(point).collect();
    let origin = if points.is_empty() { DVec3::ZERO } else { mean(&points) };
    let mut nodes = Vec::new();
    if points.len() > 1 {
        nodes.push(Node { parent: NO_NODE, splats: 0..points.len() as u32, children: 0..0 });
    }
    let mut levels = Vec::new();
    let mut level = 0..nodes.len();
    while !level.is_empty() {
        let runs = runs(&mut points, &nodes[level.clone()]);
        let open: u64 = runs.iter().map(|run| run.len() as u64).sum();
        progress.step(STEPS[0], splats.len() as u64 - open, splats.len() as u64);
        let ends: Vec<Ends> = runs.into_par_iter().map(cut).collect();
        for (number, ends) in level.clone().zip(ends) {
            add_children(&mut nodes, number, &ends);
        }
        levels.push(level.clone());
        level = level.end..nodes.len();
    }
    let leaf_parents = leaf_parents(&nodes, points.len());
    progress.step(STEPS[0], splats.len() as u64, splats.len() as u64);
    let order = points.par_iter().map(|point| point.number).collect();
    (Tree { nodes, levels, order, leaf_parents }, origin)
}

/// Where the parts of a node end, counted from its begin. Some are empty.
type Ends = [usize; 8];

/// The points below each of these nodes, whose runs follow one another with gaps.
fn runs<'a>(points: &'a mut [Point], nodes: &[Node]) -> Vec<&'a mut [Point]> {
    let mut rest = points;
    let mut begin = 0;
    let mut run = |node: &Node| {
        let (_, from_node) = std::mem::take(&mut rest).split_at_mut((node.splats.start - begin) as usize);
        let (own, after) = from_node.split_at_mut(node.splats.len());
        (rest, begin) = (after, node.splats.end);
        own
    };
    nodes.iter().map(&mut run).collect()
}

/// Sorts a node's points by the parts into which it is cut; a leaf has none.
fn cut(points: &mut [Point]) -> Ends {
    if points.len() <= LEAF_SPLATS {
        return [0; 8];
    }
    let ends = sort_by_octant(points, mean(points));
    let begins = std::iter::once(0).chain(ends);
    let largest = begins.zip(ends).map(|(begin, end)| end - begin).max();
    if largest.is_some_and(|largest| 4 * largest <= 3 * points.len()) { ends } else { cut_in_half(points) }
}

fn mean(points: &[Point]) -> DVec3 {
    points.iter().map(|point| point.center).sum::<DVec3>() / points.len() as f64
}

/// Sorts in place, one octant after the other (McIlroy, Bostic, McIlroy, "Engineering radix sort", 1993, the American flag sort).
fn sort_by_octant(points: &mut [Point], center: DVec3) -> Ends {
    let octant = |point: &Point| point.center.cmpge(center).bitmask() as usize;
    let mut ends = [0; 8];
    points.iter().for_each(|point| ends[octant(point)] += 1);
    let mut next = [0; 8];
    let mut before = 0;
    for (next, end) in next.iter_mut().zip(&mut ends) {
        *next = before;
        before += *end;
        *end = before;
    }
    for own in 0..8 {
        while next[own] < ends[own] {
            let other = octant(&points[next[own]]);
            points.swap(next[own], next[other]);
            next[other] += 1;
        }
    }
    ends
}

fn cut_in_half(points: &mut [Point]) -> Ends {
    let [low, high] = points.iter().fold([DVec3::INFINITY, DVec3::NEG_INFINITY], |[low, high], point| {
        [low.min(point.center), high.max(point.center)]
    });
    let axis = (high - low).max_position();
    let middle = points.len() / 2;
    points.select_nth_unstable_by(middle, |a, b| {
        a.center[axis].total_cmp(&b.center[axis]).then(a.number.cmp(&b.number))
    });
    let mut ends = [points.len(); 8];
    ends[0] = middle;
    ends
}

fn add_children(nodes: &mut Vec<Node>, parent: usize, ends: &Ends) {
    let first = nodes.len() as u32;
    let start = nodes[parent].splats.start;
    let mut begin = start;
    for end in ends.map(|end| start + end as u32) {
        if end > begin + 1 {
            nodes.push(Node { parent: parent as u32, splats: begin..end, children: 0..0 });
        }
        begin = end;
    }
    nodes[parent].children = first..nodes.len() as u32;
}

fn leaf_parents(nodes: &[Node], count: usize) -> Vec<u32> {
    let mut parents = vec![NO_NODE; count];
    for (number, node) in nodes.iter().enumerate() {
        for run in node.leaf_runs(nodes) {
            parents[run.start as usize..run.end as usize].fill(number as u32);
        }
    }
    parents
}
