//! Dispatches over the splats of a chunk.

use ash::vk;

use crate::{
    error::Result,
    passes::{
        pipeline::constants::FrameConstants,
        plan::draws::Draw,
        recording::{Pipeline, Recording},
    },
};

/// Records a dispatch over the splats of a chunk, with this set of lists: so many workgroups in a row, and rows.
pub(crate) fn dispatch(
    pass: &Recording<'_, '_>,
    draw: &Draw<'_>,
    constants: &FrameConstants,
    pipeline: Pipeline,
    lists: vk::DescriptorSet,
    groups: [u32; 2],
) -> Result<()> {
    pass.bind(pipeline);
    pass.bind_sets(pipeline.layout, 0, &[draw.chunk.set(), lists])?;
    pass.push(pipeline.layout, constants)?;
    pass.dispatch(groups);
    Ok(())
}
