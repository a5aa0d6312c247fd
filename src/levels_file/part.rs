//! A hierarchy, or a part of one, as pages.

use std::{
    io::{self, Seek, Write},
    ops::Range,
};

use glam::{DVec3, Vec3};

use super::{
    page::{Page, Told},
    write::Writer,
};
use crate::{
    geometry::{
        Overlaps,
        hierarchy::{Hierarchy, NO_NODE, Node, TopNode, by_spread},
    },
    scene::{Colors, ErrorBall, Shapes, Splats},
};

/// How many splats a page gets at most: so that about a MB is read at once.
const PAGE_SPLATS: usize = 1 << 14;

/// What is below a node of at most so many splats, and below none larger of that size, has pages of its own, so that a view next to the surface reads few of them. With fewer,
/// pages are small and many, and each has the parents of its splats.
const LEAST_REGION_SPLATS: u64 = 1 << 15;

/// Nor is a region less than this part of all splats of a file: more pages are looked at by each view.
const MOST_REGIONS: u64 = 64;

/// From so many splats on a page ends where others begin whose parents spread less by half an octave. What is below a large parent may be drawn
/// from afar however small it is: by sizes of their own, few of those would ask for every page.
const STEP_SPLATS: usize = 1 << 8;

/// What is at the root of a part. It is drawn for what is above the part, so that it is written when that is known.
pub(super) enum Root {
    /// Its node.
    Node { splats: Splats, ball: ErrorBall, weight: f32 },
    /// Its only splat, and one over its overlap.
    Splat(Splats, f32),
}

impl Root {
    /// Of the ball of its node; 0 of a splat.
    pub fn radius(&self) -> f64 {
        match self {
            Self::Node { ball, .. } => ball.radius.into(),
            Self::Splat(..) => 0.0,
        }
    }
}

/// Writes all of a part but its root. `overlaps`: those of its splats, and the file's; `of_splats`: how many the file has.
pub(super) fn write_part<W: Write + Seek>(
    writer: &mut Writer<W>,
    (splats, of_splats): (&Splats, u64),
    hierarchy: &Hierarchy,
    overlaps: (&Overlaps, f64),
) -> io::Result<Root> {
    let Hierarchy { tree, bounds, order, leaf_parents, .. } = hierarchy;
    if tree.is_empty() {
        let inverse = overlaps.0.inverse.first().copied().unwrap_or(1.0);
        return Ok(Root::Splat(splats.picked(0..splats.len()), inverse));
    }
    let ball = |number: u32| bounds.get(number as usize).map_or(ErrorBall::ABOVE_ROOT, |bounds| bounds.error);
    let weights = hierarchy.weights(splats, overlaps);
    let regions = regions(tree, (of_splats / MOST_REGIONS).max(LEAST_REGION_SPLATS) as usize);
    let sorted = by_spread(tree.len() - 1, |i| ball(tree[1 + i].parent).spread);
    let sorted = by_region(sorted, |i| regions[1 + i]);
    for pages in runs(&sorted) {
        let which = sorted[pages].iter().map(|(i, _)| 1 + *i as usize);
        let own = which.clone().map(|i| (bounds[i].error, weights[i])).collect();
        let parents = which.clone().map(|i| tree[i].parent);
        writer.page(Page::of(hierarchy.drawn_nodes(which), parents, ball, Told::Nodes(own)))?;
    }
    let sorted = by_spread(order.len(), |i| ball(leaf_parents[i]).spread);
    let sorted = by_region(sorted, |i| regions[leaf_parents[i] as usize]);
    for pages in runs(&sorted) {
        let places = sorted[pages].iter().map(|(place, _)| *place as usize);
        let numbers = places.clone().map(|place| order[place] as usize);
        let inverse = numbers.clone().map(|i| overlaps.0.inverse[i]).collect();
        let parents = places.map(|place| leaf_parents[place]);
        writer.page(Page::of(splats.picked(numbers), parents, ball, Told::Splats(inverse)))?;
    }
    Ok(Root::Node { splats: hierarchy.drawn_nodes(0..1), ball: bounds[0].error, weight: weights[0] })
}

/// Writes the nodes above parts, and the roots of these, each with the number of the node above it.
pub(super) fn write_top<W: Write + Seek>(
    writer: &mut Writer<W>,
    top: &[TopNode],
    roots: &[(Root, Option<usize>)],
    one_color: Option<[f32; 4]>,
) -> io::Result<()> {
    let number = |parent: Option<usize>| parent.map_or(NO_NODE, |parent| parent as u32);
    let ball = |number: u32| top.get(number as usize).map_or(ErrorBall::ABOVE_ROOT, |node| node.error);
    let mut nodes = Gathered::default();
    for node in top {
        nodes.axes(node.center, node.axes, node.color);
        nodes.own.push((node.error, node.weight));
        nodes.parents.push(number(node.parent));
    }
    for (root, parent) in roots {
        let parent = number(*parent);
        match root {
            Root::Node { splats, ball, weight } => {
                let Shapes::Ellipses { s, t } = &splats.shapes else { continue };
                nodes.axes(splats.positions[0], [s[0], t[0]], splats.color(0));
                nodes.own.push((*ball, *weight));
                nodes.parents.push(parent);
            }
            Root::Splat(splats, inverse) => {
                let told = Told::Splats(vec![*inverse]);
                writer.page(Page::of(splats.clone(), [parent].into_iter(), ball, told))?;
            }
        }
    }
    let Gathered { positions, s, t, colors, own, parents } = nodes;
    let colors = one_color.map_or(Colors::Each(colors), Colors::Uniform);
    let splats = Splats::new(positions, Shapes::Ellipses { s, t }, colors);
    let sorted = by_spread(own.len(), |i| ball(parents[i]).spread);
    for pages in runs(&sorted) {
        let which = sorted[pages].iter().map(|(i, _)| *i as usize);
        let own = which.clone().map(|i| own[i]).collect();
        let parents = which.clone().map(|i| parents[i]);
        writer.page(Page::of(splats.picked(which), parents, ball, Told::Nodes(own)))?;
    }
    Ok(())
}

/// For each node the region of at most so many splats that it is in: one more than the first place of those; 0 above all regions.
fn regions(tree: &[Node], most: usize) -> Vec<u32> {
    let mut regions = vec![0; tree.len()];
    for (i, node) in tree.iter().enumerate() {
        let around = regions.get(node.parent as usize).copied().unwrap_or(0);
        regions[i] = match around {
            0 if node.splats.len() <= most => node.splats.start + 1,
            around => around,
        };
    }
    regions
}

/// The same numbers with all of a region together, in the order in which they were.
fn by_region(mut sorted: Vec<(u32, i32)>, region: impl Fn(usize) -> u32) -> Vec<(u32, i32)> {
    sorted.sort_by_key(|(number, _)| region(*number as usize));
    sorted
}

/// Nodes that are gathered one by one.
#[derive(Default)]
struct Gathered {
    positions: Vec<DVec3>,
    s: Vec<Vec3>,
    t: Vec<Vec3>,
    colors: Vec<[f32; 4]>,
    own: Vec<(ErrorBall, f32)>,
    parents: Vec<u32>,
}

impl Gathered {
    fn axes(&mut self, center: DVec3, [s, t]: [Vec3; 2], color: [f32; 4]) {
        self.positions.push(center);
        self.s.push(s);
        self.t.push(t);
        self.colors.push(color);
    }
}

/// Where pages begin and end among splats with their steps of size.
fn runs(sorted: &[(u32, i32)]) -> Vec<Range<usize>> {
    let mut runs = Vec::new();
    let mut begin = 0;
    for end in 1..=sorted.len() {
        let count = end - begin;
        let ends_here = sorted.get(end).is_none_or(|(_, step)| *step != sorted[end - 1].1);
        if count == PAGE_SPLATS || end == sorted.len() || ends_here && count >= STEP_SPLATS {
            runs.push(begin..end);
            begin = end;
        }
    }
    runs
}
