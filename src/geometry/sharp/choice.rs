//! What a pass chooses from: the cheapest goes first.

use std::cmp::Ordering;

use super::fit::Fitted;

/// A vertex that may go.
pub(super) struct Candidate {
    pub from: u32,
    pub best: Target,
    /// Of one within a ridge.
    pub piece: Option<NewPiece>,
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
