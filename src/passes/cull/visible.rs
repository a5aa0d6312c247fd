//! The splats that may be seen ("kept"), found and listed before any is set up, in input order: a bit each, how many come
//! before each word of bits, their indices. No atomics, so that the list is the same in every run.

use std::sync::Arc;

use ash::vk;

use crate::passes::{
    cull::dispatch::dispatch,
    inputs::Inputs,
    pipeline::{
        cache::{ComputeKey, Layout},
        variant::{Constants, culls},
    },
    plan::{block_list::Listed, draws::Draw},
    tiles::pass::rows_of,
};
use crate::{
    error::Result,
    graph::{
        Access, Buffer, BufferDesc, Graph, Handle, PassBuilder, ResourceId, Start,
        execute::{Body, PassContext},
    },
    prepare::BLOCK_SPLATS,
    shaders::{self, Shader, config::*},
    vk::ComputePipeline,
};

/// Splats of a word of bits, as in `glsl/inc/kept.glsl`.
const WORD: u32 = 32;

/// Invocations of a workgroup, one a word, as in `glsl/cull_mark.comp.glsl`.
const GROUP: u32 = 64;

/// Where [`VkDispatchIndirectCommand`](vk::DispatchIndirectCommand) is in the arguments of a chunk, in bytes; before it is the draw.
const DISPATCH: u64 = 20;

fn words_of(draws: &[Draw<'_>]) -> u64 {
    let blocks: u64 = draws.iter().map(|draw| u64::from(draw.constants.listed_blocks)).sum();
    blocks * u64::from(BLOCK_SPLATS / WORD)
}

/// The kept splats of a part.
pub(crate) struct Kept {
    /// A bit a splat.
    pub bits: Handle<Buffer>,
    /// Where they are looked for.
    pub blocks: Handle<Buffer>,
    /// How many are kept before each word of bits, then in all.
    starts: Handle<Buffer>,
    /// Their indices within their chunks.
    list: Handle<Buffer>,
    /// Of each chunk, `VkDrawIndexedIndirectCommand` of points, the list being the index buffer, and
    /// `VkDispatchIndirectCommand` of workgroups of 64.
    arguments: Vec<Handle<Buffer>>,
}

/// What passes need of it when they are recorded.
#[derive(Clone)]
pub(crate) struct KeptIds {
    pub starts: ResourceId,
    pub list: ResourceId,
    pub blocks: ResourceId,
    arguments: Vec<ResourceId>,
}

impl Kept {
    fn create(
        graph: &mut Graph<Body<'_>>,
        what: &str,
        (bits, blocks): (Handle<Buffer>, Handle<Buffer>),
        draws: &[Draw<'_>],
    ) -> Self {
        let words = words_of(draws);
        let mut buffer = |part: &str, words: u64| {
            graph.create_buffer(&format!("{part} of {what}"), BufferDesc::of_bytes(4 * words))
        };
        Self {
            bits,
            blocks,
            starts: buffer("starts", words + 1),
            list: buffer("list", words * u64::from(WORD)),
            arguments: (0..draws.len())
                .map(|number| buffer(&format!("arguments in chunk {number}"), 8))
                .collect(),
        }
    }

    pub fn ids(&self) -> KeptIds {
        KeptIds {
            starts: self.starts.id(),
            list: self.list.id(),
            blocks: self.blocks.id(),
            arguments: self.arguments.iter().map(Handle::id).collect(),
        }
    }

    /// Declares that a pass dispatches one invocation a kept splat.
    pub fn read_by_compute<'g, B>(&self, pass: PassBuilder<'g, B>) -> PassBuilder<'g, B> {
        let lists = [&self.starts, &self.list, &self.blocks];
        let pass = lists.into_iter().fold(pass, |pass, list| pass.read(list, Access::StorageReadCompute));
        self.arguments.iter().fold(pass, |pass, arguments| pass.read(arguments, Access::IndirectRead))
    }

    /// Declares that a pass draws the kept splats as points.
    pub fn read_by_points<'g, B>(&self, pass: PassBuilder<'g, B>) -> PassBuilder<'g, B> {
        let pass = pass.read(&self.list, Access::IndexRead);
        self.arguments.iter().fold(pass, |pass, arguments| pass.read(arguments, Access::IndirectRead))
    }

    /// How many there are is in the last word of this, for a pass that walks over all of them.
    pub fn starts(&self) -> &Handle<Buffer> {
        &self.starts
    }

    pub fn list(&self) -> &Handle<Buffer> {
        &self.list
    }
}

impl KeptIds {
    /// Records a draw of points, one a kept splat of a chunk, inside of rendering with all bound but the indices.
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

    /// Records a dispatch of one invocation a kept splat of a chunk, 64 a workgroup, with all bound.
    pub fn dispatch(&self, context: &PassContext<'_>, chunk: usize) -> Result<()> {
        let arguments = context.buffer(self.arguments[chunk])?;
        // SAFETY: as the caller has it; the arguments were declared to be read, and are within the buffer.
        unsafe { context.device().cmd_dispatch_indirect(context.commands(), arguments, DISPATCH) };
        Ok(())
    }
}

/// What the pipelines of the three passes are, in their order. Only the first looks at splats.
fn keys(variant: &Constants) -> Vec<ComputeKey> {
    let key = |shader: &'static Shader, constants| ComputeKey { shader, layout: Layout::List, constants };
    vec![
        key(&shaders::CULL_MARK_COMP, variant.clone()),
        key(&shaders::CULL_SCAN_COMP, Vec::new()),
        key(&shaders::CULL_LIST_COMP, Vec::new()),
    ]
}

/// Declares the passes. `kind`, in front of the names, tells several such lists of a frame apart.
pub(crate) fn list_kept<'a>(
    graph: &mut Graph<Body<'a>>,
    inputs: Inputs<'a>,
    kind: &str,
    listed: &'a Listed,
) -> Result<Kept> {
    let what = format!("kept {kind}splats");
    let blocks = listed.upload(graph, &what);
    let mut bits = create_bits(graph, inputs, &what);
    let (id, blocks_id) = (bits.id(), blocks.id());
    let mark = pipelines(inputs, |draw| keys(&draw.variant).swap_remove(0))?;
    graph
        .pass(&format!("mark {what}"))
        .read(&blocks, Access::StorageReadCompute)
        .write(&mut bits, Access::StorageWriteCompute, Start::Discard)
        .finish(Box::new(move |context| {
            for (draw, pipeline) in inputs.draws.iter().zip(&mark) {
                let buffers = [(BIND_LIST_BITS, id), (BIND_LIST_BLOCKS, blocks_id)];
                dispatch(context, inputs, draw, pipeline, &buffers, groups_of(draw))?;
            }
            Ok(())
        }));
    list_marked(graph, inputs, &what, (bits, blocks))
}

/// A bit a splat, which some pass is to set.
pub(crate) fn create_bits(graph: &mut Graph<Body<'_>>, inputs: Inputs<'_>, what: &str) -> Handle<Buffer> {
    graph.create_buffer(&format!("bits of {what}"), BufferDesc::of_bytes(4 * words_of(inputs.draws)))
}

/// The pipeline of each chunk.
pub(crate) fn pipelines(
    inputs: Inputs<'_>,
    key: impl Fn(&Draw<'_>) -> ComputeKey,
) -> Result<Vec<Arc<ComputePipeline>>> {
    inputs.draws.iter().map(|draw| inputs.shaders.compute(key(draw))).collect()
}

/// Declares the two passes that list what is marked.
pub(crate) fn list_marked<'a>(
    graph: &mut Graph<Body<'a>>,
    inputs: Inputs<'a>,
    what: &str,
    bits_of_blocks: (Handle<Buffer>, Handle<Buffer>),
) -> Result<Kept> {
    let mut kept = Kept::create(graph, what, bits_of_blocks, inputs.draws);
    let KeptIds { starts, list, blocks, arguments } = kept.ids();
    let bits = kept.bits.id();
    let scan = pipelines(inputs, |draw| keys(&draw.variant).swap_remove(1))?;
    graph
        .pass(&format!("scan {what}"))
        .read(&kept.bits, Access::StorageReadCompute)
        .write(&mut kept.starts, Access::StorageWriteCompute, Start::Discard)
        .finish(Box::new(move |context| {
            // One for all chunks; the set of any will do.
            match inputs.draws.iter().zip(&scan).next() {
                Some((draw, pipeline)) => {
                    let buffers = [(BIND_LIST_BITS, bits), (BIND_LIST_STARTS, starts)];
                    dispatch(context, inputs, draw, pipeline, &buffers, [1, 1])
                }
                None => Ok(()),
            }
        }));

    let place = pipelines(inputs, |draw| keys(&draw.variant).swap_remove(2))?;
    let mut pass = graph
        .pass(&format!("list {what}"))
        .read(&kept.bits, Access::StorageReadCompute)
        .read(&kept.starts, Access::StorageReadCompute)
        .read(&kept.blocks, Access::StorageReadCompute)
        .write(&mut kept.list, Access::StorageWriteCompute, Start::Discard);
    for arguments in &mut kept.arguments {
        pass = pass.write(arguments, Access::StorageWriteCompute, Start::Discard);
    }
    pass.finish(Box::new(move |context| {
        for ((draw, pipeline), arguments) in inputs.draws.iter().zip(&place).zip(&arguments) {
            let buffers = [
                (BIND_LIST_BITS, bits),
                (BIND_LIST_STARTS, starts),
                (BIND_LIST_ITEMS, list),
                (BIND_LIST_ARGUMENTS, *arguments),
                (BIND_LIST_BLOCKS, blocks),
            ];
            dispatch(context, inputs, draw, pipeline, &buffers, groups_of(draw))?;
        }
        Ok(())
    }));
    Ok(kept)
}

/// Workgroups of one invocation a word of bits.
pub(crate) fn groups_of(draw: &Draw<'_>) -> [u32; 2] {
    rows_of((draw.constants.listed_blocks * (BLOCK_SPLATS / WORD)).div_ceil(GROUP))
}

/// The three passes, where there are splats of a variant to leave out.
pub(crate) fn recipes(variant: &Constants) -> Vec<(&'static str, ComputeKey)> {
    let passes = ["mark kept splats", "scan kept splats", "list kept splats"];
    passes.into_iter().zip(keys(variant)).filter(|_| culls(variant)).collect()
}
