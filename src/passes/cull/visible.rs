//! The splats that may be seen, found and listed before any is projected, in input order: a bit each, how many come before each
//! word of bits, their numbers. No atomics, so that the list is the same in every run.

use std::sync::Arc;

use ash::vk;

use crate::passes::{
    cull::dispatch::{dispatch, list_set},
    inputs::Inputs,
    pipeline::{
        cache::{ComputeKey, Layout},
        variant::{Constants, culls},
    },
    plan::{block_list::ListedBlocks, draws::Draw},
    tiles::pass::rows_of,
};
use crate::{
    error::Result,
    graph::{
        Access, Buffer, BufferDesc, Graph, Handle, PassBuilder, ResourceId, Start,
        execute::{Body, PassContext},
    },
    shaders::{self, Shader, config::*},
    vk::ComputePipeline,
};

/// Splats of a word of bits.
pub(crate) const WORD: u32 = u32::BITS;

/// The dispatch in the arguments of a chunk, in bytes; before it is the draw.
const DISPATCH_OFFSET: u64 = 20;

fn words_of(draws: &[Draw<'_>]) -> u64 {
    let blocks: u64 = draws.iter().map(|draw| u64::from(draw.constants.listed_blocks)).sum();
    blocks * u64::from(BLOCK_SPLATS / WORD)
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
    arguments: Vec<Handle<Buffer>>,
}

/// What bodies of passes need of it.
#[derive(Clone)]
pub(crate) struct VisibleIds {
    list: ResourceId,
    arguments: Vec<ResourceId>,
}

impl VisibleList {
    pub fn ids(&self) -> VisibleIds {
        VisibleIds { list: self.list.id(), arguments: self.arguments.iter().map(Handle::id).collect() }
    }

    /// Declares that a pass dispatches one invocation a visible splat.
    pub fn read_by_compute<'g, B>(&self, pass: PassBuilder<'g, B>) -> PassBuilder<'g, B> {
        let lists = [&self.starts, &self.list, &self.blocks];
        let pass = lists.into_iter().fold(pass, |pass, list| pass.read(list, Access::StorageReadCompute));
        self.arguments.iter().fold(pass, |pass, arguments| pass.read(arguments, Access::IndirectRead))
    }

    /// Declares that a pass draws the visible splats as points.
    pub fn read_by_points<'g, B>(&self, pass: PassBuilder<'g, B>) -> PassBuilder<'g, B> {
        let pass = pass.read(&self.list, Access::IndexRead);
        self.arguments.iter().fold(pass, |pass, arguments| pass.read(arguments, Access::IndirectRead))
    }
}

impl VisibleIds {
    /// Records a draw of points, one a visible splat of a chunk, inside of rendering with all bound but the indices.
    pub fn draw_points(&self, context: &PassContext<'_>, chunk: usize) -> Result<()> {
        let (list, arguments) = (context.buffer(self.list)?, context.buffer(self.arguments[chunk])?);
        let (device, commands) = (context.device(), context.commands());
        // SAFETY: as the caller has it; both buffers were declared to be read so, and hold indices within the chunk and
        // one command.
        unsafe {
            device.cmd_bind_index_buffer(commands, list, 0, vk::IndexType::UINT32);
            device.cmd_draw_indexed_indirect(commands, arguments, 0, 1, 20);
        }
        Ok(())
    }

    /// Records a dispatch of one invocation a visible splat of a chunk with all bound.
    pub fn dispatch(&self, context: &PassContext<'_>, chunk: usize) -> Result<()> {
        let arguments = context.buffer(self.arguments[chunk])?;
        // SAFETY: as the caller has it; the arguments were declared to be read, and are within the buffer.
        unsafe { context.device().cmd_dispatch_indirect(context.commands(), arguments, DISPATCH_OFFSET) };
        Ok(())
    }
}

/// A pipeline that marks, scans or lists.
pub(crate) fn list_key(shader: &'static Shader, constants: Constants) -> ComputeKey {
    ComputeKey { shader, layout: Layout::List, constants }
}

/// Declares the passes. `kind`, in front of the names, tells several such lists of a frame apart.
pub(crate) fn list_visible<'a>(
    graph: &mut Graph<Body<'a>>,
    inputs: Inputs<'a>,
    kind: &str,
    listed: &'a ListedBlocks,
) -> Result<VisibleList> {
    let what = format!("visible {kind}splats");
    let blocks = listed.upload(graph, &what);
    let mut bits = create_bits(graph, inputs, &what);
    let mark = pipelines(inputs, &shaders::MARK_VISIBLE_COMP)?;
    let bound = [(BIND_LIST_BITS, bits.id()), (BIND_LIST_BLOCKS, blocks.id())];
    graph
        .pass(&format!("mark {what}"))
        .read(&blocks, Access::StorageReadCompute)
        .write(&mut bits, Access::StorageWriteCompute, Start::Discard)
        .finish(Box::new(move |context| dispatch_words(context, inputs, &mark, &bound)));
    list_marked(graph, inputs, &what, (bits, blocks))
}

/// A bit a splat, which some pass is to set.
pub(crate) fn create_bits(graph: &mut Graph<Body<'_>>, inputs: Inputs<'_>, what: &str) -> Handle<Buffer> {
    graph.create_buffer(&format!("bits of {what}"), BufferDesc::of_bytes(4 * words_of(inputs.draws)))
}

/// The pipelines of a shader that looks at splats, one a chunk.
pub(crate) fn pipelines(inputs: Inputs<'_>, shader: &'static Shader) -> Result<Vec<Arc<ComputePipeline>>> {
    let of = |draw: &Draw<'_>| inputs.shaders.compute(list_key(shader, draw.variant.clone()));
    inputs.draws.iter().map(of).collect()
}

/// Records, for each chunk, a dispatch of one invocation a word of its bits, with these buffers.
pub(crate) fn dispatch_words(
    context: &PassContext<'_>,
    inputs: Inputs<'_>,
    pipelines: &[Arc<ComputePipeline>],
    bound: &[(u32, ResourceId)],
) -> Result<()> {
    let set = list_set(context, inputs, bound)?;
    for (draw, pipeline) in inputs.draws.iter().zip(pipelines) {
        dispatch(
            context,
            inputs,
            draw,
            &draw.constants,
            pipeline,
            set,
            groups_of(draw.constants.listed_blocks),
        );
    }
    Ok(())
}

/// Declares the two passes that list what is marked.
pub(crate) fn list_marked<'a>(
    graph: &mut Graph<Body<'a>>,
    inputs: Inputs<'a>,
    what: &str,
    (bits, blocks): (Handle<Buffer>, Handle<Buffer>),
) -> Result<VisibleList> {
    let words = words_of(inputs.draws);
    let mut buffer = |part: &str, words: u64| {
        graph.create_buffer(&format!("{part} of {what}"), BufferDesc::of_bytes(4 * words))
    };
    let mut starts = buffer("starts", words + 1);
    let mut list = buffer("list", words * u64::from(WORD));
    let chunks = 0..inputs.draws.len();
    let mut arguments: Vec<_> =
        chunks.map(|number| buffer(&format!("arguments in chunk {number}"), 8)).collect();

    let scan = inputs.shaders.compute(list_key(&shaders::LIST_SCAN_COMP, Vec::new()))?;
    let bound = [(BIND_LIST_BITS, bits.id()), (BIND_LIST_STARTS, starts.id())];
    graph
        .pass(&format!("scan {what}"))
        .read(&bits, Access::StorageReadCompute)
        .write(&mut starts, Access::StorageWriteCompute, Start::Discard)
        .finish(Box::new(move |context| {
            let set = list_set(context, inputs, &bound)?;
            // One for all chunks; the set of any will do.
            if let Some(draw) = inputs.draws.first() {
                dispatch(context, inputs, draw, &draw.constants, &scan, set, [1, 1]);
            }
            Ok(())
        }));

    let write = inputs.shaders.compute(list_key(&shaders::LIST_WRITE_COMP, Vec::new()))?;
    let bound = [
        (BIND_LIST_BITS, bits.id()),
        (BIND_LIST_STARTS, starts.id()),
        (BIND_LIST_ITEMS, list.id()),
        (BIND_LIST_BLOCKS, blocks.id()),
    ];
    let mut pass = graph
        .pass(&format!("list {what}"))
        .read(&bits, Access::StorageReadCompute)
        .read(&starts, Access::StorageReadCompute)
        .read(&blocks, Access::StorageReadCompute)
        .write(&mut list, Access::StorageWriteCompute, Start::Discard);
    for arguments in &mut arguments {
        pass = pass.write(arguments, Access::StorageWriteCompute, Start::Discard);
    }
    let ids: Vec<_> = arguments.iter().map(Handle::id).collect();
    pass.finish(Box::new(move |context| {
        for (draw, arguments) in inputs.draws.iter().zip(ids) {
            let bound = [&bound[..], &[(BIND_LIST_ARGUMENTS, arguments)]].concat();
            let set = list_set(context, inputs, &bound)?;
            let groups = groups_of(draw.constants.listed_blocks);
            dispatch(context, inputs, draw, &draw.constants, &write, set, groups);
        }
        Ok(())
    }));
    Ok(VisibleList { bits, blocks, starts, list, arguments })
}

/// Workgroups of one invocation a word of bits of so many blocks.
pub(crate) fn groups_of(blocks: u32) -> [u32; 2] {
    rows_of((blocks * (BLOCK_SPLATS / WORD)).div_ceil(LIST_GROUP_SIZE))
}

/// The three passes, where there are splats of a variant to leave out.
pub(crate) fn recipes(variant: &Constants) -> Vec<(&'static str, ComputeKey)> {
    let passes = [
        ("mark visible splats", list_key(&shaders::MARK_VISIBLE_COMP, variant.clone())),
        ("scan visible splats", list_key(&shaders::LIST_SCAN_COMP, Vec::new())),
        ("list visible splats", list_key(&shaders::LIST_WRITE_COMP, Vec::new())),
    ];
    passes.into_iter().filter(|_| culls(variant)).collect()
}
