//! Draws of the graphics pipeline over the tiles that have splats: a quad for each run of them along a row.

use ash::vk;

use crate::passes::{
    inputs::Inputs,
    pipeline::{
        cache::{GraphicsKey, Layout},
        constants::FinalizeConstants,
        variant::Constants,
    },
    tiles::Tiles,
};
use crate::{
    error::Result,
    graph::{Access, PassBuilder, ResourceId, execute::PassContext},
    shaders::{self, Shader, config::*},
    vk::GraphicsPipeline,
};

/// Which tiles have splats, for the passes that draw over them.
pub(crate) struct SeenTiles {
    /// Of each band the runs, and the arguments of their draw.
    bands: Vec<(ResourceId, ResourceId)>,
    /// Pixels of each tile's columns.
    tile_height: u32,
}

impl SeenTiles {
    /// Those of a frame's lists.
    pub fn of(bands: &[Tiles<'_>]) -> Self {
        Self {
            bands: bands.iter().map(|tiles| (tiles.runs.id(), tiles.arguments.id())).collect(),
            tile_height: bands.first().map_or(0, |tiles| tiles.plan.invocations.tile_height()),
        }
    }
}

/// Declares that a pass draws over the tiles that have splats.
pub(crate) fn read_seen<'g, B>(bands: &[Tiles<'_>], pass: PassBuilder<'g, B>) -> PassBuilder<'g, B> {
    bands.iter().fold(pass, |pass, tiles| {
        pass.read(&tiles.runs, Access::StorageReadVertex).read(&tiles.arguments, Access::IndirectRead)
    })
}

/// A pipeline that draws quads over tiles: without color, blending and depth, to be completed.
pub(crate) fn quads_of_tiles(fragment: &'static Shader, constants: Constants) -> GraphicsKey {
    let stages = (&shaders::TILE_QUADS_VERT, fragment);
    GraphicsKey::new(stages, Layout::TileQuads, vk::PrimitiveTopology::TRIANGLE_STRIP, constants)
}

/// Records the draws. `set`: what the fragments read; `constants`: finalization's, without the tiles' height.
pub(crate) fn draw_quads_of_tiles(
    context: &PassContext<'_>,
    inputs: Inputs<'_>,
    pipeline: &GraphicsPipeline,
    seen: &SeenTiles,
    set: vk::DescriptorSet,
    constants: FinalizeConstants,
) -> Result<()> {
    let layout = &inputs.shaders.tiles()?.quads;
    let bind_point = vk::PipelineBindPoint::GRAPHICS;
    let (device, commands) = (context.device(), context.commands());
    let constants = FinalizeConstants { tile_height: seen.tile_height, ..constants };
    for (runs, arguments) in &seen.bands {
        let list = [(BIND_RUNS, context.descriptor(*runs)?)];
        let sets = [set, inputs.descriptors.set(&inputs.shaders.tiles()?.set, &list)?];
        let arguments = context.buffer(*arguments)?;
        // SAFETY: inside of rendering; pipeline, sets and push constants have one layout; the graph's barriers order what is
        // read; the arguments are within the buffer.
        unsafe {
            device.cmd_bind_pipeline(commands, bind_point, pipeline.raw());
            device.cmd_bind_descriptor_sets(commands, bind_point, layout.raw(), 0, &sets, &[]);
            device.cmd_push_constants(
                commands,
                layout.raw(),
                layout.push_stages(),
                0,
                bytemuck::bytes_of(&constants),
            );
            device.cmd_draw_indirect(commands, arguments, 4 * u64::from(ARGUMENTS_QUADS), 1, 16);
        }
    }
    Ok(())
}
