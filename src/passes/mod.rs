//! The passes of a frame: one pass, one file, one function that declares it.

mod accumulate;
mod catalog;
mod choice;
mod constants;
mod copy_depth;
mod cull;
mod cull_hidden;
mod draws;
mod export;
mod finalize;
mod floor;
#[cfg(feature = "test-formulas")]
mod formula;
mod fullscreen;
mod gate;
#[cfg(feature = "counts")]
mod instructions;
mod kernel_texture;
mod layer_accumulate;
mod layer_compose;
mod layer_rest;
mod layer_visibility;
mod layers;
mod lights;
mod list_large;
mod lists;
mod mesh_draws;
mod paper;
mod parts;
mod pipelines;
mod point_records;
mod polygons;
mod readback;
mod recipe;
mod splat_pass;
mod splat_shaders;
mod tiles;
mod variant;
mod visibility;

use ash::vk;

pub use catalog::{Traits, frame_pipelines, papers_pipelines};
pub use choice::check as check_choice;
pub use constants::{ExportConstants, FinalizeConstants, FrameConstants, PaperConstants, TileConstants};
pub use draws::{Draw, draws};
pub use export::Exported;
pub use floor::{
    FLOOR_POINT_BYTES, FloorPoints, LIMIT_GROUP, LIMIT_GROUPS, LimitInputs, floor_frame, floor_points,
    limit_copy, limit_draws, limit_fill, limit_invocations,
};
#[cfg(feature = "test-formulas")]
pub use formula::Formula;
#[cfg(feature = "counts")]
pub use instructions::{Counter, counts_of};
pub use mesh_draws::{MeshDraw, mesh_draws};
pub use paper::paper_frame;
pub use parts::{Part, Parts};
pub use pipelines::{Shaders, room_of_lists};
pub use readback::readback;
pub use recipe::{PipelineRecipe, PipelineStages};
pub use tiles::{Invocations, STORAGE_BUFFERS as TILE_STORAGE_BUFFERS, TilePlan};

use self::{finalize::Opaque, lists::Lists};
use crate::{
    error::Result,
    graph::{Graph, Handle, Image, ImageDesc, execute::Body},
    scene::{Accumulate, Camera, Layers, Settings},
    vk::{DescriptorPool, Occlusion, PoolRoom},
};

/// What all passes of a frame are given.
#[derive(Clone, Copy)]
pub struct Inputs<'a> {
    /// The splats that are drawn.
    pub draws: &'a [Draw<'a>],
    /// The polygons.
    pub meshes: &'a [MeshDraw<'a>],
    /// How the splats are drawn by tiles, where they are.
    pub tiles: Option<&'a TilePlan>,
    /// Only splats of a list are set up.
    pub kept: bool,
    /// Points are set up once, for all passes.
    pub recorded: bool,
    /// What is hidden is left out before sums.
    pub leaves_hidden_out: bool,
    /// The scene's own lights.
    pub lights: u32,
    /// From where.
    pub camera: &'a Camera,
    /// How.
    pub settings: &'a Settings,
    /// Pipelines and their layouts.
    pub shaders: &'a Shaders,
    /// Descriptor sets that live as long as the frame; room for [`needs`].
    pub descriptors: &'a DescriptorPool,
    /// The queries of [`needs`], where it has any.
    pub occlusion: Option<&'a Occlusion>,
}

impl<'a> Inputs<'a> {
    /// Those of a frame in which nothing is drawn yet.
    pub fn new(
        camera: &'a Camera,
        settings: &'a Settings,
        shaders: &'a Shaders,
        descriptors: &'a DescriptorPool,
    ) -> Self {
        let (draws, meshes): (&[Draw<'_>], &[MeshDraw<'_>]) = (&[], &[]);
        Self {
            draws,
            meshes,
            tiles: None,
            kept: false,
            recorded: false,
            leaves_hidden_out: false,
            lights: 0,
            camera,
            settings,
            shaders,
            descriptors,
            occlusion: None,
        }
    }

    /// The same for one part of the scene.
    fn of(self, part: &'a Part<'a>) -> Self {
        Self {
            draws: &part.splats,
            meshes: &part.meshes,
            tiles: part.tiles.as_ref(),
            kept: part.kept,
            recorded: part.recorded,
            leaves_hidden_out: part.leaves_hidden_out(self.settings),
            ..self
        }
    }

    fn extent(&self) -> vk::Extent2D {
        let [width, height] = self.settings.size_px;
        vk::Extent2D { width, height }
    }

    fn image(&self, format: vk::Format) -> ImageDesc {
        ImageDesc { format, extent: self.extent() }
    }
}

/// The format of the sums.
fn sum_format(accumulate: Accumulate) -> vk::Format {
    match accumulate {
        Accumulate::F16 => vk::Format::R16G16B16A16_SFLOAT,
        Accumulate::F32 => vk::Format::R32G32B32A32_SFLOAT,
    }
}

/// The visibility pass's reversed depth: near / z.
const DEPTH_FORMAT: vk::Format = vk::Format::D32_SFLOAT;

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
    // With large splats or records.
    let listed =
        |part: &Part<'_>| part.splats.iter().filter(|draw| draw.may_be_large || part.recorded).count() as u32;
    let layers = if parts.transparent.is_empty() { 0 } else { settings.layers.most() };
    // For each such chunk: three passes that list large ones, one that makes records, two that draw them, in each layer.
    let lists = 6 * listed(&parts.opaque) + (4 + 2 * layers) * listed(&parts.transparent);
    // Of kept splats: three passes that list them, twice, and one that sets them up.
    let kept = |part: &Part<'_>| if part.kept { 8 * part.splats.len() as u32 } else { 0 };
    let lists = lists + kept(&parts.opaque) + kept(&parts.transparent);
    // What fragments read: in accumulation; in each layer's visibility, accumulation and polygons.
    let reads = 1 + 3 * layers;
    // Sums: for finalization and each layer.
    let sums = 1 + layers;
    let by_tiles = [&parts.opaque, &parts.transparent].into_iter().filter_map(|part| part.tiles.as_ref());
    let tiles = by_tiles.map(tiles::room).fold(PoolRoom::default(), |sum, room| sum.plus(&room));
    let counted = counts_draws && matches!(settings.layers, Layers::Auto(_)) && layers > 0;
    Needs {
        room: PoolRoom {
            sets: reads + sums + 1,
            buffers: reads + sums,
            images: 2 * reads + 5 * sums + 4,
            filtered_images: reads,
            storage_images: 0,
        }
        .plus(&room_of_lists(lists))
        .plus(&tiles),
        occlusion_queries: if counted { layers::queries_needed(settings) } else { 0 },
    }
}

/// The whole frame. What a scene does not have takes no pass: splats, polygons, transparent things; large splats are listed
/// where one may exceed the device's largest point or come near the eye plane; the surface is exported as data where that
/// is asked for.
///
/// # Errors
/// Whatever the driver answers when a pipeline is made.
pub fn frame<'a>(
    graph: &mut Graph<Body<'a>>,
    inputs: Inputs<'a>,
    parts: &'a Parts<'a>,
    target: &mut Handle<Image>,
    target_format: vk::Format,
    export: bool,
) -> Result<Option<Exported>> {
    let kernel = match parts.opaque.splats.is_empty() && parts.transparent.splats.is_empty() {
        true => None,
        false => accumulate::kernel_of(graph, inputs)?,
    };
    let lights = lights::lights(graph, &parts.lights);
    let inputs = Inputs { lights: parts.lights.len() as u32, ..inputs };
    let complete = export || !parts.transparent.is_empty();
    let opaque = opaque(graph, inputs.of(&parts.opaque), kernel.as_ref(), export, complete)?;
    let layers = match parts.transparent.is_empty() {
        true => None,
        false => {
            let inputs = inputs.of(&parts.transparent);
            match inputs.tiles {
                Some(plan) => {
                    let tiles = tiles::list(graph, inputs, "transparent ", plan)?;
                    Some(tiles::layers(graph, inputs, &tiles, opaque.depth(), lights.as_ref())?)
                }
                None => layers::layers(graph, inputs, opaque.depth(), kernel.as_ref(), lights.as_ref())?,
            }
        }
    };
    finalize::finalize(graph, inputs, &opaque, layers.as_ref(), lights.as_ref(), target, target_format)?;
    match (export, &opaque.splats, &opaque.splat_depth) {
        (false, ..) => Ok(None),
        (true, Some(sums), Some(depth)) => export::export(graph, inputs, sums, depth).map(Some),
        (true, ..) => Ok(Some(export::export_nothing(graph, inputs))),
    }
}

/// The opaque part: visibility of splats; polygons upon it; accumulation of the splats that neither hides.
fn opaque<'a>(
    graph: &mut Graph<Body<'a>>,
    inputs: Inputs<'a>,
    kernel: Option<&Handle<Image>>,
    with_depth: bool,
    complete: bool,
) -> Result<Opaque<'a>> {
    if let Some(plan) = inputs.tiles {
        return opaque_by_tiles(graph, inputs, plan, with_depth, complete);
    }
    let mut opaque = Opaque::default();
    let lists = Lists::make(graph, inputs, "")?;
    if !inputs.draws.is_empty() {
        opaque.splat_depth = Some(visibility::visibility(graph, inputs, &lists)?);
    }
    if !inputs.meshes.is_empty() {
        let (seen, depth) = polygons::polygons(graph, inputs, opaque.splat_depth.as_ref())?;
        (opaque.polygons, opaque.polygon_depth) = (Some(seen), Some(depth));
    }
    if let Some(depth) = &opaque.splat_depth {
        let polygons = opaque.polygon_depth.as_ref();
        let lists = lists.without_hidden(graph, inputs, depth)?;
        opaque.splats =
            Some(accumulate::accumulate(graph, inputs, &lists, depth, polygons, kernel, with_depth)?);
    }
    Ok(opaque)
}

/// The same by tiles. `complete`: all of the images is read, so that tiles without splats need content too. It is, too, where the
/// graphics pipeline draws into them: large splats before and after, polygons in between.
fn opaque_by_tiles<'a>(
    graph: &mut Graph<Body<'a>>,
    inputs: Inputs<'a>,
    plan: &'a TilePlan,
    with_depth: bool,
    complete: bool,
) -> Result<Opaque<'a>> {
    let complete = complete || plan.may_be_large || !inputs.meshes.is_empty();
    let mut tiles = tiles::list(graph, inputs, "", plan)?;
    let mut images = tiles::TileImages::create(graph, inputs, plan, complete);
    let mut opaque = Opaque::default();
    let large = plan.may_be_large.then(|| tiles::see_large(graph, inputs, &tiles)).transpose()?;
    if inputs.meshes.is_empty() {
        tiles::fused(graph, inputs, &mut tiles, &mut images, large.as_ref(), (with_depth, complete))?;
    } else {
        tiles::visibility(graph, inputs, &tiles, &mut images, large.as_ref())?;
    }
    if complete {
        opaque.splat_depth = Some(tiles::depth_buffer(graph, inputs, &tiles, &images.depth, large)?);
    }
    if !inputs.meshes.is_empty() {
        let (seen, depth) = polygons::polygons(graph, inputs, opaque.splat_depth.as_ref())?;
        tiles::accumulate(graph, inputs, &tiles, &mut images, Some(&depth), with_depth)?;
        (opaque.polygons, opaque.polygon_depth) = (Some(seen), Some(depth));
    }
    if let (true, Some(depth)) = (plan.may_be_large, &opaque.splat_depth) {
        let depths = (depth, opaque.polygon_depth.as_ref());
        tiles::sum_large(graph, inputs, &tiles, &mut images, depths, with_depth)?;
    }
    opaque.splats = Some(images.sums);
    opaque.tiles = (!complete).then_some(tiles);
    Ok(opaque)
}
