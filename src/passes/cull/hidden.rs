//! The splats that may belong to the visible surface: what is hidden behind it is not accumulated.

use ash::vk;

use crate::passes::{
    cull::visible::{VisibleList, create_bits, dispatch_words, list_marked, pipelines},
    inputs::Inputs,
    pipeline::cache::{ComputeKey, Layout},
};
use crate::{
    error::Result,
    graph::{Access, BufferDesc, Graph, Handle, Image, Start, execute::Body},
    shaders::{self, config::*},
};

/// What makes the hierarchy of the visible depth.
pub(crate) fn cells_key() -> ComputeKey {
    ComputeKey { shader: &shaders::DEPTH_CELLS_COMP, layout: Layout::DepthCells, constants: Vec::new() }
}

/// Declares the passes that list those of the visible splats that the visible depth does not hide.
pub(crate) fn list_unhidden<'a>(
    graph: &mut Graph<Body<'a>>,
    inputs: Inputs<'a>,
    visible: VisibleList,
    depth: &Handle<Image>,
) -> Result<VisibleList> {
    const CELLS: u32 = DEPTH_CELLS_SIDE * DEPTH_CELLS_SIDE;
    // Of each block its cells and itself.
    let [x, y] = inputs.settings.size_px.map(|side| side.div_ceil(CELLS));
    let words = u64::from(x) * u64::from(y) * u64::from(CELLS + 1);
    let mut cells = graph.create_buffer("cells of depth", BufferDesc::of_bytes(4 * words));
    let (depth_id, cells_id, pipeline) = (depth.id(), cells.id(), inputs.shaders.compute(cells_key())?);
    graph
        .pass("cells of depth")
        .read(depth, Access::SampledCompute)
        .write(&mut cells, Access::StorageWriteCompute, Start::Discard)
        .finish(Box::new(move |context| {
            let given = [
                (BIND_CELLS_DEPTH, context.descriptor(depth_id)?),
                (BIND_CELLS, context.descriptor(cells_id)?),
            ];
            let shaders = inputs.shaders;
            let set = inputs.descriptors.set(&shaders.cells_set, &given)?;
            let layout = shaders.cells_layout.raw();
            let bind_point = vk::PipelineBindPoint::COMPUTE;
            let (device, commands) = (context.device(), context.commands());
            // SAFETY: pipeline and set have one layout; the graph's barriers order what is read and written.
            unsafe {
                device.cmd_bind_pipeline(commands, bind_point, pipeline.raw());
                device.cmd_bind_descriptor_sets(commands, bind_point, layout, 0, &[set], &[]);
                device.cmd_dispatch(commands, x, y, 1);
            }
            Ok(())
        }));

    let what = "unhidden splats";
    let mut bits = create_bits(graph, inputs, what);
    let mark = pipelines(inputs, &shaders::MARK_UNHIDDEN_COMP)?;
    let bound = [
        (BIND_LIST_BITS, visible.bits.id()),
        (BIND_LIST_UNHIDDEN_BITS, bits.id()),
        (BIND_LIST_CELLS, cells.id()),
        (BIND_LIST_BLOCKS, visible.blocks.id()),
    ];
    graph
        .pass("mark unhidden splats")
        .read(&visible.bits, Access::StorageReadCompute)
        .read(&visible.blocks, Access::StorageReadCompute)
        .read(&cells, Access::StorageReadCompute)
        .write(&mut bits, Access::StorageWriteCompute, Start::Discard)
        .finish(Box::new(move |context| dispatch_words(context, inputs, &mark, &bound)));
    list_marked(graph, inputs, what, (bits, visible.blocks))
}
