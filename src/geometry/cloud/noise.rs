//! How coarse a cloud must be looked at so that its noise is small against what is looked at.
//!
//! Where the 12 nearest neighbors of most points are as thick as wide, planes through them mean nothing. Planes are then fitted
//! to the 48 nearest of all points, of every 4th, of every 16th and so on: the first of these in which most are flat, or on a
//! sheet that is. That is as many points a plane at any coarseness. A million points of a ball with 1% noise need every 64th.
//! What is fitted are [`patches`], fewer than points, which tell the normals of all.

use glam::DVec3;

use super::{
    fit::{FLAT, Plane},
    patches,
    plane::{MOST_NEIGHBORS, NEIGHBORS},
    sheets,
};
use crate::geometry::neighbors::Tree;

/// Every so manieth point is in a coarser tree, in the order of the finer one, in which neighbors lie near each other.
const STRIDES: [usize; 6] = [4, 16, 64, 256, 1024, 4096];

/// Thickness over width above which neighbors may be of two sheets.
const MIXED: f64 = 0.25;

/// So many points tell of all.
const SAMPLES: usize = 200;

/// The normals at all points, if those of 12 neighbors are too noisy and coarser ones are not; their sides mean nothing.
pub(super) fn normals(tree: &Tree) -> Option<Vec<DVec3>> {
    if flat_at_most(tree, tree, NEIGHBORS) {
        return None;
    }
    if flat_at_most(tree, tree, MOST_NEIGHBORS) {
        return Some(patches::normals(tree, tree));
    }
    let mut coarser = STRIDES.into_iter().map(|stride| every(tree, stride));
    let coarse = coarser.find(|coarse| flat_at_most(tree, coarse, MOST_NEIGHBORS))?;
    Some(patches::normals(tree, &coarse))
}

/// The tree of every so manieth point.
pub(super) fn every(tree: &Tree, stride: usize) -> Tree {
    Tree::new(tree.points().iter().step_by(stride).copied().collect())
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

/// The plane through all neighbors, or the sheet among them.
pub(super) fn or_sheet(whole: Plane, offsets: &[DVec3]) -> Plane {
    let sheet = (whole.thickness > MIXED).then(|| sheets::wide(offsets));
    sheet.flatten().unwrap_or(whole)
}

/// The offsets from a place of the points of a tree that are nearest to it, nearest first.
pub(super) fn nearest(tree: &Tree, place: DVec3, count: usize) -> Vec<DVec3> {
    let mut found = vec![(0.0, 0); count];
    tree.nearest_places_to(place, &mut found);
    let near = found.iter().filter(|(_, at)| *at != u32::MAX);
    near.map(|&(_, at)| tree.points()[at as usize].position - place).collect()
}
