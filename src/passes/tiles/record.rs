//! Splats set up once: culled, or made a record and a span of tiles.

use ash::vk;

use super::{
    super::{
        Inputs,
        cull::{Kept, KeptIds},
        pipelines::{ComputeKey, Layout},
        variant::Constants,
    },
    KEPT_BLOCKS, KEPT_LIST, KEPT_STARTS, SPANS, TilePlan, Tiles,
    bins::place_bits,
};
use crate::{
    error::Result,
    graph::{Access, Graph, Start, execute::Body},
    shaders,
};

/// Invocations of a workgroup, as in `glsl/tile_record.comp.glsl`.
const GROUP: u32 = 64;

/// What the pipeline is, for one chunk, of which perhaps a list is set up.
pub(in super::super) fn key(variant: &Constants, plan: &TilePlan, chunk: u32, kept: bool) -> ComputeKey {
    let mut constants = variant.clone();
    constants.extend([(22, plan.most_tiles), place_bits(plan), (25, plan.invocations.tile_height())]);
    if plan.may_be_large {
        constants.extend([(16, 1), (17, chunk)]);
    }
    let shader = if kept { &shaders::TILE_RECORD_KEPT_COMP } else { &shaders::TILE_RECORD_COMP };
    ComputeKey { shader, layout: Layout::Record, constants }
}

/// Declares the pass.
pub(super) fn record<'a>(
    graph: &mut Graph<Body<'a>>,
    inputs: Inputs<'a>,
    kind: &str,
    tiles: &mut Tiles<'a>,
    kept: Option<&Kept>,
) -> Result<()> {
    let mut chunks = Vec::new();
    for (number, draw) in (0..).zip(inputs.draws) {
        chunks.push((draw, inputs.shaders.compute(key(&draw.variant, tiles.plan, number, kept.is_some()))?));
    }
    let mut ids = tiles.records().to_vec();
    ids.push((SPANS, tiles.spans.id()));
    let mut pass = graph.pass(&format!("set up {kind}splats"));
    if let Some(kept) = kept {
        pass = kept.read_by_compute(pass);
    }
    let kept = kept.map(Kept::ids);
    if let Some(KeptIds { starts, list, blocks, .. }) = &kept {
        ids.extend([(KEPT_STARTS, *starts), (KEPT_LIST, *list), (KEPT_BLOCKS, *blocks)]);
    }
    for buffer in tiles.records.iter_mut().chain([&mut tiles.spans]) {
        pass = pass.write(buffer, Access::StorageWriteCompute, Start::Discard);
    }
    pass.finish(Box::new(move |context| {
        let mut given = Vec::new();
        for (number, id) in &ids {
            given.push((*number, context.descriptor(*id)?));
        }
        let set = inputs.descriptors.set(&inputs.shaders.tiles()?.set, &given)?;
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
            match &kept {
                Some(kept) => kept.dispatch(context, number)?,
                None => {
                    let [x, y] = super::rows_of(draw.chunk.count.div_ceil(GROUP));
                    // SAFETY: all is bound that the pipeline needs.
                    unsafe { device.cmd_dispatch(commands, x, y, 1) };
                }
            }
        }
        Ok(())
    }));
    Ok(())
}
