//! Splats set up once: culled, or made a record and a span of tiles.

use ash::vk;

use super::{
    super::{
        Inputs,
        draws::Draw,
        pipelines::{ComputeKey, Layout},
        variant::Constants,
    },
    TilePlan, Tiles,
};
use crate::{
    error::Result,
    graph::{Access, Graph, Start, execute::Body},
    shaders,
    vk::Descriptor,
};

/// Invocations of a workgroup, as in `glsl/tile_record.comp.glsl`.
const GROUP: u32 = 64;

/// What the pipeline is, for one chunk.
pub(in super::super) fn key(variant: &Constants, plan: &TilePlan, chunk: u32) -> ComputeKey {
    let mut constants = variant.clone();
    constants.push((22, plan.most_tiles));
    if plan.may_be_large {
        constants.extend([(16, 1), (17, chunk)]);
    }
    ComputeKey { shader: &shaders::TILE_RECORD_COMP, layout: Layout::Record, constants }
}

/// Declares the pass.
pub(super) fn record<'a>(
    graph: &mut Graph<Body<'a>>,
    inputs: Inputs<'a>,
    kind: &str,
    tiles: &mut Tiles<'a>,
) -> Result<()> {
    let mut chunks = Vec::new();
    for (number, draw) in (0..).zip(inputs.draws) {
        chunks.push((draw, inputs.shaders.compute(key(&draw.variant, tiles.plan, number))?));
    }
    let ids = [tiles.records().as_slice(), &[(super::SPANS, tiles.spans.id())]].concat();
    let mut pass = graph.pass(&format!("set up {kind}splats"));
    for buffer in tiles.records.iter_mut().chain([&mut tiles.spans]) {
        pass = pass.write(buffer, Access::StorageWriteCompute, Start::Discard);
    }
    pass.finish(Box::new(move |context| {
        let mut given = Vec::new();
        for (number, id) in &ids {
            given.push((*number, Descriptor::Buffer(context.buffer(*id)?)));
        }
        let set = inputs.descriptors.set(&inputs.shaders.tiles()?.set, &given)?;
        let layout = &inputs.shaders.tiles()?.record;
        let bind_point = vk::PipelineBindPoint::COMPUTE;
        let (device, commands) = (context.device(), context.commands());
        for (draw, pipeline) in &chunks {
            let draw: &Draw<'_> = draw;
            let constants = bytemuck::bytes_of(&draw.constants);
            let sets = [draw.chunk.set(), set];
            // SAFETY: pipeline, sets and push constants have one layout; chunks write places of their own.
            unsafe {
                device.cmd_bind_pipeline(commands, bind_point, pipeline.raw());
                device.cmd_bind_descriptor_sets(commands, bind_point, layout.raw(), 0, &sets, &[]);
                device.cmd_push_constants(commands, layout.raw(), layout.push_stages(), 0, constants);
                let [x, y] = super::rows_of(draw.chunk.count.div_ceil(GROUP));
                device.cmd_dispatch(commands, x, y, 1);
            }
        }
        Ok(())
    }));
    Ok(())
}
