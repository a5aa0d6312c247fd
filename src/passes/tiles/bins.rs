//! Lists of splats by tile, in a fixed order: counted, placed by prefix sums, filled; no atomics, so that they are the same
//! in every run.

use ash::vk;

use crate::passes::tiles::place_bits;
use crate::passes::{
    cull::visible::list_visible,
    inputs::Inputs,
    pipeline::{cache::ComputeKey, constants::TileConstants},
    plan::tiles::TilePlan,
    tiles::{
        TilePass, Tiles,
        pass::{TileDispatch, key},
        record::record,
    },
};
use crate::{
    error::Result,
    graph::{Access, Graph, Start, execute::Body},
    shaders::{self, Shader, config::*},
};

/// The pipelines of what counts, adds up, finds where lists start, and fills. `visible`: records are those of a list.
pub(crate) fn keys(plan: &TilePlan, visible: bool) -> [ComputeKey; 4] {
    let walk = |shader: &'static Shader| {
        let texels = u32::from(plan.invocations.fetch_texels());
        let large = u32::from(plan.may_be_large);
        let constants = [
            place_bits(plan),
            (SPEC_LISTED, u32::from(visible)),
            (SPEC_TEXELS, texels),
            (SPEC_MAY_BE_LARGE, large),
        ];
        key(shader, constants.to_vec())
    };
    [
        walk(&shaders::TILE_COUNT_COMP),
        key(&shaders::TILE_TOTAL_COMP, Vec::new()),
        key(&shaders::TILE_START_COMP, vec![(SPEC_PART_LENGTH, plan.part_length)]),
        walk(&shaders::TILE_FILL_COMP),
    ]
}

/// Declares the passes that set splats up and list them by tile. `kind`, in front of the names, tells several such lists of a
/// frame apart.
pub(crate) fn list<'a>(
    graph: &mut Graph<Body<'a>>,
    inputs: Inputs<'a>,
    kind: &str,
    plan: &'a TilePlan,
) -> Result<Tiles<'a>> {
    let visible = inputs.listed.map(|listed| list_visible(graph, inputs, kind, listed)).transpose()?;
    let visible_starts = visible.as_ref().map(|list| &list.starts);
    let mut tiles = Tiles::create(graph, kind, plan);
    record(graph, inputs, kind, &mut tiles, visible.as_ref())?;

    let cleared = tiles.counts.id();
    graph
        .pass(&format!("clear counts of {kind}tiles"))
        .write(&mut tiles.counts, Access::TransferWrite, Start::Discard)
        .finish(Box::new(move |context| {
            let buffer = context.buffer(cleared)?;
            // SAFETY: outside of rendering; the whole buffer.
            unsafe { context.device().cmd_fill_buffer(context.commands(), buffer, 0, vk::WHOLE_SIZE, 0) };
            Ok(())
        }));

    let (read, write, update) =
        (Access::StorageReadCompute, Access::StorageWriteCompute, Access::StorageUpdateCompute);
    let [count, total, start, fill] = keys(plan, visible.is_some());
    let rects = [BIND_RECTS, BIND_RECT_TEXELS];
    let pass = TilePass::new(graph, &format!("count {kind}tiles"));
    tiles
        .read_as_texels(pass, rects, &tiles.spans)
        .read_if(BIND_VISIBLE_STARTS, visible_starts, read)
        .write(BIND_COUNTS, &mut tiles.counts, update, Start::Load)
        .finish(inputs, (plan, count), walk)?;

    let groups = plan.bin_count().div_ceil(BIN_GROUP_SIZE);
    TilePass::new(graph, &format!("total {kind}tiles"))
        .write(BIND_COUNTS, &mut tiles.counts, Access::StorageReadWriteCompute, Start::Load)
        .write(BIND_STARTS, &mut tiles.starts, write, Start::Discard)
        .finish(inputs, (plan, total), move |pass| {
            pass.groups(pass.constants, groups);
            Ok(())
        })?;

    TilePass::new(graph, &format!("start {kind}tiles"))
        .write(BIND_STARTS, &mut tiles.starts, Access::StorageReadWriteCompute, Start::Load)
        .write(BIND_NON_EMPTY_TILES, &mut tiles.seen, write, Start::Discard)
        .write(BIND_RUNS, &mut tiles.runs, write, Start::Discard)
        .write(BIND_ARGUMENTS, &mut tiles.arguments, write, Start::Discard)
        .write(BIND_OVERFLOW_TILES, &mut tiles.overfull, write, Start::Discard)
        .finish(inputs, (plan, start), |pass| {
            pass.groups(pass.constants, 1);
            Ok(())
        })?;

    // Where the graphics pipeline draws some, it wants the splats' own numbers.
    let numbers = visible.as_ref().filter(|_| plan.may_be_large).map(|list| &list.list);
    let pass = TilePass::new(graph, &format!("fill {kind}tiles"));
    tiles
        .read_as_texels(pass, rects, &tiles.spans)
        .read_if(BIND_VISIBLE_STARTS, visible_starts, read)
        .read_if(BIND_VISIBLE_LIST, numbers, read)
        .read(BIND_STARTS, &tiles.starts, read)
        .write(BIND_COUNTS, &mut tiles.counts, update, Start::Load)
        .write(BIND_ENTRIES, &mut tiles.entries, write, Start::Discard)
        .finish(inputs, (plan, fill), walk)?;
    Ok(tiles)
}

/// Records the dispatches of a walk: each takes no more records of a segment than a shader's loops have iterations for.
fn walk(pass: &TileDispatch<'_, '_>) -> Result<()> {
    let TileConstants { segments, segment_length, round_length, .. } = pass.constants;
    for round_first in (0..segment_length).step_by(round_length as usize) {
        if round_first > 0 {
            pass.wait();
        }
        pass.groups(TileConstants { round_first, ..pass.constants }, segments.div_ceil(BIN_GROUP_SIZE));
    }
    Ok(())
}
