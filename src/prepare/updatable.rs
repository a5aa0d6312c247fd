//! Splats that may change after they are on the device: what the host keeps of a chunk for that, and what a change does to it.
//!
//! Of each splat the host keeps what the device has, 40 bytes (48 to 72 of ellipses and fine ones), and 8 of where it lies. So bounds are always those of what is there:
//! of a block that a change touches they are found anew from its 256 splats, and those of the chunk from its blocks'. What a change is found with lies in memory that the scene keeps.
//!
//! Each number of an object has its place for as long as the scene is there, also where no splat is in it (`rooms.rs`).

use std::ops::Range;

use glam::DVec3;

use super::{
    blocks::Block,
    chunk::Chunk,
    pack::{self, Beside, Packed, Survey},
};
use crate::{
    error::{Error, Result},
    scene::{DefectCounts, Scene, SplatFormat, Splats},
    shaders::config::BLOCK_SPLATS,
};

/// Refuses a scene whose splats are to change, where what stands for others, or the bytes they are kept in, would not go along.
pub(super) fn check(scene: &Scene) -> Result<()> {
    let problem = match scene.updatable {
        true if scene.levels || scene.has_levels() => "levels of detail stand for splats as they are",
        true if scene.storage.format == SplatFormat::Packed => {
            "packed splats have no room to move: expected the splat format exact"
        }
        _ => return Ok(()),
    };
    Err(Error::option("updatable", problem))
}

/// What the host keeps of a chunk whose splats may change.
pub(super) struct Shadow {
    /// As on the device.
    splats: Packed,
    /// The number in the object and the place in the chunk of each splat, by its number.
    places: Vec<[u32; 2]>,
    /// The box of the centers of each block, local space.
    boxes: Vec<[DVec3; 2]>,
    /// What is above the blocks, once something has changed.
    above: Vec<Vec<Block>>,
}

impl Packed {
    /// Adds others of the same survey.
    pub(super) fn extend(&mut self, others: &Self) {
        self.count += others.count;
        self.shapes.extend_from_slice(&others.shapes);
        self.colors.extend_from_slice(&others.colors);
    }

    /// None; their memory stays.
    fn clear(&mut self) {
        self.count = 0;
        self.shapes.clear();
        self.colors.clear();
        self.clips.clear();
    }
}

impl Shadow {
    /// `numbers`: of the splats in their object, in the order of the chunk.
    pub fn new(splats: Packed, numbers: &[u32], survey: &Survey) -> Self {
        let mut places: Vec<[u32; 2]> =
            numbers.iter().copied().zip(0..).map(|(number, place)| [number, place]).collect();
        places.sort_unstable();
        let mut shadow = Self { splats, places, boxes: Vec::new(), above: Vec::new() };
        let blocks = 0..numbers.len().div_ceil(BLOCK_SPLATS as usize);
        shadow.boxes = blocks.map(|block| shadow.block(block, survey).1).collect();
        shadow
    }

    /// The splats of the chunk that are among these of its object: numbers and places, by number.
    fn among(&self, numbers: &Range<u32>) -> &[[u32; 2]] {
        let first = self.places.partition_point(|[number, _]| *number < numbers.start);
        let end = self.places.partition_point(|[number, _]| *number < numbers.end);
        &self.places[first..end]
    }

    /// The words of some splats: shapes, colors.
    fn words(&self, splats: Range<u32>, survey: &Survey) -> [&[u8]; 2] {
        let [first, end] = [splats.start, splats.end].map(|place| place as usize);
        let (shape, color) = (survey.shape_bytes() / 16, survey.color_bytes() / 4);
        [
            bytemuck::cast_slice(&self.splats.shapes[first * shape..end * shape]),
            bytemuck::cast_slice(&self.splats.colors[first * color..end * color]),
        ]
    }

    /// A block by its number, and the box of its centers.
    fn block(&self, number: usize, survey: &Survey) -> (Block, [DVec3; 2]) {
        let each = survey.shape_bytes() / 16;
        let of_block = BLOCK_SPLATS as usize * each;
        let end = self.splats.shapes.len().min((number + 1) * of_block);
        Block::of(&self.splats.shapes[number * of_block..end], survey)
    }

    /// Packs splats and puts them into their places of the chunk.
    fn put(&mut self, splats: &Splats, which: &[[u32; 2]], survey: &Survey, packed: &mut Packed) {
        let (shape, color) = (survey.shape_bytes() / 16, survey.color_bytes() / 4);
        // Few at once, so that they take little memory beside the chunk's.
        for which in which.chunks(BLOCK_SPLATS as usize) {
            packed.clear();
            let own = which.iter().map(|[own, _]| *own as usize);
            pack::pack_behind(splats, own, survey, Beside::default(), packed);
            for (i, place) in which.iter().map(|[_, place]| *place as usize).enumerate() {
                let (from, to) = (i * shape, place * shape);
                for word in 0..shape {
                    // How much surfaces overlap there, and how near another one is, stays as it was found.
                    let kept = self.splats.shapes[to + word][3];
                    self.splats.shapes[to + word] = packed.shapes[from + word];
                    if word == 1 {
                        self.splats.shapes[to + word][3] = kept;
                    }
                }
                let colors = &packed.colors[i * color..(i + 1) * color];
                self.splats.colors[place * color..(place + 1) * color].copy_from_slice(colors);
            }
        }
    }
}

impl Chunk {
    /// How its splats are packed, whichever they are.
    pub(super) fn packing(&self) -> Survey {
        Survey {
            rebase: self.rebase,
            count: self.count,
            ellipses: self.ellipses,
            fine: self.fine,
            uniform_color: self.uniform_color,
            clipped: self.clipped,
            packed: self.packed,
            bounds: self.bounds,
            largest_radius: self.largest_radius,
            radii: Vec::new(),
            sum_of_radii: 0.0,
            defects: DefectCounts::default(),
        }
    }
}

mod change;
mod rooms;
#[cfg(test)]
mod rooms_tests;
#[cfg(test)]
mod tests;
mod update;

pub(crate) use change::Changes;
pub(crate) use rooms::RoomOf;
pub(super) use rooms::{empties, is_there};
pub(crate) use update::Update;
