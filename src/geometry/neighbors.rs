//! The nearest neighbors of points among themselves: a k-d tree (Friedman, Bentley, Finkel, "An Algorithm for Finding Best
//! Matches in Logarithmic Expected Time", 1977).
//!
//! Every node halves its points by number, so that no input makes the tree deep, not even points that are all the same.
//! The tree is the order of its points, and each node's plane goes through its middle one. Distances depend neither on
//! the number of threads nor on the order of the points.

mod many;
mod nearest;
#[cfg(test)]
mod tests;

use std::{iter, num::NonZero, ops::Range, thread};

use glam::DVec3;

pub(super) use many::Many;

/// How many neighbors are found.
pub(super) const NEIGHBORS: usize = 6;

/// So many points are searched one by one.
const LEAF: usize = 8;

/// Fewer points than this are not worth a thread.
const POINTS_PER_THREAD: usize = 1 << 14;

/// So many points are searched for between two progress messages.
const BATCH: usize = 1 << 18;

/// A point and its number in the input.
#[derive(Clone, Copy, Debug)]
pub(super) struct Point {
    pub position: DVec3,
    pub number: u32,
}

/// The neighbors that [`Tree::nearest_to`] finds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Nearest {
    pub distance: f64,
    pub position: DVec3,
    /// The point's.
    pub number: u32,
}

/// A k-d tree.
pub(super) struct Tree {
    points: Vec<Point>,
    /// At the place of a node's middle point: the axis along which the node is halved.
    axes: Vec<u8>,
}

impl Tree {
    /// Bytes that [`Tree::new`] needs for a point, its argument included.
    pub(super) const BYTES_PER_POINT: usize = size_of::<Point>() + 1;

    /// The tree of finite points.
    pub(super) fn new(mut points: Vec<Point>) -> Self {
        let mut axes = vec![0; points.len()];
        halve(&mut points, &mut axes, threads(usize::MAX));
        Self { points, axes }
    }

    /// Hands each point's number and the distances of its nearest neighbors, sorted, to `take`, in no order that
    /// matters. Where there are fewer neighbors, infinite distances stand in. `progress` is called with points done.
    pub(super) fn distances(
        &self,
        mut take: impl FnMut(u32, [f64; NEIGHBORS]),
        mut progress: impl FnMut(usize),
    ) {
        let mut found = Vec::new();
        for first in (0..self.points.len()).step_by(BATCH) {
            let batch = first..self.points.len().min(first + BATCH);
            found.resize(batch.len(), [0.0; NEIGHBORS]);
            let share = batch.len().div_ceil(threads(batch.len()));
            thread::scope(|scope| {
                for (i, part) in found.chunks_mut(share).enumerate() {
                    let first = batch.start + i * share;
                    scope.spawn(move || {
                        for (j, distances) in part.iter_mut().enumerate() {
                            *distances = self.six_distances(first + j);
                        }
                    });
                }
            });
            for (point, distances) in self.points[batch.clone()].iter().zip(&found) {
                take(point.number, *distances);
            }
            progress(batch.end);
        }
    }

    /// The nearest of the points that are less than `reach` away from a place that need not be one of them.
    pub(super) fn nearest_to(&self, target: DVec3, reach: f64) -> Option<Nearest> {
        self.nearest_of(target, reach, &|_| true)
    }

    /// As [`Tree::nearest_to`], of those whose positions are `wanted`.
    pub(super) fn nearest_of(
        &self,
        target: DVec3,
        reach: f64,
        wanted: &dyn Fn(DVec3) -> bool,
    ) -> Option<Nearest> {
        let place = self.nearest_place_of(target, reach, wanted)?;
        let Point { position, number } = self.points[place];
        Some(Nearest { distance: target.distance(position), position, number })
    }

    /// The place of that point.
    pub(super) fn nearest_place_of(
        &self,
        target: DVec3,
        reach: f64,
        wanted: &dyn Fn(DVec3) -> bool,
    ) -> Option<usize> {
        let (mut least, mut best) = (reach * reach, None);
        self.search(0..self.points.len(), target, least, &mut |place, squared| {
            if squared < least && wanted(self.points[place].position) {
                (least, best) = (squared, Some(place));
            }
            least
        });
        best
    }

    /// Hands each point that is less than `reach` away from a place to `take`, with its distance.
    pub(super) fn within(&self, target: DVec3, reach: f64, take: &mut dyn FnMut(&Point, f64)) {
        let bound = reach * reach;
        self.search(0..self.points.len(), target, bound, &mut |place, squared| {
            if squared < bound {
                take(&self.points[place], squared.sqrt());
            }
            bound
        });
    }

    /// Places in groups of points that lie near each other, in the tree's order: nodes of up to `most` points, each with the middle
    /// point before it.
    pub(super) fn groups(&self, most: usize) -> Vec<Range<usize>> {
        fn ends(node: Range<usize>, most: usize, into: &mut Vec<usize>) {
            if node.len() <= most {
                return into.push(node.end);
            }
            let middle = node.start + node.len() / 2;
            ends(node.start..middle, most, into);
            ends(middle + 1..node.end, most, into);
        }
        let mut found = Vec::new();
        ends(0..self.points.len(), most, &mut found);
        let starts = iter::once(0).chain(found.clone());
        starts.zip(found).map(|(start, end)| start..end).collect()
    }

    /// The places of the points, in the tree's order.
    pub(super) fn positions(&self) -> Vec<DVec3> {
        self.points.iter().map(|point| point.position).collect()
    }

    /// The points in the tree's order, in which neighbors lie near each other; a *place* is an index of it.
    pub(super) fn points(&self) -> &[Point] {
        &self.points
    }

    fn six_distances(&self, place: usize) -> [f64; NEIGHBORS] {
        let mut nearest = [f64::INFINITY; NEIGHBORS];
        let target = self.points[place].position;
        self.search(0..self.points.len(), target, f64::INFINITY, &mut |other, squared| {
            if other != place {
                insert(&mut nearest, squared);
            }
            nearest[NEIGHBORS - 1]
        });
        nearest.map(f64::sqrt)
    }

    /// Hands the places of points and their squared distances from `target` to `take`, those of the nearer side first; points
    /// are left out that are not nearer than what `take` answered last.
    fn search(
        &self,
        node: Range<usize>,
        target: DVec3,
        bound: f64,
        take: &mut impl FnMut(usize, f64) -> f64,
    ) {
        self.search_node(node, DVec3::ZERO, target, bound, take);
    }

    /// [`Tree::search`] in a node that is `outside` from the target along each axis (Arya, Mount, "Algorithms for Fast Vector
    /// Quantization", 1993): planes of several axes keep it away together. Answers what `take` did last.
    fn search_node(
        &self,
        node: Range<usize>,
        outside: DVec3,
        target: DVec3,
        bound: f64,
        take: &mut impl FnMut(usize, f64) -> f64,
    ) -> f64 {
        let squared = |place: usize| target.distance_squared(self.points[place].position);
        if node.len() <= LEAF {
            return node.fold(bound, |_, place| take(place, squared(place)));
        }
        let middle = node.start + node.len() / 2;
        let bound = take(middle, squared(middle));
        let axis = usize::from(self.axes[middle]);
        let beyond = target[axis] - self.points[middle].position[axis];
        let (below, above) = (node.start..middle, middle + 1..node.end);
        let (near, far) = if beyond < 0.0 { (below, above) } else { (above, below) };
        let bound = self.search_node(near, outside, target, bound, take);
        let mut beside = outside;
        beside[axis] = beyond;
        // Rounded as the distances are, which for a point of the node are not less then. Not where it is equal: all of many equal
        // points would be searched.
        match beside.length_squared() < bound {
            true => self.search_node(far, beside, target, bound, take),
            false => bound,
        }
    }
}

/// Into the sorted distances, if it is below the largest.
fn insert(nearest: &mut [f64; NEIGHBORS], squared: f64) {
    let mut i = NEIGHBORS;
    while i > 0 && squared < nearest[i - 1] {
        if i < NEIGHBORS {
            nearest[i] = nearest[i - 1];
        }
        i -= 1;
    }
    if i < NEIGHBORS {
        nearest[i] = squared;
    }
}

/// Brings the points into the order of the tree.
fn halve(points: &mut [Point], axes: &mut [u8], threads: usize) {
    if points.len() <= LEAF {
        return;
    }
    let axis = longest_axis(points);
    let middle = points.len() / 2;
    points.select_nth_unstable_by(middle, |a, b| {
        let along = a.position[axis].total_cmp(&b.position[axis]);
        along.then(a.number.cmp(&b.number))
    });
    let of_middle = axis as u8;
    axes[middle] = of_middle;
    let parallel = threads > 1 && points.len() > 2 * POINTS_PER_THREAD;
    // The middle point stays where it is and belongs to no half.
    let (below, above) = points.split_at_mut(middle);
    let (axes_below, axes_above) = axes.split_at_mut(middle);
    let (above, axes_above) = (&mut above[1..], &mut axes_above[1..]);
    if parallel {
        thread::scope(|scope| {
            scope.spawn(|| halve(below, axes_below, threads / 2));
            halve(above, axes_above, threads - threads / 2);
        });
    } else {
        halve(below, axes_below, 1);
        halve(above, axes_above, 1);
    }
}

fn longest_axis(points: &[Point]) -> usize {
    let first = points.first().map_or(DVec3::ZERO, |point| point.position);
    let (low, high) = points
        .iter()
        .fold((first, first), |(low, high), point| (low.min(point.position), high.max(point.position)));
    (high - low).max_position()
}

fn threads(points: usize) -> usize {
    let useful = points.div_ceil(POINTS_PER_THREAD);
    thread::available_parallelism().map_or(1, NonZero::get).min(useful).max(1)
}
