//! The object that pages become.

use super::{header::Header, page::Page, table::PageEntry};
use crate::scene::{Colors, LeveledObject, NodeBalls, Shapes, Splats};

/// The object of a file without splats, but with room for those of some pages.
pub(super) fn empty_object(
    name: &str,
    header: &Header,
    entries: &[PageEntry],
    pages: &[usize],
) -> LeveledObject {
    let sum = |of: &dyn Fn(&PageEntry) -> u32| -> usize {
        pages.iter().map(|number| of(&entries[*number]) as usize).sum()
    };
    let nodes = sum(&|page| if page.nodes { page.count } else { 0 });
    let leaves = sum(&|page| page.count) - nodes;
    let splats = |ellipses: bool, count: usize| {
        let shapes = match ellipses {
            true => Shapes::Ellipses { s: Vec::with_capacity(count), t: Vec::with_capacity(count) },
            false => Shapes::Disks { normals: Vec::with_capacity(count), radii: Vec::with_capacity(count) },
        };
        let colors = header.color.map_or_else(|| Colors::Each(Vec::with_capacity(count)), Colors::Uniform);
        Splats::new(Vec::with_capacity(count), shapes, colors)
    };
    LeveledObject {
        name: name.to_owned(),
        closed: header.closed,
        opacity: header.opacity(),
        overlap: header.overlap,
        origin: header.origin,
        radius: header.root_radius,
        balls: Vec::with_capacity(sum(&|page| page.balls) + nodes),
        leaves: splats(header.ellipses, leaves),
        leaf_parents: Vec::with_capacity(leaves),
        inverse_overlaps: Some(Vec::with_capacity(leaves)),
        nodes: splats(true, nodes),
        node_balls: Vec::with_capacity(nodes),
        weights: Vec::with_capacity(nodes),
    }
}

/// Adds a page to what there is.
pub(super) fn add(object: &mut LeveledObject, page: Page) {
    let first = object.balls.len() as u32;
    let parents = page.parents.iter().map(|parent| first + parent);
    if page.nodes {
        let own = first + page.balls.len() as u32..;
        object.node_balls.extend(own.zip(parents).map(|(own, parent)| NodeBalls { own, parent }));
        object.weights.extend(page.own.iter().map(|(_, weight)| *weight));
    } else {
        object.leaf_parents.extend(parents);
        object.inverse_overlaps.get_or_insert_default().extend(page.inverse_overlaps);
    }
    object.balls.extend(page.balls);
    object.balls.extend(page.own.iter().map(|(ball, _)| *ball));
    let all = if page.nodes { &mut object.nodes } else { &mut object.leaves };
    all.append(page.splats);
}
