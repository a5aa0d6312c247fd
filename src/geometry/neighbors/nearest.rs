//! The places nearest to one, in order.
//!
//! **Keys.** A squared distance and a place are one positive number: the upper half of the distance's bits above those of the place.
//! Such numbers are sorted as their distances are, and a number enters a sorted list by a minimum and a maximum at each place of it,
//! without a branch that a processor could guess wrong. Distances that differ by less than a millionth count as equal, and of such that were looked
//! at the lower place comes first; so do those below 1e-154, whose squares are no normal numbers.

use std::ops::Range;

use glam::DVec3;

use super::Tree;

/// Nodes of so many points are not looked into: it takes longer to guess which of them are near than to look at all.
pub(super) const LEAF: usize = 16;

/// The bits of a key that are a place.
pub(super) const PLACE: u64 = 0xffff_ffff;

/// What stands behind those that were found, where there are fewer: no key is larger, and its place is `u32::MAX`.
const NONE: f64 = f64::MAX;

/// The `K` nearest to a place.
struct Search<'a, const K: usize> {
    tree: &'a Tree,
    target: DVec3,
    /// The place that is not looked for; `usize::MAX` for none.
    but: usize,
    /// Sorted.
    keys: [f64; K],
}

impl Tree {
    /// The places of the others nearest to the point at `place`, nearest first; behind them `u32::MAX`, where there are fewer.
    pub(in crate::geometry) fn nearest_places<const K: usize>(&self, place: usize) -> [u32; K] {
        let target = self.points[place].position;
        // Those beside it in the order of the tree are near: as many as are looked for are no farther than the farthest of these, and what
        // is beyond need not be sorted. It changes nothing of what is found.
        let first = place.saturating_sub(K / 2).min(self.points.len().saturating_sub(K + 1));
        let beside = self.points.get(first..first + K + 1).map_or(NONE, |beside| {
            let squared = beside.iter().map(|point| target.distance_squared(point.position));
            f64::from_bits(squared.fold(0.0, f64::max).to_bits() | PLACE)
        });
        self.nearest(target, place, beside)
    }

    /// The places of the points nearest to a place that is no point's.
    pub(in crate::geometry) fn nearest_places_to<const K: usize>(&self, target: DVec3) -> [u32; K] {
        self.nearest(target, usize::MAX, NONE)
    }

    fn nearest<const K: usize>(&self, target: DVec3, but: usize, bound: f64) -> [u32; K] {
        // Infinite distances and those that are no number are beyond any bound.
        let bound = if bound <= NONE { bound } else { NONE };
        let mut search = Search { tree: self, target, but, keys: [bound; K] };
        search.node(0..self.points.len(), DVec3::ZERO);
        search.keys.map(|key| (key.to_bits() & PLACE) as u32)
    }
}

impl<const K: usize> Search<'_, K> {
    /// As `Tree::search_node`.
    fn node(&mut self, node: Range<usize>, outside: DVec3) {
        if node.len() <= LEAF {
            return self.leaf(node);
        }
        let middle = node.start + node.len() / 2;
        let axis = usize::from(self.tree.axes[middle]);
        let beyond = self.target[axis] - self.tree.points[middle].position[axis];
        let (below, above) = (node.start..middle, middle + 1..node.end);
        let (near, far) = if beyond < 0.0 { (below, above) } else { (above, below) };
        self.node(near, outside);
        if beyond * beyond < self.keys[K - 1] {
            self.leaf(middle..middle + 1);
            let mut beside = outside;
            beside[axis] = beyond;
            if beside.length_squared() < self.keys[K - 1] {
                self.node(far, beside);
            }
        }
    }

    /// First those nearer than the last, then each to its place: what a processor guesses is how many there are.
    fn leaf(&mut self, node: Range<usize>) {
        let (mut nearer, mut count) = ([0.0; LEAF], 0);
        let last = self.keys[K - 1];
        for (place, point) in node.clone().zip(&self.tree.points[node]) {
            let squared = self.target.distance_squared(point.position);
            let key = f64::from_bits(squared.to_bits() & !PLACE | place as u64);
            nearer[count % LEAF] = key;
            count += usize::from((key < last) & (place != self.but));
        }
        nearer[..count].iter().for_each(|key| self.insert(*key));
    }

    fn insert(&mut self, key: f64) {
        // As instructions have them: of what is not less, the second.
        let least = |a: f64, b: f64| if a < b { a } else { b };
        let most = |a: f64, b: f64| if a > b { a } else { b };
        for i in (1..K).rev() {
            self.keys[i] = least(self.keys[i], most(key, self.keys[i - 1]));
        }
        self.keys[0] = least(key, self.keys[0]);
    }
}
