//! Bands of the image, one after the other in the same memory, where lists of all of it would take more than they are meant to.
//!
//! How many splats a band has is known on the host from what bounds their blocks, so that memory has a bound before the device has
//! found anything. In a band records have other numbers, by which a tile's list is ordered: pictures are the same but for the
//! rounding of sums in another order, and that these need 32 bits where a tile of any band may have more splats than one dispatch takes.

pub(crate) mod ends;

use std::ops::Range;

use crate::passes::plan::{
    bands::ends::cost_of_rows, block_list::ListedBlocks, draws::Draw, seen::PotentiallyVisibleBlocks,
    tiles::TilePlan,
};
use crate::{
    arena::{Arena, ArenaVec},
    scene::{Settings, TileMemory},
    vk::Limits,
};

/// Bytes that lists may take in any case.
const LEAST_BYTES: u64 = 16_000_000;

/// What a frame takes beside splats, records and lists, as a part of what these may: runs of blocks, bounds of blocks, arguments, and that blocks are listed as wholes.
const BESIDE: u64 = 32;

/// The most bands: each takes a few commands more.
pub(super) const MOST_BANDS: usize = 16;

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
        let mut own = arena.copied(splats);
        let visible = Some(ListedBlocks::of(arena, &mut own, seen.chunks, plan.rows.clone()));
        Self { splats: own.into_bump_slice(), visible, plan }
    }
}

/// Bytes that records and lists of a frame may take at once: what splats with them are one and a half times what the splats take in a
/// scene.
pub(crate) fn most_bytes(draws: &[Draw<'_>], memory: TileMemory) -> u64 {
    match memory {
        TileMemory::Auto => {
            let [in_scene, splats] = draws.iter().fold([0; 2], |[in_scene, splats], draw| {
                [in_scene + draw.chunk.scene_bytes, splats + draw.chunk.splat_bytes()]
            });
            let most = (in_scene * 3 / 2).saturating_sub(splats);
            (most - most / BESIDE).max(LEAST_BYTES)
        }
        TileMemory::Most(bytes) => bytes,
    }
}

/// Whether bands would take so much less than `whole` that they are worth their commands, where lists may take so many bytes: with less than a third beyond that, they would not.
pub(crate) fn bands_gain(whole: &TilePlan, most_bytes: u64) -> bool {
    whole.bytes() > most_bytes.saturating_add(most_bytes / 3)
}

/// The plans of bands of what `whole` would draw at once, which end at these rows if that is enough; none where memory is enough without, or where bands would not help: so many
/// splats in so few rows, or in no order.
pub(crate) fn cut_into_bands<'m>(
    arena: &'m Arena,
    draws: &[Draw<'_>],
    (seen, ends): (&PotentiallyVisibleBlocks<'_>, &[u32]),
    whole: &TilePlan,
    settings: &Settings,
    limits: &Limits,
) -> &'m [TilePlan] {
    let most_bytes = most_bytes(draws, settings.tile_memory);
    if !bands_gain(whole, most_bytes) {
        return &[];
    }
    let costs = seen.costs(arena, |box_px| whole.bytes_of_one(box_px));
    let cut = Cut { arena, draws, seen, costs, whole, settings, limits };
    cut.within(most_bytes, ends).unwrap_or_default()
}

/// The plans of as few bands as leave none of what `whole` would draw to the graphics pipeline, for which it has no room in lists of all of the image: so all of it can cover pixels in
/// part. None where no number of bands does, as where something comes near the eye.
pub(crate) fn cut_without_large<'m>(
    arena: &'m Arena,
    draws: &[Draw<'_>],
    seen: &PotentiallyVisibleBlocks<'_>,
    whole: &TilePlan,
    settings: &Settings,
    limits: &Limits,
) -> Option<&'m [TilePlan]> {
    let Range { start, end } = seen.rows()?;
    if !seen.boxes(&(start..end)).all(|(_, px)| px.is_finite()) {
        return None;
    }
    let costs = seen.costs(arena, |box_px| whole.bytes_of_one(box_px));
    let cut = Cut { arena, draws, seen, costs, whole, settings, limits };
    // Of equal parts: most of what is so large is in all of them.
    let ends = |bands: u32| arena.list((1..bands).map(|band| start + (end - start) * band / bands));
    let bands = std::iter::successors(Some(2), |bands| Some(2 * bands))
        .take_while(|bands| *bands <= MOST_BANDS as u32);
    let plan = |rows| whole.of_rows_of_it(draws, seen, (rows, true), settings, limits);
    let plans = |bands: u32| cut.plans_between(ends(bands), plan);
    bands.filter_map(plans).find(|plans| plans.iter().all(|plan| !plan.may_be_large))
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
    /// The plans of bands that take so many bytes, or little more where that would be too many bands; none where bands gain nothing. They end at these rows if that is enough.
    fn within(&self, most_bytes: u64, ends: &[u32]) -> Option<&'m [TilePlan]> {
        let whole = self.whole;
        let gains = |plans: &&[TilePlan]| {
            plans.len() > 1 && plans.iter().all(|plan| 4 * plan.bytes() <= 3 * whole.bytes())
        };
        let enough = |plans: &&[TilePlan]| plans.iter().all(|plan| plan.bytes() <= most_bytes);
        if let Some(plans) =
            self.plans_between(ends, |rows| self.plan(rows)).filter(|plans| gains(plans) && enough(plans))
        {
            return Some(plans);
        }
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
        found.filter(gains)
    }

    fn plan(&self, rows: Range<u32>) -> Option<TilePlan> {
        self.whole.of_rows_of_it(self.draws, self.seen, (rows, false), self.settings, self.limits)
    }

    /// The plans of bands that end at these rows; `plan`: of one.
    fn plans_between(
        &self,
        ends: &[u32],
        plan: impl Fn(Range<u32>) -> Option<TilePlan>,
    ) -> Option<&'m [TilePlan]> {
        let Range { start, end } = self.seen.rows()?;
        let mut plans: ArenaVec<'_, TilePlan> = self.arena.growing();
        let mut next = start;
        for end in ends.iter().copied().filter(|row| start < *row && *row < end).chain([end]) {
            plans.extend(plan(next..end));
            next = end;
        }
        Some(self.alike(&plans))
    }

    /// The plans of bands, each of as many rows as so many bytes are enough for; none where they would be too many.
    fn plans(&self, most_bytes: u64) -> Option<&'m [TilePlan]> {
        let Range { start: first, end } = self.seen.rows()?;
        let mut plans: ArenaVec<'_, TilePlan> = self.arena.growing();
        let mut next = first;
        while next < end {
            // A row alone is a band, whatever it takes.
            let more = (next + 2..=end)
                .take_while(|end| cost_of_rows(self.whole, self.costs, next..*end) <= most_bytes)
                .count();
            let band = next..next + 1 + more as u32;
            next = band.end;
            plans.extend(self.plan(band));
            if plans.len() > MOST_BANDS {
                return None;
            }
        }
        Some(self.alike(&plans))
    }

    /// These, with what bands have in common.
    fn alike(&self, plans: &[TilePlan]) -> &'m [TilePlan] {
        self.arena.list(plans.iter().map(|plan| plan.with_common_capacity(plans)))
    }
}

#[cfg(test)]
mod tests {
    use glam::{DVec3, Vec3};

    use super::*;
    use crate::passes::plan::tiles::rows::{Drawn, rows_of_image};
    use crate::{
        math::random::SplitMix,
        passes::plan::{FramePlan, draws::draws, range::DepthRange},
        prepare::{Placed, PreparedScene, prepare_without_device},
        scene::{Camera, Colors, Edges, Object, Rasterizer, Scene, Shapes, Splats},
    };

    fn sheet(count: usize, radius: f32) -> PreparedScene {
        let mut random = SplitMix(3);
        let mut side = || 2.0 * random.unit() - 1.0;
        let positions = (0..count).map(|_| DVec3::new(side(), side(), 0.0)).collect();
        let shapes = Shapes::Disks { normals: vec![Vec3::Z; count], radii: vec![radius; count] };
        let splats = Splats::new(positions, shapes, Colors::Uniform([1.0; 4]));
        let objects = vec![Object { name: "sheet".to_owned(), splats, closed: false }];
        prepare_without_device(&Limits::plain(), &Scene { objects, ..Scene::default() }).expect("a sheet")
    }

    fn camera() -> Camera {
        Camera { eye: DVec3::new(0.0, 0.0, 2.6), ..Camera::default() }
    }

    /// Disks as large as the image, of which lists have a hundred million entries. What comes near the eye plane has no bound.
    #[test]
    fn bands_have_room_for_what_is_too_large_for_lists_of_all_of_the_image() {
        let (limits, arena) = (Limits::plain(), Arena::new());
        let bands = |scene: &PreparedScene, camera: &Camera, edges| {
            let settings = Settings { size_px: [1024; 2], edges, ..Settings::default() };
            let plan = FramePlan::new(&arena, &[Placed::at_home(scene)], camera, &settings, &limits);
            assert_eq!(
                plan.opaque.settings.edges == Edges::Coverage,
                !plan.opaque.bands()[0].plan.may_be_large
            );
            plan.opaque.bands().iter().map(|band| band.plan.clone()).collect::<Vec<_>>()
        };
        let large = sheet(10_000, 1.0);
        let cut = bands(&large, &camera(), Edges::Coverage);
        assert!((2..=MOST_BANDS).contains(&cut.len()), "{cut:?}");
        assert!(cut.iter().all(|plan| !plan.may_be_large && plan.bytes() < 100_000_000), "{cut:?}");
        assert!(cut.windows(2).all(|pair| pair[0].rows.end == pair[1].rows.start), "{cut:?}");
        assert_eq!((cut[0].rows.start, cut[cut.len() - 1].rows.end), (0, 128));
        let beside_eye = Camera { eye: DVec3::new(0.5, 0.5, 0.0), target: DVec3::ZERO, ..camera() };
        for (camera, edges) in [(camera(), Edges::Hard), (beside_eye, Edges::Coverage)] {
            let whole = bands(&large, &camera, edges);
            assert!(whole.len() == 1 && whole[0].may_be_large, "{whole:?}");
        }
        assert_eq!(bands(&sheet(10_000, 0.01), &camera(), Edges::Coverage).len(), 1);
    }

    /// Few splats in a large image, whose tiles take more than they do, and many.
    #[test]
    fn a_band_takes_no_more_than_it_may_tiles_without_splats_included() {
        let limits = Limits::plain();
        let most = 16_000_000;
        for (count, radius, side_px) in [(20_000, 0.01, 4096), (100_000, 0.004, 3000)] {
            let prepared = sheet(count, radius);
            let settings = Settings {
                size_px: [side_px; 2],
                rasterizer: Rasterizer::Compute,
                tile_memory: TileMemory::Most(most),
                ..Settings::default()
            };
            let (placed, arena) = (Placed::at_home(&prepared), Arena::new());
            let range = DepthRange::of(&[placed], &camera());
            let camera = range.begin(&camera());
            let draws = arena.list(draws(&arena, placed, (&camera, range), &settings, &limits));
            let rows = rows_of_image(&settings);
            let runs = arena.list(draws.iter().map(|draw| draw.potentially_visible_runs(&arena)));
            let seen = PotentiallyVisibleBlocks::new(&arena, runs, rows.end);
            let whole = TilePlan::of(Drawn::new(&arena, draws), false, &settings, &limits).expect("room");
            let whole = whole.tightened_to_blocks(draws, &seen, &settings, &limits);
            let cut = cut_into_bands(&arena, draws, (&seen, &[]), &whole, &settings, &limits);
            let of_bands: Vec<u64> = cut.iter().map(TilePlan::bytes).collect();
            println!("{count} at {side_px}: {} in bands of {of_bands:?}", whole.bytes());
            assert!((2..=4).contains(&cut.len()), "{of_bands:?} of {}", whole.bytes());
            assert!(of_bands.iter().all(|bytes| *bytes <= most), "{of_bands:?} of {}", whole.bytes());
        }
    }
}
