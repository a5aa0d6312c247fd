//! Tiles with more splats than one dispatch takes: a part after the other, with depths and sums kept in the images.
//!
//! llvmpipe ends the loops of a shader after 65535 iterations without a word, and all splats of a scene seen from afar may
//! fall into one tile. So many dispatches are recorded as the whole scene in one tile would need; for most frames the device
//! finds that there is no such tile, and leaves each of them out.

use ash::vk;

use super::{TilePass, TilePlan, WHOLE, after_dispatches_before};
use crate::{
    error::Result,
    graph::{ResourceId, execute::PassContext},
};

/// The dispatches of one pass.
pub(super) struct Parts {
    /// Where the numbers of workgroups are.
    pub arguments: ResourceId,
    /// The place of those of all tiles but the overfull; none where those are done elsewhere.
    pub whole: Option<u64>,
    /// The place of those of the overfull tiles.
    pub overfull: u64,
    /// How many parts there may be.
    pub parts: u32,
}

/// How many parts a tile may have; none where it can't be overfull.
pub(super) fn of_parts(plan: &TilePlan) -> u32 {
    if plan.may_be_overfull() { plan.parts() } else { 0 }
}

/// Pixels of an image that has room for so many tiles: `SLOTS_IN_ROW` of `glsl/inc/tiles.glsl` in a row.
pub(super) fn extent_of_slots(tiles: u32, [tile_width, tile_height]: [u32; 2]) -> vk::Extent2D {
    const SLOTS_IN_ROW: u32 = 256;
    vk::Extent2D {
        width: tiles.min(SLOTS_IN_ROW) * tile_width,
        height: tiles.div_ceil(SLOTS_IN_ROW) * tile_height,
    }
}

impl Parts {
    /// Records them.
    pub fn record(&self, context: &PassContext<'_>, pass: &TilePass<'_>) -> Result<()> {
        pass.bind(context)?;
        let arguments = context.buffer(self.arguments)?;
        let dispatch = |part, offset| {
            let mut constants = pass.constants;
            constants.part = part;
            pass.push(context, &constants)?;
            // SAFETY: all is bound that the pipeline needs; the arguments are within the buffer and declared to be read.
            unsafe { context.device().cmd_dispatch_indirect(context.commands(), arguments, offset) };
            Ok::<_, crate::error::Error>(())
        };
        if let Some(whole) = self.whole {
            dispatch(WHOLE, whole)?;
        }
        for part in 0..self.parts {
            if part > 0 {
                after_dispatches_before(context);
            }
            dispatch(part, self.overfull)?;
        }
        Ok(())
    }
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
