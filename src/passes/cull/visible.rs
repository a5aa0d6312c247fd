//! The splats that may be seen, found and listed before any is projected, in input order: a bit each, how many come before each
//! word of bits, their numbers. No atomics, so that the list is the same in every run.

use ash::vk;

use crate::passes::{
    cull::dispatch::dispatch,
    inputs::Inputs,
    pass::Pass,
    pipeline::{
        constants::FrameConstants,
        key::{ComputeKey, Layout},
        variant::Constants,
    },
    place::{At, INDICES, Place, lists, transfer},
    plan::{
        block_list::ListedBlocks,
        draws::{Draw, by_variant},
    },
    predicate::{draw_indexed, is_predicated},
    recording::{Arguments, Recording, rows_of},
};
use crate::{
    error::Result,
    graph::{Access, Buffer, BufferDesc, Graph, Handle, Start, execute::Body},
    shaders::{self, Shader, config::*},
};

/// Why a frame lists them.
const WHY: &str = "some splats face away or may lie outside of the view: the others are listed";

/// Splats of a word of bits.
pub(crate) const WORD: u32 = u32::BITS;

/// Words of the arguments of a chunk, and where the dispatch is in them, in bytes; before it is the draw.
const ARGUMENT_WORDS: u64 = 8;
const DISPATCH_OFFSET: u64 = 20;

fn words_of(draws: &[Draw<'_>]) -> u64 {
    u64::from(blocks_of(draws)) * u64::from(BLOCK_SPLATS / WORD)
}

/// Blocks that are looked in, of all chunks: a list of their splats is within what a buffer holds, so that they are fewer than 2³².
fn blocks_of(draws: &[Draw<'_>]) -> u32 {
    draws.iter().map(|draw| draw.place.listed_blocks).sum()
}

/// The visible splats of all chunks.
pub(crate) struct VisibleList {
    /// A bit a splat.
    pub bits: Handle<Buffer>,
    /// Where they are looked for.
    pub blocks: Handle<Buffer>,
    /// How many come before each word of bits, then in all.
    pub starts: Handle<Buffer>,
    /// Their numbers within their chunks.
    pub list: Handle<Buffer>,
    /// Of each chunk, `VkDrawIndexedIndirectCommand` of points, the list being the index buffer, and
    /// `VkDispatchIndirectCommand` of workgroups of [`PROJECT_GROUP_SIZE`].
    pub arguments: Handle<Buffer>,
}

impl VisibleList {
    /// Adds to a pass what its draws of visible splats as points read.
    pub fn read<'g, 'a>(&self, pass: Pass<'g, 'a>) -> Pass<'g, 'a> {
        pass.read(INDICES, &self.list, Access::IndexRead).read(
            VISIBLE_ARGUMENTS,
            &self.arguments,
            Access::IndirectRead,
        )
    }
}

/// The arguments of the visible splats of all chunks.
pub(crate) const VISIBLE_ARGUMENTS: At = Place::VisibleArguments.at(0);

/// The buffers that visible splats are drawn by, of all chunks: looked for once.
#[derive(Clone, Copy)]
pub(crate) struct VisibleDraws {
    list: vk::Buffer,
    arguments: vk::Buffer,
}

impl VisibleDraws {
    /// Those that a pass found.
    pub fn of(pass: &Recording<'_, '_>) -> Result<Self> {
        Ok(Self { list: pass.buffer(INDICES)?, arguments: pass.buffer(VISIBLE_ARGUMENTS)? })
    }

    /// Records a draw of points, one a visible splat of a chunk, inside of rendering with all bound but the indices: of a layer, where the layer before is
    /// not empty.
    pub fn draw(self, pass: &Recording<'_, '_>, chunk: usize) -> Result<()> {
        let offset = 4 * ARGUMENT_WORDS * chunk as u64;
        // SAFETY: as the caller has it; the buffer was declared to be read so, and holds indices within the chunk.
        unsafe { pass.device().cmd_bind_index_buffer(pass.commands(), self.list, 0, vk::IndexType::UINT32) };
        if is_predicated(pass) {
            return draw_indexed(pass, self.arguments, offset);
        }
        // SAFETY: as above; the buffer holds a command a chunk.
        unsafe { pass.device().cmd_draw_indexed_indirect(pass.commands(), self.arguments, offset, 1, 20) };
        Ok(())
    }
}

/// Records a dispatch of one invocation a visible splat of a chunk with all bound.
pub(crate) fn dispatch_visible(pass: &Recording<'_, '_>, arguments: Arguments, chunk: usize) {
    pass.dispatch_by(arguments, 4 * ARGUMENT_WORDS * chunk as u64 + DISPATCH_OFFSET);
}

/// A pipeline that marks, scans or lists.
pub(crate) fn list_key(shader: &'static Shader, constants: Constants) -> ComputeKey {
    ComputeKey { shader, layout: Layout::List, constants }
}

/// Declares the passes. `kind`, in front of the names, tells several such lists of a frame apart.
pub(crate) fn list_visible<'a>(
    graph: &mut Graph<'a, Body<'a>>,
    inputs: Inputs<'a>,
    kind: &str,
    listed: ListedBlocks<'a>,
) -> Result<VisibleList> {
    let what = graph.arena().text(format_args!("visible {kind}splats"));
    let name = graph.arena().text(format_args!("blocks of {what}"));
    let bytes: &[u8] = bytemuck::cast_slice(listed.words());
    let mut blocks = graph.create_buffer(name, BufferDesc::of_bytes(bytes.len() as u64));
    Pass::new(graph, inputs.source, name, WHY)
        .write(transfer(0), &mut blocks, Access::TransferWrite, Start::Discard)
        .finish(move |pass| pass.update_buffer(transfer(0), bytes));
    let mut bits = create_bits(graph, inputs, what);
    let pass = Pass::new(graph, inputs.source, format_args!("mark {what}"), WHY)
        .read(lists(BIND_LIST_BLOCKS), &blocks, Access::StorageReadCompute)
        .write(lists(BIND_LIST_BITS), &mut bits, Access::StorageWriteCompute, Start::Discard);
    dispatch_words(pass, inputs, &shaders::MARK_VISIBLE_COMP)?;
    list_marked(graph, inputs, what, WHY, (bits, blocks))
}

/// A bit a splat, which some pass is to set.
pub(crate) fn create_bits(graph: &mut Graph<'_, Body<'_>>, inputs: Inputs<'_>, what: &str) -> Handle<Buffer> {
    graph.create_buffer(format_args!("bits of {what}"), BufferDesc::of_bytes(4 * words_of(inputs.draws)))
}

/// Declares a pass of a dispatch a chunk, of one invocation a word of its bits, by a shader that looks at splats.
pub(crate) fn dispatch_words<'a>(
    pass: Pass<'_, 'a>,
    inputs: Inputs<'a>,
    shader: &'static Shader,
) -> Result<()> {
    let of = |draw: &Draw<'_>| pass.compute(list_key(shader, *draw.variant));
    let pipelines = by_variant(pass.arena(), inputs.draws, of)?;
    pass.finish(move |pass| {
        let set = pass.set(Place::Lists(0))?;
        for (draw, pipeline) in inputs.draws.iter().zip(pipelines) {
            let groups = groups_of(draw.place.listed_blocks);
            dispatch(pass, draw.chunk, &draw.told(), *pipeline, set, groups)?;
        }
        Ok(())
    });
    Ok(())
}

/// Declares the two passes that list what is marked.
pub(crate) fn list_marked<'a>(
    graph: &mut Graph<'a, Body<'a>>,
    inputs: Inputs<'a>,
    what: &str,
    why: &'static str,
    (bits, blocks): (Handle<Buffer>, Handle<Buffer>),
) -> Result<VisibleList> {
    let words = words_of(inputs.draws);
    let most = inputs.listed.map_or(u64::MAX, |listed| listed.most_splats().max(1));
    let mut buffer = |part: &str, words: u64| {
        graph.create_buffer(format_args!("{part} of {what}"), BufferDesc::of_bytes(4 * words))
    };
    let mut starts = buffer("starts", words + 1);
    let mut list = buffer("list", most.min(words * u64::from(WORD)));
    let mut arguments = buffer("arguments", ARGUMENT_WORDS * inputs.draws.len() as u64);
    let (read, write) = (Access::StorageReadCompute, Access::StorageWriteCompute);

    let pass = Pass::new(graph, inputs.source, format_args!("scan {what}"), why)
        .read(lists(BIND_LIST_BITS), &bits, read)
        .write(lists(BIND_LIST_STARTS), &mut starts, write, Start::Discard);
    let scan = pass.compute(list_key(&shaders::LIST_SCAN_COMP, [].into()))?;
    pass.finish(move |pass| {
        let set = pass.set(Place::Lists(0))?;
        // One for all chunks; the set of any will do.
        match inputs.draws.first() {
            Some(draw) => dispatch(pass, draw.chunk, &draw.told(), scan, set, [1, 1]),
            None => Ok(()),
        }
    });

    let pass = Pass::new(graph, inputs.source, format_args!("list {what}"), why)
        .read(lists(BIND_LIST_BITS), &bits, read)
        .read(lists(BIND_LIST_STARTS), &starts, read)
        .read(lists(BIND_LIST_BLOCKS), &blocks, read)
        .write(lists(BIND_LIST_ITEMS), &mut list, write, Start::Discard)
        .write(lists(BIND_LIST_ARGUMENTS), &mut arguments, write, Start::Discard);
    let write = pass.compute(list_key(&shaders::LIST_WRITE_COMP, [].into()))?;
    pass.finish(move |pass| {
        let Some(draw) = inputs.draws.first() else { return Ok(()) };
        // One for all chunks; the set of any will do, and their number is in the place of its own.
        let mut constants = FrameConstants { first_record: 0, ..draw.told() };
        constants.number_chunk(inputs.draws.len() as u32);
        let groups = groups_of(blocks_of(inputs.draws));
        dispatch(pass, draw.chunk, &constants, write, pass.set(Place::Lists(0))?, groups)
    });
    Ok(VisibleList { bits, blocks, starts, list, arguments })
}

/// Workgroups of one invocation a word of bits of so many blocks.
pub(crate) fn groups_of(blocks: u32) -> [u32; 2] {
    rows_of((blocks * (BLOCK_SPLATS / WORD)).div_ceil(LIST_GROUP_SIZE))
}
