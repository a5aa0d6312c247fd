//! The splats that are drawn as quads, because they exceed the device's largest point, come near the eye plane or are
//! too thin for a triangle: found and listed on the GPU, in input order, chunk by chunk.

use crate::passes::{
    cull::{
        dispatch::dispatch,
        visible::{WORD, groups_of, list_key},
    },
    inputs::Inputs,
    pass::Pass,
    pipeline::{constants::FrameConstants, key::ComputeKey},
    place::{Place, arguments},
    plan::draws::Draw,
};
use crate::{
    error::Result,
    graph::{Access, Buffer, BufferDesc, Graph, Handle, Start, execute::Body},
    shaders::{self, config::*},
};

/// Why a frame lists them.
const WHY: &str = "a splat may exceed the device's largest point, or come near the eye plane";

/// The large splats of one chunk.
pub(crate) struct LargeList {
    /// The chunk's number among the draws.
    chunk: u32,
    /// A bit a splat: it is large.
    bits: Handle<Buffer>,
    /// How many large splats come before each word of bits, then in all.
    starts: Handle<Buffer>,
    /// The numbers of the large splats in their chunk, in order.
    list: Handle<Buffer>,
    /// `VkDrawIndirectCommand`: one strip of four vertices a large splat.
    arguments: Handle<Buffer>,
}

impl LargeList {
    fn create(graph: &mut Graph<'_, Body<'_>>, kind: &str, chunk: u32, draw: &Draw<'_>) -> Self {
        let words = u64::from(blocks_of(draw)) * u64::from(BLOCK_SPLATS / WORD);
        let mut buffer = |what: &str, words: u64| {
            let desc = BufferDesc::of_bytes(4 * words);
            graph.create_buffer(format_args!("large {what} of {kind}chunk {chunk}"), desc)
        };
        Self {
            chunk,
            bits: buffer("bits", words),
            starts: buffer("starts", words + 1),
            list: buffer("list", u64::from(draw.chunk.count)),
            arguments: buffer("arguments", 8),
        }
    }

    /// Adds to a pass what its draws of the chunk read.
    pub fn read<'g, 'a>(&self, pass: Pass<'g, 'a>) -> Pass<'g, 'a> {
        let lists = Place::Lists(self.chunk);
        pass.read(lists.at(BIND_LIST_BITS), &self.bits, Access::StorageReadVertex)
            .read(lists.at(BIND_LIST_ITEMS), &self.list, Access::StorageReadVertex)
            .read(arguments(self.chunk), &self.arguments, Access::IndirectRead)
    }
}

/// What the pipelines of the three passes are, in their order. Only the first projects splats and so has the variants of the splat
/// passes.
fn key(step: usize, draw: &Draw<'_>) -> ComputeKey {
    let large = (SPEC_LARGE_LIST, 1);
    match step {
        0 => list_key(&shaders::MARK_LARGE_COMP, draw.variant.with([large])),
        1 => list_key(&shaders::LIST_SCAN_COMP, [].into()),
        _ => list_key(&shaders::LIST_WRITE_COMP, [large].into()),
    }
}

/// Declares the three passes that list large splats; none where no chunk may have any. `kind`, in front of the names, tells several
/// such lists of a frame apart.
pub(crate) fn list_large<'a>(
    graph: &mut Graph<'a, Body<'a>>,
    inputs: Inputs<'a>,
    kind: &str,
) -> Result<&'a [LargeList]> {
    let may_be_large = (0..).zip(inputs.draws).filter(|(_, draw)| draw.may_be_large);
    let mut lists = graph.arena().growing();
    lists.extend(may_be_large.map(|(chunk, draw)| LargeList::create(graph, kind, chunk, draw)));
    if lists.is_empty() {
        return Ok(&[]);
    }
    let (read, write) = (Access::StorageReadCompute, Access::StorageWriteCompute);
    for (step, what) in ["mark", "scan", "list"].into_iter().enumerate() {
        let mut pass = Pass::new(graph, inputs.source, format_args!("{what} large {kind}splats"), WHY);
        let mut chunks = pass.arena().growing();
        for LargeList { chunk, bits, starts, list, arguments } in &mut lists {
            let [at_bits, at_starts, at_list, at_arguments] =
                [BIND_LIST_BITS, BIND_LIST_STARTS, BIND_LIST_ITEMS, BIND_LIST_ARGUMENTS]
                    .map(|binding| Place::Lists(*chunk).at(binding));
            pass = match step {
                0 => pass.write(at_bits, bits, write, Start::Discard),
                1 => pass.read(at_bits, bits, read).write(at_starts, starts, write, Start::Discard),
                _ => pass
                    .read(at_bits, bits, read)
                    .read(at_starts, starts, read)
                    .write(at_list, list, write, Start::Discard)
                    .write(at_arguments, arguments, write, Start::Discard),
            };
            let draw = &inputs.draws[*chunk as usize];
            chunks.push((*chunk, draw, pass.compute(key(step, draw))?));
        }
        let chunks = chunks.into_bump_slice();
        pass.finish(move |pass| {
            for &(chunk, draw, pipeline) in chunks {
                let blocks = blocks_of(draw);
                // Its lists are its own.
                let mut constants = FrameConstants { first_record: 0, chunk_color: 0, ..draw.constants };
                constants.list_blocks(blocks);
                let groups = if step == 1 { [1, 1] } else { groups_of(blocks) };
                dispatch(pass, draw.chunk, &constants, pipeline, pass.set(Place::Lists(chunk))?, groups)?;
            }
            Ok(())
        });
    }
    Ok(lists.into_bump_slice())
}

fn blocks_of(draw: &Draw<'_>) -> u32 {
    draw.chunk.count.div_ceil(BLOCK_SPLATS)
}
