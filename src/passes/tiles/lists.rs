//! What a frame has to list splats by tile: its buffers, and how passes read them.

use ash::vk;

use crate::passes::{
    pass::Pass,
    place::{arguments, tiles},
    plan::tiles::{RECORD_BYTES, TilePlan},
};
use crate::{
    graph::{Access, Buffer, BufferDesc, Graph, Handle, Start, execute::Body},
    shaders::config::*,
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
    pub records: [Handle<Buffer>; 4],
    /// What clip curves cut off each, where they do.
    pub clips: Option<Handle<Buffer>>,
    /// The tiles that each touches.
    pub rects: Handle<Buffer>,
    /// Of each segment, how many of its records fall into each bin.
    pub counts: Handle<Buffer>,
    /// Where the list of each bin starts.
    pub starts: Handle<Buffer>,
    /// The lists: indices of records.
    pub entries: Handle<Buffer>,
    /// The tiles that have splats.
    pub seen: Handle<Buffer>,
    /// Runs of such tiles along rows: the first, and how many.
    pub runs: Handle<Buffer>,
    /// Of dispatches and draws.
    pub arguments: Handle<Buffer>,
    /// The tiles with more splats than one dispatch takes.
    pub overflow: Handle<Buffer>,
}

impl<'a> Tiles<'a> {
    pub fn create(graph: &mut Graph<'a, Body<'a>>, kind: &str, plan: &'a TilePlan) -> Self {
        let mut create = |what: &str, size_bytes, texels| {
            graph.create_buffer(format_args!("{what} of {kind}tiles"), BufferDesc { size_bytes, texels })
        };
        const FLOATS: vk::Format = vk::Format::R32G32B32A32_SFLOAT;
        const WORDS: vk::Format = vk::Format::R32G32B32A32_UINT;
        let (tile_count, bins) = (u64::from(plan.tile_count), u64::from(plan.bin_count()));
        let formats = [FLOATS, FLOATS, FLOATS, WORDS];
        let records =
            std::array::from_fn(|i| create(RECORD_QUARTERS[i], plan.record_room * RECORD_BYTES, formats[i]));
        let clips = plan.clips.then(|| create("clips", plan.clip_bytes(), FLOATS));
        let mut words = |what: &str, count| create(what, count * 4, vk::Format::R32_UINT);
        let (entries, rects) = (words("entries", plan.entry_room), words("rects", plan.record_room));
        let mut buffer = |what: &str, size_bytes| create(what, size_bytes, vk::Format::UNDEFINED);
        Self {
            plan,
            records,
            clips,
            entries,
            rects,
            counts: buffer("counts", plan.count_bytes()),
            starts: buffer("starts", (bins + 4) * 4),
            seen: buffer("seen", tile_count * 4),
            runs: buffer("runs", tile_count * 8),
            arguments: buffer(
                "arguments",
                4 * u64::from(ARGUMENTS_CHUNKS) + 16 * u64::from(plan.chunk_count),
            ),
            overflow: buffer("overflow", tile_count * 4),
        }
    }

    /// Adds to a pass what it reads that walks over records: the tiles of each, and where some are cut, which ones, and in which tiles.
    pub fn read_for_walk<'g, 'b>(&self, pass: Pass<'g, 'b>) -> Pass<'g, 'b> {
        let mut pass = self.read_as_texels(pass, [BIND_RECTS, BIND_RECT_TEXELS], &self.rects);
        if self.plan.parted_by() != 0 {
            pass = self.read_as_texels(pass, [BIND_RECORDS, BIND_RECORD_TEXELS], &self.records[0]);
        }
        match &self.clips {
            Some(clips) => self.read_as_texels(pass, [BIND_CLIPS, BIND_CLIP_TEXELS], clips),
            None => pass,
        }
    }

    /// Adds to a pass what it reads that draws from the lists: it is dispatched by their arguments.
    pub fn read_lists<'g, 'b>(&self, pass: Pass<'g, 'b>) -> Pass<'g, 'b> {
        let pass = self.read_all_but_entries(pass);
        self.read_as_texels(pass, [BIND_ENTRIES, BIND_ENTRY_TEXELS], &self.entries)
    }

    /// The same of a pass that leaves entries out, which nobody reads after it.
    pub fn shorten_lists<'g, 'b>(&mut self, pass: Pass<'g, 'b>) -> Pass<'g, 'b> {
        let pass = self.read_all_but_entries(pass);
        pass.write(tiles(BIND_ENTRIES), &mut self.entries, Access::StorageUpdateCompute, Start::Load)
    }

    fn read_all_but_entries<'g, 'b>(&self, mut pass: Pass<'g, 'b>) -> Pass<'g, 'b> {
        for (number, quarter) in (0..).zip(&self.records) {
            pass = self.read_as_texels(
                pass,
                [BIND_RECORDS, BIND_RECORD_TEXELS].map(|first| first + number),
                quarter,
            );
        }
        if let Some(clips) = &self.clips {
            pass = self.read_as_texels(pass, [BIND_CLIPS, BIND_CLIP_TEXELS], clips);
        }
        pass.read(tiles(BIND_STARTS), &self.starts, Access::StorageReadCompute)
            .read(tiles(BIND_NON_EMPTY_TILES), &self.seen, Access::StorageReadCompute)
            .read(tiles(BIND_OVERFLOW_TILES), &self.overflow, Access::StorageReadCompute)
            .read(arguments(0), &self.arguments, Access::IndirectRead)
    }

    /// Adds what is read as words, or as texels where the plan has it so.
    pub fn read_as_texels<'g, 'b>(
        &self,
        pass: Pass<'g, 'b>,
        [as_words, as_texels]: [u32; 2],
        buffer: &Handle<Buffer>,
    ) -> Pass<'g, 'b> {
        match self.plan.invocations.fetch_texels() {
            true => pass.read(tiles(as_texels), buffer, Access::TexelReadCompute),
            false => pass.read(tiles(as_words), buffer, Access::StorageReadCompute),
        }
    }
}
