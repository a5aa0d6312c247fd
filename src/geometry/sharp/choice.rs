//! What a pass chooses from: the cheapest goes first.

use std::cmp::Ordering;

use rayon::slice::ParallelSliceMut as _;

use super::fit::Fitted;

/// A vertex that may go.
pub(super) struct Candidate {
    pub from: u32,
    pub best: Target,
    /// Of one within a ridge; apart, so that all the others are small where they are sorted.
    pub piece: Option<Box<NewPiece>>,
}

/// What a ridge becomes without a vertex.
pub(super) struct NewPiece {
    pub ends: [u32; 2],
    pub fitted: Fitted,
}

impl NewPiece {
    pub fn other_end(&self, end: u32) -> u32 {
        if self.ends[0] == end { self.ends[1] } else { self.ends[0] }
    }
}

/// A vertex onto which another may go.
#[derive(Clone, Copy)]
pub(super) struct Target {
    /// The price, and a millionth of the squared length of the edge: where a surface is flat, short ones go first.
    pub rank: f64,
    pub price: f64,
    pub to: u32,
}

impl Target {
    pub fn comes_before(&self, other: &Self) -> bool {
        self.rank.total_cmp(&other.rank).then(self.to.cmp(&other.to)).is_lt()
    }
}

/// Brings the cheapest, so many of them, to the front in their order; how many these are.
pub(super) fn sort_cheapest(candidates: &mut [Candidate], most: usize) -> usize {
    let order = |a: &Candidate, b: &Candidate| a.best.rank.total_cmp(&b.best.rank).then(a.from.cmp(&b.from));
    let count = most.min(candidates.len());
    if count < candidates.len() {
        candidates.select_nth_unstable_by(count, order);
    }
    candidates[..count].par_sort_unstable_by(order);
    count
}

/// A choice that was not the first.
pub(super) struct Later {
    pub rank: f64,
    pub candidate: usize,
    pub choice: usize,
}

impl Ord for Later {
    /// The least rank is the greatest.
    fn cmp(&self, other: &Self) -> Ordering {
        other.rank.total_cmp(&self.rank).then(other.candidate.cmp(&self.candidate))
    }
}

impl PartialOrd for Later {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Later {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Later {}
