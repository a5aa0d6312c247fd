//! Many points nearest to a place, in no order.
//!
//! A sorted list of 48 takes longer to keep than the tree takes to search. All points within a distance are taken instead, without a branch, and the
//! nearest of them chosen. The distance is a guess from the place before, which lies near in most cases; where it was too short, one that is
//! long enough is taken from as many points that are beside each other in the order of the tree. What is found does not depend on the guess.

use std::ops::Range;

use glam::DVec3;

use super::{
    Tree,
    nearest::{LEAF, PLACE},
};

/// The guess, in squared distances of the farthest that was found before: half as many more points, where all else is equal.
const GUESS: f64 = 1.5;

/// Looks for the points nearest to one place after another, in the same memory.
#[derive(Default)]
pub(in crate::geometry) struct Many {
    /// As those of `nearest.rs`, which are compared as whole numbers here.
    keys: Vec<u64>,
    /// The squared distance of the farthest that was found last.
    farthest: f64,
    offsets: Vec<DVec3>,
}

impl Many {
    /// The offsets of the `count` points that are nearest to a place, in no order; all where there are fewer.
    pub(in crate::geometry) fn nearest(&mut self, tree: &Tree, target: DVec3, count: usize) -> &[DVec3] {
        let enough = tree.enough(target, count);
        for bound in [enough.min(GUESS * self.farthest), enough] {
            self.keys.clear();
            tree.within_squared(0..tree.points.len(), DVec3::ZERO, target, bound, &mut self.keys);
            if self.keys.len() >= count {
                break;
            }
        }
        if self.keys.len() > count {
            self.keys.select_nth_unstable(count - 1);
            self.keys.truncate(count);
        }
        self.farthest = f64::from_bits(self.keys.iter().copied().max().unwrap_or(0) | PLACE);
        self.take_offsets(tree, target)
    }

    /// Those that were found last, nearest first.
    pub(in crate::geometry) fn sorted(&mut self, tree: &Tree, target: DVec3) -> &[DVec3] {
        self.keys.sort_unstable();
        self.take_offsets(tree, target)
    }

    fn take_offsets(&mut self, tree: &Tree, target: DVec3) -> &[DVec3] {
        self.offsets.clear();
        let place = |key: &u64| tree.points[(key & PLACE) as usize].position - target;
        self.offsets.extend(self.keys.iter().map(place));
        &self.offsets
    }
}

impl Tree {
    /// A squared distance within which there are at least so many points, if there are as many at all.
    fn enough(&self, target: DVec3, count: usize) -> f64 {
        let (mut start, mut end) = (0, self.points.len());
        while end - start > count {
            let middle = start + (end - start) / 2;
            let axis = usize::from(self.axes[middle]);
            match target[axis] < self.points[middle].position[axis] {
                true => end = middle,
                false => start = middle + 1,
            }
        }
        let first = (start + (end - start) / 2).saturating_sub(count / 2);
        let first = first.min(self.points.len().saturating_sub(count));
        let Some(beside) = self.points.get(first..first + count) else { return f64::MAX };
        let squared = beside.iter().map(|point| target.distance_squared(point.position));
        squared.fold(0.0, f64::max).min(f64::MAX)
    }

    /// The keys of the points of a node that are no farther than a squared distance.
    fn within_squared(
        &self,
        node: Range<usize>,
        outside: DVec3,
        target: DVec3,
        bound: f64,
        keys: &mut Vec<u64>,
    ) {
        if node.len() <= LEAF {
            let (mut within, mut count) = ([0; LEAF], 0);
            for (place, point) in node.clone().zip(&self.points[node]) {
                let squared = target.distance_squared(point.position);
                within[count % LEAF] = squared.to_bits() & !PLACE | place as u64;
                count += usize::from(squared <= bound);
            }
            return keys.extend_from_slice(&within[..count]);
        }
        let middle = node.start + node.len() / 2;
        let axis = usize::from(self.axes[middle]);
        let beyond = target[axis] - self.points[middle].position[axis];
        let (below, above) = (node.start..middle, middle + 1..node.end);
        let (near, far) = if beyond < 0.0 { (below, above) } else { (above, below) };
        self.within_squared(near, outside, target, bound, keys);
        if beyond * beyond <= bound {
            self.within_squared(middle..middle + 1, outside, target, bound, keys);
            let mut beside = outside;
            beside[axis] = beyond;
            if beside.length_squared() <= bound {
                self.within_squared(far, beside, target, bound, keys);
            }
        }
    }
}
