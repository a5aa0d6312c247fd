//! How coarse a cloud must be looked at so that its noise is small against what is looked at.
//!
//! Where the 12 nearest neighbors of most points are as thick as wide, planes through them mean nothing. Planes are then fitted
//! to the 48 nearest of all points, of every 4th, of every 16th and so on: the first of these in which most are flat, or on a
//! sheet that is. That is as many points a plane at any coarseness, and so the same time. A million points of a ball with 1% noise
//! need every 64th.
//!
//! Points that lie beside each other have nearly the same coarse neighbors, which are searched for once for [`GROUP`] of them: those
//! about a point are then as near as the 48th is to the group's middle, which is 48 in the mean.

use std::ops::Range;

use glam::DVec3;
use rayon::prelude::*;

use super::{
    fit::{FLAT, Plane},
    plane::{MOST_NEIGHBORS, NEIGHBORS},
    sheets,
};
use crate::geometry::neighbors::{Point, Tree};

/// Every so manieth point is in a coarser tree, in the order of the finer one, in which neighbors lie near each other.
const STRIDES: [usize; 7] = [1, 4, 16, 64, 256, 1024, 4096];

/// So many points at most are searched for together. With 16 it takes longer by a fifth, with 64 as long.
const GROUP: usize = 32;

/// Thickness over width above which neighbors may be of two sheets.
const MIXED: f64 = 0.25;

/// So many points tell of all.
const SAMPLES: usize = 500;

/// The tree to fit planes to, where that of all points and their 12 neighbors are too noisy; `None` too where all are.
pub(super) fn coarse_tree(tree: &Tree) -> Option<Tree> {
    if flat_at_most(tree, tree, NEIGHBORS) {
        return None;
    }
    STRIDES
        .into_iter()
        .map(|stride| every(tree, stride))
        .find(|coarse| flat_at_most(tree, coarse, MOST_NEIGHBORS))
}

fn every(tree: &Tree, stride: usize) -> Tree {
    let points: Vec<Point> = tree.points().iter().step_by(stride).copied().collect();
    Tree::new(points)
}

/// Whether most points are flat among their `count` nearest points of `among`, or there are not enough to tell.
fn flat_at_most(tree: &Tree, among: &Tree, count: usize) -> bool {
    let total = tree.points().len();
    if among.points().len() <= 4 * count {
        return among.points().len() == total;
    }
    let samples: Vec<usize> = (0..total).step_by(total.div_ceil(SAMPLES)).collect();
    let is_flat = |place: &&usize| {
        let offsets = nearest(among, tree.points()[**place].position, count);
        let whole = Plane::fit(&offsets, |_| true);
        let plane = if count == NEIGHBORS { whole } else { or_sheet(whole, &offsets) };
        plane.thickness <= FLAT
    };
    2 * samples.iter().filter(is_flat).count() >= samples.len()
}

/// The normals at all points of a tree, of planes through the points of a coarser one; their sides mean nothing.
pub(super) fn normals(tree: &Tree, coarse: &Tree) -> Vec<DVec3> {
    let of_group = |scratch: &mut [Vec<DVec3>; 2], group: Range<usize>| {
        group_normals(&tree.points()[group], coarse, scratch)
    };
    tree.groups(GROUP).into_par_iter().map_init(Default::default, of_group).flatten_iter().collect()
}

fn group_normals(points: &[Point], coarse: &Tree, [around, offsets]: &mut [Vec<DVec3>; 2]) -> Vec<DVec3> {
    let middle = points.iter().map(|point| point.position).sum::<DVec3>() / points.len() as f64;
    let radius = points.iter().map(|point| point.position.distance(middle)).fold(0.0, f64::max);
    let mut nearest = [(0.0, 0); MOST_NEIGHBORS];
    coarse.nearest_places_to(middle, &mut nearest);
    let reach = nearest[MOST_NEIGHBORS - 1].0.sqrt();
    around.clear();
    coarse.within(middle, reach + radius, &mut |point, _| around.push(point.position));
    let normal = |point: &Point| {
        offsets.clear();
        offsets.extend(around.iter().map(|other| *other - point.position));
        let whole = Plane::fit(offsets, |offset| offset.length_squared() <= reach * reach);
        if whole.thickness > MIXED {
            offsets.sort_unstable_by(|a, b| a.length_squared().total_cmp(&b.length_squared()));
            offsets.truncate(MOST_NEIGHBORS);
        }
        or_sheet(whole, offsets).normal
    };
    points.iter().map(normal).collect()
}

/// The plane through all neighbors, or the sheet among them.
fn or_sheet(whole: Plane, offsets: &[DVec3]) -> Plane {
    let sheet = (whole.thickness > MIXED).then(|| sheets::wide(offsets));
    sheet.flatten().unwrap_or(whole)
}

/// The offsets from a place of the points of a tree that are nearest to it, nearest first.
fn nearest(tree: &Tree, place: DVec3, count: usize) -> Vec<DVec3> {
    let mut found = vec![(0.0, 0); count];
    tree.nearest_places_to(place, &mut found);
    let near = found.iter().filter(|(_, at)| *at != u32::MAX);
    near.map(|&(_, at)| tree.points()[at as usize].position - place).collect()
}
