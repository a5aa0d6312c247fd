//! One triangle over the whole target.

use crate::error::Result;
use crate::passes::{
    pipeline::constants::FinalizeConstants,
    place::Place,
    recording::{Pipeline, Recording},
};

/// Records the draw. The pipeline's vertex stage is `glsl/fullscreen.vert.glsl`, its layout finalization's.
pub(crate) fn draw_fullscreen(
    pass: &Recording<'_, '_>,
    pipeline: Pipeline,
    constants: &FinalizeConstants,
) -> Result<()> {
    bind_fullscreen(pass, pipeline, constants)?;
    pass.draw([3, 1]);
    Ok(())
}

/// Records what that draw needs.
pub(crate) fn bind_fullscreen(
    pass: &Recording<'_, '_>,
    pipeline: Pipeline,
    constants: &FinalizeConstants,
) -> Result<()> {
    pass.bind(pipeline);
    pass.bind_sets(pipeline.layout, 0, &[pass.set(Place::Sums)?])?;
    pass.push(pipeline.layout, constants)
}
