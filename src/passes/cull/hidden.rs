//! The splats that may belong to the visible surface: what is hidden behind it is not accumulated.

use ash::vk;

use crate::passes::{
    cull::dispatch::dispatch,
    cull::visible::{Kept, create_bits, groups_of, list_marked, pipelines},
    inputs::Inputs,
    pipeline::{
        cache::{ComputeKey, Layout},
        variant::Constants,
    },
};
use crate::{
    error::Result,
    graph::{Access, BufferDesc, Graph, Handle, Image, Start, execute::Body},
    shaders::{self, config::*},
};

/// Pixels along a side of a block, as in `glsl/inc/depth_cells.glsl`.
const BLOCK_PX: u32 = 64;

/// What makes the hierarchy.
pub(crate) fn cells_key() -> ComputeKey {
    ComputeKey { shader: &shaders::DEPTH_CELLS_COMP, layout: Layout::DepthCells, constants: Vec::new() }
}

/// What marks the splats of a variant.
pub(crate) fn hidden_key(variant: &Constants) -> ComputeKey {
    ComputeKey { shader: &shaders::CULL_HIDDEN_COMP, layout: Layout::List, constants: variant.clone() }
}

/// Declares the passes that list those of the kept splats that the visible depth does not hide.
pub(crate) fn list_seen<'a>(
    graph: &mut Graph<Body<'a>>,
    inputs: Inputs<'a>,
    kept: Kept,
    depth: &Handle<Image>,
) -> Result<Kept> {
    let blocks = inputs.settings.size_px.map(|side| side.div_ceil(BLOCK_PX));
    // Of each block 64 cells and itself.
    let words = u64::from(blocks[0]) * u64::from(blocks[1]) * 65;
    let mut cells = graph.create_buffer("cells of depth", BufferDesc::of_bytes(4 * words));
    let (depth_id, cells_id, pipeline) = (depth.id(), cells.id(), inputs.shaders.compute(cells_key())?);
    graph
        .pass("cells of depth")
        .read(depth, Access::SampledCompute)
        .write(&mut cells, Access::StorageWriteCompute, Start::Discard)
        .finish(Box::new(move |context| {
            let image = context.descriptor(depth_id)?;
            let given = [(BIND_CELLS_DEPTH, image), (BIND_CELLS, context.descriptor(cells_id)?)];
            let shaders = inputs.shaders;
            let set = inputs.descriptors.set(&shaders.cells_set, &given)?;
            let layout = shaders.cells_layout.raw();
            let bind_point = vk::PipelineBindPoint::COMPUTE;
            let (device, commands) = (context.device(), context.commands());
            // SAFETY: pipeline and set have one layout; the graph's barriers order what is read and written.
            unsafe {
                device.cmd_bind_pipeline(commands, bind_point, pipeline.raw());
                device.cmd_bind_descriptor_sets(commands, bind_point, layout, 0, &[set], &[]);
                device.cmd_dispatch(commands, blocks[0], blocks[1], 1);
            }
            Ok(())
        }));

    let what = "seen splats";
    let mut bits = create_bits(graph, inputs, what);
    let (kept_id, seen_id, blocks_id) = (kept.bits.id(), bits.id(), kept.blocks.id());
    let mark = pipelines(inputs, |draw| hidden_key(&draw.variant))?;
    graph
        .pass("mark seen splats")
        .read(&kept.bits, Access::StorageReadCompute)
        .read(&kept.blocks, Access::StorageReadCompute)
        .read(&cells, Access::StorageReadCompute)
        .write(&mut bits, Access::StorageWriteCompute, Start::Discard)
        .finish(Box::new(move |context| {
            for (draw, pipeline) in inputs.draws.iter().zip(&mark) {
                let buffers = [
                    (BIND_LIST_BITS, kept_id),
                    (BIND_LIST_SEEN_BITS, seen_id),
                    (BIND_LIST_CELLS, cells_id),
                    (BIND_LIST_BLOCKS, blocks_id),
                ];
                dispatch(context, inputs, draw, pipeline, &buffers, groups_of(draw))?;
            }
            Ok(())
        }));
    list_marked(graph, inputs, what, (bits, kept.blocks))
}
