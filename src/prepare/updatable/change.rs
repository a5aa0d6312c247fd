//! A change of some splats of an object: found and checked first, then made as a whole.

use std::ops::Range;

use glam::DVec3;

use super::super::{
    block_tree::{above, distinct},
    chunk::Chunk,
    pack::{self, Packed},
    radii::RadiusCounts,
};
use crate::{
    error::{Error, Result},
    scene::{Clip, DefectCounts, Shapes, Splats},
    shaders::config::BLOCK_SPLATS,
    vk::Copies,
};

/// Splats that are between two changed ones and are copied with them, rather than begin a copy of its own.
const MOST_BETWEEN: u32 = 16;

/// How far from its chunk's origin a changed splat may reach, in the chunk's own unit, which is about as large as what was uploaded: an upload gives what is farther a chunk of its own.
const FARTHEST: f64 = 1e18;

/// What changes of a scene are found with, one after the other: memory that stays.
#[derive(Default)]
pub(crate) struct Changes {
    /// Of each chunk that the change at hand touches, and of more.
    pub(super) of_chunks: Vec<Change>,
    /// How many those of this change are.
    pub(super) len: usize,
    pub(super) packed: Packed,
    pub(super) radii: RadiusCounts,
}

/// What is to be in places of an object.
#[derive(Clone, Copy)]
pub(super) enum What<'s> {
    /// These splats.
    Splats(&'s Splats),
    /// So many times nobody.
    Nobody(u32),
}

impl What<'_> {
    pub fn len(self) -> usize {
        match self {
            Self::Splats(splats) => splats.len(),
            Self::Nobody(count) => count as usize,
        }
    }

    /// The call that asks for it.
    pub fn call(self) -> &'static str {
        match self {
            Self::Splats(_) => "update",
            Self::Nobody(_) => "remove",
        }
    }

    /// The parts of a splat that are copied: shape and color.
    fn parts(self) -> std::ops::Range<usize> {
        match self {
            Self::Splats(_) => 0..2,
            Self::Nobody(_) => 0..1,
        }
    }
}

/// What a change writes into a chunk.
#[derive(Default)]
pub(super) struct Change {
    /// The chunk's number.
    pub chunk: usize,
    /// Of each splat the number among those that are given, and the place in the chunk, by which they are in order.
    pub splats: Vec<[u32; 2]>,
}

impl Change {
    fn places(&self) -> impl Iterator<Item = u32> + Clone + '_ {
        self.splats.iter().map(|[_, place]| *place)
    }

    /// The runs of places that are copied.
    fn runs(&self) -> impl Iterator<Item = Range<u32>> + '_ {
        let is_near = |[_, one]: &[u32; 2], [_, next]: &[u32; 2]| next - one <= MOST_BETWEEN + 1;
        self.splats.chunk_by(is_near).map(|run| run[0][1]..run[run.len() - 1][1] + 1)
    }
}

impl Chunk {
    /// What it is to write of splats `first` and so on of its object. Whether it has any of them.
    ///
    /// # Errors
    /// [`crate::ErrorKind::Option`] for splats of another kind than the chunk's.
    pub(super) fn change(&self, first: u32, what: What<'_>, into: &mut Change) -> Result<bool> {
        let refused = |problem: String| Err(Error::option(what.call(), problem));
        let Some(shadow) = &self.shadow else {
            let what = if self.clipped {
                "clip curves cut its splats"
            } else {
                "expected a scene that was uploaded with Scene::updatable"
            };
            return refused(format!("{what}: expected an object of an updatable scene, of whole splats"));
        };
        let numbers = first..first + what.len() as u32;
        let among = shadow.among(&numbers);
        if among.is_empty() {
            return Ok(false);
        }
        into.splats.clear();
        // As many as there can be, so that the next change of as many has room.
        into.splats.reserve(what.len());
        match what {
            What::Splats(splats) => {
                self.check(first, splats, among)?;
                into.splats.extend(among.iter().map(|[number, place]| [number - first, *place]));
            }
            What::Nobody(_) => {
                let survey = self.packing();
                let filled = among.iter().filter(|[_, place]| shadow.is_filled(*place, &survey));
                into.splats.extend(filled.map(|[number, place]| [number - first, *place]));
            }
        }
        into.splats.sort_unstable_by_key(|[_, place]| *place);
        Ok(!into.splats.is_empty())
    }

    /// Refuses splats, from number `first` of the object on, of which some are to be in places of the chunk, and can't.
    fn check(&self, first: u32, splats: &Splats, among: &[[u32; 2]]) -> Result<()> {
        let refused = |problem: String| Err(Error::option("update", problem));
        if matches!(splats.shapes, Shapes::Ellipses { .. }) != self.ellipses {
            let (is, expected) = if self.ellipses { ("disks", "ellipses") } else { ("ellipses", "disks") };
            return refused(format!("{is}: expected {expected}, as the object has"));
        }
        for [number, _] in among {
            let own = (number - first) as usize;
            let problem = match splats.defect(own) {
                Some(defect) => {
                    let mut counts = DefectCounts::default();
                    counts.add(Some(defect));
                    counts.to_string()
                }
                None if splats.clips.get(own) != Clip::None => "a clip curve cuts it".to_owned(),
                None if self.rebase.scale * splats.major_radius(own) > FARTHEST => {
                    "its radius is so large that no camera sees the rest of its object".to_owned()
                }
                None if self.rebase.point(splats.positions[own]).abs().max_element() > FARTHEST => {
                    "it lies so far off that no camera sees the rest of its object".to_owned()
                }
                None if !self.transparent && splats.color(own)[3] < 1.0 => {
                    "it is transparent, and its object is not".to_owned()
                }
                None if pack::local(splats, own, self.rebase).is_err() => {
                    "it lies so far off that the device has no number for it".to_owned()
                }
                None => continue,
            };
            return refused(format!("splat {number}: {problem}"));
        }
        Ok(())
    }

    /// Bytes of what a change copies.
    pub(super) fn bytes_of(&self, change: &Change, what: What<'_>) -> u64 {
        let each: u64 = self.bytes_each[what.parts()].iter().sum();
        change.runs().map(|run| u64::from(run.end - run.start) * each).sum()
    }

    /// Changes what is known of it, and copies what has changed, where it is on a device.
    pub(super) fn apply(
        &mut self,
        (change, what): (&Change, What<'_>),
        (packed, counts): (&mut Packed, &mut RadiusCounts),
        copies: Option<&mut Copies<'_>>,
    ) {
        let survey = self.packing();
        let Some(shadow) = &mut self.shadow else { return };
        match what {
            What::Splats(splats) => shadow.put(splats, &change.splats, &survey, packed),
            What::Nobody(_) => change.places().for_each(|place| shadow.empty(place, &survey)),
        }
        if let (Some(memory), Some(copies)) = (&self.memory, copies) {
            for (part, each) in self.bytes_each.into_iter().enumerate().take(what.parts().end) {
                for run in change.runs() {
                    let words = shadow.words(run.clone(), &survey)[part];
                    copies.push(&memory.buffers[part], u64::from(run.start) * each, words);
                }
            }
        }
        if shadow.above.is_empty() {
            shadow.above = above(&self.blocks);
        }
        let touched = change.places().map(|place| (place / BLOCK_SPLATS) as usize);
        for block in distinct(touched.clone()) {
            (self.blocks[block], shadow.boxes[block]) = shadow.block(block, &survey);
        }
        self.bounds =
            shadow.boxes.iter().fold([DVec3::INFINITY, DVec3::NEG_INFINITY], |[lo, hi], [least, most]| {
                [lo.min(*least), hi.max(*most)]
            });
        self.tree.renew(&self.blocks, &mut shadow.above, touched);
        if self.sparse {
            self.count = self.filled_places(&survey);
        }
        if self.count == 0 {
            self.bounds = [DVec3::ZERO; 2];
        }
        self.largest_radius = self.blocks.iter().map(|block| block.largest_radius).fold(0.0, f64::max);
        counts.clear();
        // Of its block the largest: more than it is, but bounded without a look at all.
        let places = |first: u32| self.count.saturating_sub(first).min(BLOCK_SPLATS);
        let firsts = (0..).step_by(BLOCK_SPLATS as usize);
        // Places that have none count, too: a frame that does not list splats looks at all.
        self.blocks
            .iter()
            .zip(firsts)
            .for_each(|(block, first)| counts.add_several(block.largest_radius, places(first)));
        self.radii.clear();
        // One a block at most, whichever they are after the next change.
        self.radii.reserve(self.blocks.len());
        self.radii.extend(counts.each_step());
    }
}
