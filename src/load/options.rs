//! How files are read: what they may hold at most, and what the user says of them.

use super::{Columns, Input};
use crate::{
    error::Result,
    notes::{Deed, Note},
};

/// How files are read.
#[derive(Clone, Debug, Default)]
pub struct LoadOptions {
    /// What a file may hold.
    pub limits: Limits,
    /// Files that a file names may lie outside of its folder.
    pub allow_outside: bool,
    /// What the columns of rows of numbers are; `None`: as the file's header or their number tells it.
    pub columns: Option<Columns>,
}

impl LoadOptions {
    /// That the columns which the user names are of no use, where there are some, for a file that has no rows of numbers.
    pub fn columns_unused(&self) -> Option<Note> {
        let what = "choice of columns (--columns, of a file without rows of numbers)";
        Note::of(Deed::Ignored, self.columns.is_some().into(), what)
    }
}

/// What a file may hold at most: more is refused before memory is taken for it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Points or vertices; their numbers are kept in 32 bits.
    pub points: u64,
    /// Triangles.
    pub faces: u64,
    /// Bytes of a line of text.
    pub line_bytes: usize,
    /// Bytes of a header of text.
    pub header_bytes: usize,
    /// Corners of one polygon. A strip of triangles may have as many as `faces` allows.
    pub list_items: usize,
    /// Bytes of standard input, of which no size is known beforehand.
    pub piped_bytes: u64,
    /// Bytes to which the compressed points of any LAZ or PCD file may expand, however small it is.
    pub expanded_bytes: u64,
    /// As [`Limits::expanded_bytes`], for files that are compressed as a whole, by gzip or zstd, and for nodes of Potree.
    pub unpacked_bytes: u64,
    /// Bytes to which each byte of a larger compressed file may expand beyond these.
    pub expansion: u64,
    /// As [`Limits::expansion`], for the records of LAZ files, whose flat terrains compress better than others.
    pub laz_expansion: u64,
}

impl Limits {
    /// The limits unless told otherwise.
    pub const DEFAULT: Self = Self {
        points: u32::MAX as u64,
        faces: u32::MAX as u64,
        line_bytes: 1 << 20,
        header_bytes: 1 << 20,
        list_items: 1 << 20,
        piped_bytes: 16 << 30,
        expanded_bytes: 32 << 20,
        // Points of three bytes become splats of 25 times as much: together less than 64 MiB.
        unpacked_bytes: 2 << 20,
        // Text becomes a tenth, seldom less.
        expansion: 16,
        laz_expansion: 32,
    };
}

impl Default for Limits {
    fn default() -> Self {
        Self::DEFAULT
    }
}

impl Limits {
    /// Refuses a number of points.
    pub(super) fn check_points(&self, input: &Input<'_>, points: u64) -> Result<()> {
        match points <= self.points {
            true => Ok(()),
            false => Err(input.fault("", format!("{points} points; expected at most {}", self.points))),
        }
    }

    /// Bytes to which this many compressed ones may expand, each to `expansion`.
    pub(super) fn expanded(&self, compressed: usize, expansion: u64) -> u64 {
        expansion.saturating_mul(compressed as u64).saturating_add(self.expanded_bytes)
    }

    /// As [`Limits::expanded`], for files that are compressed as a whole, and nodes of Potree.
    pub(super) fn unpacked(&self, compressed: usize) -> u64 {
        self.expansion.saturating_mul(compressed as u64).saturating_add(self.unpacked_bytes)
    }
}
