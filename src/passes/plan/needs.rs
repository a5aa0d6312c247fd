//! What a frame takes from whoever records it: descriptor sets and queries.

use crate::passes::{
    pipeline::{cache::room_of_lists, tile_layouts::STORAGE_BUFFERS},
    plan::{FramePlan, SurfacePlan},
};
use crate::{
    scene::{Layers, Settings},
    vk::PoolSizes,
};

/// What a frame takes for itself from whoever records it, at most.
#[derive(Clone, Copy, Debug, Default)]
pub struct Needs {
    /// Descriptor sets.
    pub room: PoolSizes,
    /// Queries whether anything was drawn.
    pub occlusion_queries: u32,
}

/// What a frame takes, at most. `counts_draws`: the device can take the number of draws from a buffer.
pub fn needs(plan: &FramePlan<'_>, settings: &Settings, counts_draws: bool) -> Needs {
    // With large splats.
    let listed = |part: &SurfacePlan<'_>| part.splats.iter().filter(|draw| draw.may_be_large).count() as u32;
    let layers = if plan.transparent.is_empty() { 0 } else { settings.layers.most() };
    // For each such chunk: three passes that list large ones, two that draw them, in each layer.
    let lists = 5 * listed(&plan.opaque) + (3 + 2 * layers) * listed(&plan.transparent);
    // Without lists, what draws splats: visibility and accumulation, also of each layer.
    let lists = lists + 2 + 2 * layers;
    // Of visible splats: three passes that list them, and three that list those which nothing hides; large ones of a band, two draws.
    let listed = |part: &SurfacePlan<'_>| part.bands().len() + usize::from(part.visible().is_some());
    let lists = lists + 8 * (listed(&plan.opaque) + listed(&plan.transparent)) as u32;
    let bands = plan.opaque.bands().len() as u32;
    // Of hybrids the choice of polygons.
    let in_cells = plan.opaque.meshes.iter().any(|draw| draw.levels.is_some());
    let lists = lists + u32::from(in_cells);
    // What fragments read: in visibility and accumulation, of each band, too; of polygons; in each layer's visibility, accumulation
    // and polygons.
    let reads = 3 + 2 * bands + 3 * layers;
    // Sums: for finalization, of tiles and of polygons, and for the export; the depth of tiles of each band; and each layer.
    // Those of samples, two more.
    let sums = 3 + bands + layers + if settings.samples.0 > 1 { 2 } else { 0 };
    // To find whose the surface is: three passes that list large ones, one that draws them and all others; those that list visible ones.
    let (lists, reads) = match &plan.objects {
        None => (lists, reads),
        Some(objects) => {
            let large = objects.splats.iter().filter(|draw| draw.may_be_large).count() as u32;
            (lists + 4 * large + 1 + 8 * u32::from(objects.visible().is_some()), reads + 1)
        }
    };
    let bands_of_all = plan.opaque.bands().iter().chain(plan.transparent.bands());
    let tiles = bands_of_all.fold(PoolSizes::default(), |sum, _| sum.plus(&room_of_tiles()));
    let counted = counts_draws && matches!(settings.layers, Layers::Auto(_)) && layers > 0;
    Needs {
        room: PoolSizes {
            sets: reads + sums + 1,
            uniform_buffers: 2 * reads + sums,
            // The cells of depth have a buffer and an image.
            buffers: 1 + reads,
            images: 2 * reads + 5 * sums + 1,
            filtered_images: reads,
            ..PoolSizes::default()
        }
        .plus(&room_of_lists(lists))
        .plus(&tiles),
        occlusion_queries: if counted { queries_of_layers(settings) } else { 0 },
    }
}

/// Sets and descriptors that a band of tiles takes from the frame's pool, at most: one for each of its passes.
fn room_of_tiles() -> PoolSizes {
    let sets = 12;
    PoolSizes {
        sets,
        buffers: STORAGE_BUFFERS * sets,
        uniform_buffers: 2 * sets,
        texel_buffers: 6 * sets,
        images: 6 * sets,
        storage_images: 6 * sets,
        ..PoolSizes::default()
    }
}

/// How many queries the layers of these settings need, on a device that can make use of them.
fn queries_of_layers(settings: &Settings) -> u32 {
    match settings.layers {
        Layers::Fixed(_) => 0,
        Layers::Auto(most) => most - 1,
    }
}
