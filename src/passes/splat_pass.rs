//! What the passes of splats are made of, and how they are recorded: their pipelines, draws and dispatches.

use std::sync::Arc;

use ash::vk;

use super::{
    Draw, Inputs,
    gate::Gate,
    lists::ListIds,
    pipelines::{GraphicsKey, Layout},
    splat_shaders::{Primitive, SplatShaders, Stages},
    variant::Constants,
};
use crate::{
    error::Result,
    graph::{ResourceId, execute::PassContext},
    vk::{Blend, ComputePipeline, GraphicsPipeline},
};

/// What a splat pass is made of: its shaders, and what it writes.
pub(super) struct SplatPass {
    pub shaders: SplatShaders,
    pub color_formats: Vec<vk::Format>,
    /// The depth test and whether it writes, where there is one.
    pub depth: Option<(vk::CompareOp, bool)>,
    /// Specialization constants beside those of the splats.
    pub constants: Constants,
}

/// The pipelines for one draw: of the rasterizer's own primitive, and quads where there may be large splats.
pub(super) struct DrawPipelines {
    primitive: Primitive,
    own: Arc<GraphicsPipeline>,
    quads: Option<Arc<GraphicsPipeline>>,
}

impl SplatPass {
    /// What the pipeline is that draws splats of a variant as a primitive.
    pub fn key(&self, stages: Stages, primitive: Primitive, variant: &Constants) -> GraphicsKey {
        let constants = [variant.as_slice(), &self.constants].concat();
        GraphicsKey {
            color_formats: self.color_formats.clone(),
            blend: Blend::Add,
            depth: self.depth,
            ..GraphicsKey::new(stages, Layout::Splat, primitive.topology(), constants)
        }
    }

    /// The pipelines that draw listed splats as quads, one a draw.
    pub fn quad_pipelines(&self, inputs: Inputs<'_>) -> Result<Vec<Arc<GraphicsPipeline>>> {
        let key = |draw: &Draw<'_>| self.key(self.shaders.listed, Primitive::Quad, &draw.variant);
        inputs.draws.iter().map(|draw| inputs.shaders.graphics(key(draw))).collect()
    }

    /// The pipelines of every draw, in their order.
    pub fn pipelines(&self, inputs: Inputs<'_>) -> Result<Vec<DrawPipelines>> {
        let make = |stages: Stages, primitive: Primitive, draw: &Draw<'_>| {
            inputs.shaders.graphics(self.key(stages, primitive, &draw.variant))
        };
        let primitive = Primitive::of(inputs.settings.rasterizer);
        let both = |draw: &Draw<'_>| {
            let own = if draw.may_be_large { self.shaders.small } else { self.shaders.all };
            let quads = draw.may_be_large.then_some(self.shaders.listed);
            Ok(DrawPipelines {
                primitive,
                own: make(own, primitive, draw)?,
                quads: quads.map(|quads| make(quads, Primitive::Quad, draw)).transpose()?,
            })
        };
        inputs.draws.iter().map(both).collect()
    }
}

/// Records the draws of all chunks; where there is a gate, the device leaves them out while it is closed.
pub(super) fn draw_splats(
    context: &PassContext<'_>,
    inputs: Inputs<'_>,
    pipelines: &[DrawPipelines],
    lists: &ListIds,
    gate: Option<Gate>,
) -> Result<()> {
    let (device, commands) = (context.device(), context.commands());
    let layout = &inputs.shaders.splat_layout;
    let bind_point = vk::PipelineBindPoint::GRAPHICS;
    for ((number, draw), pipelines) in inputs.draws.iter().enumerate().zip(pipelines) {
        let mut sets = vec![draw.chunk.set()];
        let given = lists.descriptors(context, number)?;
        if !given.is_empty() {
            sets.push(inputs.descriptors.set(&inputs.shaders.list_set, &given)?);
        }
        let arguments = lists.large(number).map(|large| context.buffer(large.arguments)).transpose()?;
        // SAFETY: inside of rendering, with pipelines, sets and push constants of one layout; the graph's barriers
        // order what the draws read.
        unsafe {
            device.cmd_bind_descriptor_sets(commands, bind_point, layout.raw(), 0, &sets, &[]);
            let constants = bytemuck::bytes_of(&draw.constants);
            device.cmd_push_constants(commands, layout.raw(), layout.push_stages(), 0, constants);
            device.cmd_bind_pipeline(commands, bind_point, pipelines.own.raw());
            match (gate, &lists.kept) {
                (Some(gate), _) => gate.draw_splats(context, number)?,
                (None, Some(kept)) => kept.draw_points(context, number)?,
                (None, None) => {
                    let [vertices, instances] = pipelines.primitive.counts(draw.chunk.count);
                    device.cmd_draw(commands, vertices, instances, 0, 0);
                }
            }
            if let (Some(quads), Some(arguments)) = (&pipelines.quads, arguments) {
                device.cmd_bind_pipeline(commands, bind_point, quads.raw());
                match gate {
                    Some(gate) => gate.draw_listed(context, arguments)?,
                    None => device.cmd_draw_indirect(commands, arguments, 0, 1, 16),
                }
            }
        }
    }
    Ok(())
}

/// Records a dispatch over the splats of a chunk, with these buffers in set 1: so many workgroups in a row, and rows.
pub(super) fn dispatch(
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
