//! One triangle over the whole target.

use ash::vk;

use crate::{
    graph::execute::PassContext,
    vk::{GraphicsPipeline, PipelineLayout},
};

/// Records the draw. The pipeline's vertex stage is `glsl/fullscreen.vert.glsl`; set and push constants are those of
/// `layout`.
pub(super) fn draw_fullscreen(
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
        device.cmd_draw(commands, 3, 1, 0, 0);
    }
}
