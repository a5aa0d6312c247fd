//! The passes of a frame: one pass, one file, one function that declares it.

mod accumulate;
mod catalog;
mod constants;
mod copy_depth;
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
mod mesh_draws;
mod paper;
mod pipelines;
mod polygons;
mod readback;
mod splat_shaders;
mod variant;
mod visibility;

use ash::vk;

pub use catalog::{PipelineRecipe, PipelineStages, Traits, frame_pipelines, papers_pipelines};
pub use constants::{ExportConstants, FinalizeConstants, FrameConstants, PaperConstants};
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
pub use pipelines::Shaders;
pub use readback::readback;

use self::finalize::Opaque;
use crate::{
    error::Result,
    graph::{Graph, Handle, Image, ImageDesc, execute::Body},
    prepare::PreparedScene,
    scene::{Accumulate, Camera, Layers, Settings},
    vk::{DescriptorPool, Limits, Occlusion, PoolRoom},
};

/// What is drawn alike: all that is opaque, or all that is transparent.
#[derive(Default)]
pub struct Part<'a> {
    /// As splats.
    pub splats: Vec<Draw<'a>>,
    /// As polygons.
    pub meshes: Vec<MeshDraw<'a>>,
}

/// A prepared scene as seen from a camera.
#[derive(Default)]
pub struct Parts<'a> {
    /// What hides all that is behind it.
    pub opaque: Part<'a>,
    /// What is drawn in layers.
    pub transparent: Part<'a>,
    /// What shines on both, where the scene has lights of its own.
    pub lights: Vec<lights::ShaderLight>,
}

impl<'a> Parts<'a> {
    /// The parts of a scene.
    pub fn of(scene: &'a PreparedScene, camera: &Camera, settings: &Settings, limits: &Limits) -> Self {
        let all = draws(scene, camera, settings, limits).into_iter();
        let (clear_splats, splats) = all.partition(|draw| draw.chunk.transparent);
        let all = mesh_draws(scene, camera, settings, limits).into_iter();
        let (clear_meshes, meshes) = all.partition(|draw| draw.chunk.transparent);
        Self {
            opaque: Part { splats, meshes },
            transparent: Part { splats: clear_splats, meshes: clear_meshes },
            lights: lights::shader_lights(&scene.lights, camera),
        }
    }
}

impl Part<'_> {
    /// Nothing at all.
    pub fn is_empty(&self) -> bool {
        self.splats.is_empty() && self.meshes.is_empty()
    }
}

/// What all passes of a frame are given.
#[derive(Clone, Copy)]
pub struct Inputs<'a> {
    /// The splats that are drawn.
    pub draws: &'a [Draw<'a>],
    /// The polygons.
    pub meshes: &'a [MeshDraw<'a>],
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
    /// The same for one part of the scene.
    fn of(self, part: &'a Part<'a>) -> Self {
        Self { draws: &part.splats, meshes: &part.meshes, ..self }
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
fn sum_format(settings: &Settings) -> vk::Format {
    match settings.accumulate {
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
    let large = |part: &Part<'_>| part.splats.iter().filter(|draw| draw.may_be_large).count() as u32;
    let layers = if parts.transparent.is_empty() { 0 } else { settings.layers.most() };
    // For each chunk with large splats: three passes that list them, two that draw them, in each layer.
    let lists = 5 * large(&parts.opaque) + (3 + 2 * layers) * large(&parts.transparent);
    // What fragments read: in accumulation; in each layer's visibility, accumulation and polygons.
    let reads = 1 + 3 * layers;
    // Sums: for finalization and each layer.
    let sums = 1 + layers;
    let counted = counts_draws && matches!(settings.layers, Layers::Auto(_)) && layers > 0;
    Needs {
        room: PoolRoom {
            sets: lists + reads + sums + 1,
            buffers: 4 * lists + reads + sums,
            images: 2 * reads + 5 * sums + 3,
            filtered_images: reads,
        },
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
    let opaque = opaque(graph, inputs.of(&parts.opaque), kernel.as_ref(), export)?;
    let layers = match parts.transparent.is_empty() {
        true => None,
        false => {
            let inputs = inputs.of(&parts.transparent);
            layers::layers(graph, inputs, opaque.depth(), kernel.as_ref(), lights.as_ref())?
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
) -> Result<Opaque> {
    let mut opaque = Opaque::default();
    let large = list_large::list_large(graph, inputs, "")?;
    if !inputs.draws.is_empty() {
        opaque.splat_depth = Some(visibility::visibility(graph, inputs, &large)?);
    }
    if !inputs.meshes.is_empty() {
        let (seen, depth) = polygons::polygons(graph, inputs, opaque.splat_depth.as_ref())?;
        (opaque.polygons, opaque.polygon_depth) = (Some(seen), Some(depth));
    }
    if let Some(depth) = &opaque.splat_depth {
        let polygons = opaque.polygon_depth.as_ref();
        opaque.splats =
            Some(accumulate::accumulate(graph, inputs, &large, depth, polygons, kernel, with_depth)?);
    }
    Ok(opaque)
}
