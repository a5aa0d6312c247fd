//! Picking: what is seen in one pixel, and where it is. An image of that pixel alone, whose splats are looked for as those of frames
//! are, in the blocks that may touch it; a frame has no part in it, and pays nothing for it. An invocation finds which is nearest of a word of splats, or of a run
//! of triangles, by the equations of all others; the host takes the nearest of them, and finds its place along the pixel's ray in `f64` (`plan`).

mod plan;
mod ray;

use bytemuck::{Pod, Zeroable};

use plan::PickedChunk;
pub use plan::{PickPlan, Picked, PickedPart};
pub use ray::PickRay;

use crate::passes::{
    cull::{
        dispatch::dispatch,
        visible::{groups_of, list_key},
    },
    pass::{self, Pass, Source},
    pipeline::cache::room_of_lists,
    place::{Place, Planes, lists, transfer},
    plan::{mesh_draws::MeshDraw, needs::Needs},
    recording::rows_of,
    resolve::readback::readback_buffer,
};
use crate::{
    error::Result,
    graph::{Access, Buffer, BufferDesc, Graph, Handle, Start, execute::Body},
    shaders::{self, config::*},
};

/// The nearest thing of a word of splats, or of a run of triangles; `glsl/inc/picked.glsl`.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
struct Nearest {
    moved: f32,
    depth: f32,
    index: u32,
    unused: u32,
    normal: [f32; 4],
}

/// Of nothing; see the shader.
const NOTHING_MOVED: f32 = -1e38;

/// Triangles of an invocation.
const RUN: u32 = 32;

/// Descriptor sets of a pick.
pub(crate) fn needs() -> Needs {
    Needs { room: room_of_lists(2), ..Needs::default() }
}

/// Declares the passes; `to` is filled with [`PickPlan::size_bytes`].
pub(crate) fn pick<'a>(
    graph: &mut Graph<'a, Body<'a>>,
    (place, planes): (pass::Place<'a>, Planes),
    plan: &'a PickPlan<'a>,
    to: &mut Handle<Buffer>,
) -> Result<()> {
    const WHY: &str = "a pixel is picked";
    let source = Source::new(place, &plan.ray.camera).cut_by(planes);
    let bytes: &[u8] = bytemuck::cast_slice(&plan.listed);
    let mut blocks = graph.create_buffer("picked blocks", BufferDesc::of_bytes(bytes.len() as u64));
    Pass::new(graph, source, "picked blocks", WHY)
        .write(transfer(0), &mut blocks, Access::TransferWrite, Start::Discard)
        .finish(move |pass| pass.update_buffer(transfer(0), bytes));
    let mut picked = graph.create_buffer("picked", BufferDesc::of_bytes(plan.size_bytes()));
    if !plan.draws.is_empty() {
        let pass = Pass::new(graph, source, "pick splats", WHY)
            .read(lists(BIND_LIST_BLOCKS), &blocks, Access::StorageReadCompute)
            .write(lists(BIND_LIST_ITEMS), &mut picked, Access::StorageWriteCompute, Start::Discard);
        let of = |draw: &PickedChunk<'_>| pass.compute(list_key(&shaders::PICK_COMP, draw.variant));
        let pipelines = pass.arena().try_list(plan.draws.iter().map(of))?;
        pass.finish(move |pass| {
            let set = pass.set(Place::Lists(0))?;
            plan.draws.iter().zip(pipelines.iter().copied()).try_for_each(|(draw, pipeline)| {
                let groups = groups_of(draw.constants.listed_blocks());
                dispatch(pass, draw.chunk, &draw.constants, pipeline, set, groups)
            })
        });
    }
    if !plan.meshes.is_empty() {
        let start = if plan.draws.is_empty() { Start::Discard } else { Start::Load };
        let pass = Pass::new(graph, source, "pick polygons", WHY).write(
            lists(BIND_LIST_ITEMS),
            &mut picked,
            Access::StorageWriteCompute,
            start,
        );
        let pipeline = |draw: &MeshDraw<'_>| {
            let layered = (SPEC_IN_LAYERS, u32::from(draw.chunk.transparent));
            let constants = [(SPEC_CULL_BACKFACES, u32::from(draw.cull)), layered];
            pass.compute(list_key(&shaders::PICK_POLYGONS_COMP, constants.into()))
        };
        let pipelines = pass.arena().try_list(plan.meshes.iter().map(pipeline))?;
        pass.finish(move |pass| {
            let set = pass.set(Place::Lists(0))?;
            for (draw, pipeline) in plan.meshes.iter().zip(pipelines.iter().copied()) {
                pass.bind(pipeline);
                pass.bind_sets(pipeline.layout, 0, &[draw.chunk.set(), set])?;
                pass.push(pipeline.layout, &draw.constants)?;
                pass.dispatch(rows_of(plan::runs_of(draw).div_ceil(LIST_GROUP_SIZE)));
            }
            Ok(())
        });
    }
    readback_buffer(graph, source, "read back picked", &picked, to, plan.size_bytes());
    Ok(())
}
