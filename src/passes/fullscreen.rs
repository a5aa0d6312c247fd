//! One triangle over the whole target.

use ash::vk;

use super::Inputs;
use crate::{
    error::Result,
    graph::{ResourceId, execute::PassContext},
    vk::{GraphicsPipeline, PipelineLayout, SetLayout},
};

/// Records the draw. The pipeline's vertex stage is `glsl/fullscreen.vert.glsl`; what it reads and its push constants are
/// those of `layout`, which is finalization's.
pub(super) fn draw_fullscreen(
    context: &PassContext<'_>,
    inputs: Inputs<'_>,
    pipeline: &GraphicsPipeline,
    layout: &PipelineLayout,
    read: Read<'_>,
    constants: &[u8],
) -> Result<()> {
    bind_fullscreen(context, inputs, pipeline, layout, read, constants)?;
    // SAFETY: inside of rendering, with all bound that the pipeline needs.
    unsafe { context.device().cmd_draw(context.commands(), 3, 1, 0, 0) };
    Ok(())
}

/// Records what that draw needs.
pub(super) fn bind_fullscreen(
    context: &PassContext<'_>,
    inputs: Inputs<'_>,
    pipeline: &GraphicsPipeline,
    layout: &PipelineLayout,
    read: Read<'_>,
    constants: &[u8],
) -> Result<()> {
    let set = read_set(context, inputs, &inputs.shaders.sums_set, read)?;
    bind(context, pipeline, layout, set, constants);
    Ok(())
}

/// What such a draw reads: images by their bindings in set 0, and the scene's own lights.
pub(super) type Read<'a> = (&'a [(u32, ResourceId)], Option<ResourceId>);

/// The binding of lights.
const LIGHTS: u32 = 5;

/// A set of what is read.
pub(super) fn read_set(
    context: &PassContext<'_>,
    inputs: Inputs<'_>,
    layout: &SetLayout,
    (images, lights): Read<'_>,
) -> Result<vk::DescriptorSet> {
    let mut given = Vec::new();
    if let Some(lights) = lights {
        given.push((LIGHTS, context.descriptor(lights)?));
    }
    for (number, id) in images {
        given.push((*number, context.descriptor(*id)?));
    }
    inputs.descriptors.set(layout, &given)
}

/// Binds pipeline, set 0 and push constants.
pub(super) fn bind(
    context: &PassContext<'_>,
    pipeline: &GraphicsPipeline,
    layout: &PipelineLayout,
    set: vk::DescriptorSet,
    constants: &[u8],
) {
    let (device, commands) = (context.device(), context.commands());
    let bind_point = vk::PipelineBindPoint::GRAPHICS;
    // SAFETY: inside of rendering; pipeline, set and push constants have one layout; the graph's barriers order what
    // is sampled.
    unsafe {
        device.cmd_bind_pipeline(commands, bind_point, pipeline.raw());
        device.cmd_bind_descriptor_sets(commands, bind_point, layout.raw(), 0, &[set], &[]);
        device.cmd_push_constants(commands, layout.raw(), layout.push_stages(), 0, constants);
    }
}
