//! Clouds whose points come in clumps: one place seen many times, a little beside itself each time, as in clouds that were put together of the same scan, or maps
//! of a camera that stood still. All neighbors of a point are in its own clump then, and tell nothing of the surface between clumps.

use super::plane::MOST_NEIGHBORS;
use crate::geometry::neighbors::Tree;

/// A clump ends where the next point is so many times as far away. Of points at random on a surface, behind the second, one in 256 has that.
const GAP: f64 = 4.0;

/// The fewest others of a clump, and the most.
const SIZES: std::ops::Range<usize> = 2..MOST_NEIGHBORS - 1;

/// Fewer points are things of a few points each, such as the corners of two boxes.
const FEWEST: usize = 1000;

/// So many points tell of all.
const SAMPLES: usize = 400;

/// Of the clumps that were looked at, so many hundredths are no wider than what is gathered.
const WIDEST: usize = 90;

/// Of each point's number that of the point in whose clump it is, which may be itself; `None` where fewer than half of the points are in clumps.
pub(super) fn first_of_clumps(tree: &Tree) -> Option<Vec<u32>> {
    let count = tree.points().len();
    let step = count.div_ceil(SAMPLES).max(1);
    let clumps: Vec<[f64; 2]> = (0..count).step_by(step).filter_map(|place| clump(tree, place)).collect();
    if count < FEWEST || 2 * clumps.len() < count.div_ceil(step) {
        return None;
    }
    let sorted = |which: usize| {
        let mut all: Vec<f64> = clumps.iter().map(|clump| clump[which]).collect();
        all.sort_unstable_by(f64::total_cmp);
        all
    };
    // No farther than half of the way to the next clump.
    let (widest, gaps) = (sorted(0), sorted(1));
    let reach = (1.5 * widest.get(widest.len() * WIDEST / 100)?).min(0.5 * gaps.get(gaps.len() / 2)?);
    let mut first = vec![u32::MAX; count];
    for point in tree.points() {
        if first[point.number as usize] == u32::MAX {
            tree.within(point.position, reach, &mut |other, _| {
                let first = &mut first[other.number as usize];
                if *first == u32::MAX {
                    *first = point.number;
                }
            });
        }
    }
    Some(first)
}

/// How far the others of a point's clump are, and the next point that is none of it.
fn clump(tree: &Tree, place: usize) -> Option<[f64; 2]> {
    let here = tree.points()[place].position;
    let near: [u32; MOST_NEIGHBORS] = tree.nearest_places(place);
    let near = near.iter().filter(|at| **at != u32::MAX);
    let distances: Vec<f64> = near.map(|at| tree.points()[*at as usize].position.distance(here)).collect();
    let ends = distances.windows(2).enumerate().skip(SIZES.start - 1).take(SIZES.len());
    let gap = |[last, next]: [f64; 2]| next / last;
    let widest =
        ends.filter_map(|(_, pair)| pair.try_into().ok()).max_by(|a, b| gap(*a).total_cmp(&gap(*b)))?;
    (gap(widest) >= GAP).then_some(widest)
}
