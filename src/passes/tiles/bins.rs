//! Lists of splats by tile, in a fixed order: counted, placed by prefix sums, filled; no atomics, so that they are the same
//! in every run.

use ash::vk;

use super::{
    super::{
        Inputs,
        constants::TileConstants,
        cull::{Kept, list_kept},
        variant::Constants,
    },
    ARGUMENTS, COUNTS, ENTRIES, KEPT_LIST, KEPT_STARTS, OVERFULL, RUNS, SEEN, SPAN_TEXELS, SPANS, STARTS,
    TilePass, TilePlan, Tiles, after_dispatches_before,
    plan::WALKERS,
    record::record,
};
use crate::{
    error::Result,
    graph::{
        Access, Graph, PassBuilder, Start,
        execute::{Body, PassContext},
    },
    shaders::{self, Shader},
};

/// The constant of how many entries a dispatch takes of a tile.
pub(super) fn part_length(plan: &TilePlan) -> Constants {
    vec![(19, plan.part_length)]
}

/// The constant of how spans are cut.
pub(super) fn place_bits(plan: &TilePlan) -> (u32, u32) {
    (24, plan.place_bits)
}

/// What counts. `kept`: records are those of a list.
pub(super) fn count_shader(plan: &TilePlan, kept: bool) -> (&'static Shader, Constants) {
    let shader = match (kept, plan.invocations.fetch_texels()) {
        (false, false) => &shaders::TILE_COUNT_COMP,
        (false, true) => &shaders::TILE_COUNT_TEXELS_COMP,
        (true, false) => &shaders::TILE_COUNT_KEPT_COMP,
        (true, true) => &shaders::TILE_COUNT_KEPT_TEXELS_COMP,
    };
    (shader, vec![place_bits(plan)])
}

/// What fills.
pub(super) fn fill_shader(plan: &TilePlan, kept: bool) -> (&'static Shader, Constants) {
    let shader = match (kept, plan.invocations.fetch_texels()) {
        (false, false) => &shaders::TILE_FILL_COMP,
        (false, true) => &shaders::TILE_FILL_TEXELS_COMP,
        (true, false) => &shaders::TILE_FILL_KEPT_COMP,
        (true, true) => &shaders::TILE_FILL_KEPT_TEXELS_COMP,
    };
    let mut constants = vec![place_bits(plan)];
    constants.extend(kept.then_some((16, u32::from(plan.may_be_large))));
    (shader, constants)
}

/// Declares that a walk reads how many records a list has; and, where the graphics pipeline draws some, the splats' own numbers.
fn read_kept<'g, B>(pass: PassBuilder<'g, B>, kept: Option<&Kept>, numbers: bool) -> PassBuilder<'g, B> {
    let Some(kept) = kept else { return pass };
    let pass = pass.read(kept.starts(), Access::StorageReadCompute);
    if numbers { pass.read(kept.list(), Access::StorageReadCompute) } else { pass }
}

/// Declares the passes that set splats up and list them by tile. `kind`, in front of the names, tells several such lists of a
/// frame apart.
pub(in super::super) fn list<'a>(
    graph: &mut Graph<Body<'a>>,
    inputs: Inputs<'a>,
    kind: &str,
    plan: &'a TilePlan,
) -> Result<Tiles<'a>> {
    let kept = inputs.kept.map(|listed| list_kept(graph, inputs, kind, listed)).transpose()?;
    let mut tiles = Tiles::create(graph, kind, plan);
    record(graph, inputs, kind, &mut tiles, kept.as_ref())?;
    let kept = kept.as_ref();
    let kept_starts = kept.map(|kept| (KEPT_STARTS, kept.starts().id()));
    let (counts, starts) = ((COUNTS, tiles.counts.id()), (STARTS, tiles.starts.id()));
    let read = tiles.access_of_lists();

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

    let counted = [counts].into_iter().chain(kept_starts).collect();
    let mut count = TilePass::new(inputs, plan, count_shader(plan, inputs.kept.is_some()), counted)?;
    tiles.bind_read(&mut count, [SPANS, SPAN_TEXELS], &tiles.spans);
    read_kept(graph.pass(&format!("count {kind}tiles")), kept, false)
        .read(&tiles.spans, read)
        .write(&mut tiles.counts, Access::StorageUpdateCompute, Start::Load)
        .finish(Box::new(move |context| walk(context, &count)));

    let total = TilePass::new(inputs, plan, (&shaders::TILE_TOTAL_COMP, Vec::new()), vec![counts, starts])?;
    let groups = plan.bin_count().div_ceil(WALKERS);
    graph
        .pass(&format!("total {kind}tiles"))
        .write(&mut tiles.counts, Access::StorageReadWriteCompute, Start::Load)
        .write(&mut tiles.starts, Access::StorageWriteCompute, Start::Discard)
        .finish(Box::new(move |context| total.dispatch(context, groups)));

    let written = vec![
        starts,
        (SEEN, tiles.seen.id()),
        (RUNS, tiles.runs.id()),
        (ARGUMENTS, tiles.arguments.id()),
        (OVERFULL, tiles.overfull.id()),
    ];
    let start = TilePass::new(inputs, plan, (&shaders::TILE_START_COMP, part_length(plan)), written)?;
    graph
        .pass(&format!("start {kind}tiles"))
        .write(&mut tiles.starts, Access::StorageReadWriteCompute, Start::Load)
        .write(&mut tiles.seen, Access::StorageWriteCompute, Start::Discard)
        .write(&mut tiles.runs, Access::StorageWriteCompute, Start::Discard)
        .write(&mut tiles.arguments, Access::StorageWriteCompute, Start::Discard)
        .write(&mut tiles.overfull, Access::StorageWriteCompute, Start::Discard)
        .finish(Box::new(move |context| start.dispatch(context, 1)));

    // A binding needs a buffer, also where nobody reads it.
    let numbers = kept.map(|kept| if plan.may_be_large { kept.list() } else { kept.starts() });
    let numbers = numbers.map(|list| (KEPT_LIST, list.id()));
    let filled = [counts, starts, (ENTRIES, tiles.entries.id())];
    let filled = filled.into_iter().chain(kept_starts).chain(numbers).collect();
    let mut fill = TilePass::new(inputs, plan, fill_shader(plan, inputs.kept.is_some()), filled)?;
    tiles.bind_read(&mut fill, [SPANS, SPAN_TEXELS], &tiles.spans);
    read_kept(graph.pass(&format!("fill {kind}tiles")), kept, plan.may_be_large)
        .read(&tiles.spans, read)
        .read(&tiles.starts, Access::StorageReadCompute)
        .write(&mut tiles.counts, Access::StorageUpdateCompute, Start::Load)
        .write(&mut tiles.entries, Access::StorageWriteCompute, Start::Discard)
        .finish(Box::new(move |context| walk(context, &fill)));
    Ok(tiles)
}

/// Records the dispatches of a walk: each takes no more records of a segment than a shader's loops have iterations for.
fn walk(context: &PassContext<'_>, pass: &TilePass<'_>) -> Result<()> {
    let TileConstants { segments, segment_length, round_length, .. } = pass.constants;
    pass.bind(context)?;
    for round_first in (0..segment_length).step_by(round_length as usize) {
        if round_first > 0 {
            after_dispatches_before(context);
        }
        pass.push(context, &TileConstants { round_first, ..pass.constants })?;
        // SAFETY: all is bound that the pipeline needs.
        unsafe { context.device().cmd_dispatch(context.commands(), segments.div_ceil(WALKERS), 1, 1) };
    }
    Ok(())
}
