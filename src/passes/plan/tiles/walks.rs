//! How records are cut into segments and pieces of these, over which the device walks to list them by tile (`glsl/tile/walk.glsl`).

use crate::{
    passes::plan::{invocations::Invocations, tiles::TilePlan},
    shaders::config::*,
};

/// Iterations of all loops of a shader's run together, after which llvmpipe ends them silently, with some in reserve.
pub(super) const MOST_ITERATIONS: u32 = 60_000;

/// By so many times more iterations than others splats that clip curves cut have at most (`glsl/tile/surface.glsl`): of 8, which are one step of a loop, columns take two in each of four steps, and
/// each step is a loop over two curves; pixels take each in one over two.
pub(super) const CLIPPED_ITERATIONS: u32 = 17;

/// Segments: enough to keep a CPU's cores busy with vectors of 8, and few enough that their counts of all tiles stay small.
const SEGMENTS: u32 = 32;

/// Pieces of a segment at most, where workgroups walk: the more, the busier is a GPU, and the more memory their counts take: so many bytes at most, unless
/// those of segments take more.
const MOST_PIECES: u64 = 4;
const MOST_BYTES_OF_PIECES: u64 = 64 << 20;

/// Blocks of a segment at least: of few splats, most of the work is to add up counts that are 0.
const LEAST_BLOCKS: u32 = 4;

/// Segments of so many blocks of records, where there is room for the counts of some.
pub(super) fn segments_of(blocks: u32, with_room: u64) -> u32 {
    let with_work = blocks.div_ceil(LEAST_BLOCKS).next_multiple_of(BIN_GROUP_SIZE).min(SEGMENTS);
    with_room.min(u64::from(with_work)) as u32
}

/// Pieces of a segment, for so many bins.
pub(super) fn pieces_of(invocations: Invocations, bins: u64, most_bytes: u64) -> u32 {
    let most_bytes = MOST_BYTES_OF_PIECES.min(most_bytes);
    let most = if invocations.walk_together() { MOST_PIECES } else { 1 };
    (most_bytes / 4 / u64::from(SEGMENTS) / bins).clamp(1, most) as u32
}

/// Records of one walk of which each has so many tiles. Where a workgroup walks, an invocation does a 64th of these tiles, with up to 84 iterations for each.
pub(super) fn round_length(invocations: Invocations, most_tiles: u32) -> u32 {
    let iterations = if invocations.walk_together() { MOST_ITERATIONS / 4 * 3 } else { MOST_ITERATIONS };
    iterations / most_tiles.max(1)
}

impl TilePlan {
    /// Walks that go over all records.
    pub(crate) fn walks(&self) -> u32 {
        self.segments * self.pieces
    }

    /// Bins that walks count in: two lists of a tile are one where each has room in half a word, and no invocations add to it at once.
    pub(crate) fn count_bins(&self) -> u32 {
        let in_halves = self.parted_by() != 0
            && !self.invocations.walk_together()
            && self.record_count < 1 << HALF_COUNT_BITS;
        if in_halves { self.tile_count + self.chunk_count } else { self.bin_count() }
    }

    /// Bytes of what each walk counts in bins.
    pub(crate) fn count_bytes(&self) -> u64 {
        self.bytes_of_counts(self.pieces)
    }

    /// The same where segments have so many pieces.
    pub(super) fn bytes_of_counts(&self, pieces: u32) -> u64 {
        u64::from(self.segments) * u64::from(pieces) * u64::from(self.count_bins()) * 4
    }
}
