//! Draws of the graphics pipeline over the tiles that have splats: a quad for each run of them along a row.

use crate::passes::{
    pass::Pass,
    pipeline::{
        constants::FinalizeConstants,
        key::{GraphicsKey, Layout},
        variant::Constants,
    },
    place::{Place, arguments},
    recording::{Pipeline, Recording},
    tiles::lists::Tiles,
};
use crate::{
    error::Result,
    graph::Access,
    shaders::{self, Shader, config::*},
};

/// The runs of a frame's bands.
#[derive(Clone, Copy)]
pub(crate) struct Runs {
    bands: u32,
    /// Pixels of each tile's columns.
    tile_height: u32,
}

/// Adds to a pass the runs that it draws over.
pub(crate) fn read_runs<'g, 'a>(mut pass: Pass<'g, 'a>, bands: &[Tiles<'_>]) -> (Pass<'g, 'a>, Runs) {
    for (number, tiles) in (0..).zip(bands) {
        pass = pass.read(Place::Tiles(number).at(BIND_RUNS), &tiles.runs, Access::StorageReadVertex).read(
            arguments(number),
            &tiles.arguments,
            Access::IndirectRead,
        );
    }
    let tile_height = bands.first().map_or(0, |tiles| tiles.plan.invocations.tile_height());
    (pass, Runs { bands: bands.len() as u32, tile_height })
}

/// A pipeline that draws over runs: without color, blending and depth, to be completed.
pub(crate) fn runs_key(fragment: &'static Shader, constants: Constants) -> GraphicsKey {
    let stages = (&shaders::TILE_QUADS_VERT, fragment);
    GraphicsKey::new(stages, Layout::TileQuads, ash::vk::PrimitiveTopology::TRIANGLE_STRIP, constants)
}

/// Records the draws, whose fragments read sums. `constants`: finalization's, without the tiles' height.
pub(crate) fn draw_runs(
    pass: &Recording<'_, '_>,
    pipeline: Pipeline,
    runs: Runs,
    constants: FinalizeConstants,
) -> Result<()> {
    let sums = pass.set(Place::Sums)?;
    pass.bind(pipeline);
    pass.push(pipeline.layout, &FinalizeConstants { tile_height: runs.tile_height, ..constants })?;
    for number in 0..runs.bands {
        pass.bind_sets(pipeline.layout, 0, &[sums, pass.set(Place::Tiles(number))?])?;
        pass.draw_indirect(arguments(number), 4 * u64::from(ARGUMENTS_QUADS))?;
    }
    Ok(())
}
