//! Polygons by the graphics pipeline: pipelines and draws of the passes over them.

use ash::vk;

use crate::passes::{
    inputs::Inputs,
    pass::Pass,
    pipeline::{
        constants::FrameConstants,
        key::{ColorFormats, GraphicsKey, Layout},
        variant::Constants,
    },
    plan::mesh_draws::MeshDraw,
    polygons::cells::draw_cells,
    predicate::{self, is_predicated},
    recording::{Pipeline, Recording},
};
use crate::{
    error::Result,
    shaders::{self, Shader, config::*},
    vk::Blend,
};

/// What a pass over polygons is made of: its fragment stage, and what it writes.
pub(crate) struct MeshPass {
    pub fragment: &'static Shader,
    pub color_formats: ColorFormats,
    pub blend: Blend,
    /// The depth test and whether it writes, where there is one.
    pub depth: Option<(vk::CompareOp, bool)>,
    pub constants: Constants,
}

impl MeshPass {
    /// What the pipeline of a piece is; normals of layers of a closed surface stay as they are.
    fn key(&self, draw: &MeshDraw<'_>) -> GraphicsKey {
        let topology = vk::PrimitiveTopology::TRIANGLE_LIST;
        let outward = (SPEC_OUTWARD, u32::from(draw.chunk.closed && draw.chunk.transparent));
        let constants = self.constants.with([outward]);
        GraphicsKey {
            color_formats: self.color_formats,
            blend: self.blend,
            depth: self.depth,
            cull_clockwise: draw.cull,
            ..GraphicsKey::new((&shaders::POLYGONS_VERT, self.fragment), Layout::Splat, topology, constants)
        }
    }

    /// The pipelines of every draw, in their order.
    pub fn pipelines<'a>(&self, pass: &Pass<'_, 'a>, inputs: Inputs<'_>) -> Result<&'a [Pipeline]> {
        pass.arena().try_list(inputs.meshes.iter().map(|draw| pass.graphics(self.key(draw))))
    }
}

/// Records the draws of all pieces.
pub(crate) fn draw_meshes(
    pass: &Recording<'_, '_>,
    inputs: Inputs<'_>,
    pipelines: &[Pipeline],
) -> Result<()> {
    draw_meshes_at(pass, inputs, pipelines, [0.0; 2])
}

/// The same, of what lies so far right and down from the middle of each pixel.
pub(crate) fn draw_meshes_at(
    pass: &Recording<'_, '_>,
    inputs: Inputs<'_>,
    pipelines: &[Pipeline],
    place_px: [f32; 2],
) -> Result<()> {
    let (device, commands) = (pass.device(), pass.commands());
    for ((number, draw), pipeline) in inputs.meshes.iter().enumerate().zip(pipelines) {
        pass.bind(*pipeline);
        pass.bind_sets(Layout::Splat, 0, &[draw.chunk.set()])?;
        let middle_px = [0, 1].map(|i| draw.constants.middle_px[i] - place_px[i]);
        pass.push(Layout::Splat, &FrameConstants { middle_px, ..draw.constants })?;
        // SAFETY: the piece's indices are alive as long as the scene.
        unsafe { device.cmd_bind_index_buffer(commands, draw.chunk.indices(), 0, vk::IndexType::UINT32) };
        match is_predicated(pass) {
            true => predicate::draw_mesh(pass, inputs, number)?,
            false if draw.levels.is_some() => draw_cells(pass, inputs.meshes, number)?,
            // SAFETY: inside of rendering with all bound, and three indices a triangle, each below the number of vertices.
            false => unsafe { device.cmd_draw_indexed(commands, 3 * draw.chunk.triangles, 1, 0, 0, 0) },
        }
    }
    Ok(())
}
