//! A piece of an object within the device's limits.

mod upload;

use ash::vk;
use glam::DVec3;

use super::{
    block_bounds::BOUNDS_BYTES,
    block_tree::{BlockTree, CHILDREN},
    blocks::{Block, BlockMaker},
    clip_vectors::ClipVectors,
    facing::Facing,
    level_words::LevelWords,
    levels::{ChunkLevels, LevelPart},
    memory::{ChunkMemory, Uploader},
    pack::{Packed, Survey, shape_bytes},
    radii::RadiusStep,
    rebase::Rebase,
    updatable::Shadow,
};
use crate::{error::Result, scene::Epsilon, shaders::config::BLOCK_SPLATS};

/// The most splats of a chunk, whatever the device allows: bounds the lists that hold an index for each.
const MAX_SPLATS: usize = 1 << 22;

/// How many splats fit into buffers of this many bytes: the larger shape decides, so that it is the same for all.
pub(super) fn capacity(max_storage_buffer_range: u64) -> usize {
    let fit = max_storage_buffer_range / shape_bytes(true, false) as u64;
    usize::try_from(fit).unwrap_or(usize::MAX).clamp(1, MAX_SPLATS)
}

/// How many of that fit where they are fine.
pub(super) fn part_of(capacity: usize, fine: bool) -> usize {
    if fine { (capacity * shape_bytes(true, false) / shape_bytes(true, true)).max(1) } else { capacity }
}

/// What is known of an object.
#[derive(Clone, Copy)]
pub(super) struct Traits {
    pub closed: bool,
    pub transparent: bool,
    /// Its splats never change.
    pub is_fixed: bool,
}

/// Splats of one object in buffers of their own.
pub struct Chunk {
    /// The number of its object in [`super::PreparedScene::objects`].
    pub object: usize,
    /// The numbers of its splats in the object, where they are kept.
    pub(super) numbers: Option<Vec<u32>>,
    /// Its local space.
    pub rebase: Rebase,
    /// How many splats; of a sparse one so many places, in some of which there is none.
    pub count: u32,
    /// Splats may be taken out of it, and put into places that have none.
    pub sparse: bool,
    /// Whether they carry tangent vectors.
    pub ellipses: bool,
    /// Whether they belong to a closed, outward-oriented surface.
    pub closed: bool,
    /// Some of the object is transparent.
    pub transparent: bool,
    /// Coordinates have two parts: 16 bytes more.
    pub fine: bool,
    /// One color for all.
    pub uniform_color: bool,
    /// Clip curves cut something off its splats.
    pub clipped: bool,
    /// The ε that the object has of its own.
    pub epsilon: Option<Epsilon>,
    /// Some of its splats have less ε than others: where another surface is near.
    pub own_epsilon: bool,
    /// It is of an object that clip curves cut, some of it or all.
    pub is_sharp: bool,
    /// Some splats of its object lie at a border, and reach further than their rims.
    pub has_borders: bool,
    /// Disks in 16 bytes, colors in 4: [`SplatFormat::Packed`](crate::scene::SplatFormat::Packed).
    pub packed: bool,
    /// Its levels of detail, if it has any.
    pub levels: Option<ChunkLevels>,
    /// One over the overlap of all its splats; 1 where each has its own.
    pub inverse_overlap: f64,
    /// The box of the centers, local space.
    pub bounds: [DVec3; 2],
    /// The largest major radius, local space.
    pub largest_radius: f64,
    /// How many have which, roughly; local space.
    pub radii: Vec<RadiusStep>,
    /// The bytes of its splats in a scene ([`crate::scene::Splats::bytes`]).
    pub scene_bytes: u64,
    /// A host writes its splats.
    pub(super) dynamic: bool,
    /// Its splats in runs of [`BLOCK_SPLATS`](crate::shaders::config::BLOCK_SPLATS).
    pub blocks: Vec<Block>,
    /// What the host keeps of it, where its splats may change.
    pub(super) shadow: Option<Shadow>,
    /// Runs of those.
    pub tree: BlockTree,
    /// Where its splats may face, if it is closed, never changes, has no levels of detail and more than one quad of them; then the device has bounds of its blocks (`block_bounds.rs`), too.
    pub facing: Option<Facing>,
    /// Bytes of a shape and of a color.
    pub(super) bytes_each: [u64; 2],
    /// Of bounds behind its colors.
    bounds_bytes: u64,
    /// Shapes and colors, but where a frame is only listed.
    pub(super) memory: Option<ChunkMemory>,
}

impl Chunk {
    /// Room for the splats of a survey, with nothing in it yet; no memory without an uploader.
    pub(super) fn new(
        uploader: Option<&Uploader<'_>>,
        number: usize,
        Traits { closed, transparent, is_fixed }: Traits,
        (survey, levels): (&Survey, Option<(ChunkLevels, &LevelWords)>),
    ) -> Result<Self> {
        let colors = if survey.uniform_color { 1 } else { survey.count };
        let bytes_each = [survey.shape_bytes() as u64, survey.color_bytes() as u64];
        let blocks = survey.count.div_ceil(BLOCK_SPLATS) as usize;
        let is_bounded = closed && is_fixed && levels.is_none() && blocks > CHILDREN;
        let bounds_bytes = if is_bounded { (blocks * BOUNDS_BYTES) as u64 } else { 0 };
        let memory = |uploader: &Uploader<'_>| {
            let buffer = |what: &str, count: usize, bytes_each: u64| {
                // Shaders read 8 bytes of colors at once.
                let size = (count as u64 * bytes_each).next_multiple_of(8);
                let size = if what == "colors" { size + bounds_bytes } else { size };
                let name = format!("{what} of chunk {number}");
                uploader.buffer(&name, size, vk::BufferUsageFlags::STORAGE_BUFFER)
            };
            let mut buffers = vec![
                buffer("shapes", survey.count as usize, bytes_each[0])?,
                buffer("colors", colors as usize, bytes_each[1])?,
            ];
            if let Some((_, LevelWords { words, .. })) = levels {
                buffers.push(buffer("levels", words.len(), size_of::<u32>() as u64)?);
            }
            // Behind levels, or in their place.
            if survey.clipped {
                buffers.push(buffer("clips", survey.count as usize, size_of::<ClipVectors>() as u64)?);
            }
            let named = buffers.len();
            ChunkMemory::new(uploader, &format!("chunk {number}"), buffers, named)
        };
        Ok(Self {
            object: 0,
            numbers: None,
            rebase: survey.rebase,
            count: survey.count,
            sparse: false,
            ellipses: survey.ellipses,
            closed,
            transparent,
            fine: survey.fine,
            uniform_color: survey.uniform_color,
            clipped: survey.clipped,
            epsilon: None,
            own_epsilon: false,
            is_sharp: false,
            has_borders: false,
            packed: survey.packed,
            levels: levels.map(|(levels, _)| levels),
            inverse_overlap: 1.0,
            bounds: survey.bounds,
            largest_radius: survey.largest_radius,
            radii: survey.radii.clone(),
            scene_bytes: 0,
            dynamic: false,
            blocks: Vec::new(),
            shadow: None,
            tree: BlockTree::default(),
            facing: None,
            bytes_each,
            bounds_bytes,
            memory: uploader.map(memory).transpose()?.flatten(),
        })
    }

    /// Whether a host writes its splats: then all of its blocks have the bounds of all of them.
    pub(crate) fn is_dynamic(&self) -> bool {
        self.dynamic
    }

    /// Puts its splats on the device, if there is one, batch by batch, and finds its blocks. `progress` is told how many are done.
    pub(super) fn fill(
        &mut self,
        mut uploader: Option<&mut Uploader<'_>>,
        batches: impl Iterator<Item = Packed>,
        survey: &Survey,
        progress: &mut dyn FnMut(u64),
    ) -> Result<()> {
        let mut blocks = match self.bounds_bytes {
            0 => BlockMaker::default(),
            _ => BlockMaker::with_normals(),
        };
        let mut first = 0;
        for packed in batches.filter(|packed| packed.count > 0) {
            blocks.add(&packed, survey);
            if let Some(uploader) = &mut uploader {
                self.upload(uploader, first, &packed)?;
            }
            first += packed.count;
            progress(first.into());
        }
        let (blocks, normals) = blocks.finish();
        self.tree = BlockTree::new(&blocks);
        self.facing = normals.map(|normals| Facing::new(&normals, survey.largest_radius));
        self.blocks = blocks;
        if let (Some(uploader), true) = (uploader, self.bounds_bytes > 0) {
            self.upload_bounds(uploader)?;
        }
        Ok(())
    }

    /// How many splats are in it.
    pub(super) fn present(&self) -> u32 {
        match self.tree.levels.last() {
            Some(top) if self.sparse => top.iter().flat_map(|quad| quad.counts).sum(),
            _ => self.count,
        }
    }

    /// The number in its object of a splat of this chunk, where it is kept ([`crate::scene::Scene::numbered`]).
    pub fn number_of(&self, splat: usize) -> Option<u32> {
        self.numbers.as_ref()?.get(splat).copied()
    }

    /// How many splats its buffers have room for.
    pub(super) fn room(&self) -> u32 {
        let bytes = self.memory.as_ref().map_or(0, |memory| memory.buffers[0].size());
        u32::try_from(bytes / self.bytes_each[0]).unwrap_or(u32::MAX)
    }

    /// The buffers of shapes and colors of disks that have no other, as those have that a host writes.
    pub(super) fn written_by_host(&self) -> Option<[vk::Buffer; 2]> {
        match self.memory.as_ref()?.buffers.as_slice() {
            [shapes, colors] if self.dynamic => Some([shapes.raw(), colors.raw()]),
            _ => None,
        }
    }

    /// Whether its splats are nodes, which stand for the object's own.
    pub fn is_of_nodes(&self) -> bool {
        self.levels.is_some_and(|levels| levels.part == LevelPart::Nodes)
    }

    /// Whether its splats stand for others, or for polygons, and are drawn in their place.
    pub fn stands_for_others(&self) -> bool {
        self.levels.is_some_and(|levels| levels.part.stands_for_others())
    }

    /// The descriptor set; null without memory.
    pub fn set(&self) -> vk::DescriptorSet {
        self.memory.as_ref().map_or(vk::DescriptorSet::null(), |memory| memory.set)
    }

    /// Bytes of its splats on the device, without bounds of blocks.
    pub(crate) fn splat_bytes(&self) -> u64 {
        self.bytes().saturating_sub(self.bounds_bytes)
    }

    /// Bytes of device memory.
    pub fn bytes(&self) -> u64 {
        self.memory.as_ref().map_or(0, ChunkMemory::bytes)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_chunk_never_exceeds_the_range_by_a_byte_nor_our_own_cap() {
        for range in [48, 95, 96, 1 << 27, (1 << 27) + 8, u64::from(u32::MAX), u64::MAX] {
            let capacity = capacity(range) as u64;
            assert!(capacity * 48 <= range && capacity <= 1 << 22, "{range}");
        }
        assert_eq!(capacity(1 << 27), 2_796_202);
    }
}
