//! The passes of a frame: one pass, one file, one function that declares it.

mod accumulate;
mod catalog;
mod constants;
mod draws;
mod export;
mod finalize;
mod floor;
#[cfg(feature = "test-formulas")]
mod formula;
mod fullscreen;
#[cfg(feature = "counts")]
mod instructions;
mod kernel_texture;
mod list_large;
mod paper;
mod pipelines;
mod readback;
mod splat_shaders;
mod variant;
mod visibility;

use ash::vk;

pub use catalog::{PipelineRecipe, PipelineStages, Traits, frame_pipelines, papers_pipelines};
pub use constants::{ExportConstants, FinalizeConstants, FrameConstants, PaperConstants};
pub use draws::{Draw, draws};
pub use export::Exported;
pub use floor::{FLOOR_POINT_BYTES, FloorPoints, floor_frame, floor_points};
#[cfg(feature = "test-formulas")]
pub use formula::Formula;
#[cfg(feature = "counts")]
pub use instructions::{Counter, counts_of};
pub use paper::paper_frame;
pub use pipelines::Shaders;
pub use readback::readback;

use crate::{
    error::Result,
    graph::{Graph, Handle, Image, ImageDesc, execute::Body},
    scene::{Accumulate, Camera, KernelEval, Settings},
    vk::{DescriptorPool, PoolRoom},
};

/// What all passes of a frame are given.
#[derive(Clone, Copy)]
pub struct Inputs<'a> {
    /// What is drawn.
    pub draws: &'a [Draw<'a>],
    /// From where.
    pub camera: &'a Camera,
    /// How.
    pub settings: &'a Settings,
    /// Pipelines and their layouts.
    pub shaders: &'a Shaders,
    /// Descriptor sets that live as long as the frame; room for [`room_needed`].
    pub descriptors: &'a DescriptorPool,
}

impl Inputs<'_> {
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

/// What a frame takes from [`Inputs::descriptors`], at most.
pub fn room_needed(draws: &[Draw<'_>], settings: &Settings) -> PoolRoom {
    let large = draws.iter().filter(|draw| draw.may_be_large).count() as u32;
    // For each chunk with large splats: three passes that list them, two that draw them.
    let lists = 5 * large;
    PoolRoom {
        // What accumulation reads; sums for finalization; sums and depth for export.
        sets: lists + 3,
        buffers: 4 * lists,
        images: 1 + 2 + 3,
        filtered_images: u32::from(settings.kernel_eval == KernelEval::Texture),
    }
}

/// The frame of an opaque scene: visibility, accumulation, finalization; before them the list of large splats, only
/// where a splat may exceed the device's largest point or come near the eye plane; after them the surface as data, only where it is asked for.
///
/// # Errors
/// Whatever the driver answers when a pipeline is made.
pub fn opaque_frame<'a>(
    graph: &mut Graph<Body<'a>>,
    inputs: Inputs<'a>,
    target: &mut Handle<Image>,
    target_format: vk::Format,
    export: bool,
) -> Result<Option<Exported>> {
    let large = list_large::list_large(graph, inputs)?;
    let depth = visibility::visibility(graph, inputs, &large)?;
    let sums = accumulate::accumulate(graph, inputs, &large, &depth, export)?;
    finalize::finalize(graph, inputs, &sums, &depth, target, target_format)?;
    match export {
        true => export::export(graph, inputs, &sums, &depth).map(Some),
        false => Ok(None),
    }
}
