//! One triangle over the whole target.

use ash::vk;

use super::Inputs;
use crate::{
    error::Result,
    graph::{ResourceId, execute::PassContext},
    vk::{Descriptor, GraphicsPipeline, PipelineLayout, SetLayout},
};

/// Records the draw. The pipeline's vertex stage is `glsl/fullscreen.vert.glsl`; its images, by their bindings in set 0, and
/// its push constants are those of `layout`, which is finalization's.
pub(super) fn draw_fullscreen(
    context: &PassContext<'_>,
    inputs: Inputs<'_>,
    pipeline: &GraphicsPipeline,
    layout: &PipelineLayout,
    images: &[(u32, ResourceId)],
    constants: &[u8],
) -> Result<()> {
    bind_fullscreen(context, inputs, pipeline, layout, images, constants)?;
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
    images: &[(u32, ResourceId)],
    constants: &[u8],
) -> Result<()> {
    let set = sampled_set(context, inputs, &inputs.shaders.sums_set, images)?;
    bind(context, pipeline, layout, set, constants);
    Ok(())
}

/// A set of sampled images, by their bindings.
pub(super) fn sampled_set(
    context: &PassContext<'_>,
    inputs: Inputs<'_>,
    layout: &SetLayout,
    images: &[(u32, ResourceId)],
) -> Result<vk::DescriptorSet> {
    let mut given = Vec::new();
    for (number, id) in images {
        given.push((*number, Descriptor::Sampled(context.image(*id)?.1, context.layout(*id))));
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
