//! What the lists of a frame held, which only the device knows: told by the few buffers that the host has to read for it.

use std::collections::BTreeMap;

use crate::passes::{
    inputs::Inputs,
    plan::{
        FramePlan,
        tiles::{RECORD_BYTES, TilePlan},
    },
    tiles::lists::RECORD_QUARTERS,
};
use crate::{arena::Arena, shaders::config::*};

/// What the lists of one frame held.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ListOccupancy {
    /// Bytes of buffers that have room for more than is in use, or of which a pass may read less than there is, by their names in the
    /// plan: as many as each pass that accesses them reads or writes at least. 0 where that is not known.
    pub bytes: BTreeMap<String, u64>,
    /// The lists of tiles: one of each part and band that is drawn so.
    pub tiles: Vec<TileOccupancy>,
}

/// What one list of tiles held.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TileOccupancy {
    /// What is in front of `tiles` in the names of its buffers and passes.
    pub kind: String,
    /// Splats that were set up and touch a tile.
    pub records: u64,
    /// Splats of all tiles, each as often as it touches one.
    pub entries: u64,
    /// Tiles that have some.
    pub tiles: u64,
    /// Of these, tiles that have more than one dispatch takes.
    pub overflow: u64,
    /// Pixels of tiles that have some within the image, at least.
    pub pixels: u64,
    /// Splats at pixels: every splat of a tile is looked for at each pixel of it.
    pub splat_pixels: u64,
}

/// The buffers of one kind of lists that tell what they hold.
struct Names {
    /// How many splats are visible before each word of bits, then in all.
    visible_starts: String,
    rects: String,
    starts: String,
    arguments: String,
}

impl Names {
    fn of(kind: &str) -> Self {
        let of_tiles = |what| format!("{what} of {kind}tiles");
        Self {
            visible_starts: format!("starts of visible {kind}splats"),
            rects: of_tiles("rects"),
            starts: of_tiles("starts"),
            arguments: of_tiles("arguments"),
        }
    }
}

/// All lists of a frame, each with what is in front of its names.
fn lists<'a>(
    arena: &'a Arena,
    inputs: Inputs<'a>,
    plan: &'a FramePlan<'a>,
) -> impl Iterator<Item = (String, Inputs<'a>, Option<&'a TilePlan>)> {
    let surfaces = [("", &plan.opaque), ("transparent ", &plan.transparent)];
    surfaces.into_iter().flat_map(move |(surface, plan)| {
        let inputs = inputs.of(plan);
        let name = move |band: &str| format!("{surface}{band}");
        match inputs.bands.is_empty() {
            true => vec![(name(""), inputs, None)],
            false => {
                inputs.of_bands(arena).map(|(band, inputs, plan)| (name(band), inputs, Some(plan))).collect()
            }
        }
    })
}

/// The buffers that tell it, of those that a frame has.
pub fn counter_buffers<'a>(arena: &'a Arena, inputs: Inputs<'a>, plan: &'a FramePlan<'a>) -> Vec<String> {
    let names = |(kind, ..): (String, Inputs<'_>, Option<&TilePlan>)| {
        let Names { visible_starts, rects, starts, arguments } = Names::of(&kind);
        [visible_starts, rects, starts, arguments]
    };
    lists(arena, inputs, plan).flat_map(names).collect()
}

impl ListOccupancy {
    /// What the words of these buffers tell.
    pub fn of<'a>(inputs: Inputs<'a>, plan: &'a FramePlan<'a>, told: &BTreeMap<String, Vec<u32>>) -> Self {
        let mut all = Self::default();
        for (kind, inputs, plan) in lists(&Arena::new(), inputs, plan) {
            let names = Names::of(&kind);
            let words = |name: &String| told.get(name).map_or(&[][..], Vec::as_slice);
            let visible = words(&names.visible_starts).last().map(|count| u64::from(*count));
            if let Some(visible) = visible {
                let of_visible = |what: &str| format!("{what} of visible {kind}splats");
                // Of starts, how many there are.
                all.bytes.extend([(of_visible("list"), 4 * visible), (of_visible("starts"), 4)]);
            }
            if let Some(plan) = plan {
                let set_up = visible.unwrap_or(plan.record_count.into());
                let told = [&names.rects, &names.starts, &names.arguments].map(words);
                all.add_tiles(kind, (plan, inputs.settings.size_px), set_up, told);
            }
        }
        all
    }

    /// `set_up`: splats that were, whether they touch a tile or not.
    fn add_tiles(
        &mut self,
        kind: String,
        (plan, size_px): (&TilePlan, [u32; 2]),
        set_up: u64,
        [rects, starts, arguments]: [&[u32]; 3],
    ) {
        let word = |words: &[u32], place: u64| words.get(place as usize).copied().unwrap_or(0).into();
        let (tile_count, bins) = (u64::from(plan.tile_count), u64::from(plan.bin_count()));
        let records = rects.iter().take(set_up as usize).filter(|rect| **rect < RECT_CHUNK).count() as u64;
        // Behind those of tiles are those of chunks, which other passes read.
        let entries = word(starts, plan.first_chunk_bin().into());
        let [tiles, overflow, clipped] = [1, 2, 3].map(|place| word(starts, bins + place));
        let tiles = if plan.parted_by() != 0 { tiles + clipped } else { tiles };
        let runs: u64 = word(arguments, u64::from(ARGUMENTS_QUADS) + 1);
        let lists = [
            ("rects", 4 * set_up),
            ("entries", 4 * entries),
            ("starts", 4 * tiles),
            ("seen", 4 * tiles),
            ("runs", 8 * runs),
            ("overflow", 4 * overflow),
        ];
        let in_use =
            RECORD_QUARTERS.map(|quarter| (quarter, RECORD_BYTES * records)).into_iter().chain(lists);
        self.bytes.extend(in_use.map(|(name, bytes)| (format!("{name} of {kind}tiles"), bytes)));

        let [width_px, height_px] = plan.tile_px();
        let tile_pixels = u64::from(width_px * height_px);
        let rows_px = (plan.rows.end * BAND_ROW).min(size_px[1]) - plan.rows.start * BAND_ROW;
        // Tiles at the image's border reach beyond it: as if all of them had splats.
        let beyond = tile_count * tile_pixels - u64::from(size_px[0]) * u64::from(rows_px);
        let splat_pixels = entries * tile_pixels;
        let pixels = (tiles * tile_pixels).saturating_sub(beyond);
        self.tiles.push(TileOccupancy { kind, records, entries, tiles, overflow, pixels, splat_pixels });
    }
}
