//! Bands of the image, one after the other in the same memory, where lists of all of it would take more than they are meant to.
//!
//! How many splats a band has is known on the host from what bounds their blocks, so that memory has a bound before the device has
//! found anything. In a band records have other numbers, by which a tile's list is ordered: pictures are the same but for the
//! rounding of sums in another order, and that these need 32 bits where a tile of any band may have more splats than one dispatch takes.

use std::ops::Range;

use crate::passes::plan::{
    block_list::ListedBlocks, draws::Draw, seen::PotentiallyVisibleBlocks, tiles::TilePlan,
};
use crate::{
    arena::{Arena, ArenaVec},
    prepare::Chunk,
    scene::{Settings, TileMemory},
    vk::Limits,
};

/// Bytes that lists may take in any case.
const LEAST_BYTES: u64 = 16_000_000;

/// What a frame takes beside splats, records and lists, as a part of what these may: runs of blocks, arguments, and that blocks are listed as wholes.
const BESIDE: u64 = 32;

/// The most bands: each takes a few commands more.
const MOST_BANDS: usize = 16;

/// How often other bands are tried.
const ATTEMPTS: u32 = 8;

/// Rows of tiles with their lists.
#[derive(Clone)]
pub struct Band<'a> {
    /// The chunks.
    pub splats: &'a [Draw<'a>],
    /// Where splats that may be seen are looked for, if only those are set up.
    pub visible: Option<ListedBlocks<'a>>,
    /// How they are drawn.
    pub plan: TilePlan,
}

impl<'a> Band<'a> {
    /// A band of splats that are listed first: of the blocks that may touch its rows.
    pub fn new(
        arena: &'a Arena,
        splats: &[Draw<'a>],
        seen: &PotentiallyVisibleBlocks<'_>,
        plan: TilePlan,
    ) -> Self {
        let mut own = arena.growing();
        own.extend_from_slice_copy(splats);
        let visible = Some(ListedBlocks::of(arena, &mut own, seen.chunks, plan.rows.clone()));
        Self { splats: own.into_bump_slice(), visible, plan }
    }
}

/// Bytes that records and lists of a frame may take at once: what splats with them are one and a half times what the splats take in a
/// scene.
pub(crate) fn most_bytes(draws: &[Draw<'_>], memory: TileMemory) -> u64 {
    let sum = |of: fn(&Chunk) -> u64| draws.iter().map(|draw| of(draw.chunk)).sum::<u64>();
    match memory {
        TileMemory::Auto => {
            let splats = sum(Chunk::bytes);
            let most = (sum(|chunk| chunk.scene_bytes) * 3 / 2).saturating_sub(splats);
            (most - most / BESIDE).max(LEAST_BYTES)
        }
        TileMemory::Most(bytes) => bytes,
    }
}

/// The plans of bands of what `whole` would draw at once; none where memory is enough for that, or where bands would not help: so many
/// splats in so few rows, or in no order.
pub(crate) fn cut_into_bands<'m>(
    arena: &'m Arena,
    draws: &[Draw<'_>],
    seen: &PotentiallyVisibleBlocks<'_>,
    whole: &TilePlan,
    settings: &Settings,
    limits: &Limits,
) -> &'m [TilePlan] {
    let most_bytes = most_bytes(draws, settings.tile_memory);
    if whole.bytes() <= most_bytes {
        return &[];
    }
    let costs = seen.costs(arena, |box_px| whole.bytes_of_one(box_px));
    let cut = Cut { arena, draws, seen, costs, whole, settings, limits };
    cut.within(most_bytes).unwrap_or_default()
}

/// What is cut into bands.
struct Cut<'c, 'm> {
    arena: &'m Arena,
    draws: &'c [Draw<'c>],
    seen: &'c PotentiallyVisibleBlocks<'c>,
    /// What records and entries take, as [`PotentiallyVisibleBlocks::costs`] has it.
    costs: &'c [[u64; 2]],
    whole: &'c TilePlan,
    settings: &'c Settings,
    limits: &'c Limits,
}

impl<'m> Cut<'_, 'm> {
    /// The plans of bands that take so many bytes, or little more where that would be too many bands; none where bands gain nothing.
    fn within(&self, most_bytes: u64) -> Option<&'m [TilePlan]> {
        let whole = self.whole;
        // All bands together take at least what the whole does.
        let most_bytes = most_bytes.max(whole.bytes() / MOST_BANDS as u64);
        let mut wanted = most_bytes;
        let mut found: Option<&[TilePlan]> = None;
        for _ in 0..ATTEMPTS {
            match self.plans(wanted) {
                Some(plans) => {
                    let bytes = |plans: &[TilePlan]| plans.iter().map(TilePlan::bytes).max().unwrap_or(0);
                    let enough = bytes(plans) <= most_bytes;
                    if found.as_ref().is_none_or(|found| bytes(plans) < bytes(found)) {
                        found = Some(plans);
                    }
                    if enough {
                        break;
                    }
                    wanted -= wanted / 16;
                }
                None if found.is_some() => break,
                None => wanted += wanted / 2,
            }
        }
        let gains = |plans: &&[TilePlan]| {
            plans.len() > 1 && plans.iter().all(|plan| 4 * plan.bytes() <= 3 * whole.bytes())
        };
        found.filter(gains)
    }

    fn plan(&self, rows: Range<u32>) -> Option<TilePlan> {
        self.whole.of_rows_of_it(self.draws, self.seen, rows, self.settings, self.limits)
    }

    /// What records and entries of these rows take.
    fn cost(&self, rows: Range<u32>) -> u64 {
        let [end, start] = [rows.end, rows.start].map(|row| self.costs[row as usize]);
        end[0] - start[1]
    }

    /// The plans of bands, each of as many rows as so many bytes are enough for; none where they would be too many.
    fn plans(&self, most_bytes: u64) -> Option<&'m [TilePlan]> {
        let Range { start: first, end } = self.seen.rows()?;
        let mut plans: ArenaVec<'_, TilePlan> = self.arena.growing();
        let mut next = first;
        while next < end {
            // A row alone is a band, whatever it takes.
            let more = (next + 2..=end).take_while(|end| self.cost(next..*end) <= most_bytes).count();
            let band = next..next + 1 + more as u32;
            next = band.end;
            plans.extend(self.plan(band));
            if plans.len() > MOST_BANDS {
                return None;
            }
        }
        Some(self.arena.list(plans.iter().map(|plan| plan.with_common_capacity(&plans))))
    }
}
