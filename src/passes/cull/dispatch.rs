//! Dispatches over the splats of a chunk.

use ash::vk;

use crate::{
    error::Result,
    graph::{ResourceId, execute::PassContext},
    passes::{inputs::Inputs, pipeline::constants::FrameConstants, plan::draws::Draw},
    vk::ComputePipeline,
};

/// A set of lists with these buffers.
pub(crate) fn list_set(
    context: &PassContext<'_>,
    inputs: Inputs<'_>,
    buffers: &[(u32, ResourceId)],
) -> Result<vk::DescriptorSet> {
    let given = buffers.iter().map(|(number, id)| Ok((*number, context.descriptor(*id)?)));
    inputs.descriptors.set(&inputs.shaders.list_set, &given.collect::<Result<Vec<_>>>()?)
}

/// Records a dispatch over the splats of a chunk, with this set of lists: so many workgroups in a row, and rows.
pub(crate) fn dispatch(
    context: &PassContext<'_>,
    inputs: Inputs<'_>,
    draw: &Draw<'_>,
    constants: &FrameConstants,
    pipeline: &ComputePipeline,
    lists: vk::DescriptorSet,
    [x, y]: [u32; 2],
) {
    let layout = &inputs.shaders.list_layout;
    let bind_point = vk::PipelineBindPoint::COMPUTE;
    let (device, commands) = (context.device(), context.commands());
    let (sets, constants) = ([draw.chunk.set(), lists], bytemuck::bytes_of(constants));
    // SAFETY: pipeline, sets and push constants have one layout; the graph's barriers order the passes.
    unsafe {
        device.cmd_bind_pipeline(commands, bind_point, pipeline.raw());
        device.cmd_bind_descriptor_sets(commands, bind_point, layout.raw(), 0, &sets, &[]);
        device.cmd_push_constants(commands, layout.raw(), layout.push_stages(), 0, constants);
        device.cmd_dispatch(commands, x, y, 1);
    }
}
