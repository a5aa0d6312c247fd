//! Splats set up once: culled, or made a record and a span of tiles.

use ash::vk;

use crate::passes::{
    cull::visible::VisibleList,
    inputs::Inputs,
    pipeline::{
        cache::{ComputeKey, Layout},
        variant::Constants,
    },
    plan::tiles::TilePlan,
    tiles::{TilePass, Tiles, place_bits},
};
use crate::{
    error::Result,
    graph::{Access, Graph, Start, execute::Body},
    shaders::{self, config::*},
};

/// What the pipeline is, for one chunk, of which perhaps a list is set up.
pub(crate) fn key(variant: &Constants, plan: &TilePlan, chunk: u32, visible: bool) -> ComputeKey {
    let mut constants = variant.clone();
    constants.extend([
        place_bits(plan),
        (SPEC_MOST_TILES, plan.most_tiles),
        (SPEC_TILE_HEIGHT, plan.invocations.tile_height()),
        (SPEC_LISTED, u32::from(visible)),
    ]);
    if plan.may_be_large {
        constants.extend([(SPEC_MAY_BE_LARGE, 1), (SPEC_CHUNK, chunk)]);
    }
    ComputeKey { shader: &shaders::TILE_PROJECT_COMP, layout: Layout::Record, constants }
}

/// Declares the pass.
pub(crate) fn record<'a>(
    graph: &mut Graph<Body<'a>>,
    inputs: Inputs<'a>,
    kind: &str,
    tiles: &mut Tiles<'a>,
    visible: Option<&VisibleList>,
) -> Result<()> {
    let mut chunks = Vec::new();
    for (number, draw) in (0..).zip(inputs.draws) {
        chunks
            .push((draw, inputs.shaders.compute(key(&draw.variant, tiles.plan, number, visible.is_some()))?));
    }
    let mut pass = TilePass::new(graph, &format!("set up {kind}splats"));
    if let Some(visible) = visible {
        pass = pass
            .declare(|pass| visible.read_by_compute(pass))
            .bind(BIND_VISIBLE_STARTS, &visible.starts)
            .bind(BIND_VISIBLE_LIST, &visible.list)
            .bind(BIND_VISIBLE_BLOCKS, &visible.blocks);
    }
    let quarters = (BIND_RECORDS..).zip(&mut tiles.records);
    for (binding, buffer) in quarters.chain([(BIND_RECTS, &mut tiles.spans)]) {
        pass = pass.write(binding, buffer, Access::StorageWriteCompute, Start::Discard);
    }
    let visible = visible.map(VisibleList::ids);
    pass.finish_with_set(inputs, move |context, set| {
        let layout = &inputs.shaders.tiles()?.record;
        let bind_point = vk::PipelineBindPoint::COMPUTE;
        let (device, commands) = (context.device(), context.commands());
        for (number, (draw, pipeline)) in chunks.iter().enumerate() {
            let constants = bytemuck::bytes_of(&draw.constants);
            let sets = [draw.chunk.set(), set];
            // SAFETY: pipeline, sets and push constants have one layout; chunks write places of their own.
            unsafe {
                device.cmd_bind_pipeline(commands, bind_point, pipeline.raw());
                device.cmd_bind_descriptor_sets(commands, bind_point, layout.raw(), 0, &sets, &[]);
                device.cmd_push_constants(commands, layout.raw(), layout.push_stages(), 0, constants);
            }
            match &visible {
                Some(visible) => visible.dispatch(context, number)?,
                None => {
                    let [x, y] =
                        crate::passes::tiles::pass::rows_of(draw.chunk.count.div_ceil(PROJECT_GROUP_SIZE));
                    // SAFETY: all is bound that the pipeline needs.
                    unsafe { device.cmd_dispatch(commands, x, y, 1) };
                }
            }
        }
        Ok(())
    });
    Ok(())
}
