//! Which cells of meshes are drawn as polygons, found on the device, which takes the draws from there: nothing comes back to the host.

use crate::passes::{
    cull::visible::list_key,
    inputs::Inputs,
    pass::Pass,
    place::{At, Place, arguments, lists, transfer},
    plan::mesh_draws::MeshDraw,
    recording::{Recording, rows_of},
};
use crate::{
    error::Result,
    graph::{Access, Buffer, BufferDesc, Graph, Handle, Start, execute::Body},
    shaders::{self, config::*},
};

/// Where the passes that draw polygons find the arguments.
pub(crate) const CELLS: At = arguments(0);

const WHY: &str = "hybrids: cells of a mesh are drawn as polygons where their splats would be large";

/// Bytes of a `VkDrawIndexedIndirectCommand`.
const DRAW_BYTES: u64 = 20;

/// Declares the pass, where the frame has meshes in cells; before it, that which tells it how the camera sees them. Gives the arguments of the draws, one a
/// cell.
pub(crate) fn choose<'a>(
    graph: &mut Graph<'a, Body<'a>>,
    inputs: Inputs<'a>,
) -> Result<Option<Handle<Buffer>>> {
    if inputs.meshes.iter().all(|draw| draw.levels.is_none()) {
        return Ok(None);
    }
    let words = graph.arena().list(words(inputs.meshes));
    let mut view = graph.create_buffer("view of cells", BufferDesc::of_bytes(4 * words.len() as u64));
    Pass::new(graph, inputs.source, "view of cells", WHY)
        .write(transfer(0), &mut view, Access::TransferWrite, Start::Discard)
        .finish(move |pass| pass.update_buffer(transfer(0), bytemuck::cast_slice(words)));
    let bytes = offset_of(inputs.meshes, inputs.meshes.len());
    let mut draws = graph.create_buffer("cells drawn as polygons", BufferDesc::of_bytes(bytes));
    let pass = Pass::new(graph, inputs.source, "choose polygons", WHY)
        .read(lists(BIND_LIST_BLOCKS), &view, Access::StorageReadCompute)
        .write(lists(BIND_LIST_ARGUMENTS), &mut draws, Access::StorageWriteCompute, Start::Discard);
    let pipeline = pass.compute(list_key(&shaders::CHOOSE_POLYGONS_COMP, [].into()))?;
    pass.finish(move |pass| {
        let set = pass.set(Place::Lists(0))?;
        pass.bind(pipeline);
        let mut first = 0;
        for (number, draw) in (0..).zip(inputs.meshes) {
            let cells = cells_of(draw);
            let mut constants = draw.constants;
            constants.number_chunk(number);
            (constants.splat_count, constants.first_record) = (cells, first);
            pass.bind_sets(pipeline.layout, 0, &[draw.chunk.set(), set])?;
            pass.push(pipeline.layout, &constants)?;
            if cells > 0 {
                pass.dispatch(rows_of(cells.div_ceil(LIST_GROUP_SIZE)));
            }
            first += cells;
        }
        Ok(())
    });
    Ok(Some(draws))
}

/// Records the draws of the cells of a mesh, inside of rendering with all bound: one each. A draw that takes their number from a buffer would be one for all, but with it lavapipe of Mesa
/// 22.3 left pictures empty where no cell was drawn.
pub(crate) fn draw_cells(pass: &Recording<'_, '_>, meshes: &[MeshDraw<'_>], number: usize) -> Result<()> {
    let (device, commands, buffer) = (pass.device(), pass.commands(), pass.buffer(CELLS)?);
    let (cells, first) = (cells_of(&meshes[number]), offset_of(meshes, number));
    for cell in 0..u64::from(cells) {
        // SAFETY: as the caller has it, with the index buffer; the buffer holds a draw a cell, each within the mesh.
        unsafe {
            device.cmd_draw_indexed_indirect(
                commands,
                buffer,
                first + DRAW_BYTES * cell,
                1,
                DRAW_BYTES as u32,
            );
        }
    }
    Ok(())
}

fn cells_of(draw: &MeshDraw<'_>) -> u32 {
    draw.levels.and(draw.chunk.levels).map_or(0, |levels| levels.cells)
}

/// Where the draws of a mesh begin, in bytes; behind all where there is no such mesh.
fn offset_of(meshes: &[MeshDraw<'_>], number: usize) -> u64 {
    let before: u64 = meshes[..number].iter().map(|draw| u64::from(cells_of(draw))).sum();
    DRAW_BYTES * before
}

/// Three words that are not read, and how the camera sees each, the last one first (`glsl/inc/list.glsl`, `glsl/inc/levels.glsl`).
fn words(meshes: &[MeshDraw<'_>]) -> impl Iterator<Item = u32> {
    let views = meshes
        .iter()
        .rev()
        .map(|draw| draw.levels.map_or([0; LEVEL_WORDS as usize], |levels| levels.words()));
    [0; 3].into_iter().chain(views.flatten())
}
