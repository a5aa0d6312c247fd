//! How splats are drawn: by tiles or by the graphics pipeline, and why.

use crate::passes::plan::few::are_few;
use crate::passes::plan::{
    bands::{
        MOST_BANDS, bands_gain, cut_into_bands, cut_without_large,
        ends::{largest_of, likely_bands, likely_ends},
        most_bytes,
    },
    tiles::rows::{Drawn, rows_of_image},
};
use crate::passes::{
    pipeline::tile_layouts::STORAGE_BUFFERS,
    plan::{
        SplatMethod,
        ahead::Ahead,
        bands::Band,
        block_list::ListedBlocks,
        blocks::walk::Closer,
        culling,
        draws::{Draw, with_hard_steps, without_levels},
        invocations::Invocations,
        seen::{PotentiallyVisibleBlocks, PotentiallyVisibleRun},
        tiles::TilePlan,
    },
};
use crate::{
    arena::{Arena, ArenaVec},
    error::{Error, Result},
    scene::{Accumulate, Rasterizer, Settings},
    vk::Limits,
};

/// The reason for a choice, or against one, as a part of a sentence.
pub(super) type Reason = &'static str;

/// Bands of tiles for these splats, and why they are drawn so. `polygons`: there are some beside them. `ahead`: those that there may be of a frame that is not drawn.
///
/// On CPU drivers tiles take a quarter to a fifth of the time of points, from 154 thousand splats to 5 million, and two fifths with
/// ten thousand; with some hundred opaque ones, which are large, points are as fast, so that few keep their few passes and no lists
/// (`benches/README.md`). On the one GPU that was measured, an H100, tiles take 0.08 to 0.28 of it for 100 000 to 5 million splats, and 0.78
/// with 50, so that on GPUs even few are drawn by tiles.
///
/// # Errors
/// The reason against tiles.
pub(crate) fn tiles<'a>(
    arena: &'a Arena,
    splats: &[Draw<'a>],
    polygons: bool,
    (settings, limits): (&Settings, &Limits),
    ahead: Option<Ahead>,
) -> std::result::Result<(&'a [Band<'a>], Reason), Reason> {
    let transparent = splats.iter().any(|draw| draw.chunk.transparent);
    let few = !polygons && !transparent && are_few(splats, settings);
    if let Some(ahead) = ahead {
        return ahead.bands(arena, splats, (polygons, transparent, few), settings, limits);
    }
    let reason = wants_tiles(few, settings, limits)?;
    if polygons && transparent {
        return Err("there are polygons in the same layers");
    }
    let bands = bands(arena, splats, polygons, transparent, settings, limits);
    bands.map(|bands| (bands, reason)).ok_or("tiles have no room for so many, or for ones so large in layers")
}

/// How the graphics pipeline draws these splats, which it numbers, and sums in as many bits as it was asked to.
pub(crate) fn primitives<'a>(
    arena: &'a Arena,
    splats: &mut ArenaVec<'a, Draw<'a>>,
    polygons: bool,
    (settings, limits): (&Settings, &Limits),
    ahead: Option<Ahead>,
) -> SplatMethod<'a> {
    let half_sums = settings.accumulate == Accumulate::F16 && settings.weighs_splats();
    splats.iter_mut().for_each(|draw| draw.half_sums = half_sums);
    with_hard_steps(arena, splats);
    if let Some(ahead) = ahead {
        splats.iter_mut().for_each(|draw| draw.may_be_large = ahead.may_be_large(settings));
    }
    let leaves_out = ahead.map_or_else(|| culling::may_leave_out(splats), |ahead| ahead.listed);
    if !culling::lists_primitives(splats, leaves_out, settings, limits) {
        without_levels(arena, splats);
        culling::number_splats(splats);
        return SplatMethod::default();
    }
    let rows = rows_of_image(settings);
    let seen = arena.list(splats.iter().map(|draw| draw.potentially_visible_runs(arena)));
    SplatMethod::Primitives {
        visible: Some(ListedBlocks::of(arena, splats, seen, rows)),
        culls_hidden: culling::primitives_cull_hidden(polygons, settings),
    }
}

/// Numbers of bands that are tried, of which blocks are looked at where they are to end.
const MOST_TRIES: u64 = 3;

/// Rows for each band, of which some are better than others to end at.
const LEAST_ROWS: u64 = 8;

/// Bands of all these splats; `None` where they have no room.
fn bands<'a>(
    arena: &'a Arena,
    splats: &[Draw<'a>],
    polygons: bool,
    transparent: bool,
    settings: &Settings,
    limits: &Limits,
) -> Option<&'a [Band<'a>]> {
    let culls_hidden = culling::tiles_cull_hidden(splats, polygons, settings);
    let rows = rows_of_image(settings);
    let seen_by = |runs: fn(&Draw<'a>, &'a Arena) -> &'a [PotentiallyVisibleRun]| {
        let blocks = arena.list(splats.iter().map(|draw| runs(draw, arena)));
        PotentiallyVisibleBlocks::new(arena, blocks, rows.end)
    };
    let seen = || seen_by(Draw::potentially_visible_runs);
    let drawn = Drawn::new(arena, splats);
    let left_to_others = |plan: &TilePlan| transparent && plan.may_be_large;
    // Bands may have room for what is too large for lists of all of the image; but polygons may be drawn between two passes over all of it, and levels of detail
    // are counted in one list.
    let leaves_large = |plan: &TilePlan| {
        let may_gain = !polygons && splats.iter().all(|draw| draw.levels.is_none());
        plan.may_be_large && may_gain && settings.covers_in_part()
    };
    let of_plans = |seen: &PotentiallyVisibleBlocks<'_>, plans: &[TilePlan]| {
        arena.list(plans.iter().map(|plan| Band::new(arena, splats, seen, plan.clone())))
    };
    let (seen, whole, ends) = if splats.iter().any(|draw| draw.levels.is_some()) {
        // Of levels of detail there may be many more splats than there is room for; those that may be drawn are few.
        let seen = seen();
        if !culling::list_has_room(seen.block_count(), limits) {
            return None;
        }
        let of_blocks = TilePlan::of_blocks(drawn, &seen, rows.clone(), culls_hidden, settings, limits);
        let whole = of_blocks.or_else(|| TilePlan::of(drawn, culls_hidden, settings, limits))?;
        (seen, whole, &[][..])
    } else {
        let whole = TilePlan::of(drawn, culls_hidden, settings, limits)?;
        // Bands are made of listed splats, too.
        let gains =
            culling::may_leave_out(splats) || whole.bytes() > most_bytes(splats, settings.tile_memory);
        if !gains || !culling::lists_tiles(splats, settings, limits) {
            if leaves_large(&whole) && culling::list_has_room(culling::blocks_of(splats), limits) {
                let seen = seen();
                if let Some(cut) = cut_without_large(arena, splats, &seen, &whole, settings, limits) {
                    return Some(of_plans(&seen, cut));
                }
            }
            let mut own = arena.copied(splats);
            culling::number_splats(&mut own);
            let band = Band { splats: own.into_bump_slice(), visible: None, plan: whole };
            return (!left_to_others(&band.plan)).then(|| std::slice::from_ref(arena.keep(band)));
        }
        let most_bytes = most_bytes(splats, settings.tile_memory);
        let tightened = |seen: &PotentiallyVisibleBlocks<'_>| {
            whole.clone().tightened_to_blocks(splats, seen, settings, limits)
        };
        // One look at each is enough where all that may face the eye is in one band.
        let rough = if leaves_large(&whole) { seen() } else { seen_by(Draw::runs_at_once) };
        let tight = tightened(&rough);
        if tight.bytes() <= most_bytes {
            (rough, tight, &[][..])
        } else {
            let looked_into = |seen: &PotentiallyVisibleBlocks<'_>, closer: Closer<'_>| {
                let runs = splats.iter().zip(seen.chunks);
                let runs = arena.list(runs.map(|(draw, runs)| draw.closer_runs(arena, runs, closer)));
                PotentiallyVisibleBlocks::new(arena, runs, rows.end)
            };
            let mut close = looked_into(&rough, Closer::InPart);
            let mut tight = tightened(&close);
            let has_rows = || splats.iter().zip(rough.chunks).all(|(draw, runs)| draw.has_rows(runs));
            if !polygons && bands_gain(&tight, most_bytes) && !has_rows() {
                close = looked_into(&seen(), Closer::InPart);
                tight = tightened(&close);
            }
            if polygons || !bands_gain(&tight, most_bytes) {
                (close, tight, &[][..])
            } else {
                let mut bands = likely_bands(&tight, most_bytes);
                if u64::from(rows.end) < LEAST_ROWS * bands {
                    // Anywhere.
                    let closest = looked_into(&close, Closer::Cut(arena.list(rows.clone())));
                    (closest, tightened(&closest), &[][..])
                } else {
                    let (mut closest, mut ends) = (looked_into(&close, Closer::Tall), &[][..]);
                    for _ in 0..MOST_TRIES {
                        ends = likely_ends(arena, &closest, &tight, bands);
                        closest = looked_into(&closest, Closer::Cut(ends));
                        let largest = largest_of(arena, &closest, &tight, ends);
                        if largest <= most_bytes || bands >= MOST_BANDS as u64 {
                            break;
                        }
                        bands = (bands + 1).max((bands * largest).div_ceil(most_bytes.max(1)));
                        bands = bands.min(MOST_BANDS as u64);
                    }
                    (closest, tightened(&closest), ends)
                }
            }
        }
    };
    let without_large = leaves_large(&whole)
        .then(|| cut_without_large(arena, splats, &seen, &whole, settings, limits))
        .flatten();
    if without_large.is_none() && left_to_others(&whole) {
        return None;
    }
    let cut = match without_large {
        Some(cut) => cut,
        None if polygons => &[],
        None => cut_into_bands(arena, splats, (&seen, ends), &whole, settings, limits),
    };
    // A splat that is large for a band alone would be the graphics pipeline's, too.
    match cut.is_empty() || cut.iter().any(left_to_others) {
        true => Some(std::slice::from_ref(arena.keep(Band::new(arena, splats, &seen, whole)))),
        false => Some(of_plans(&seen, cut)),
    }
}

pub(super) fn wants_tiles(
    few: bool,
    settings: &Settings,
    limits: &Limits,
) -> std::result::Result<Reason, Reason> {
    match settings.rasterizer {
        Rasterizer::Compute => can_do_tiles(settings, limits).map(|()| "asked for"),
        Rasterizer::Auto if settings.covers_in_part() => {
            can_do_tiles(settings, limits).map(|()| "auto: they cover pixels in part where surfaces end")
        }
        Rasterizer::Auto if limits.is_cpu && !Invocations::has_columns(limits) => {
            Err("auto: on a CPU tiles gain by shuffles among 8 invocations, which the device lacks")
        }
        Rasterizer::Auto if few && limits.is_cpu => Err("auto: so few that tiles gain little on a CPU"),
        Rasterizer::Auto => can_do_tiles(settings, limits).map(|()| "auto: faster than points"),
        _ => Err("another rasterizer was asked for"),
    }
}

fn can_do_tiles(settings: &Settings, limits: &Limits) -> std::result::Result<(), Reason> {
    if let Some((_, reason)) = settings.why_not_tiles() {
        return Err(reason);
    }
    if !limits.first_instance
        || limits.storage_buffers_a_stage < STORAGE_BUFFERS
        || !limits.stores_without_format
    {
        return Err(
            "the device lacks drawIndirectFirstInstance, storage buffers, or stores without a format",
        );
    }
    Ok(())
}

/// Refuses tiles that were asked for where there can be none.
///
/// # Errors
/// [`crate::error::ErrorKind::Option`] with the reason.
pub fn check(settings: &Settings, limits: &Limits) -> Result<()> {
    match (settings.rasterizer, can_do_tiles(settings, limits)) {
        (Rasterizer::Compute, Err(reason)) => {
            Err(Error::option("--rasterizer", format!("compute: {reason}")))
        }
        _ => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::passes::plan::few::is_few;
    use crate::scene::{Edges, Filter, KernelEval};

    #[test]
    fn auto_takes_tiles_where_they_are_faster_and_only_for_what_they_can_draw() {
        let cpu = Limits { is_cpu: true, shuffles: true, max_texels: u32::MAX, ..Limits::plain() };
        let auto = Settings { edges: Edges::Hard, ..Settings::default() };
        assert!(wants_tiles(false, &auto, &cpu).is_ok());
        assert!(wants_tiles(false, &auto, &Limits::plain()).is_ok());
        assert!(wants_tiles(false, &Settings { filter: Filter::Max, ..auto.clone() }, &cpu).is_err());
        let textured = Settings { kernel_eval: KernelEval::Texture, ..auto.clone() };
        assert!(wants_tiles(false, &textured, &cpu).is_err());
        assert!(wants_tiles(false, &auto, &Limits { first_instance: false, ..cpu }).is_err());
        assert!(wants_tiles(true, &auto, &cpu).is_err());
        assert!(wants_tiles(true, &auto, &Limits::plain()).is_ok());
        assert!(wants_tiles(false, &auto, &Limits { shuffles: false, ..cpu }).is_err());
        // Nothing else covers pixels in part.
        let covers = Settings::default();
        assert!(wants_tiles(true, &covers, &Limits::plain()).is_ok());
        let textured = Settings { kernel_eval: KernelEval::Texture, ..covers };
        assert!(wants_tiles(false, &textured, &Limits::plain()).is_err());
        // An image of this size has a pixel more than a thousand for each of 1048 splats.
        assert!(is_few(1048, &auto) && !is_few(1049, &auto));
        let named = |rasterizer| Settings { rasterizer, ..Settings::default() };
        assert!(wants_tiles(true, &named(Rasterizer::Compute), &Limits::plain()).is_ok());
        assert!(wants_tiles(false, &named(Rasterizer::Perspective), &cpu).is_err());
        assert!(check(&named(Rasterizer::Compute), &Limits { storage_buffers_a_stage: 4, ..cpu }).is_err());
        assert!(check(&auto, &Limits { storage_buffers_a_stage: 4, ..cpu }).is_ok());
    }
}
