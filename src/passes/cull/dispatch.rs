//! Dispatches over the splats of a chunk.

use ash::vk;

use crate::{
    error::Result,
    passes::{
        pipeline::constants::FrameConstants,
        recording::{Pipeline, Recording},
    },
    prepare::Chunk,
};

/// Records a dispatch over the splats of a chunk, with this set of lists: so many workgroups in a row, and rows.
pub(crate) fn dispatch(
    pass: &Recording<'_, '_>,
    chunk: &Chunk,
    constants: &FrameConstants,
    pipeline: Pipeline,
    lists: vk::DescriptorSet,
    groups: [u32; 2],
) -> Result<()> {
    pass.bind(pipeline);
    pass.bind_sets(pipeline.layout, 0, &[chunk.set(), lists])?;
    pass.push(pipeline.layout, constants)?;
    pass.dispatch(groups);
    Ok(())
}
