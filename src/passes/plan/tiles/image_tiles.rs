//! How many of an image's tiles a splat's box touches.

use crate::{math::size::pixels_along, passes::plan::invocations::Invocations, shaders::config::TILE_WIDTH};

/// The tiles of an image: along its rows, along its columns.
#[derive(Clone, Copy)]
pub(super) struct ImageTiles {
    pub along: [u32; 2],
    pub invocations: Invocations,
}

impl ImageTiles {
    /// Tiles that a box of so many pixels touches at most, along each side: one more for each tile's pixels beyond the first, up to all of the image.
    pub fn along(self, box_px: f64) -> [u64; 2] {
        let px = pixels_along(box_px);
        let touched = |tile_px: u32, all: u32| {
            let tiles = ((px + u64::from(tile_px) - 2) >> tile_px.trailing_zeros()) + 1;
            tiles.min(all.into())
        };
        [touched(TILE_WIDTH, self.along[0]), touched(self.invocations.tile_height(), self.along[1])]
    }

    /// All that such a box touches at most.
    pub fn of(self, box_px: f64) -> u64 {
        self.along(box_px).into_iter().product()
    }
}
