//! Tiles with more splats than one dispatch takes: a part after the other, with depths and sums kept in the images.
//!
//! llvmpipe ends the loops of a shader after 65535 iterations without a word, and all splats of a scene seen from afar may
//! fall into one tile. So many dispatches are recorded as the whole scene in one tile would need; for most frames the device
//! finds that there is no such tile, and leaves each of them out.

use ash::vk;

use crate::passes::{pipeline::constants::TileConstants, tiles::dispatch::TileDispatch};
use crate::{error::Result, shaders::config::*};

/// Why a frame has passes for them.
pub(crate) const WHY: &str = "a tile may have more splats than one dispatch takes";

/// Pixels of an image that has room for so many tiles.
pub(crate) fn extent_of_slots(tiles: u32, [tile_width, tile_height]: [u32; 2]) -> vk::Extent2D {
    vk::Extent2D {
        width: tiles.min(SLOTS_IN_ROW) * tile_width,
        height: tiles.div_ceil(SLOTS_IN_ROW) * tile_height,
    }
}

/// Records the dispatches of a pass: perhaps of whole tiles, then of all parts of overflow ones.
pub(crate) fn in_parts(pass: &TileDispatch<'_, '_>, whole: bool, parts: u32) -> Result<()> {
    if whole {
        pass.whole_tiles(pass.constants)?;
    }
    let part = |part| TileConstants { part, ..pass.constants };
    pass.indirect_in_turn((0..parts).map(part), ARGUMENTS_OVERFLOW)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn images_of_slots_have_a_place_for_each_and_are_no_larger_than_devices_have_to_take() {
        for tiles in [1, 2, 255, 256, 257, 280, 5000] {
            let vk::Extent2D { width, height } = extent_of_slots(tiles, [8, 4]);
            assert!(width <= 4096 && height <= 4096, "{tiles}");
            let last = [(tiles - 1) % 256, (tiles - 1) / 256];
            assert!((last[0] + 1) * 8 <= width && (last[1] + 1) * 4 == height, "{tiles}: {width}x{height}");
        }
    }
}
