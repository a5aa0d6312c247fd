//! Polygons: the meshes of a prepared scene as this frame's camera and settings see them; and how they are drawn.

use std::sync::Arc;

use ash::vk;

use super::{
    Inputs,
    constants::FrameConstants,
    draws::frame_constants,
    gate::Gate,
    pipelines::{GraphicsKey, Layout},
    variant::Constants,
};
use crate::{
    error::Result,
    graph::execute::PassContext,
    prepare::{MeshChunk, PreparedScene},
    scene::{Backfaces, Camera, Epsilon, Settings},
    shaders::config::*,
    shaders::{self, Shader},
    vk::{Blend, GraphicsPipeline, Limits},
};

/// A piece of a mesh in this frame.
pub struct MeshDraw<'a> {
    /// The triangles.
    pub chunk: &'a MeshChunk,
    /// What its shaders are told.
    pub constants: FrameConstants,
    /// Triangles that face away are not drawn.
    pub cull: bool,
}

/// All pieces of meshes as seen from a camera.
pub fn mesh_draws<'a>(
    scene: &'a PreparedScene,
    camera: &Camera,
    settings: &Settings,
    limits: &Limits,
) -> Vec<MeshDraw<'a>> {
    let epsilon = match settings.epsilon {
        Epsilon::Radii(radii) => radii * scene.mean_transparent_radius,
        Epsilon::Length(length) => length,
    };
    let draw = |chunk: &'a MeshChunk| {
        let view = chunk.rebase.view_from_local(camera);
        MeshDraw {
            chunk,
            constants: FrameConstants {
                uniform_color: u32::from(chunk.uniform_color),
                ..frame_constants(&view, camera, settings, limits, (0.0, epsilon))
            },
            cull: match settings.backfaces {
                Backfaces::Auto => chunk.closed && !chunk.transparent,
                Backfaces::Flip => false,
                Backfaces::Cull => true,
            },
        }
    };
    scene.meshes.iter().map(draw).collect()
}

/// What a pass over polygons is made of: its fragment stage, and what it writes.
pub(super) struct MeshPass {
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
pub(super) fn draw_meshes(
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
