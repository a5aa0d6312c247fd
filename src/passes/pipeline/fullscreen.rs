//! One triangle over the whole target.

use ash::vk;

use crate::passes::{inputs::Inputs, pipeline::constants::FinalizeConstants};
use crate::{
    error::Result,
    graph::{ResourceId, execute::PassContext},
    shaders::config::BIND_SUMS_LIGHTS,
    vk::GraphicsPipeline,
};

/// Records the draw. The pipeline's vertex stage is `glsl/fullscreen.vert.glsl`, its layout finalization's.
pub(crate) fn draw_fullscreen(
    context: &PassContext<'_>,
    inputs: Inputs<'_>,
    pipeline: &GraphicsPipeline,
    read: Read<'_>,
    constants: &FinalizeConstants,
) -> Result<()> {
    bind_fullscreen(context, inputs, pipeline, read, constants)?;
    // SAFETY: inside of rendering, with all bound that the pipeline needs.
    unsafe { context.device().cmd_draw(context.commands(), 3, 1, 0, 0) };
    Ok(())
}

/// Records what that draw needs.
pub(crate) fn bind_fullscreen(
    context: &PassContext<'_>,
    inputs: Inputs<'_>,
    pipeline: &GraphicsPipeline,
    read: Read<'_>,
    constants: &FinalizeConstants,
) -> Result<()> {
    let set = read_set(context, inputs, read)?;
    let layout = &inputs.shaders.finalize_layout;
    let (device, commands) = (context.device(), context.commands());
    let bind_point = vk::PipelineBindPoint::GRAPHICS;
    let constants = bytemuck::bytes_of(constants);
    // SAFETY: inside of rendering; pipeline, set and push constants have one layout; the graph's barriers order what
    // is sampled.
    unsafe {
        device.cmd_bind_pipeline(commands, bind_point, pipeline.raw());
        device.cmd_bind_descriptor_sets(commands, bind_point, layout.raw(), 0, &[set], &[]);
        device.cmd_push_constants(commands, layout.raw(), layout.push_stages(), 0, constants);
    }
    Ok(())
}

/// What such a draw reads: images by their bindings in set 0, and the scene's own lights.
pub(crate) type Read<'a> = (&'a [(u32, ResourceId)], Option<ResourceId>);

/// A set of what is read.
pub(crate) fn read_set(
    context: &PassContext<'_>,
    inputs: Inputs<'_>,
    (images, lights): Read<'_>,
) -> Result<vk::DescriptorSet> {
    let mut given = Vec::new();
    if let Some(lights) = lights {
        given.push((BIND_SUMS_LIGHTS, context.descriptor(lights)?));
    }
    for (number, id) in images {
        given.push((*number, context.descriptor(*id)?));
    }
    inputs.descriptors.set(&inputs.shaders.sums_set, &given)
}
