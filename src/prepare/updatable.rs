//! Splats that may change after they are on the device: what the host keeps of a chunk for that, and what a change does to it.
//!
//! Of each splat the host keeps what the device has, 40 bytes (48 to 72 of ellipses and fine ones), and 8 of where it lies. So bounds are always those of what is there:
//! of a block that a change touches they are found anew from its 256 splats, and those of the chunk from its blocks'.

use std::ops::Range;

use glam::DVec3;

use super::{
    PreparedScene,
    block_tree::BlockTree,
    blocks::Block,
    chunk::Chunk,
    pack::{self, Beside, Packed, Survey},
    radii::RadiusCounts,
};
use crate::{
    error::{Error, Result},
    scene::{Clip, DefectCounts, Scene, Shapes, SplatFormat, Splats},
    shaders::config::BLOCK_SPLATS,
    vk::{Device, Staging},
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

/// Splats that are between two changed ones and are copied with them, rather than begin a copy of its own.
const MOST_BETWEEN: u32 = 16;

/// How far from its chunk's origin a changed splat may reach, in the chunk's own unit, which is about as large as what was uploaded: an upload gives what is farther a chunk of its own.
const FARTHEST: f64 = 1e18;

/// What the host keeps of a chunk whose splats may change.
pub(super) struct Shadow {
    /// As on the device.
    splats: Packed,
    /// The number in the object and the place in the chunk of each splat, by its number.
    places: Vec<[u32; 2]>,
    /// The box of the centers of each block, local space.
    boxes: Vec<[DVec3; 2]>,
}

/// What a change writes into a chunk: places and, in their order, splats.
struct Change {
    places: Vec<u32>,
    packed: Packed,
}

impl Packed {
    /// Adds others of the same survey.
    pub(super) fn extend(&mut self, others: &Self) {
        self.count += others.count;
        self.shapes.extend_from_slice(&others.shapes);
        self.colors.extend_from_slice(&others.colors);
    }
}

impl Shadow {
    /// `numbers`: of the splats in their object, in the order of the chunk.
    pub fn new(splats: Packed, numbers: &[u32], survey: &Survey) -> Self {
        let mut places: Vec<[u32; 2]> =
            numbers.iter().copied().zip(0..).map(|(number, place)| [number, place]).collect();
        places.sort_unstable();
        let mut shadow = Self { splats, places, boxes: Vec::new() };
        shadow.boxes =
            shadow.blocks(0..numbers.len() as u32, survey).into_iter().map(|(_, bounds)| bounds).collect();
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

    /// The blocks of some splats, which begin with one's first, and the boxes of their centers.
    fn blocks(&self, splats: Range<u32>, survey: &Survey) -> Vec<(Block, [DVec3; 2])> {
        let each = survey.shape_bytes() / 16;
        let words = &self.splats.shapes[splats.start as usize * each..splats.end as usize * each];
        words.chunks(each * BLOCK_SPLATS as usize).map(|words| Block::of(words, survey)).collect()
    }
}

impl Chunk {
    /// How its splats are packed, whichever they are.
    fn packing(&self) -> Survey {
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

    /// What it is to write of splats `first` and so on of its object: how much of them it has, and what; `None` where it has none of them.
    ///
    /// # Errors
    /// [`crate::ErrorKind::Option`] for splats of another kind than the chunk's.
    fn change(&self, first: u32, splats: &Splats) -> Result<Option<Change>> {
        let refused = |problem: String| Err(Error::option("update", problem));
        let Some(shadow) = &self.shadow else {
            let what = if self.clipped {
                "clip curves cut its splats"
            } else {
                "expected a scene that was uploaded with Scene::updatable"
            };
            return refused(format!("{what}: expected an object of an updatable scene, of whole splats"));
        };
        let numbers = first..first + splats.len() as u32;
        let among = shadow.among(&numbers);
        if among.is_empty() {
            return Ok(None);
        }
        if matches!(splats.shapes, Shapes::Ellipses { .. }) != self.ellipses {
            let (is, expected) = if self.ellipses { ("disks", "ellipses") } else { ("ellipses", "disks") };
            return refused(format!("{is}: expected {expected}, as the object has"));
        }
        let mut sorted: Vec<[u32; 2]> = among.to_vec();
        sorted.sort_unstable_by_key(|[_, place]| *place);
        let own = |number: u32| (number - first) as usize;
        for [number, _] in &sorted {
            let problem = match splats.defect(own(*number)) {
                Some(defect) => {
                    let mut counts = DefectCounts::default();
                    counts.add(Some(defect));
                    counts.to_string()
                }
                None if splats.clips.get(own(*number)) != Clip::None => "a clip curve cuts it".to_owned(),
                None if self.rebase.scale * splats.major_radius(own(*number)) > FARTHEST => {
                    "its radius is so large that no camera sees the rest of its object".to_owned()
                }
                None if self.rebase.point(splats.positions[own(*number)]).abs().max_element() > FARTHEST => {
                    "it lies so far off that no camera sees the rest of its object".to_owned()
                }
                None if !self.transparent && splats.color(own(*number))[3] < 1.0 => {
                    "it is transparent, and its object is not".to_owned()
                }
                None => continue,
            };
            return refused(format!("splat {number}: {problem}"));
        }
        let survey = self.packing();
        let which = sorted.iter().map(|[number, _]| own(*number));
        let packed = pack::pack(splats, which, &survey, Beside::default());
        if packed.count as usize != sorted.len() {
            return refused("a splat lies so far off that the device has no number for it".to_owned());
        }
        Ok(Some(Change { places: sorted.into_iter().map(|[_, place]| place).collect(), packed }))
    }

    /// The runs of places that a change copies.
    fn runs(change: &Change) -> Vec<Range<u32>> {
        let mut runs: Vec<Range<u32>> = Vec::new();
        for &place in &change.places {
            match runs.last_mut() {
                Some(run) if place - run.end <= MOST_BETWEEN => run.end = place + 1,
                _ => runs.push(place..place + 1),
            }
        }
        runs
    }

    /// Bytes of those.
    fn bytes_of(&self, runs: &[Range<u32>]) -> u64 {
        let survey = self.packing();
        let each = (survey.shape_bytes() + survey.color_bytes()) as u64;
        runs.iter().map(|run| u64::from(run.end - run.start) * each).sum()
    }

    /// Changes what is known of it, and puts copies of what has changed into a batch that has room for them, where it is on a device.
    fn apply(&mut self, change: &Change, runs: &[Range<u32>], staging: Option<&mut Staging>) -> Result<()> {
        let survey = self.packing();
        let Some(shadow) = &mut self.shadow else { return Ok(()) };
        let (shape, color) = (survey.shape_bytes() / 16, survey.color_bytes() / 4);
        for (i, place) in change.places.iter().map(|place| *place as usize).enumerate() {
            let (from, to) = (i * shape, place * shape);
            for word in 0..shape {
                // How much surfaces overlap there, and how near another one is, stays as it was found.
                let kept = shadow.splats.shapes[to + word][3];
                shadow.splats.shapes[to + word] = change.packed.shapes[from + word];
                if word == 1 {
                    shadow.splats.shapes[to + word][3] = kept;
                }
            }
            let colors = &change.packed.colors[i * color..(i + 1) * color];
            shadow.splats.colors[place * color..(place + 1) * color].copy_from_slice(colors);
        }
        if let (Some(memory), Some(staging)) = (&self.memory, staging) {
            for run in runs {
                let [shapes, colors] = shadow.words(run.clone(), &survey);
                staging.push(&memory.buffers[0], u64::from(run.start) * self.bytes_each[0], shapes)?;
                staging.push(&memory.buffers[1], u64::from(run.start) * self.bytes_each[1], colors)?;
            }
        }
        let mut touched: Vec<u32> = change.places.iter().map(|place| place / BLOCK_SPLATS).collect();
        touched.dedup();
        for block in touched {
            let first = block * BLOCK_SPLATS;
            let found = shadow.blocks(first..(first + BLOCK_SPLATS).min(self.count), &survey);
            for (found, bounds) in found {
                (self.blocks[block as usize], shadow.boxes[block as usize]) = (found, bounds);
            }
        }
        self.bounds =
            shadow.boxes.iter().fold([DVec3::INFINITY, DVec3::NEG_INFINITY], |[lo, hi], [least, most]| {
                [lo.min(*least), hi.max(*most)]
            });
        self.tree = BlockTree::new(&self.blocks);
        self.largest_radius = self.blocks.iter().map(|block| block.largest_radius).fold(0.0, f64::max);
        let mut radii = RadiusCounts::new();
        // Of its block the largest: more than it is, but bounded without a look at all.
        self.blocks.iter().for_each(|block| radii.add_several(block.largest_radius, block.count));
        self.radii = radii.steps();
        Ok(())
    }
}

impl PreparedScene {
    /// Changes splats of an object, from this number on; copies for the device, none where it is on none or where nothing changes.
    ///
    /// # Errors
    /// As [`crate::renderer::Renderer::update`]. Then nothing has changed.
    pub(crate) fn update(
        &mut self,
        device: Option<&Device>,
        object: usize,
        first: u32,
        splats: &Splats,
    ) -> Result<Option<Staging>> {
        let refused = |problem: String| Err(Error::option("update", problem));
        if device.is_some_and(|device| !self.is_on(device)) {
            return refused("the scene was prepared for another device".to_owned());
        }
        splats.check_lengths().map_err(|problem| Error::option("update", problem))?;
        if object >= self.objects.len() {
            return refused(format!("object {object}: the scene has {}", self.objects.len()));
        }
        if u32::try_from(splats.len()).ok().and_then(|count| first.checked_add(count)).is_none() {
            return refused(format!("{} splats from {first} on: expected numbers of 32 bits", splats.len()));
        }
        let mut changes = Vec::new();
        for (number, chunk) in self.chunks.iter().enumerate().filter(|(_, chunk)| chunk.object == object) {
            if let Some(change) = chunk.change(first, splats)? {
                let runs = Chunk::runs(&change);
                changes.push((number, runs, change));
            }
        }
        let found: usize = changes.iter().map(|(.., change)| change.places.len()).sum();
        if found != splats.len() {
            let (has, of) = (found, splats.len());
            return refused(format!(
                "object {object} has {has} of the {of} splats from {first} on: fewer are there, or were left out by the upload"
            ));
        }
        let bytes: u64 = changes.iter().map(|(number, runs, _)| self.chunks[*number].bytes_of(runs)).sum();
        let staging =
            device.filter(|_| bytes > 0).map(|device| Staging::new(device, "update of splats", bytes));
        let mut staging = staging.transpose()?;
        for (number, runs, change) in &changes {
            self.chunks[*number].apply(change, runs, staging.as_mut())?;
        }
        Ok(staging)
    }
}

#[cfg(test)]
mod tests;
