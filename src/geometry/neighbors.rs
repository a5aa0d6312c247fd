//! The nearest neighbors of points among themselves: a k-d tree (Friedman, Bentley, Finkel, "An Algorithm for Finding Best
//! Matches in Logarithmic Expected Time", 1977).
//!
//! Every node halves its points by number, so that no input makes the tree deep, not even points that are all the same.
//! The tree is the order of its points, and each node's plane goes through its middle one. Distances depend neither on
//! the number of threads nor on the order of the points.

use std::{num::NonZero, ops::Range, thread};

use glam::DVec3;

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
                            *distances = self.nearest(first + j);
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
        let mut best = Nearest { distance: reach * reach, position: DVec3::NAN };
        self.search(0..self.points.len(), target, best.distance, &mut |place, squared| {
            if squared < best.distance {
                best = Nearest { distance: squared, position: self.points[place].position };
            }
            best.distance
        });
        let found = !best.position.is_nan();
        found.then(|| Nearest { distance: best.distance.sqrt(), ..best })
    }

    /// The points in the tree's order, in which neighbors lie near each other; a *place* is an index of it.
    pub(super) fn points(&self) -> &[Point] {
        &self.points
    }

    /// Fills `found` with the squared distances and places of the others nearest to the point at `place`, nearest first.
    /// Where there are fewer, infinite distances stand behind them.
    pub(super) fn nearest_places(&self, place: usize, found: &mut [(f64, u32)]) {
        self.nearest_but(Some(place), self.points[place].position, found);
    }

    /// As [`Tree::nearest_places`] for a place that is no point's.
    pub(super) fn nearest_places_to(&self, target: DVec3, found: &mut [(f64, u32)]) {
        self.nearest_but(None, target, found);
    }

    fn nearest_but(&self, place: Option<usize>, target: DVec3, found: &mut [(f64, u32)]) {
        found.fill((f64::INFINITY, u32::MAX));
        let Some(last) = found.len().checked_sub(1) else { return };
        self.search(0..self.points.len(), target, f64::INFINITY, &mut |other, squared| {
            if Some(other) != place && squared < found[last].0 {
                let mut i = last;
                while i > 0 && squared < found[i - 1].0 {
                    found[i] = found[i - 1];
                    i -= 1;
                }
                found[i] = (squared, other as u32);
            }
            found[last].0
        });
    }

    fn nearest(&self, place: usize) -> [f64; NEIGHBORS] {
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
    /// are left out that are not nearer than what `take` answered last, which is also the answer.
    fn search(
        &self,
        node: Range<usize>,
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
        let bound = self.search(near, target, bound, take);
        // Not where it is equal: all of many equal points would be searched.
        if beyond * beyond < bound { self.search(far, target, bound, take) } else { bound }
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::SplitMix;

    fn distances(positions: &[DVec3]) -> Vec<[f64; NEIGHBORS]> {
        let points = (0..).zip(positions).map(|(number, &position)| Point { position, number }).collect();
        let mut all = vec![[f64::NAN; NEIGHBORS]; positions.len()];
        Tree::new(points).distances(|number, found| all[number as usize] = found, |_| {});
        all
    }

    fn brute_force(positions: &[DVec3], of: usize) -> [f64; NEIGHBORS] {
        let others = positions.iter().enumerate().filter(|(other, _)| *other != of);
        let mut all: Vec<f64> = others.map(|(_, p)| p.distance_squared(positions[of]).sqrt()).collect();
        all.sort_by(f64::total_cmp);
        all.resize(NEIGHBORS.max(all.len()), f64::INFINITY);
        std::array::from_fn(|i| all[i])
    }

    #[test]
    fn distances_are_those_of_brute_force() {
        let mut random = SplitMix(5);
        let mut unit = move || random.unit();
        for count in [0, 1, 2, 6, 7, LEAF, LEAF + 1, 50, 2000] {
            // In space, on a plane, on a grid with many equal coordinates, and at one place with a few elsewhere.
            let space: Vec<_> = (0..count).map(|_| DVec3::new(unit(), unit(), unit())).collect();
            let plane: Vec<_> = space.iter().map(|p| DVec3::new(p.x, 3.0, 1e6 * p.z)).collect();
            let grid: Vec<_> = space.iter().map(|p| (*p * 4.0).floor()).collect();
            let heap: Vec<_> = space.iter().map(|p| if p.x < 0.9 { DVec3::ONE } else { *p }).collect();
            for positions in [space, plane, grid, heap] {
                for (i, found) in distances(&positions).into_iter().enumerate() {
                    assert_eq!(found, brute_force(&positions, i), "{count} points, {i}");
                }
            }
        }
    }

    #[test]
    fn the_nearest_to_a_place_is_that_of_brute_force_within_reach() {
        let mut random = SplitMix(6);
        let mut place = move || DVec3::new(random.unit(), random.unit(), random.unit());
        for count in [0, 1, LEAF, 50, 2000] {
            let points: Vec<_> = (0..count).map(|_| place()).collect();
            let numbered = (0..).zip(&points).map(|(number, &position)| Point { position, number });
            let tree = Tree::new(numbered.collect());
            for reach in [0.02, 0.2, f64::INFINITY] {
                for _ in 0..50 {
                    let target = 1.2 * place();
                    let near = points.iter().map(|p| p.distance_squared(target).sqrt()).fold(reach, f64::min);
                    let found = tree.nearest_to(target, reach);
                    assert_eq!(found.map(|n| n.distance), (near < reach).then_some(near), "{count} {reach}");
                    assert!(found.is_none_or(|n| n.position.distance_squared(target).sqrt() == n.distance));
                }
            }
        }
    }

    #[test]
    fn many_points_on_several_threads_and_all_at_one_place() {
        // Enough for threads when building and for two batches. Along a line every distance is known.
        let count = BATCH + 4 * POINTS_PER_THREAD;
        let line: Vec<_> = (0..count).map(|i| DVec3::X * ((i * 7919) % count) as f64).collect();
        for (i, found) in distances(&line).into_iter().enumerate() {
            let at = line[i].x;
            let from_end = at.min((count - 1) as f64 - at);
            if from_end >= 3.0 {
                assert_eq!(found, [1.0, 1.0, 2.0, 2.0, 3.0, 3.0], "{i}");
            }
        }
        // Would take hours if equal points were searched on both sides of every plane.
        let heap = vec![DVec3::splat(0.1); count];
        assert!(distances(&heap).into_iter().all(|found| found == [0.0; NEIGHBORS]));
    }
}
