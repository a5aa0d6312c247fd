//! The passes of a frame: one pass, one file, one function that declares it.

mod accumulate;
mod blocks;
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
mod inputs;
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
mod listed;
mod lists;
mod mesh_draws;
mod needs;
mod paper;
mod parts;
mod pipelines;
mod polygons;
mod readback;
mod recipe;
mod seen;
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
    FLOOR_POINT_BYTES, FloorPoints, LimitDispatch, LimitInputs, floor_frame, floor_points, limit_dispatch,
    limit_draws, limit_fill,
};
#[cfg(feature = "test-formulas")]
pub use formula::Formula;
pub use inputs::Inputs;
#[cfg(feature = "counts")]
pub use instructions::{Counter, counts_of};
pub use mesh_draws::{MeshDraw, mesh_draws};
pub use needs::{Needs, needs};
pub use paper::paper_frame;
pub use parts::{Part, Parts};
pub use pipelines::{Shaders, room_of_lists};
pub use readback::{readback, readback_buffer};
pub use recipe::{PipelineRecipe, PipelineStages};
pub use tiles::{
    Invocations, ListsInUse, STORAGE_BUFFERS as TILE_STORAGE_BUFFERS, TilePlan, TilesInUse, told_by,
};

use self::{finalize::Opaque, lists::Lists, tiles::TileStart};
use crate::{
    error::Result,
    graph::{Buffer, Graph, Handle, Image, execute::Body},
    scene::{Accumulate, Settings},
};

/// The format of the sums.
fn sum_format(accumulate: Accumulate) -> vk::Format {
    match accumulate {
        Accumulate::F16 => vk::Format::R16G16B16A16_SFLOAT,
        Accumulate::F32 => vk::Format::R32G32B32A32_SFLOAT,
    }
}

/// The visibility pass's reversed depth: near / z.
const DEPTH_FORMAT: vk::Format = vk::Format::D32_SFLOAT;

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
    let readers = Readers { export, layers: !parts.transparent.is_empty(), target_format };
    let opaque = opaque(graph, inputs.of(&parts.opaque), (kernel.as_ref(), lights.as_ref()), readers)?;
    let layers = match parts.transparent.is_empty() {
        true => None,
        false => {
            let inputs = inputs.of(&parts.transparent);
            match inputs.tiles {
                Some(_) => Some(tiles::layers(graph, inputs, opaque.depth(), lights.as_ref())?),
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

/// Who reads what the opaque part leaves.
#[derive(Clone, Copy)]
struct Readers {
    /// Sums, of depth too, are exported.
    export: bool,
    /// Transparent layers lie before it.
    layers: bool,
    /// The picture's.
    target_format: vk::Format,
}

impl Readers {
    /// Sums and depth are read everywhere, not only where finalization shades.
    fn whole_images(self) -> bool {
        self.export || self.layers
    }

    /// The precision of what tiles show: a target of 32 bits loses nothing by it.
    fn shown(self, settings: &Settings) -> Accumulate {
        match self.target_format {
            vk::Format::R32G32B32A32_SFLOAT => Accumulate::F32,
            _ => settings.accumulate,
        }
    }
}

/// The opaque part: visibility of splats; polygons upon it; accumulation of the splats that neither hides.
fn opaque<'a>(
    graph: &mut Graph<Body<'a>>,
    inputs: Inputs<'a>,
    (kernel, lights): (Option<&Handle<Image>>, Option<&Handle<Buffer>>),
    readers: Readers,
) -> Result<Opaque<'a>> {
    if let Some(plan) = inputs.tiles {
        return match !readers.whole_images() && tiles::can_shade(inputs) {
            true => shaded_by_tiles(graph, inputs, lights, readers.shown(inputs.settings)),
            false => opaque_by_tiles(graph, inputs, plan, readers),
        };
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
            Some(accumulate::accumulate(graph, inputs, &lists, depth, polygons, kernel, readers.export)?);
    }
    Ok(opaque)
}

/// The same by tiles, which are shaded, too: for a frame of which nobody reads sums or depth.
fn shaded_by_tiles<'a>(
    graph: &mut Graph<Body<'a>>,
    inputs: Inputs<'a>,
    lights: Option<&Handle<Buffer>>,
    precision: Accumulate,
) -> Result<Opaque<'a>> {
    let image = graph.create_image("shown by tiles", inputs.image(sum_format(precision)));
    let mut shown = tiles::Shown { image, precision };
    let mut opaque = Opaque::default();
    let mut start = TileStart::Empty;
    if !inputs.meshes.is_empty() {
        let depth = polygons::shaded(graph, inputs, (&mut shown.image, precision), lights)?;
        (opaque.polygon_depth, start) = (Some(depth), TileStart::Polygons);
    }
    for (kind, inputs) in inputs.of_bands() {
        let Some(plan) = inputs.tiles else { continue };
        let mut tiles = tiles::list(graph, inputs, &kind, plan)?;
        let polygons = opaque.polygon_depth.as_ref();
        tiles::shaded(graph, inputs, &kind, &mut tiles, &mut shown, (polygons, lights), start)?;
        start = start.after_a_band();
        opaque.tiles.push(tiles);
    }
    opaque.shown = Some(shown.image);
    Ok(opaque)
}

/// The same by tiles. Where all of the images is read, tiles without splats need content too. It is, too, where the graphics
/// pipeline draws into them: large splats before and after, polygons in between.
fn opaque_by_tiles<'a>(
    graph: &mut Graph<Body<'a>>,
    inputs: Inputs<'a>,
    plan: &'a TilePlan,
    readers: Readers,
) -> Result<Opaque<'a>> {
    if !inputs.bands.is_empty() {
        return opaque_by_bands(graph, inputs, plan, readers);
    }
    let with_depth = readers.export;
    let complete = readers.whole_images() || plan.may_be_large || !inputs.meshes.is_empty();
    let mut tiles = tiles::list(graph, inputs, "", plan)?;
    let mut images = tiles::TileImages::create(graph, inputs, plan, complete);
    let mut opaque = Opaque::default();
    let large = plan.may_be_large.then(|| tiles::see_large(graph, inputs, "", &tiles, None)).transpose()?;
    if inputs.meshes.is_empty() {
        let start = if complete { TileStart::Cleared } else { TileStart::Empty };
        tiles::fused(graph, inputs, "", &mut tiles, &mut images, large.as_ref(), (with_depth, start))?;
    } else {
        tiles::visibility(graph, inputs, &tiles, &mut images, large.as_ref())?;
    }
    if complete {
        opaque.splat_depth = Some(tiles::depth_buffer(graph, inputs, "", &tiles, &images.depth, large)?);
    }
    if !inputs.meshes.is_empty() {
        let (seen, depth) = polygons::polygons(graph, inputs, opaque.splat_depth.as_ref())?;
        tiles::accumulate(graph, inputs, &tiles, &mut images, Some(&depth), with_depth)?;
        (opaque.polygons, opaque.polygon_depth) = (Some(seen), Some(depth));
    }
    if let (true, Some(depth)) = (plan.may_be_large, &opaque.splat_depth) {
        let depths = (depth, opaque.polygon_depth.as_ref());
        tiles::sum_large(graph, inputs, "", &tiles, &mut images, depths, with_depth)?;
    }
    opaque.splats = Some(images.sums);
    opaque.tiles = if complete { Vec::new() } else { vec![tiles] };
    Ok(opaque)
}

/// The same, a band of the image after the other: of splats alone.
fn opaque_by_bands<'a>(
    graph: &mut Graph<Body<'a>>,
    inputs: Inputs<'a>,
    whole: &TilePlan,
    readers: Readers,
) -> Result<Opaque<'a>> {
    let with_depth = readers.export;
    let plans = || inputs.bands.iter().map(|band| &band.plan);
    let common = plans().next().unwrap_or(whole);
    let complete = readers.whole_images() || common.may_be_large;
    let mut images = tiles::TileImages::create(graph, inputs, common, complete);
    let mut start = if complete { TileStart::Cleared } else { TileStart::Empty };
    let mut opaque = Opaque::default();
    for ((kind, inputs), plan) in inputs.of_bands().into_iter().zip(plans()) {
        let mut tiles = tiles::list(graph, inputs, &kind, plan)?;
        let mut large = None;
        if plan.may_be_large {
            large = Some(tiles::see_large(graph, inputs, &kind, &tiles, opaque.splat_depth.take())?);
        }
        tiles::fused(graph, inputs, &kind, &mut tiles, &mut images, large.as_ref(), (with_depth, start))?;
        start = start.after_a_band();
        if complete {
            let before = large.or(opaque.splat_depth.take());
            opaque.splat_depth =
                Some(tiles::depth_buffer(graph, inputs, &kind, &tiles, &images.depth, before)?);
        }
        // At once, for the lists of the next band lie where those of this one are.
        if let (true, Some(depth)) = (plan.may_be_large, &opaque.splat_depth) {
            tiles::sum_large(graph, inputs, &kind, &tiles, &mut images, (depth, None), with_depth)?;
        }
        if !complete {
            opaque.tiles.push(tiles);
        }
    }
    opaque.splats = Some(images.sums);
    Ok(opaque)
}
