//! Splats drawn by tiles of the image, in compute: set up once, listed by tile, then seen and summed a tile at a time.
//!
//! What it leaves is what the graphics pipeline's passes leave: sums, and a depth. Splats that are too large for that, or not
//! regular, are listed too, by chunk, and drawn by the graphics pipeline into the same images.

pub(crate) mod bins;
pub(crate) mod depth;
pub(crate) mod large;
pub(crate) mod layer_work;
pub(crate) mod layers;
pub(crate) mod overfull;
pub(crate) mod pass;
pub(crate) mod quads;
pub(crate) mod record;
pub(crate) mod shaded;
pub(crate) mod splat;

use ash::vk;

use crate::passes::pipeline::tile_layouts::STORAGE_BUFFERS;
pub use crate::passes::plan::tiles::TilePlan;
use crate::passes::tiles::pass::TilePass;
pub(crate) use crate::passes::{
    plan::tiles::RECORD_BYTES,
    tiles::{
        bins::list,
        depth::depth_buffer,
        large::{see_large, sum_large},
        layers::layers,
        shaded::{Shown, shaded},
        splat::{TileImages, fused, see, sum},
    },
};

use crate::passes::{inputs::Inputs, pipeline::constants::TileConstants};
use crate::{
    graph::{Access, Buffer, BufferDesc, Graph, Handle, Image, Start, execute::Body},
    shaders::config::*,
    vk::PoolSizes,
};

/// What the buffers of records are called.
pub(crate) const RECORD_QUARTERS: [&str; 4] = [
    "first quarter of records",
    "second quarter of records",
    "third quarter of records",
    "fourth quarter of records",
];

/// What a frame has to list splats by tile.
pub(crate) struct Tiles<'a> {
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
        let mut create = |what: &str, size_bytes, texels| {
            graph.create_buffer(&format!("{what} of {kind}tiles"), BufferDesc { size_bytes, texels })
        };
        const FLOATS: vk::Format = vk::Format::R32G32B32A32_SFLOAT;
        const WORDS: vk::Format = vk::Format::R32G32B32A32_UINT;
        let (tiles, bins) = (u64::from(plan.tile_count), u64::from(plan.bin_count()));
        let formats = [FLOATS, FLOATS, FLOATS, WORDS];
        let records =
            std::array::from_fn(|i| create(RECORD_QUARTERS[i], plan.record_room * RECORD_BYTES, formats[i]));
        let mut words = |what: &str, count| create(what, count * 4, vk::Format::R32_UINT);
        let (entries, spans) = (words("entries", plan.entry_room), words("spans", plan.record_room));
        let mut buffer = |what: &str, size_bytes| create(what, size_bytes, vk::Format::UNDEFINED);
        Self {
            plan,
            records,
            entries,
            spans,
            counts: buffer("counts", u64::from(plan.segments) * bins * 4),
            starts: buffer("starts", (bins + 3) * 4),
            seen: buffer("seen", tiles * 4),
            runs: buffer("runs", tiles * 8),
            arguments: buffer(
                "arguments",
                4 * u64::from(ARGUMENTS_CHUNKS) + 16 * u64::from(plan.chunk_count),
            ),
            overfull: buffer("overfull", tiles * 4),
        }
    }

    /// Adds to a pass what it reads that draws from the lists: it is dispatched by their arguments.
    fn read_lists<'g, 'b>(&self, pass: TilePass<'g, 'b>) -> TilePass<'g, 'b> {
        let pass = self.read_all_but_entries(pass);
        self.read_as_texels(pass, [BIND_ENTRIES, BIND_ENTRY_TEXELS], &self.entries)
    }

    /// The same of a pass that leaves entries out, which nobody reads after it.
    fn shorten_lists<'g, 'b>(&mut self, pass: TilePass<'g, 'b>) -> TilePass<'g, 'b> {
        let pass = self.read_all_but_entries(pass);
        pass.write(BIND_ENTRIES, &mut self.entries, Access::StorageUpdateCompute, Start::Load)
    }

    fn read_all_but_entries<'g, 'b>(&self, mut pass: TilePass<'g, 'b>) -> TilePass<'g, 'b> {
        for (number, quarter) in (0..).zip(&self.records) {
            pass = self.read_as_texels(
                pass,
                [BIND_RECORDS, BIND_RECORD_TEXELS].map(|first| first + number),
                quarter,
            );
        }
        pass.read(BIND_STARTS, &self.starts, Access::StorageReadCompute)
            .read(BIND_NON_EMPTY_TILES, &self.seen, Access::StorageReadCompute)
            .read(BIND_OVERFLOW_TILES, &self.overfull, Access::StorageReadCompute)
            .declare(|pass| pass.read(&self.arguments, Access::IndirectRead))
    }

    /// Adds what is read as words, or as texels where the plan has it so.
    fn read_as_texels<'g, 'b>(
        &self,
        pass: TilePass<'g, 'b>,
        [as_words, as_texels]: [u32; 2],
        buffer: &Handle<Buffer>,
    ) -> TilePass<'g, 'b> {
        match self.plan.invocations.fetch_texels() {
            true => pass.read(as_texels, buffer, Access::TexelReadCompute),
            false => pass.read(as_words, buffer, Access::StorageReadCompute),
        }
    }
}

/// The constant of how spans are cut.
pub(crate) fn place_bits(plan: &TilePlan) -> (u32, u32) {
    (SPEC_PLACE_BITS, plan.place_bits)
}

/// Sets and descriptors that drawing by tiles takes from the frame's pool, at most.
pub(crate) fn room(plan: &TilePlan) -> PoolSizes {
    let sets = plan.chunk_count * 3 + 12;
    PoolSizes {
        sets,
        buffers: STORAGE_BUFFERS * sets,
        uniform_buffers: sets,
        texel_buffers: 6 * sets,
        images: 6 * sets,
        storage_images: 6 * sets,
        ..PoolSizes::default()
    }
}

fn constants(inputs: Inputs<'_>, plan: &TilePlan) -> TileConstants {
    let [width, height] = inputs.settings.size_px;
    TileConstants {
        half_size_px: [0.5 * width as f32, 0.5 * height as f32],
        tiles_x: plan.tiles_x,
        first_tile: plan.first_tile(),
        tile_count: plan.tile_count,
        bin_count: plan.bin_count(),
        record_count: plan.record_count,
        segments: plan.segments,
        segment_length: plan.segment_length,
        round_first: 0,
        round_length: plan.round_length,
        part: WHOLE_TILES,
        focal_px: inputs.camera.focal_px(height) as f32,
        surfaces: 0,
        blends_rest: 0,
        step: 0,
        ends: 0,
    }
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
