//! Lists of splats by tile: counted, placed by prefix sums, filled, in an order that is the same in every run.

use ash::vk;

use crate::passes::{
    cull::visible::list_visible,
    inputs::Inputs,
    pass::Pass,
    pipeline::{constants::TileConstants, key::ComputeKey},
    place::{tiles as at, transfer},
    plan::tiles::TilePlan,
    tiles::{
        dispatch::{TileDispatch, finish, key},
        lists::Tiles,
        project::project,
    },
};
use crate::{
    error::Result,
    graph::{Access, Graph, Start, execute::Body},
    shaders::{self, Shader, config::*},
};

/// Why a frame has these passes.
const WHY: &str = "lists of splats by tile: counted, placed by prefix sums, filled";

/// The pipeline of what walks over projected splats; `listed`: they are those of a list.
fn walk_key(shaders: [&'static Shader; 2], plan: &TilePlan, listed: bool) -> ComputeKey {
    let constants = [
        (SPEC_PLACE_BITS, plan.place_bits),
        (SPEC_LISTED, u32::from(listed)),
        (SPEC_TEXELS, u32::from(plan.invocations.fetch_texels())),
        (SPEC_MAY_BE_LARGE, u32::from(plan.may_be_large)),
        (SPEC_PARTED, plan.parted_by()),
    ];
    key(plan.invocations.shader(shaders), constants.into())
}

/// Declares the passes that project splats and list them by tile. `kind`, in front of the names, tells several such lists of a
/// frame apart.
pub(crate) fn list<'a>(
    graph: &mut Graph<'a, Body<'a>>,
    inputs: Inputs<'a>,
    kind: &str,
    plan: &'a TilePlan,
) -> Result<Tiles<'a>> {
    let visible = inputs.listed.map(|listed| list_visible(graph, inputs, kind, listed)).transpose()?;
    let visible_starts = visible.as_ref().map(|list| &list.starts);
    let mut tiles = Tiles::create(graph, kind, plan);
    project(graph, inputs, kind, &mut tiles, visible.as_ref())?;

    let arena = graph.arena();
    let name = |what: &str| arena.text(format_args!("{what} {kind}tiles"));
    Pass::new(graph, inputs.source, name("clear counts of"), WHY)
        .write(transfer(0), &mut tiles.counts, Access::TransferWrite, Start::Discard)
        .finish(|pass| {
            let buffer = pass.buffer(transfer(0))?;
            // SAFETY: outside of rendering; the whole buffer.
            unsafe { pass.device().cmd_fill_buffer(pass.commands(), buffer, 0, vk::WHOLE_SIZE, 0) };
            Ok(())
        });

    let (read, write, update) =
        (Access::StorageReadCompute, Access::StorageWriteCompute, Access::StorageUpdateCompute);
    let pass = Pass::new(graph, inputs.source, name("count"), WHY);
    let pass = tiles.read_for_walk(pass).read_if(at(BIND_VISIBLE_STARTS), visible_starts, read).write(
        at(BIND_COUNTS),
        &mut tiles.counts,
        update,
        Start::Load,
    );
    let count = walk_key(
        [&shaders::TILE_COUNT_COLUMN_COMP, &shaders::TILE_COUNT_PIXEL_COMP],
        plan,
        visible.is_some(),
    );
    finish(pass, inputs, (plan, count), |pass| walk(pass, plan))?;

    let groups = plan.count_bins().div_ceil(TOTAL_GROUP_SIZE);
    let pass = Pass::new(graph, inputs.source, name("total"), WHY)
        .write(at(BIND_COUNTS), &mut tiles.counts, Access::StorageReadWriteCompute, Start::Load)
        .write(at(BIND_STARTS), &mut tiles.starts, write, Start::Discard);
    let total = key(&shaders::TILE_TOTAL_COMP, [].into());
    finish(pass, inputs, (plan, total), move |pass| pass.groups(pass.constants, groups))?;

    let pass = Pass::new(graph, inputs.source, name("start"), WHY)
        .write(at(BIND_STARTS), &mut tiles.starts, Access::StorageReadWriteCompute, Start::Load)
        .write(at(BIND_NON_EMPTY_TILES), &mut tiles.seen, write, Start::Discard)
        .write(at(BIND_RUNS), &mut tiles.runs, write, Start::Discard)
        .write(at(BIND_ARGUMENTS), &mut tiles.arguments, write, Start::Discard)
        .write(at(BIND_OVERFLOW_TILES), &mut tiles.overflow, write, Start::Discard);
    let start = [(SPEC_PART_LENGTH, plan.part_length), (SPEC_PARTED, plan.parted_by())].into();
    let start = key(&shaders::TILE_START_COMP, start);
    finish(pass, inputs, (plan, start), |pass| pass.groups(pass.constants, 1))?;

    // Where the graphics pipeline draws some, it wants the splats' own numbers.
    let numbers = visible.as_ref().filter(|_| plan.may_be_large).map(|list| &list.list);
    let pass = Pass::new(graph, inputs.source, name("fill"), WHY);
    let pass = tiles
        .read_for_walk(pass)
        .read_if(at(BIND_VISIBLE_STARTS), visible_starts, read)
        .read_if(at(BIND_VISIBLE_LIST), numbers, read)
        .read(at(BIND_STARTS), &tiles.starts, read)
        .write(at(BIND_COUNTS), &mut tiles.counts, update, Start::Load)
        .write(at(BIND_ENTRIES), &mut tiles.entries, write, Start::Discard);
    let fill =
        walk_key([&shaders::TILE_FILL_COLUMN_COMP, &shaders::TILE_FILL_PIXEL_COMP], plan, visible.is_some());
    finish(pass, inputs, (plan, fill), |pass| walk(pass, plan))?;
    Ok(tiles)
}

/// Records the dispatches of walks: each takes no more projected splats than a shader's loops have iterations for.
fn walk(pass: &TileDispatch<'_, '_>, plan: &TilePlan) -> Result<()> {
    let groups = match plan.invocations.walk_together() {
        true => plan.walks(),
        false => plan.walks().div_ceil(BIN_GROUP_SIZE),
    };
    for round_first in (0..plan.segment_length.div_ceil(plan.pieces)).step_by(plan.round_length as usize) {
        if round_first > 0 {
            pass.wait();
        }
        pass.groups(TileConstants { round_first, ..pass.constants }, groups)?;
    }
    Ok(())
}
