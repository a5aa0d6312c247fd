//! What a frame takes from whoever records it: descriptor sets and queries.

use super::{Part, Parts, layers, room_of_lists, tiles};
use crate::{
    scene::{Layers, Settings},
    vk::PoolRoom,
};

/// What a frame takes for itself from whoever records it, at most.
#[derive(Clone, Copy, Debug, Default)]
pub struct Needs {
    /// Descriptor sets.
    pub room: PoolRoom,
    /// Queries whether anything was drawn.
    pub occlusion_queries: u32,
}

/// What a frame takes, at most. `counts_draws`: the device can take the number of draws from a buffer.
pub fn needs(parts: &Parts<'_>, settings: &Settings, counts_draws: bool) -> Needs {
    // With large splats.
    let listed = |part: &Part<'_>| part.splats.iter().filter(|draw| draw.may_be_large).count() as u32;
    let layers = if parts.transparent.is_empty() { 0 } else { settings.layers.most() };
    // For each such chunk: three passes that list large ones, two that draw them, in each layer.
    let lists = 5 * listed(&parts.opaque) + (3 + 2 * layers) * listed(&parts.transparent);
    // Of kept splats: three passes that list them, twice, and one that sets them up.
    let kept = |part: &Part<'_>| {
        let lists = if part.kept.is_some() { part.bands.len().max(1) as u32 } else { 0 };
        8 * lists * part.splats.len() as u32
    };
    let lists = lists + kept(&parts.opaque) + kept(&parts.transparent);
    let bands = parts.opaque.bands.len() as u32;
    // What fragments read: in accumulation, of each band; in each layer's visibility, accumulation and polygons.
    let reads = 1 + bands + 3 * layers;
    // Sums: for finalization, of tiles and of polygons; the depth of tiles of each band; and each layer.
    let sums = 2 + bands + layers;
    let plans = [&parts.opaque, &parts.transparent].into_iter().flat_map(Part::plans);
    let tiles = plans.map(tiles::room).fold(PoolRoom::default(), |sum, room| sum.plus(&room));
    let counted = counts_draws && matches!(settings.layers, Layers::Auto(_)) && layers > 0;
    Needs {
        room: PoolRoom {
            sets: reads + sums + 1,
            uniform_buffers: reads + sums,
            images: 2 * reads + 5 * sums + 4,
            filtered_images: reads,
            ..PoolRoom::default()
        }
        .plus(&room_of_lists(lists))
        .plus(&tiles),
        occlusion_queries: if counted { layers::queries_needed(settings) } else { 0 },
    }
}
