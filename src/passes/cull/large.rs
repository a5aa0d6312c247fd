//! The splats that are drawn as quads, because they exceed the device's largest point, come near the eye plane or are
//! too thin for a triangle: found and listed on the GPU, in input order, chunk by chunk.

use std::sync::Arc;

use crate::passes::{
    cull::{
        dispatch::{dispatch, list_set},
        visible::{WORD, groups_of, list_key},
    },
    inputs::Inputs,
    pipeline::{cache::ComputeKey, constants::FrameConstants, variant::Constants},
    plan::draws::Draw,
};
use crate::{
    error::Result,
    graph::{Access, Buffer, BufferDesc, Graph, Handle, PassBuilder, ResourceId, Start, execute::Body},
    shaders::{self, config::*},
};

/// The large splats of one chunk.
pub(crate) struct LargeList {
    /// A bit a splat: it is large.
    bits: Handle<Buffer>,
    /// How many large splats come before each word of bits, then in all.
    starts: Handle<Buffer>,
    /// The numbers of the large splats in their chunk, in order.
    list: Handle<Buffer>,
    /// `VkDrawIndirectCommand`: one strip of four vertices a large splat.
    arguments: Handle<Buffer>,
}

/// The resources of a [`LargeList`].
#[derive(Clone, Copy)]
pub(crate) struct LargeIds {
    pub bits: ResourceId,
    pub starts: ResourceId,
    pub list: ResourceId,
    pub arguments: ResourceId,
}

impl LargeList {
    fn create(graph: &mut Graph<Body<'_>>, kind: &str, number: usize, draw: &Draw<'_>) -> Self {
        let words = u64::from(blocks_of(draw)) * u64::from(BLOCK_SPLATS / WORD);
        let mut buffer = |what: &str, words: u64| {
            let desc = BufferDesc::of_bytes(4 * words);
            graph.create_buffer(&format!("large {what} of {kind}chunk {number}"), desc)
        };
        Self {
            bits: buffer("bits", words),
            starts: buffer("starts", words + 1),
            list: buffer("list", u64::from(draw.chunk.count)),
            arguments: buffer("arguments", 8),
        }
    }

    /// Declares that a pass draws with it.
    pub fn read_by_draws<'g, B>(&self, pass: PassBuilder<'g, B>) -> PassBuilder<'g, B> {
        pass.read(&self.bits, Access::StorageReadVertex)
            .read(&self.list, Access::StorageReadVertex)
            .read(&self.arguments, Access::IndirectRead)
    }

    pub fn ids(&self) -> LargeIds {
        let Self { bits, starts, list, arguments } = self;
        LargeIds { bits: bits.id(), starts: starts.id(), list: list.id(), arguments: arguments.id() }
    }
}

impl LargeIds {
    /// The bindings of its set of lists.
    pub fn bindings(&self) -> [(u32, ResourceId); 4] {
        [
            (BIND_LIST_BITS, self.bits),
            (BIND_LIST_STARTS, self.starts),
            (BIND_LIST_ITEMS, self.list),
            (BIND_LIST_ARGUMENTS, self.arguments),
        ]
    }
}

/// What the pipelines of the three passes are, in their order. Only the first projects splats and so has the variants of the splat
/// passes.
pub(crate) fn keys(variant: &Constants) -> [ComputeKey; 3] {
    let large = (SPEC_LARGE_LIST, 1);
    [
        list_key(&shaders::MARK_LARGE_COMP, [variant.as_slice(), &[large]].concat()),
        list_key(&shaders::LIST_SCAN_COMP, Vec::new()),
        list_key(&shaders::LIST_WRITE_COMP, vec![large]),
    ]
}

/// Declares the three passes that list large splats; none where no chunk may have any. One list (or none) a draw. `kind`, in
/// front of the names, tells several such lists of a frame apart.
pub(crate) fn list_large<'a>(
    graph: &mut Graph<Body<'a>>,
    inputs: Inputs<'a>,
    kind: &str,
) -> Result<Vec<Option<LargeList>>> {
    let mut lists = Vec::new();
    let mut chunks = Vec::new();
    for (number, draw) in inputs.draws.iter().enumerate() {
        let list = draw.may_be_large.then(|| LargeList::create(graph, kind, number, draw));
        if let Some(list) = &list {
            let [mark, scan, write] = keys(&draw.variant).map(|key| inputs.shaders.compute(key));
            chunks.push((draw, list.ids(), [mark?, scan?, write?]));
        }
        lists.push(list);
    }
    if chunks.is_empty() {
        return Ok(lists);
    }
    let chunks = Arc::new(chunks);
    let (read, write) = (Access::StorageReadCompute, Access::StorageWriteCompute);
    for (step, what) in ["mark", "scan", "list"].into_iter().enumerate() {
        let mut pass = graph.pass(&format!("{what} large {kind}splats"));
        for LargeList { bits, starts, list, arguments } in lists.iter_mut().flatten() {
            pass = match step {
                0 => pass.write(bits, write, Start::Discard),
                1 => pass.read(bits, read).write(starts, write, Start::Discard),
                _ => pass.read(bits, read).read(starts, read).write(list, write, Start::Discard).write(
                    arguments,
                    write,
                    Start::Discard,
                ),
            };
        }
        let chunks = Arc::clone(&chunks);
        pass.finish(Box::new(move |context| {
            // What each step declares.
            let bound = [0..1, 0..2, 0..4][step].clone();
            for (draw, ids, pipelines) in chunks.iter() {
                let set = list_set(context, inputs, &ids.bindings()[bound.clone()])?;
                let blocks = blocks_of(draw);
                let constants = FrameConstants { first_record: 0, listed_blocks: blocks, ..draw.constants };
                let groups = if step == 1 { [1, 1] } else { groups_of(blocks) };
                dispatch(context, inputs, draw, &constants, &pipelines[step], set, groups);
            }
            Ok(())
        }));
    }
    Ok(lists)
}

fn blocks_of(draw: &Draw<'_>) -> u32 {
    draw.chunk.count.div_ceil(BLOCK_SPLATS)
}
