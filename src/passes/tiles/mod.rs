//! Splats drawn by tiles of the image, in compute: set up once, listed by tile, then seen and summed a tile at a time.
//!
//! What it leaves is what the graphics pipeline's passes leave: sums, and a depth. Splats that are too large for that, or not
//! regular, are listed too, by chunk, and drawn by the graphics pipeline into the same images.

mod bins;
mod depth;
mod large;
mod layers;
mod overfull;
mod plan;
mod quads;
mod recipes;
mod record;
mod splat;

use std::sync::Arc;

use ash::vk;

pub(super) use self::{
    bins::list,
    depth::depth_buffer,
    large::{see_large, sum_large},
    layers::layers,
    quads::{SeenTiles, draw_quads_of_tiles, quads_of_tiles},
    recipes::{TileTraits, depth_recipe, layers_recipe, list_recipes, opaque_recipes},
    splat::{TileImages, accumulate, fused, visibility},
};
pub use plan::TilePlan;

use super::{
    Inputs,
    constants::TileConstants,
    pipelines::{ComputeKey, Layout},
    variant::Constants,
};
use crate::{
    error::Result,
    graph::{
        Access, Buffer, BufferDesc, Graph, Handle, Image, PassBuilder, ResourceId, Start,
        execute::{Body, PassContext},
    },
    shaders::Shader,
    vk::{ComputePipeline, Descriptor, PoolRoom},
};

// The bindings of the set of tiles.
const RECORDS: u32 = 0; // and the three after it
const SPANS: u32 = 4;
const COUNTS: u32 = 5;
const STARTS: u32 = 6;
const ENTRIES: u32 = 7;
const SEEN: u32 = 8;
const ARGUMENTS: u32 = 9;
const OVERFULL: u32 = 10;
const COLOR_SUMS: u32 = 11;
const NORMAL_SUMS: u32 = 12;
const VISIBLE_DEPTH: u32 = 13;
const DEPTH_BEFORE: u32 = 14;
const POLYGON_DEPTH: u32 = 15;
const LIGHTS: u32 = 16;
const PEELED_WEIGHT: u32 = 17;
const PEELED_STATE: u32 = 18;
pub(super) const RUNS: u32 = 19;
const KEPT_STARTS: u32 = 20;
pub(super) const KEPT_LIST: u32 = 21;

// Where the arguments are, in bytes; `glsl/inc/tiles.glsl` has the same in words.
const SEEN_ARGUMENTS: u64 = 0;
const OVERFULL_ARGUMENTS: u64 = 16;
const QUAD_ARGUMENTS: u64 = 32;
const CHUNK_ARGUMENTS: u64 = 48;

/// Storage buffers in the layout of the pass that makes records.
pub const STORAGE_BUFFERS: u32 = 18;

/// The part that is all of a tile, as in `glsl/tile_splat.comp.glsl`.
const WHOLE: u32 = u32::MAX;

/// What a frame has to list splats by tile.
pub(super) struct Tiles<'a> {
    pub plan: &'a TilePlan,
    /// Splats ready to be drawn: 16 bytes of each in each.
    records: [Handle<Buffer>; 4],
    /// The tiles that each touches.
    spans: Handle<Buffer>,
    /// Of each segment, how many of its records fall into each bin.
    counts: Handle<Buffer>,
    /// Where the list of each bin starts.
    starts: Handle<Buffer>,
    /// The lists: indices of records.
    entries: Handle<Buffer>,
    /// The tiles that have splats.
    seen: Handle<Buffer>,
    /// Runs of such tiles along rows: the first, and how many.
    runs: Handle<Buffer>,
    /// Of dispatches and draws.
    arguments: Handle<Buffer>,
    /// The tiles with more splats than one dispatch takes.
    overfull: Handle<Buffer>,
}

impl<'a> Tiles<'a> {
    fn create(graph: &mut Graph<Body<'a>>, kind: &str, plan: &'a TilePlan) -> Self {
        let mut buffer = |what: &str, size_bytes| {
            graph.create_buffer(&format!("{what} of {kind}tiles"), BufferDesc { size_bytes })
        };
        let records = u64::from(plan.record_count);
        let (tiles, bins) = (u64::from(plan.tile_count), u64::from(plan.bin_count()));
        Self {
            plan,
            records: ["first", "second", "third", "fourth"].map(|quarter| {
                buffer(&format!("{quarter} quarter of records"), records * plan::RECORD_BYTES)
            }),
            spans: buffer("spans", records * 4),
            counts: buffer("counts", u64::from(plan.segments) * bins * 4),
            starts: buffer("starts", (bins + 3) * 4),
            entries: buffer("entries", plan.entry_room * 4),
            seen: buffer("seen", tiles * 4),
            runs: buffer("runs", tiles * 8),
            arguments: buffer("arguments", CHUNK_ARGUMENTS + 16 * u64::from(plan.chunk_count)),
            overfull: buffer("overfull", tiles * 4),
        }
    }

    fn records(&self) -> [(u32, ResourceId); 4] {
        std::array::from_fn(|i| (RECORDS + i as u32, self.records[i].id()))
    }

    /// What the passes read that draw from the lists.
    fn lists(&self) -> Vec<(u32, ResourceId)> {
        let mut all = self.records().to_vec();
        all.extend([(STARTS, self.starts.id()), (ENTRIES, self.entries.id()), (SEEN, self.seen.id())]);
        all.push((OVERFULL, self.overfull.id()));
        all
    }

    /// Declares that a pass reads [`Self::lists`] and is dispatched by their arguments.
    fn read_lists<'g, B>(&self, mut pass: PassBuilder<'g, B>) -> PassBuilder<'g, B> {
        for buffer in self.records.iter().chain([&self.starts, &self.entries, &self.seen, &self.overfull]) {
            pass = pass.read(buffer, Access::StorageReadCompute);
        }
        pass.read(&self.arguments, Access::IndirectRead)
    }
}

/// Sets and descriptors that drawing by tiles takes from the frame's pool, at most.
pub(super) fn room(plan: &TilePlan) -> PoolRoom {
    let sets = plan.chunk_count * 3 + 12;
    PoolRoom { sets, buffers: 11 * sets, images: 4 * sets, storage_images: 3 * sets, ..PoolRoom::default() }
}

fn constants(inputs: Inputs<'_>, plan: &TilePlan) -> TileConstants {
    let [width, height] = inputs.settings.size_px;
    TileConstants {
        half_size_px: [0.5 * width as f32, 0.5 * height as f32],
        tiles_x: plan.tiles_x,
        tile_count: plan.tile_count,
        bin_count: plan.bin_count(),
        record_count: plan.record_count,
        segments: plan.segments,
        segment_length: plan.segment_length,
        round_first: 0,
        round_length: plan.round_length,
        part: WHOLE,
        focal_px: inputs.camera.focal_px(height) as f32,
        surfaces: 0,
        blends_rest: 0,
        step: 0,
        ends: 0,
    }
}

/// One compute pass over tiles.
struct TilePass<'a> {
    inputs: Inputs<'a>,
    pipeline: Arc<ComputePipeline>,
    constants: TileConstants,
    buffers: Vec<(u32, ResourceId)>,
    storage_images: Vec<(u32, ResourceId)>,
    sampled_images: Vec<(u32, ResourceId)>,
}

impl<'a> TilePass<'a> {
    fn new(
        inputs: Inputs<'a>,
        plan: &TilePlan,
        (shader, constants_of_shader): (&'static Shader, Constants),
        buffers: Vec<(u32, ResourceId)>,
    ) -> Result<Self> {
        let key = ComputeKey { shader, layout: Layout::Tile, constants: constants_of_shader };
        Ok(Self {
            inputs,
            pipeline: inputs.shaders.compute(key)?,
            constants: constants(inputs, plan),
            buffers,
            storage_images: Vec::new(),
            sampled_images: Vec::new(),
        })
    }

    fn bind(&self, context: &PassContext<'_>) -> Result<()> {
        let mut given = Vec::new();
        for (number, id) in &self.buffers {
            given.push((*number, Descriptor::Buffer(context.buffer(*id)?)));
        }
        for (number, id) in &self.storage_images {
            given.push((*number, Descriptor::Storage(context.image(*id)?.1)));
        }
        for (number, id) in &self.sampled_images {
            given.push((*number, Descriptor::Sampled(context.image(*id)?.1, context.layout(*id))));
        }
        let set = self.inputs.descriptors.set(&self.inputs.shaders.tiles()?.set, &given)?;
        let layout = self.inputs.shaders.tiles()?.tile.raw();
        let bind_point = vk::PipelineBindPoint::COMPUTE;
        let (device, commands) = (context.device(), context.commands());
        // SAFETY: pipeline and set have one layout; the graph's barriers order what is read and written.
        unsafe {
            device.cmd_bind_pipeline(commands, bind_point, self.pipeline.raw());
            device.cmd_bind_descriptor_sets(commands, bind_point, layout, 0, &[set], &[]);
        }
        self.push(context, &self.constants)
    }

    fn push(&self, context: &PassContext<'_>, constants: &TileConstants) -> Result<()> {
        let layout = &self.inputs.shaders.tiles()?.tile;
        let bytes = bytemuck::bytes_of(constants);
        // SAFETY: the layout's constants are these.
        unsafe {
            let commands = context.commands();
            context.device().cmd_push_constants(commands, layout.raw(), layout.push_stages(), 0, bytes);
        }
        Ok(())
    }

    /// Records one dispatch of so many workgroups.
    fn dispatch(&self, context: &PassContext<'_>, groups: u32) -> Result<()> {
        self.bind(context)?;
        let [x, y] = rows_of(groups);
        // SAFETY: all is bound that the pipeline needs.
        unsafe { context.device().cmd_dispatch(context.commands(), x, y, 1) };
        Ok(())
    }

    /// Records a dispatch of as many as a buffer says.
    fn dispatch_indirect(&self, context: &PassContext<'_>, arguments: ResourceId, offset: u64) -> Result<()> {
        self.bind(context)?;
        let arguments = context.buffer(arguments)?;
        // SAFETY: as in `dispatch`; the arguments were declared to be read, and are within the buffer.
        unsafe { context.device().cmd_dispatch_indirect(context.commands(), arguments, offset) };
        Ok(())
    }
}

/// Workgroups along a row, and rows: a device need not take more than 65535 in one dimension. As in `glsl/inc/tiles.glsl`.
pub(super) fn rows_of(groups: u32) -> [u32; 2] {
    const MOST_GROUPS_IN_ROW: u32 = 32_768;
    let rows = groups.div_ceil(MOST_GROUPS_IN_ROW);
    [groups.div_ceil(rows.max(1)), rows]
}

/// Declares a pass that sets images to 0.
fn clear(graph: &mut Graph<Body<'_>>, name: &str, images: &mut [&mut Handle<Image>]) {
    let ids: Vec<_> = images.iter().map(|image| image.id()).collect();
    let mut pass = graph.pass(name);
    for image in images {
        pass = pass.write(image, Access::TransferWrite, Start::Discard);
    }
    pass.finish(Box::new(move |context| {
        let range = vk::ImageSubresourceRange::default()
            .aspect_mask(vk::ImageAspectFlags::COLOR)
            .level_count(1)
            .layer_count(1);
        let zero = vk::ClearColorValue { float32: [0.0; 4] };
        for id in ids {
            let (image, layout) = (context.image(id)?.0, context.layout(id));
            // SAFETY: outside of rendering; the image is in the layout that the pass declares.
            unsafe {
                context.device().cmd_clear_color_image(context.commands(), image, layout, &zero, &[range]);
            }
        }
        Ok(())
    }));
}

/// Orders a dispatch behind those before it in the same pass, which work on the same memory.
fn after_dispatches_before(context: &PassContext<'_>) {
    let storage = vk::AccessFlags2::SHADER_STORAGE_READ | vk::AccessFlags2::SHADER_STORAGE_WRITE;
    let compute = vk::PipelineStageFlags2::COMPUTE_SHADER;
    let barriers = [vk::MemoryBarrier2::default()
        .src_stage_mask(compute)
        .src_access_mask(vk::AccessFlags2::SHADER_STORAGE_WRITE)
        .dst_stage_mask(compute)
        .dst_access_mask(storage)];
    let info = vk::DependencyInfo::default().memory_barriers(&barriers);
    // SAFETY: outside of rendering, in a compute pass.
    unsafe { context.device().cmd_pipeline_barrier2(context.commands(), &info) };
}

#[cfg(test)]
mod tests {
    use super::rows_of;

    #[test]
    fn rows_hold_all_workgroups_and_few_more() {
        for groups in [0, 1, 32_768, 32_769, 43_690, 65_536, 4_194_304, 1 << 30] {
            let [x, y] = rows_of(groups);
            assert!(x <= 32_768 && y <= 65_535, "{groups}: {x} {y}");
            assert!((groups..groups + y.max(1)).contains(&(x * y)), "{groups}: {x} {y}");
        }
    }
}
