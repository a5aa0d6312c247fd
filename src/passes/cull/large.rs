//! The splats that are drawn as quads, because they exceed the device's largest point, come near the eye plane or are
//! too thin for a triangle: found, counted and listed on the GPU, in input order.

use std::sync::Arc;

use crate::passes::{
    cull::dispatch::dispatch,
    inputs::Inputs,
    pipeline::{
        cache::{ComputeKey, Layout},
        variant::Constants,
    },
    plan::draws::Draw,
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

/// Splats of a block: one workgroup, as in `glsl/large_count.comp.glsl`.
const BLOCK: u32 = 256;

/// The large splats of one chunk. The order of the fields is that of the set's bindings.
pub(crate) struct LargeList {
    /// A bit a splat: it is large.
    bits: Handle<Buffer>,
    /// How many large splats a block has; later how many come before it.
    counts: Handle<Buffer>,
    /// The indices of the large splats, in order.
    list: Handle<Buffer>,
    /// `VkDrawIndirectCommand`: one strip of four vertices a large splat.
    arguments: Handle<Buffer>,
}

/// The resources of a [`LargeList`].
#[derive(Clone, Copy)]
pub(crate) struct LargeIds {
    pub bits: ResourceId,
    pub counts: ResourceId,
    pub list: ResourceId,
    pub arguments: ResourceId,
}

impl LargeList {
    fn create(graph: &mut Graph<Body<'_>>, kind: &str, number: usize, draw: &Draw<'_>) -> Self {
        let blocks = u64::from(blocks_of(draw));
        let mut buffer = |what: &str, size_bytes| {
            graph.create_buffer(
                &format!("large {what} of {kind}chunk {number}"),
                BufferDesc::of_bytes(size_bytes),
            )
        };
        Self {
            bits: buffer("bits", blocks * u64::from(BLOCK) / 8),
            counts: buffer("counts", blocks * 4),
            list: buffer("list", u64::from(draw.chunk.count) * 4),
            arguments: buffer("arguments", 16),
        }
    }

    /// Declares that a pass draws with it.
    pub fn read_by_draws<'g, B>(&self, pass: PassBuilder<'g, B>) -> PassBuilder<'g, B> {
        pass.read(&self.bits, Access::StorageReadVertex)
            .read(&self.list, Access::StorageReadVertex)
            .read(&self.arguments, Access::IndirectRead)
    }

    pub fn ids(&self) -> LargeIds {
        LargeIds {
            bits: self.bits.id(),
            counts: self.counts.id(),
            list: self.list.id(),
            arguments: self.arguments.id(),
        }
    }
}

/// What the pipelines of the three passes are, in their order.
pub(crate) fn keys(variant: &Constants) -> [ComputeKey; 3] {
    [&shaders::LARGE_COUNT_COMP, &shaders::LARGE_SCAN_COMP, &shaders::LARGE_LIST_COMP]
        .map(|shader| key(shader, variant))
}

/// Only the first sets splats up and so has the variants of the splat passes.
fn key(shader: &'static Shader, variant: &Constants) -> ComputeKey {
    let constants = if shader == &shaders::LARGE_COUNT_COMP { variant.clone() } else { Vec::new() };
    ComputeKey { shader, layout: Layout::List, constants }
}

/// Declares the three passes that list large splats; none where no chunk may have any. One list (or none) a draw. `kind`, in
/// front of the names, tells several such lists of a frame apart.
pub(crate) fn list_large<'a>(
    graph: &mut Graph<Body<'a>>,
    inputs: Inputs<'a>,
    kind: &str,
) -> Result<Vec<Option<LargeList>>> {
    let mut lists: Vec<_> = inputs
        .draws
        .iter()
        .enumerate()
        .map(|(number, draw)| draw.may_be_large.then(|| LargeList::create(graph, kind, number, draw)))
        .collect();
    if lists.iter().all(Option::is_none) {
        return Ok(lists);
    }
    let ids: Vec<_> = lists.iter().map(|list| list.as_ref().map(LargeList::ids)).collect();

    let count = Dispatches::new(inputs, &ids, &shaders::LARGE_COUNT_COMP)?;
    let mut pass = graph.pass(&format!("count large {kind}splats"));
    for list in lists.iter_mut().flatten() {
        pass = pass.write(&mut list.bits, Access::StorageWriteCompute, Start::Discard).write(
            &mut list.counts,
            Access::StorageWriteCompute,
            Start::Discard,
        );
    }
    pass.finish(Box::new(move |context| {
        count.record(
            context,
            |ids| vec![(BIND_LIST_BITS, ids.bits), (BIND_LIST_STARTS, ids.counts)],
            blocks_of,
        )
    }));

    let scan = Dispatches::new(inputs, &ids, &shaders::LARGE_SCAN_COMP)?;
    let mut pass = graph.pass(&format!("scan large {kind}splats"));
    for list in lists.iter_mut().flatten() {
        pass = pass.write(&mut list.counts, Access::StorageReadWriteCompute, Start::Load).write(
            &mut list.arguments,
            Access::StorageWriteCompute,
            Start::Discard,
        );
    }
    pass.finish(Box::new(move |context| {
        scan.record(
            context,
            |ids| vec![(BIND_LIST_STARTS, ids.counts), (BIND_LIST_ARGUMENTS, ids.arguments)],
            |_| 1,
        )
    }));

    let place = Dispatches::new(inputs, &ids, &shaders::LARGE_LIST_COMP)?;
    let mut pass = graph.pass(&format!("list large {kind}splats"));
    for list in lists.iter_mut().flatten() {
        pass = pass
            .read(&list.bits, Access::StorageReadCompute)
            .read(&list.counts, Access::StorageReadCompute)
            .write(&mut list.list, Access::StorageWriteCompute, Start::Discard);
    }
    pass.finish(Box::new(move |context| {
        place.record(
            context,
            |ids| {
                vec![(BIND_LIST_BITS, ids.bits), (BIND_LIST_STARTS, ids.counts), (BIND_LIST_ITEMS, ids.list)]
            },
            blocks_of,
        )
    }));
    Ok(lists)
}

/// One dispatch for each chunk that may have large splats.
struct Dispatches<'a> {
    inputs: Inputs<'a>,
    chunks: Vec<(&'a Draw<'a>, LargeIds, Arc<ComputePipeline>)>,
}

impl<'a> Dispatches<'a> {
    fn new(inputs: Inputs<'a>, ids: &[Option<LargeIds>], shader: &'static Shader) -> Result<Self> {
        let mut chunks = Vec::new();
        for (draw, ids) in inputs.draws.iter().zip(ids) {
            if let Some(ids) = ids {
                let pipeline = inputs.shaders.compute(key(shader, &draw.variant))?;
                chunks.push((draw, *ids, pipeline));
            }
        }
        Ok(Self { inputs, chunks })
    }

    fn record(
        &self,
        context: &PassContext<'_>,
        bindings: impl Fn(&LargeIds) -> Vec<(u32, ResourceId)>,
        groups: impl Fn(&Draw<'_>) -> u32,
    ) -> Result<()> {
        for (draw, ids, pipeline) in &self.chunks {
            dispatch(context, self.inputs, draw, pipeline, &bindings(ids), [groups(draw), 1])?;
        }
        Ok(())
    }
}

/// Workgroups of one invocation a splat.
fn blocks_of(draw: &Draw<'_>) -> u32 {
    draw.chunk.count.div_ceil(BLOCK)
}
