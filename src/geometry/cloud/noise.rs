//! How coarse a cloud must be looked at so that its noise is small against what is looked at.
//!
//! Where the 12 nearest neighbors of most points are as thick as wide, planes through them mean nothing. Planes are then fitted
//! to the 48 nearest of all points, of every 4th, of every 16th and so on: the first of these in which most are flat. That is as
//! many points a plane at any coarseness, and so the same time. A million points of a ball with 1% noise need every 64th.

use glam::DVec3;

use super::plane::{FLAT, MOST_NEIGHBORS, NEIGHBORS, Plane};
use crate::geometry::neighbors::{Point, Tree};

/// Every so manieth point is in a coarser tree, in the order of the finer one, in which neighbors lie near each other.
const STRIDES: [usize; 5] = [1, 4, 16, 64, 256];

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
    let is_flat = |place: &&usize| fit(among, tree.points()[**place].position, count).thickness <= FLAT;
    2 * samples.iter().filter(is_flat).count() >= samples.len()
}

/// The plane through the nearest points of a tree, as seen from a place.
pub(super) fn fit(tree: &Tree, place: DVec3, count: usize) -> Plane {
    let mut found = vec![(0.0, 0); count];
    tree.nearest_places_to(place, &mut found);
    let near = found.iter().filter(|(_, at)| *at != u32::MAX);
    let offsets: Vec<DVec3> = near.map(|&(_, at)| tree.points()[at as usize].position - place).collect();
    Plane::fit(&offsets, |_| true)
}
