//! One compute pass over tiles: its pipeline, what is bound, and how it is dispatched.

use std::sync::Arc;

use ash::vk;

use super::{
    super::{
        Inputs,
        constants::TileConstants,
        pipelines::{ComputeKey, Layout},
        variant::Constants,
    },
    TilePlan,
};
use crate::{
    error::Result,
    graph::{ResourceId, execute::PassContext},
    shaders::Shader,
    vk::ComputePipeline,
};

/// One compute pass over tiles.
pub(super) struct TilePass<'a> {
    inputs: Inputs<'a>,
    pipeline: Arc<ComputePipeline>,
    pub constants: TileConstants,
    pub buffers: Vec<(u32, ResourceId)>,
    pub texel_buffers: Vec<(u32, ResourceId)>,
    pub storage_images: Vec<(u32, ResourceId)>,
    pub sampled_images: Vec<(u32, ResourceId)>,
}

impl<'a> TilePass<'a> {
    pub fn new(
        inputs: Inputs<'a>,
        plan: &TilePlan,
        (shader, constants_of_shader): (&'static Shader, Constants),
        buffers: Vec<(u32, ResourceId)>,
    ) -> Result<Self> {
        let key = ComputeKey { shader, layout: Layout::Tile, constants: constants_of_shader };
        Ok(Self {
            inputs,
            pipeline: inputs.shaders.compute(key)?,
            constants: super::constants(inputs, plan),
            buffers,
            texel_buffers: Vec::new(),
            storage_images: Vec::new(),
            sampled_images: Vec::new(),
        })
    }

    pub fn bind(&self, context: &PassContext<'_>) -> Result<()> {
        let mut given = Vec::new();
        let of_buffers = self.buffers.iter().chain(&self.texel_buffers);
        for (number, id) in of_buffers.chain(&self.storage_images).chain(&self.sampled_images) {
            given.push((*number, context.descriptor(*id)?));
        }
        let set = self.inputs.descriptors.set(&self.inputs.shaders.tiles()?.set, &given)?;
        let layout = self.inputs.shaders.tiles()?.tile.raw();
        let bind_point = vk::PipelineBindPoint::COMPUTE;
        let (device, commands) = (context.device(), context.commands());
        // SAFETY: pipeline and set have one layout; the graph's barriers order what is read and written.
        unsafe {
            device.cmd_bind_pipeline(commands, bind_point, self.pipeline.raw());
            device.cmd_bind_descriptor_sets(commands, bind_point, layout, 0, &[set], &[]);
        }
        self.push(context, &self.constants)
    }

    pub fn push(&self, context: &PassContext<'_>, constants: &TileConstants) -> Result<()> {
        let layout = &self.inputs.shaders.tiles()?.tile;
        let bytes = bytemuck::bytes_of(constants);
        // SAFETY: the layout's constants are these.
        unsafe {
            let commands = context.commands();
            context.device().cmd_push_constants(commands, layout.raw(), layout.push_stages(), 0, bytes);
        }
        Ok(())
    }

    /// Records one dispatch of so many workgroups.
    pub fn dispatch(&self, context: &PassContext<'_>, groups: u32) -> Result<()> {
        self.bind(context)?;
        let [x, y] = rows_of(groups);
        // SAFETY: all is bound that the pipeline needs.
        unsafe { context.device().cmd_dispatch(context.commands(), x, y, 1) };
        Ok(())
    }

    /// Records a dispatch of as many as a buffer says.
    pub fn dispatch_indirect(
        &self,
        context: &PassContext<'_>,
        arguments: ResourceId,
        offset: u64,
    ) -> Result<()> {
        self.bind(context)?;
        let arguments = context.buffer(arguments)?;
        // SAFETY: as in `dispatch`; the arguments were declared to be read, and are within the buffer.
        unsafe { context.device().cmd_dispatch_indirect(context.commands(), arguments, offset) };
        Ok(())
    }
}

/// Workgroups along a row, and rows: a device need not take more than 65535 in one dimension. As in `glsl/inc/groups.glsl`.
pub(in super::super) fn rows_of(groups: u32) -> [u32; 2] {
    const MOST_GROUPS_IN_ROW: u32 = 32_768;
    let rows = groups.div_ceil(MOST_GROUPS_IN_ROW);
    [groups.div_ceil(rows.max(1)), rows]
}

/// Orders a dispatch behind those before it in the same pass, which work on the same memory.
pub(super) fn after_dispatches_before(context: &PassContext<'_>) {
    let storage = vk::AccessFlags2::SHADER_STORAGE_READ | vk::AccessFlags2::SHADER_STORAGE_WRITE;
    let compute = vk::PipelineStageFlags2::COMPUTE_SHADER;
    let barriers = [vk::MemoryBarrier2::default()
        .src_stage_mask(compute)
        .src_access_mask(vk::AccessFlags2::SHADER_STORAGE_WRITE)
        .dst_stage_mask(compute)
        .dst_access_mask(storage)];
    let info = vk::DependencyInfo::default().memory_barriers(&barriers);
    // SAFETY: outside of rendering, in a compute pass.
    unsafe { context.device().cmd_pipeline_barrier2(context.commands(), &info) };
}

#[cfg(test)]
mod tests {
    use super::rows_of;

    #[test]
    fn rows_hold_all_workgroups_and_few_more() {
        for groups in [0, 1, 32_768, 32_769, 43_690, 65_536, 4_194_304, 1 << 30] {
            let [x, y] = rows_of(groups);
            assert!(x <= 32_768 && y <= 65_535, "{groups}: {x} {y}");
            assert!((groups..groups + y.max(1)).contains(&(x * y)), "{groups}: {x} {y}");
        }
    }
}
