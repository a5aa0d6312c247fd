//! An element that is read past.

use ply_rs_bw::ply::PropertyAccess;

/// Keeps nothing.
pub(super) struct Skipped;

impl PropertyAccess for Skipped {
    fn new() -> Self {
        Self
    }
}
