//! Dispatches over the splats of a chunk.

use ash::vk;

use crate::{
    error::Result,
    graph::{ResourceId, execute::PassContext},
    passes::{inputs::Inputs, plan::draws::Draw},
    vk::ComputePipeline,
};

/// Records a dispatch over the splats of a chunk, with these buffers in set 1: so many workgroups in a row, and rows.
pub(crate) fn dispatch(
    context: &PassContext<'_>,
    inputs: Inputs<'_>,
    draw: &Draw<'_>,
    pipeline: &ComputePipeline,
    buffers: &[(u32, ResourceId)],
    [x, y]: [u32; 2],
) -> Result<()> {
    let mut given = Vec::new();
    for (number, id) in buffers {
        given.push((*number, context.descriptor(*id)?));
    }
    let shaders = inputs.shaders;
    let sets = [draw.chunk.set(), inputs.descriptors.set(&shaders.list_set, &given)?];
    let layout = &shaders.list_layout;
    let constants = bytemuck::bytes_of(&draw.constants);
    let bind_point = vk::PipelineBindPoint::COMPUTE;
    let (device, commands) = (context.device(), context.commands());
    // SAFETY: pipeline, sets and push constants have one layout; the graph's barriers order the passes.
    unsafe {
        device.cmd_bind_pipeline(commands, bind_point, pipeline.raw());
        device.cmd_bind_descriptor_sets(commands, bind_point, layout.raw(), 0, &sets, &[]);
        device.cmd_push_constants(commands, layout.raw(), layout.push_stages(), 0, constants);
        device.cmd_dispatch(commands, x, y, 1);
    }
    Ok(())
}
