//! Which splats are left out before they are set up, and before they are summed (`--cull`).

use crate::passes::{
    pipeline::splat_shaders::Primitive,
    plan::{draws::Draw, few::are_few},
};
use crate::{
    scene::{Cull, Rasterizer, Settings, Transition},
    shaders::config::BLOCK_SPLATS,
    vk::Limits,
};

/// Points of an indexed draw; more would need `fullDrawIndexUint32`.
const MOST_INDICES: u32 = 1 << 24;

/// Other surfaces count from this part of all splats on.
const LEAST_PART: u64 = 64;

/// Whether some splats face away and are not drawn, or may lie outside of the view.
pub(crate) fn may_leave_out(splats: &[Draw<'_>]) -> bool {
    splats.iter().any(|draw| draw.culls || !draw.is_wholly_in_view())
}

/// Whether tiles are made of listed splats where a list gains something.
pub(crate) fn lists_tiles(splats: &[Draw<'_>], settings: &Settings, limits: &Limits) -> bool {
    settings.cull != Cull::Setup && list_has_room(blocks_of(splats), limits)
}

/// Whether the graphics pipeline draws listed splats alone, some of which [may be left out](may_leave_out) or not. Layers draw all, but where there are levels
/// of detail to choose.
pub(crate) fn lists_primitives(
    splats: &[Draw<'_>],
    leaves_out: bool,
    settings: &Settings,
    limits: &Limits,
) -> bool {
    let wanted = match settings.cull {
        // Where points were named, they are set up as the papers do it.
        Cull::Auto => settings.rasterizer == Rasterizer::Auto && limits.is_cpu && !are_few(splats, settings),
        Cull::Setup => false,
        Cull::List | Cull::Hidden => Primitive::of(settings.rasterizer) == Primitive::Point,
    };
    let has_levels = splats.iter().any(|draw| draw.levels.is_some());
    let wanted = wanted || has_levels && Primitive::of(settings.rasterizer) == Primitive::Point;
    wanted
        && (has_levels || !splats.iter().any(|draw| draw.chunk.transparent))
        && (has_levels || leaves_out || settings.cull == Cull::Hidden)
        && list_has_room(blocks_of(splats), limits)
        && splats.iter().all(|draw| draw.chunk.count <= MOST_INDICES)
}

/// Whether a list of the splats of so many blocks is within what a buffer holds.
pub(crate) fn list_has_room(blocks: usize, limits: &Limits) -> bool {
    blocks as u64 * u64::from(BLOCK_SPLATS) * 4 < limits.max_storage_buffer_range.min(1 << 32)
}

/// How many blocks they are.
pub(crate) fn blocks_of(splats: &[Draw<'_>]) -> usize {
    splats.iter().map(|draw| draw.chunk.blocks.len()).sum()
}

/// Whether a tile sums only what its visible depth does not hide. Beside polygons more than what visibility lets through may
/// count, and layers are behind each other.
pub(crate) fn tiles_cull_hidden(splats: &[Draw<'_>], polygons: bool, settings: &Settings) -> bool {
    let wanted = match settings.cull {
        // One surface hides little of itself, so that to look for it costs more than it gains. (One of more than a chunk is
        // taken for several: 3% of a frame; but not for a few that are far from the rest and so have a chunk of their own.)
        Cull::Auto => {
            let counts = || splats.iter().map(|draw| u64::from(draw.chunk.count));
            let (all, most) = (counts().sum::<u64>(), counts().max().unwrap_or(0));
            (all - most) * LEAST_PART > all
        }
        Cull::Setup | Cull::List => false,
        Cull::Hidden => true,
    };
    wanted && !polygons && !splats.iter().any(|draw| draw.chunk.transparent)
}

/// Whether the graphics pipeline sums only what the visible depth does not hide: not where fragments farther behind count, too, because
/// the paper's transition shifts toward the viewer what visibility has shifted away.
pub(crate) fn primitives_cull_hidden(polygons: bool, settings: &Settings) -> bool {
    let shifted_twice = polygons && settings.transition == Transition::Paper;
    settings.cull == Cull::Hidden && !shifted_twice
}

/// Gives each chunk its number, and that of its first splat among all.
pub(crate) fn number_splats(splats: &mut [Draw<'_>]) {
    let mut next = 0_u32;
    for (number, draw) in (0..).zip(splats) {
        (draw.place.number, draw.place.first_record) = (number, next);
        // Where 32 bits are too few, nobody looks at it.
        next = next.wrapping_add(draw.chunk.count);
    }
}
