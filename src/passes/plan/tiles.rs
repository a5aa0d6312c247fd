//! What is decided on the host about drawing splats by tiles: how records are cut into segments, how much room lists have.

mod image_tiles;
pub(crate) mod rows;
mod walks;

use std::ops::Range;

use crate::passes::plan::invocations::Invocations;
use crate::passes::plan::tiles::{
    image_tiles::ImageTiles,
    rows::tile_rows,
    walks::{CLIPPED_ITERATIONS, MOST_ITERATIONS, pieces_of, round_length, segments_of},
};
use crate::{shaders::config::*, vk::Limits};

/// Bits of a tile's column or row in a tile rect at least; what is left of [`RECT_SIDE_BITS`] is for how many tiles a splat touches
/// along a side. As few are taken as have room for the image: of up to 1536 pixels along a side, every splat has room.
const LEAST_PLACE_BITS: u32 = 8;

/// Chunks that tile rects can tell apart.
const MOST_CHUNKS: u32 = u32::MAX - RECT_CHUNK;

/// Tiles along a side that a splat of a record touches at most: `MOST_MORE` of `glsl/tile/rect.glsl`, and one.
fn most_tiles_a_side(place_bits: u32) -> u32 {
    3 << (RECT_SIDE_BITS - place_bits - 2)
}

/// Entries of lists that there is room for at least, where the device allows it; for each splat; and for each pixel: as much as
/// sums of 16 bits take.
const LEAST_ENTRIES: u64 = 16 << 20;
const ENTRIES_A_SPLAT: u64 = 16;
const ENTRIES_A_PIXEL: u64 = 4;

/// Walks over all segments, one after the other, unless splats touch [`MOST_OF_MANY`] tiles at most; and where no splat is left to the graphics
/// pipeline then, so that all can cover pixels in part.
const MOST_ROUNDS: u32 = 16;
const MOST_ROUNDS_OF_ALL: u32 = 64;
const MOST_OF_MANY: u64 = 64;

/// The bytes of a quarter of a record, each quarter in a buffer of its own.
pub(crate) const RECORD_BYTES: u64 = 16;

/// Four quarters and a rect; an index, a bit, and a 32nd of a count.
fn bytes_of_records(records: u64) -> u64 {
    records * (4 * RECORD_BYTES + 4) + records * 4 + records / 4
}

/// How splats are drawn by tiles.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TilePlan {
    /// Tiles along a row.
    pub tiles_x: u32,
    /// The rows that it is for: all of the image, or a band.
    pub rows: Range<u32>,
    /// Tiles of these.
    pub tile_count: u32,
    /// Splats of all chunks, or of their blocks that may be seen, at most.
    pub record_count: u32,
    /// Records that there is room for.
    pub record_room: u64,
    /// Chunks.
    pub chunk_count: u32,
    /// Segments of records.
    pub segments: u32,
    /// Pieces of each, which one walk goes over.
    pub pieces: u32,
    /// Records of one.
    pub segment_length: u32,
    /// Records that are walked over in one dispatch.
    pub round_length: u32,
    /// Bits of a column or row of tiles in a tile rect.
    pub place_bits: u32,
    /// Tiles that a splat of a record touches at most.
    pub most_tiles: u32,
    /// Entries of all lists together that there is room for.
    pub entry_room: u64,
    /// Entries over which a dispatch can walk twice.
    pub walk_length: u32,
    /// Entries of a tile up to which one dispatch does all of it.
    pub part_length: u32,
    /// Layers that one dispatch does of such a tile.
    pub layers_at_once: u32,
    /// Some splats may be too large for a record or not regular, and are left to the graphics pipeline.
    pub may_be_large: bool,
    /// In some band of the image a tile may have more entries than one dispatch takes, so that sums need 32 bits in all.
    pub overflows_somewhere: bool,
    /// What a tile's visible depth hides is not summed.
    pub hidden: bool,
    /// Surfaces are told apart by the side that they show.
    pub two_sided: bool,
    /// Some splats lie at borders, and reach further than their rims.
    pub reaches: bool,
    /// Levels of detail blend into each other.
    pub blended: bool,
    /// Clip curves cut something off some splats.
    pub clips: bool,
    /// Planes may.
    pub planes: bool,
    /// Polygons beside them cover pixels in part.
    pub samples_polygons: bool,
    /// What they draw, and how they come by splats.
    pub invocations: Invocations,
}

impl TilePlan {
    /// Bytes of records and lists, and of the lists of splats that may be seen which they are made from.
    pub fn bytes(&self) -> u64 {
        let of_records = bytes_of_records(self.record_room);
        of_records + self.clip_bytes() + self.entry_room * 4 + self.bytes_of_bins(self.pieces)
    }

    /// Bytes of what there is of each tile, whatever splats it has, where segments have so many pieces.
    pub(crate) fn bytes_of_bins(&self, pieces: u32) -> u64 {
        // Starts, tiles with splats, runs, overflow tiles.
        self.bytes_of_counts(pieces) + u64::from(self.bin_count()) * 4 + u64::from(self.tile_count) * 16
    }

    /// Bytes of one splat's record and entries, whose box has so many pixels.
    pub(crate) fn bytes_of_one(&self, box_px: f64) -> u64 {
        let of_clips = if self.clips { u64::from(CLIP_RECORD_VECTORS) * RECORD_BYTES } else { 0 };
        bytes_of_records(1) + of_clips + 4 * self.image_tiles().of(box_px).min(self.most_tiles.into())
    }

    /// Bytes of the clip curves of records.
    pub(crate) fn clip_bytes(&self) -> u64 {
        if self.clips { self.record_room * u64::from(CLIP_RECORD_VECTORS) * RECORD_BYTES } else { 0 }
    }

    /// The plan for rows of an image, and so many chunks with so many splats of boxes up to so many pixels.
    pub(crate) fn of_boxes(
        chunks: usize,
        boxes: impl Iterator<Item = (u32, f64)> + Clone,
        ([width, height], rows): ([u32; 2], Range<u32>),
        limits: &Limits,
        invocations: Invocations,
    ) -> Option<Self> {
        let range = limits.max_storage_buffer_range;
        // A record, or an entry, is a texel of each buffer that it is in.
        let most_texels = if invocations.fetch_texels() { u64::from(limits.max_texels) } else { u64::MAX };
        let records: u64 = boxes.clone().map(|(count, _)| u64::from(count)).sum();
        let all_rows = 0..height.div_ceil(BAND_ROW);
        let (tiles_x, tiles_y) = (width.div_ceil(TILE_WIDTH), tile_rows(all_rows.end, invocations));
        let tile_count = tiles_x * tiles_y;
        let bins = u64::from(tile_count) + chunks as u64;
        let segments_with_room = range / 4 / bins / u64::from(BIN_GROUP_SIZE) * u64::from(BIN_GROUP_SIZE);
        let most_records = (range / RECORD_BYTES).min(most_texels);
        let refused = records == 0
            || records > most_records
            || chunks > MOST_CHUNKS as usize
            || segments_with_room == 0;
        if refused {
            return None;
        }
        let has_places = |bits: &u32| tiles_x.max(tiles_y) <= 1 << bits;
        let place_bits = (LEAST_PLACE_BITS..=MOST_PLACE_BITS).find(has_places)?;
        let most_a_side = most_tiles_a_side(place_bits);
        let record_count = u32::try_from(records).ok()?;
        let blocks = record_count.div_ceil(SEGMENT_BLOCK);
        let segments = segments_of(blocks, segments_with_room);
        let segment_length = blocks.div_ceil(segments) * SEGMENT_BLOCK;
        let of_pixels = u64::from(width) * u64::from(height) * ENTRIES_A_PIXEL;
        let room =
            (records * ENTRIES_A_SPLAT).max(LEAST_ENTRIES).max(of_pixels).min(range / 4).min(most_texels);
        // Rounds are as long as if each of their records had the most; there must not be too many.
        let in_rounds = |rounds: u32| u64::from(rounds * MOST_ITERATIONS / segment_length).max(MOST_OF_MANY);
        // A splat that is left to the graphics pipeline has an entry, too.
        let image = ImageTiles { along: [tiles_x, tiles_y], invocations };
        let own_rows = tile_rows(rows.end - rows.start, invocations);
        let tiles = ImageTiles { along: [tiles_x, own_rows], invocations };
        let entries = |most: u64| -> u64 {
            boxes.clone().map(|(count, px)| u64::from(count) * tiles.of(px).min(most)).sum()
        };
        let largest = boxes.clone().map(|(_, px)| px).fold(0.0, f64::max);
        let of_largest = tiles.of(largest);
        // What has no bound may come near the eye.
        let has_rect =
            largest.is_finite() && image.along(largest).iter().all(|a_side| *a_side <= most_a_side.into());
        let is_few = has_rect && of_largest <= in_rounds(MOST_ROUNDS_OF_ALL);
        let of_all = is_few.then(|| entries(of_largest)).filter(|of_all| *of_all <= room);
        let most_of_all = u64::from(most_a_side * most_a_side).min(in_rounds(MOST_ROUNDS));
        // As many as there is room for if all have them; or as they have, where there is room for all.
        let most_tiles = match of_all {
            Some(_) => of_largest,
            None if entries(most_of_all) <= room => most_of_all.min(of_largest),
            None => most_of_all.min(room / records),
        };
        let entry_room = of_all.unwrap_or_else(|| entries(most_tiles));
        let most_tiles = most_tiles as u32;
        let walk_length = TILE_BATCH * MOST_ITERATIONS / 2;
        let whole = Self {
            tiles_x,
            rows: all_rows,
            tile_count,
            record_count,
            record_room: records,
            chunk_count: chunks as u32,
            segments,
            pieces: pieces_of(invocations, bins, range),
            segment_length,
            round_length: round_length(invocations, most_tiles).min(segment_length),
            place_bits,
            most_tiles,
            entry_room,
            walk_length,
            part_length: walk_length,
            layers_at_once: 1,
            may_be_large: of_all.is_none(),
            overflows_somewhere: false,
            hidden: false,
            two_sided: false,
            reaches: false,
            blended: false,
            samples_polygons: false,
            clips: false,
            planes: false,
            invocations,
        };
        Some(whole.within(rows))
    }

    /// The plan for splats of which clip curves or planes cut off something; none where the curves have no room.
    fn cut_by(self, clips: bool, planes: bool, limits: &Limits) -> Option<Self> {
        let walk_length = if clips { self.walk_length / CLIPPED_ITERATIONS } else { self.walk_length };
        let plan = Self { clips, planes, walk_length, part_length: walk_length, ..self };
        let texels = plan.clip_bytes() / RECORD_BYTES;
        let fit = plan.clip_bytes().max(plan.count_bytes()) <= limits.max_storage_buffer_range
            && (!plan.invocations.fetch_texels() || texels <= limits.max_texels.into());
        fit.then_some(plan)
    }

    /// The plan for what leaves out hidden splats: it walks three times.
    fn without_hidden(self) -> Self {
        let walk_length = self.walk_length / 3 * 2;
        Self { hidden: true, walk_length, part_length: walk_length, ..self }
    }

    /// The plan for what covers pixels in part where it ends: what one surface hides, the next may show.
    /// `two_sided`: some splats that face away are drawn. `reaches`: some lie at borders. `blended`: levels of detail blend into each other. `samples_polygons`: polygons beside them end so, too.
    pub(crate) fn with_edges(
        self,
        (two_sided, reaches): (bool, bool),
        blended: bool,
        samples_polygons: bool,
    ) -> Self {
        Self { hidden: false, two_sided, reaches, blended, samples_polygons, ..self }
    }

    /// The bins of all lists: of tiles, then of chunks.
    pub fn bin_count(&self) -> u32 {
        self.first_chunk_bin() + self.chunk_count
    }

    /// What cuts some splats, as shaders are told: then each tile has a list of these apart from that of others.
    pub(crate) fn parted_by(&self) -> u32 {
        u32::from(self.clips) * PARTED_CURVES + u32::from(self.planes) * PARTED_PLANES
    }

    /// The bins of tiles: where something cuts some splats, two each.
    pub fn first_chunk_bin(&self) -> u32 {
        if self.parted_by() != 0 { 2 * self.tile_count } else { self.tile_count }
    }

    /// A tile's pixels along both sides.
    pub(crate) fn tile_px(&self) -> [u32; 2] {
        [TILE_WIDTH, self.invocations.tile_height()]
    }

    /// The plan for so many layers at most, each of which walks twice, under so many lights: up to 16 layers in one dispatch, or of
    /// more 4 in each. Every step of the last layer's walk is a loop over the lights, too; so is every pixel of a layer, for which
    /// there is the reserve. `two_sided`: each is of one side.
    pub fn with_layers(self, most: u32, lights: u32, two_sided: bool) -> Self {
        let layers_at_once = if most <= 16 { most } else { 4 };
        let walk_length = self.walk_length / (1 + lights);
        Self { layers_at_once, walk_length, part_length: walk_length / layers_at_once, two_sided, ..self }
    }

    /// Whether a tile may have more splats than one dispatch takes.
    pub fn may_overflow(&self) -> bool {
        self.overflows_somewhere || self.record_count > self.part_length
    }

    /// Parts of a tile that has all splats.
    pub fn parts(&self) -> u32 {
        self.record_count.div_ceil(self.walk_length)
    }

    /// The same; none where no tile can overflow.
    pub fn parts_of_overflow(&self) -> u32 {
        if self.may_overflow() { self.parts() } else { 0 }
    }

    /// Tiles that may overflow at once.
    pub fn most_overflow(&self) -> u64 {
        (self.entry_room / u64::from(self.part_length)).clamp(1, self.tile_count.into())
    }
}

#[cfg(test)]
mod tests;
