//! An object while it is cut into chunks.

use super::{
    levels::{ChunkLevels, Leveled},
    pack::Beside,
};
use crate::scene::{Epsilon, Object};

/// An object on its way.
pub(super) struct Part<'a> {
    /// Its number among all.
    pub number: usize,
    pub object: &'a Object,
    /// What the numbers of its splats are in the object as it came, where that is known; `None`: the same.
    pub numbers: Numbers<'a>,
    pub transparent: bool,
    /// One over the overlap of each splat.
    pub inverse_overlaps: Vec<f32>,
    pub epsilon: Option<Epsilon>,
    /// Of the object's splats, where they have any.
    pub shares: Option<Vec<f32>>,
    /// How a surface with sharp edges turns away near each, and how wide it is; of others none.
    pub bends: Vec<u32>,
    /// Whether each splat lies at a border, where some do.
    pub at_border: Option<Vec<bool>>,
    pub levels: Option<(&'a Leveled, ChunkLevels)>,
}

/// The numbers of splats in the object as it came.
#[derive(Clone, Copy)]
pub(super) enum Numbers<'a> {
    /// Their own.
    Own,
    /// Those at their own.
    Listed(&'a [u32]),
    /// Nobody asks, or nobody knows.
    Unknown,
}

impl Part<'_> {
    /// The numbers of some of its splats.
    pub fn numbered(&self, which: Vec<usize>) -> Option<Vec<u32>> {
        let own = |i: usize| u32::try_from(i).unwrap_or(u32::MAX);
        match self.numbers {
            Numbers::Own => Some(which.into_iter().map(own).collect()),
            Numbers::Listed(numbers) => Some(which.into_iter().map(|i| numbers[i]).collect()),
            Numbers::Unknown => None,
        }
    }

    pub fn beside(&self) -> Beside<'_> {
        Beside {
            shares: self.shares.as_deref(),
            bends: &self.bends,
            at_border: self.at_border.as_deref(),
            inverse_overlaps: Some(&self.inverse_overlaps),
            levels: self.levels,
        }
    }
}
