//! Polygons by the graphics pipeline: pipelines and draws of the passes over them.

use std::sync::Arc;

use ash::vk;

use crate::passes::{
    cull::gate::Gate,
    inputs::Inputs,
    pipeline::{
        cache::{GraphicsKey, Layout},
        variant::Constants,
    },
    plan::mesh_draws::MeshDraw,
};
use crate::{
    error::Result,
    graph::execute::PassContext,
    shaders::{self, Shader, config::*},
    vk::{Blend, GraphicsPipeline},
};

/// What a pass over polygons is made of: its fragment stage, and what it writes.
pub(crate) struct MeshPass {
    pub fragment: &'static Shader,
    pub color_formats: Vec<vk::Format>,
    pub blend: Blend,
    /// The depth test and whether it writes, where there is one.
    pub depth: Option<(vk::CompareOp, bool)>,
    pub constants: Constants,
}

impl MeshPass {
    /// What its pipeline is. `cull`: without triangles that face away; `outward`: normals of layers stay as they are.
    pub fn key(&self, cull: bool, outward: bool) -> GraphicsKey {
        let topology = vk::PrimitiveTopology::TRIANGLE_LIST;
        let mut constants = self.constants.clone();
        constants.push((SPEC_OUTWARD, u32::from(outward)));
        let stages = (&shaders::POLYGONS_VERT, self.fragment);
        GraphicsKey {
            color_formats: self.color_formats.clone(),
            blend: self.blend,
            depth: self.depth,
            cull_clockwise: cull,
            ..GraphicsKey::new(stages, Layout::Splat, topology, constants)
        }
    }

    /// The pipelines of every draw, in their order.
    pub fn pipelines(&self, inputs: Inputs<'_>) -> Result<Vec<Arc<GraphicsPipeline>>> {
        let outward = |draw: &MeshDraw<'_>| draw.chunk.closed && draw.chunk.transparent;
        inputs.meshes.iter().map(|draw| inputs.shaders.graphics(self.key(draw.cull, outward(draw)))).collect()
    }
}

/// Records the draws of all pieces; behind a gate, the device leaves them out where it is closed.
pub(crate) fn draw_meshes(
    context: &PassContext<'_>,
    inputs: Inputs<'_>,
    pipelines: &[Arc<GraphicsPipeline>],
    gate: Option<Gate>,
) -> Result<()> {
    let (device, commands) = (context.device(), context.commands());
    let layout = &inputs.shaders.splat_layout;
    let bind_point = vk::PipelineBindPoint::GRAPHICS;
    for ((number, draw), pipeline) in inputs.meshes.iter().enumerate().zip(pipelines) {
        let constants = bytemuck::bytes_of(&draw.constants);
        // SAFETY: inside of rendering, with pipeline, set and push constants of one layout, and three indices a triangle,
        // each below the number of vertices.
        unsafe {
            device.cmd_bind_descriptor_sets(commands, bind_point, layout.raw(), 0, &[draw.chunk.set()], &[]);
            device.cmd_push_constants(commands, layout.raw(), layout.push_stages(), 0, constants);
            device.cmd_bind_pipeline(commands, bind_point, pipeline.raw());
            device.cmd_bind_index_buffer(commands, draw.chunk.indices(), 0, vk::IndexType::UINT32);
            match gate {
                None => device.cmd_draw_indexed(commands, 3 * draw.chunk.triangles, 1, 0, 0, 0),
                Some(gate) => gate.draw_mesh(context, number)?,
            }
        }
    }
    Ok(())
}
