//! Plans for some rows of the image's tiles: what they need of all that is drawn, and what those of several bands have in common.

use std::ops::Range;

use ash::vk;

use crate::passes::plan::tiles::{TilePlan, image_tiles::ImageTiles, walks::round_length};
use crate::{
    arena::Arena,
    passes::plan::{
        draws::Draw,
        invocations::{Invocations, are_small},
        seen::PotentiallyVisibleBlocks,
    },
    scene::{Settings, TileInvocations},
    shaders::config::*,
    vk::Limits,
};

/// All rows that bands can have.
pub(crate) fn rows_of_image(settings: &Settings) -> Range<u32> {
    all_of(settings.size_px).1
}

/// An image of this size, and all of its rows.
pub(crate) fn all_of(size_px: [u32; 2]) -> ([u32; 2], Range<u32>) {
    (size_px, 0..size_px[1].div_ceil(BAND_ROW))
}

/// Rows of tiles in so many rows of a band.
pub(crate) fn tile_rows(rows: u32, invocations: Invocations) -> u32 {
    rows * (BAND_ROW / invocations.tile_height())
}

/// All that is drawn.
#[derive(Clone, Copy)]
pub struct Drawn<'a> {
    pub draws: &'a [Draw<'a>],
    /// How many splats have boxes up to how many pixels ([`Draw::boxes`]): found once, for they are asked for again and again.
    pub boxes: &'a [(u32, f64)],
}

impl<'a> Drawn<'a> {
    /// These chunks.
    pub fn new(arena: &'a Arena, draws: &'a [Draw<'a>]) -> Self {
        let mut boxes = arena.growing();
        boxes.reserve(draws.iter().map(|draw| draw.chunk.radii.len()).sum());
        boxes.extend(draws.iter().flat_map(|draw| draw.boxes()));
        Self { draws, boxes: boxes.into_bump_slice() }
    }
}

/// What an invocation draws: by all that is drawn, so that all bands have the same.
fn wanted(drawn: Drawn<'_>, settings: &Settings, limits: &Limits) -> Invocations {
    let small = are_small(drawn.boxes.iter().copied(), settings.edges);
    Invocations::of(settings.tile_invocations, limits, small)
}

impl TilePlan {
    /// The plan for what is drawn; none where there is nothing, or more than the device has room for.
    pub fn of(drawn: Drawn<'_>, culls_hidden: bool, settings: &Settings, limits: &Limits) -> Option<Self> {
        let of = |invocations| {
            let (boxes, area) = (drawn.boxes.iter().copied(), all_of(settings.size_px));
            Self::of_boxes(drawn.draws.len(), boxes, area, limits, invocations)
        };
        let wanted = wanted(drawn, settings, limits);
        // Twice as many tiles of a huge image may have no room; in no band then.
        let plan = of(wanted).or_else(|| of(wanted.of_full_height()))?;
        plan.when_drawn(drawn.draws, culls_hidden, limits)
    }

    /// This one, of all rows, or what the blocks that may be seen need, if that is less and draws as much.
    pub fn tightened_to_blocks(
        self,
        draws: &[Draw<'_>],
        seen: &PotentiallyVisibleBlocks<'_>,
        settings: &Settings,
        limits: &Limits,
    ) -> Self {
        let of_blocks = self.of_rows_of_it(draws, seen, (self.rows.clone(), false), settings, limits);
        let draws_as_much = |of_blocks: &Self| self.may_be_large || !of_blocks.may_be_large;
        let better = |of_blocks: &Self| draws_as_much(of_blocks) && of_blocks.bytes() < self.bytes();
        of_blocks.filter(better).unwrap_or(self)
    }

    /// The plan for the blocks that may touch some rows of tiles; none where there is none, or more than the device has room for.
    pub(crate) fn of_blocks(
        drawn: Drawn<'_>,
        seen: &PotentiallyVisibleBlocks<'_>,
        rows: Range<u32>,
        culls_hidden: bool,
        settings: &Settings,
        limits: &Limits,
    ) -> Option<Self> {
        let of = |invocations| {
            let area = (settings.size_px, rows.clone());
            Self::of_boxes(drawn.draws.len(), seen.boxes(&rows), area, limits, invocations)
        };
        let may_be_high = settings.tile_invocations == TileInvocations::Auto;
        let plan = Self::with_room(of, wanted(drawn, settings, limits), may_be_high)?;
        plan.when_drawn(drawn.draws, culls_hidden, limits)
    }

    /// The plan that `of` gives for these invocations. Lists of tiles half as high have up to twice the entries, and may have no room for all: some splats would then be left to the graphics pipeline. So tiles are higher
    /// where that leaves none, if they may be, and where twice as many tiles of a huge image have no room; in no band then.
    pub(super) fn with_room(
        of: impl Fn(Invocations) -> Option<Self>,
        wanted: Invocations,
        may_be_high: bool,
    ) -> Option<Self> {
        let higher = || of(wanted.of_full_height());
        match of(wanted) {
            Some(plan) if plan.may_be_large && may_be_high => {
                higher().filter(|higher| !higher.may_be_large).or(Some(plan))
            }
            plan => plan.or_else(higher),
        }
    }

    /// The same for some rows of what this one draws. With the same splats left to the graphics pipeline; or, if the rows have `own_room`, with those that have none in these rows'
    /// own lists, in which no splat has more tiles than the rows have.
    pub(crate) fn of_rows_of_it(
        &self,
        draws: &[Draw<'_>],
        seen: &PotentiallyVisibleBlocks<'_>,
        (rows, own_room): (Range<u32>, bool),
        settings: &Settings,
        limits: &Limits,
    ) -> Option<Self> {
        let (size_px, all) = all_of(settings.size_px);
        let area = (size_px, if own_room { rows.clone() } else { all });
        let plan = Self::of_boxes(draws.len(), seen.boxes(&rows), area, limits, self.invocations)?;
        // Bands are to save memory, which the counts of more pieces take.
        Self { pieces: 1, ..plan.within(rows) }.when_drawn(draws, self.hidden, limits)
    }

    pub(crate) fn when_drawn(self, draws: &[Draw<'_>], culls_hidden: bool, limits: &Limits) -> Option<Self> {
        let any = |has: fn(&Draw<'_>) -> bool| draws.iter().any(has);
        let plan = match (any(|draw| draw.chunk.clipped), any(|draw| !draw.planes.is_empty())) {
            (false, false) => self,
            (clips, planes) => self.cut_by(clips, planes, limits)?,
        };
        Some(if culls_hidden { plan.without_hidden() } else { plan })
    }

    /// The same for some rows of the image alone.
    pub(crate) fn within(self, rows: Range<u32>) -> Self {
        let tile_count = self.tiles_x * tile_rows(rows.end - rows.start, self.invocations);
        Self { tile_count, rows, ..self }
    }

    /// The same as one of several bands, which have their pipelines and images in common, and buffers of the same sizes, so that
    /// each lies where that of the band before was.
    pub(crate) fn with_common_capacity(&self, bands: &[Self]) -> Self {
        let largest = |of: fn(&Self) -> u64| bands.iter().map(of).max().unwrap_or(0);
        // A band that leaves splats to the graphics pipeline has no room for more tiles of each.
        let with_room = bands.iter().filter(|band| band.may_be_large).map(|band| band.most_tiles).min();
        let most_tiles = (largest(|band| band.most_tiles.into()) as u32).min(with_room.unwrap_or(u32::MAX));
        Self {
            record_room: largest(|band| band.record_room),
            most_tiles,
            round_length: round_length(self.invocations, most_tiles).min(self.segment_length),
            segments: largest(|band| band.segments.into()) as u32,
            entry_room: largest(|band| band.entry_room),
            may_be_large: bands.iter().any(|band| band.may_be_large),
            overflows_somewhere: bands.iter().any(Self::may_overflow),
            ..self.clone()
        }
    }

    /// The tiles of its rows.
    pub(super) fn image_tiles(&self) -> ImageTiles {
        let rows = tile_rows(self.rows.end - self.rows.start, self.invocations);
        ImageTiles { along: [self.tiles_x, rows], invocations: self.invocations }
    }

    /// Its rows as pixels of an image.
    pub(crate) fn area(&self, image: vk::Extent2D) -> vk::Rect2D {
        let [first, end] = [self.rows.start, self.rows.end].map(|row| (row * BAND_ROW).min(image.height));
        vk::Rect2D {
            offset: vk::Offset2D { x: 0, y: first as i32 },
            extent: vk::Extent2D { width: image.width, height: end - first },
        }
    }

    /// The first tile of its rows.
    pub fn first_tile(&self) -> u32 {
        tile_rows(self.rows.start, self.invocations) * self.tiles_x
    }
}
