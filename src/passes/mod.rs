//! The passes of a frame: one pass, one file, one function that declares it.

pub(crate) mod cull;
pub(crate) mod host;
pub(crate) mod in_parts;
pub(crate) mod inputs;
pub(crate) mod layers;
pub(crate) mod pass;
pub(crate) mod pick;
pub(crate) mod pipeline;
pub(crate) mod place;
pub(crate) mod plan;
pub(crate) mod polygons;
pub(crate) mod predicate;
pub(crate) mod recording;
pub(crate) mod resolve;
pub(crate) mod splats;
pub(crate) mod tiles;

use ash::vk;

pub use crate::passes::inputs::Inputs;
pub use crate::passes::pass::{Place, Source};
pub use crate::passes::pick::{PickPlan, PickRay, Picked, PickedPart};
pub(crate) use crate::passes::pick::{needs as needs_of_pick, pick};
pub(crate) use crate::passes::pipeline::cache::Run;
pub use crate::passes::pipeline::cache::{MissingPipelines, Shaders, room_of_lists};
pub use crate::passes::pipeline::constants::{
    FinalizeConstants, FrameConstants, HostDepth, HostObject, PaperConstants, TileConstants,
};
#[cfg(feature = "test-formulas")]
pub use crate::passes::pipeline::formula::Formula;
pub use crate::passes::pipeline::recipe::{PipelineRecipe, PipelineStages};
pub(crate) use crate::passes::place::PLANES_BYTES;
pub use crate::passes::place::{Planes, Tints};
pub use crate::passes::plan::budget::count_drawn;
pub(crate) use crate::passes::plan::budget::within_budget;
pub(crate) use crate::passes::plan::digits::{
    beyond_f32, check as check_digits, floors, unused_levels, unused_sums,
};
pub use crate::passes::plan::draws::{Draw, draws};
pub(crate) use crate::passes::plan::lights::check as check_lights;
pub use crate::passes::plan::mesh_draws::{MeshDraw, mesh_draws};
pub use crate::passes::plan::needs::{Needs, needs};
pub(crate) use crate::passes::plan::planes::ShaderPlane;
pub use crate::passes::plan::range::DepthRange;
pub use crate::passes::plan::{
    FramePlan, SplatMethod, SurfacePlan, method::check as check_method, sums::with_sums,
};
pub use crate::passes::resolve::export::Exported;
pub use crate::passes::resolve::readback::{readback, readback_buffer};
pub(crate) use crate::passes::resolve::samples::{SAMPLE_FORMAT, add_sample, resolve_samples};
pub use crate::passes::{
    pipeline::tile_layouts::STORAGE_BUFFERS as TILE_STORAGE_BUFFERS,
    plan::{bands::Band, invocations::Invocations, tiles::TilePlan},
};

use crate::passes::{
    cull::lists::Lists,
    host::BesideHost,
    plan::outputs::Outputs,
    resolve::finalize::{Opaque, ShownPolygons},
    tiles::{shaded::PolygonsBefore, start::TileStart},
};
use crate::{
    error::Result,
    graph::{Buffer, Graph, Handle, Image, execute::Body},
    scene::Shading,
};

/// The whole frame. What a scene does not have takes no pass: splats, polygons, transparent things; large splats are listed
/// where one may exceed the device's largest point or come near the eye plane; the surface is exported as data where that
/// is asked for.
///
/// # Errors
/// Whatever the driver answers when a pipeline is made.
pub(crate) fn frame<'a>(
    graph: &mut Graph<'a, Body<'a>>,
    inputs: Inputs<'a>,
    plan: &'a FramePlan<'a>,
    target: &mut Handle<Image>,
    target_format: vk::Format,
    (export, beside): (bool, Option<BesideHost<'_>>),
) -> Result<Option<Exported>> {
    let kernel = match plan.opaque.splats.is_empty() && plan.transparent.splats.is_empty() {
        true => None,
        false => splats::accumulate::kernel_of(graph, inputs)?,
    };
    let lights = resolve::lights::lights(graph, inputs.source, plan.lights);
    let inputs = Inputs { lights: plan.lights.len() as u32, ..inputs };
    let by_depth = inputs.settings.shading == Shading::EyeDome;
    let outputs = Outputs {
        surface: export || by_depth,
        depth: beside.is_some(),
        layers: !plan.transparent.is_empty(),
        target_format,
    };

    let opaque_inputs = inputs.of(&plan.opaque);
    let (opaque, own_depth) = if plan.opaque.bands().is_empty() {
        (by_primitives(graph, opaque_inputs, kernel.as_ref(), outputs)?, None)
    } else if outputs.may_be_shaded(&plan.opaque) {
        shaded_by_tiles(graph, opaque_inputs, lights.as_ref(), outputs)?
    } else {
        (summed_by_tiles(graph, opaque_inputs, outputs)?, None)
    };

    let of_host = beside.as_ref().and_then(|beside| beside.hides).filter(|_| outputs.layers);
    let with_host = of_host
        .map(|of_host| host::depth_in::depth_with_host(graph, inputs, opaque.depth(), of_host))
        .transpose()?;
    let hides = with_host.as_ref().or(opaque.depth());
    let mut layers = match plan.transparent.is_empty() {
        true => None,
        false => {
            let inputs = inputs.of(&plan.transparent);
            match inputs.bands.is_empty() {
                false => Some(tiles::layers(graph, inputs, hides, lights.as_ref())?),
                true => layers::frame::layers(graph, inputs, hides, kernel.as_ref(), lights.as_ref())?,
            }
        }
    };
    if let Some(BesideHost { depth, objects, layers: target, .. }) = beside {
        let polygons = !plan.opaque.meshes.is_empty();
        host::depth_out::surface_depth(graph, inputs, (&opaque, own_depth.as_ref()), polygons, depth)?;
        if let (Some(plan), Some(objects)) = (&plan.objects, objects) {
            host::objects_out::objects(graph, inputs.of(plan), depth, objects)?;
        }
        if let (Some(layers), Some(target)) = (layers.take(), target) {
            host::layers_out::layers_alone(graph, inputs, &layers, (target, target_format))?;
        }
    }
    let surface = opaque.splats.as_ref().zip(opaque.splat_depth.as_ref());
    match surface.filter(|_| by_depth) {
        Some(surface) => resolve::eye_dome::eye_dome(graph, inputs, surface, target, target_format)?,
        None => resolve::finalize::finalize(
            graph,
            inputs,
            &opaque,
            layers.as_ref(),
            lights.as_ref(),
            target,
            target_format,
        )?,
    }
    export.then(|| resolve::export::export(graph, inputs, surface)).transpose()
}

/// Opaque things by the graphics pipeline: visibility of splats; polygons upon it; accumulation of the splats that neither hides.
fn by_primitives<'a>(
    graph: &mut Graph<'a, Body<'a>>,
    inputs: Inputs<'a>,
    kernel: Option<&Handle<Image>>,
    outputs: Outputs,
) -> Result<Opaque<'a>> {
    let mut opaque = Opaque::nothing(graph.arena());
    let lists = Lists::make(graph, inputs, "")?;
    if !inputs.draws.is_empty() {
        opaque.splat_depth = Some(splats::visibility::visibility(graph, inputs, &lists)?);
    }
    if !inputs.meshes.is_empty() {
        let (seen, depth) = polygons::draw::polygons(graph, inputs, opaque.splat_depth.as_ref())?;
        (opaque.polygons, opaque.polygon_depth) = (Some(seen), Some(depth));
    }
    if let Some(depth) = &opaque.splat_depth {
        let polygons = opaque.polygon_depth.as_ref();
        let lists = lists.without_hidden(graph, inputs, depth)?;
        opaque.splats = Some(splats::accumulate::accumulate(
            graph,
            inputs,
            &lists,
            depth,
            polygons,
            kernel,
            outputs.sums_depth(),
        )?);
    }
    Ok(opaque)
}

/// Opaque things by tiles that are shaded at once, for a frame of which nobody reads sums: polygons; then, band by band, lists, and
/// the tiles. Transparent layers want the depth, too, and all of both images. What a host draws beside wants the surface's own depth, which is
/// the second answer.
fn shaded_by_tiles<'a>(
    graph: &mut Graph<'a, Body<'a>>,
    inputs: Inputs<'a>,
    lights: Option<&Handle<Buffer>>,
    outputs: Outputs,
) -> Result<(Opaque<'a>, Option<Handle<Image>>)> {
    let mut shown = tiles::ShadedTiles::create(graph, inputs, outputs);
    let mut opaque = Opaque::nothing(graph.arena());
    let mut start = if outputs.layers { TileStart::Cleared } else { TileStart::Empty };
    let mut samples = None;
    if inputs.samples_polygons() {
        let image = (&mut shown.image, shown.precision);
        let (drawn, depth) = polygons::sampled::sampled(graph, inputs, image, lights, outputs)?;
        samples = Some(drawn);
        (opaque.polygon_depth, start) = (depth, TileStart::SampledPolygons);
        opaque.shows_polygons = ShownPolygons::InPart;
    } else if !inputs.meshes.is_empty() {
        let depth = polygons::draw::shaded(graph, inputs, (&mut shown.image, shown.precision), lights)?;
        (opaque.polygon_depth, start) = (Some(depth), TileStart::Polygons);
        opaque.shows_polygons = ShownPolygons::Whole;
    }
    for (band, inputs, plan) in inputs.of_bands(graph.arena()) {
        let mut tiles = tiles::list(graph, inputs, band, plan)?;
        let polygons = match (&samples, &opaque.polygon_depth) {
            (Some(samples), _) => PolygonsBefore::Sampled(&samples.color, &samples.depth),
            (None, Some(depth)) => PolygonsBefore::Whole(depth),
            (None, None) => PolygonsBefore::None,
        };
        tiles::shaded(graph, inputs, band, &mut tiles, &mut shown, (polygons, lights), start)?;
        start = start.after_a_band();
        if let Some(depth) = &shown.depth {
            let before = opaque.polygon_depth.take().or(opaque.splat_depth.take());
            opaque.splat_depth = Some(tiles::depth_buffer(graph, inputs, band, &tiles, depth, before)?);
        }
        opaque.tiles.push(tiles);
    }
    opaque.shown = Some(shown.image);
    Ok((opaque, shown.own_depth))
}

/// Opaque things by tiles that leave sums and a depth. Where all of the images is read, tiles without splats need content, too; so
/// they do where the graphics pipeline draws into them: large splats before and after, polygons (of an image in one band) in
/// between.
fn summed_by_tiles<'a>(
    graph: &mut Graph<'a, Body<'a>>,
    inputs: Inputs<'a>,
    outputs: Outputs,
) -> Result<Opaque<'a>> {
    let (polygons, with_depth) = (!inputs.meshes.is_empty(), outputs.sums_depth());
    let mut opaque = Opaque::nothing(graph.arena());
    let Some(common) = inputs.bands.first().map(|band| &band.plan) else { return Ok(opaque) };
    let complete = outputs.reads_whole_images() || common.may_be_large || polygons;
    let mut images = tiles::TileImages::create(graph, inputs, common, complete);
    let mut start = if complete { TileStart::Cleared } else { TileStart::Empty };
    for (band, inputs, plan) in inputs.of_bands(graph.arena()) {
        let mut tiles = tiles::list(graph, inputs, band, plan)?;
        let may_be_large = tiles.plan.may_be_large;
        let mut depth = opaque.splat_depth.take();
        if may_be_large {
            depth = Some(tiles::see_large(graph, inputs, band, &tiles, depth)?);
        }
        let large = depth.as_ref().filter(|_| may_be_large);
        if polygons {
            tiles::see(graph, inputs, band, &tiles, &mut images, large, true)?;
        } else {
            tiles::fused(graph, inputs, band, &mut tiles, &mut images, large, (with_depth, start))?;
        }
        start = start.after_a_band();
        if complete {
            depth = Some(tiles::depth_buffer(graph, inputs, band, &tiles, &images.depth, depth)?);
        }
        if polygons {
            let (seen, depth) = polygons::draw::polygons(graph, inputs, depth.as_ref())?;
            tiles::sum(graph, inputs, band, &tiles, &mut images, (Some(&depth), with_depth), true)?;
            (opaque.polygons, opaque.polygon_depth) = (Some(seen), Some(depth));
        }
        // At once, for the lists of the next band lie where those of this one are.
        if let (true, Some(depth)) = (may_be_large, &depth) {
            let depths = (depth, opaque.polygon_depth.as_ref());
            tiles::sum_large(graph, inputs, band, &tiles, &mut images, depths, with_depth)?;
        }
        opaque.splat_depth = depth;
        if !complete {
            opaque.tiles.push(tiles);
        }
    }
    opaque.splats = Some(images.sums);
    Ok(opaque)
}
