//! Points set up once, for all passes that draw them: a record each, which their vertex stages read.

use super::{
    Draw, Inputs,
    cull::Kept,
    list_large::LargeList,
    pipelines::{ComputeKey, LARGE_BINDINGS, Layout},
    splat_pass::{Groups, dispatch},
    tiles::rows_of,
    variant::Constants,
};
use crate::{
    error::Result,
    graph::{Access, Buffer, BufferDesc, Graph, Handle, PassBuilder, ResourceId, Start, execute::Body},
    shaders,
};

/// Invocations of a workgroup, as in `glsl/point_record.comp.glsl`.
const GROUP: u32 = 64;

/// The first binding of the buffers, as in `glsl/inc/point_record.glsl`.
const FIRST_BINDING: u32 = LARGE_BINDINGS;

/// Bytes of a record in each of its buffers: no more than any splat has, so that what holds a chunk's shapes holds these.
const BYTES: u64 = 16;

/// The records of a chunk, each at its splat's place.
pub(super) struct Records([Handle<Buffer>; 4]);

/// The same for passes that are recorded.
#[derive(Clone, Copy)]
pub(super) struct RecordIds([ResourceId; 4]);

impl Records {
    /// Declares that a pass draws from them.
    pub fn read_by_points<'g, B>(&self, pass: PassBuilder<'g, B>) -> PassBuilder<'g, B> {
        self.0.iter().fold(pass, |pass, buffer| pass.read(buffer, Access::StorageReadVertex))
    }

    pub fn ids(&self) -> RecordIds {
        RecordIds(self.0.each_ref().map(Handle::id))
    }
}

impl RecordIds {
    /// Each with its binding.
    pub fn bound(self) -> impl Iterator<Item = (u32, ResourceId)> {
        (FIRST_BINDING..).zip(self.0)
    }
}

/// What the pipeline is for splats of a variant. `small`: the large ones are left out; `kept`: of a list.
pub(super) fn key(variant: &Constants, small: bool, kept: bool) -> ComputeKey {
    let shader = match (small, kept) {
        (false, false) => &shaders::POINT_RECORD_COMP,
        (false, true) => &shaders::POINT_RECORD_KEPT_COMP,
        (true, false) => &shaders::POINT_RECORD_SMALL_COMP,
        (true, true) => &shaders::POINT_RECORD_SMALL_KEPT_COMP,
    };
    ComputeKey { shader, layout: Layout::List, constants: variant.clone() }
}

/// Declares the pass, over the kept splats where they are listed.
pub(super) fn set_up_points<'a>(
    graph: &mut Graph<Body<'a>>,
    inputs: Inputs<'a>,
    kind: &str,
    large: &[Option<LargeList>],
    kept: Option<&Kept>,
) -> Result<Vec<Records>> {
    let mut records = Vec::new();
    let mut chunks = Vec::new();
    for ((number, draw), large) in inputs.draws.iter().enumerate().zip(large) {
        let mut buffer = |part: u32| {
            let name = format!("records {part} of {kind}points in chunk {number}");
            graph.create_buffer(&name, BufferDesc::of_bytes(BYTES * u64::from(draw.chunk.count)))
        };
        let of_chunk = Records([buffer(0), buffer(1), buffer(2), buffer(3)]);
        let mut buffers: Vec<_> = of_chunk.ids().bound().collect();
        buffers.extend(large.iter().map(|large| (0, large.ids().bits)));
        buffers.extend(kept.iter().flat_map(|kept| [(1, kept.starts().id()), (2, kept.list().id())]));
        let pipeline = inputs.shaders.compute(key(&draw.variant, large.is_some(), kept.is_some()))?;
        chunks.push((draw, pipeline, buffers));
        records.push(of_chunk);
    }
    let mut pass = graph.pass(&format!("set up {kind}points"));
    for buffer in records.iter_mut().flat_map(|records| &mut records.0) {
        pass = pass.write(buffer, Access::StorageWriteCompute, Start::Discard);
    }
    for large in large.iter().flatten() {
        pass = large.read_by_compute(pass);
    }
    if let Some(kept) = kept {
        pass = kept.read_by_compute(pass);
    }
    let kept = kept.map(Kept::ids);
    pass.finish(Box::new(move |context| {
        for (number, (draw, pipeline, buffers)) in chunks.iter().enumerate() {
            let groups = match &kept {
                Some(kept) => Groups::Kept(kept, number),
                None => groups_of(draw),
            };
            dispatch(context, inputs, draw, pipeline, buffers, groups)?;
        }
        Ok(())
    }));
    Ok(records)
}

fn groups_of(draw: &Draw<'_>) -> Groups<'static> {
    Groups::Rows(rows_of(draw.chunk.count.div_ceil(GROUP)))
}
