//! The splats that may belong to the visible surface: what is hidden behind it is not accumulated.

use crate::passes::{
    cull::visible::{VisibleList, create_bits, dispatch_words, list_marked},
    inputs::Inputs,
    pass::Pass,
    pipeline::key::{ComputeKey, Layout},
    place::{Place, lists},
};
use crate::{
    error::Result,
    graph::{Access, BufferDesc, Graph, Handle, Image, Start, execute::Body},
    shaders::{self, config::*},
};

/// Declares the passes that list those of the visible splats that the visible depth does not hide.
pub(crate) fn list_unhidden<'a>(
    graph: &mut Graph<'a, Body<'a>>,
    inputs: Inputs<'a>,
    visible: VisibleList,
    depth: &Handle<Image>,
) -> Result<VisibleList> {
    const CELLS: u32 = DEPTH_CELLS_SIDE * DEPTH_CELLS_SIDE;
    const WHY: &str = "--cull hidden: what the visible depth hides is not summed";
    // Of each block its cells and itself.
    let blocks = inputs.settings.size_px.map(|side| side.div_ceil(CELLS));
    let words = u64::from(blocks[0]) * u64::from(blocks[1]) * u64::from(CELLS + 1);
    let mut cells = graph.create_buffer("cells of depth", BufferDesc::of_bytes(4 * words));
    let why = "--cull hidden: the farthest visible depth of parts of the image";
    let pass = Pass::new(graph, inputs.source, "cells of depth", why)
        .read(Place::Cells.at(BIND_CELLS_DEPTH), depth, Access::SampledCompute)
        .write(Place::Cells.at(BIND_CELLS), &mut cells, Access::StorageWriteCompute, Start::Discard);
    let (shader, layout) = (&shaders::DEPTH_CELLS_COMP, Layout::DepthCells);
    let pipeline = pass.compute(ComputeKey { shader, layout, constants: [].into() })?;
    pass.finish(move |pass| {
        pass.bind(pipeline);
        pass.bind_sets(layout, 0, &[pass.set(Place::Cells)?])?;
        pass.push(layout, &inputs.settings.size_px)?;
        pass.dispatch(blocks);
        Ok(())
    });

    let what = "unhidden splats";
    let mut bits = create_bits(graph, inputs, what);
    let (read, write) = (Access::StorageReadCompute, Access::StorageWriteCompute);
    let pass = Pass::new(graph, inputs.source, "mark unhidden splats", WHY)
        .read(lists(BIND_LIST_BITS), &visible.bits, read)
        .read(lists(BIND_LIST_BLOCKS), &visible.blocks, read)
        .read(lists(BIND_LIST_CELLS), &cells, read)
        .write(lists(BIND_LIST_UNHIDDEN_BITS), &mut bits, write, Start::Discard);
    dispatch_words(pass, inputs, &shaders::MARK_UNHIDDEN_COMP)?;
    list_marked(graph, inputs, what, WHY, (bits, visible.blocks))
}
