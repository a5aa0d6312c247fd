//! Splats are projected once: culled, or made a projected splat and a rect of tiles.

use crate::passes::{
    cull::visible::{VISIBLE_ARGUMENTS, VisibleList, dispatch_visible},
    inputs::Inputs,
    pass::Pass,
    pipeline::{
        key::{ComputeKey, Layout},
        variant::Constants,
    },
    place::{Place, tiles as at},
    plan::{
        draws::{Draw, by_variant},
        tiles::TilePlan,
    },
    recording::rows_of,
    tiles::lists::Tiles,
};
use crate::{
    error::Result,
    graph::{Access, Graph, Start, execute::Body},
    shaders::{self, config::*},
};

/// What the pipeline is for a chunk, of which perhaps a list is projected.
fn key(variant: &Constants, plan: &TilePlan, listed: bool) -> ComputeKey {
    let constants = variant.with([
        (SPEC_PLACE_BITS, plan.place_bits),
        (SPEC_TILE_HEIGHT, plan.invocations.tile_height()),
        (SPEC_LISTED, u32::from(listed)),
        (SPEC_MAY_BE_LARGE, u32::from(plan.may_be_large)),
        (SPEC_PARTED, plan.parted_by()),
    ]);
    ComputeKey { shader: &shaders::TILE_PROJECT_COMP, layout: Layout::Record, constants }
}

/// Declares the pass.
pub(crate) fn project<'a>(
    graph: &mut Graph<'a, Body<'a>>,
    inputs: Inputs<'a>,
    kind: &str,
    tiles: &mut Tiles<'a>,
    visible: Option<&VisibleList>,
) -> Result<()> {
    let why = match inputs.draws.iter().any(|draw| draw.chunk.transparent) {
        false => "opaque splats: each is culled, or made ready to be drawn by tiles",
        true => "transparent splats: each is made ready to be drawn by tiles",
    };
    let mut pass = Pass::new(graph, inputs.source, format_args!("project {kind}splats"), why);
    if let Some(visible) = visible {
        pass = pass
            .read(at(BIND_VISIBLE_STARTS), &visible.starts, Access::StorageReadCompute)
            .read(at(BIND_VISIBLE_LIST), &visible.list, Access::StorageReadCompute)
            .read(at(BIND_VISIBLE_BLOCKS), &visible.blocks, Access::StorageReadCompute)
            .read(VISIBLE_ARGUMENTS, &visible.arguments, Access::IndirectRead);
    }
    let quarters = (BIND_RECORDS..).zip(&mut tiles.records);
    for (binding, buffer) in quarters.chain([(BIND_RECTS, &mut tiles.rects)]) {
        pass = pass.write(at(binding), buffer, Access::StorageWriteCompute, Start::Discard);
    }
    pass = match &mut tiles.clips {
        Some(clips) => pass.write(at(BIND_CLIPS), clips, Access::StorageWriteCompute, Start::Discard),
        // What is not written has to be what may be: a stand-in is only read.
        None => pass.also(at(BIND_CLIPS)),
    };
    let of = |draw: &Draw<'_>| pass.compute(key(draw.variant, tiles.plan, visible.is_some()));
    let pipelines = by_variant(pass.arena(), inputs.draws, of)?;
    let most_tiles = tiles.plan.most_tiles;
    pass.finish(move |pass| {
        let set = pass.set(Place::Tiles(0))?;
        let arguments = pass.has(VISIBLE_ARGUMENTS).then(|| pass.arguments(VISIBLE_ARGUMENTS)).transpose()?;
        // Chunks write places of their own.
        for (number, (draw, pipeline)) in inputs.draws.iter().zip(pipelines.iter().copied()).enumerate() {
            pass.bind(pipeline);
            pass.bind_sets(pipeline.layout, 0, &[draw.chunk.set(), set])?;
            pass.push(pipeline.layout, &draw.told().with_most_tiles(most_tiles))?;
            match arguments {
                Some(arguments) => dispatch_visible(pass, arguments, number),
                None => pass.dispatch(rows_of(draw.chunk.count.div_ceil(PROJECT_GROUP_SIZE))),
            }
        }
        Ok(())
    });
    Ok(())
}
