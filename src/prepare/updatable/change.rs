//! A change of some splats of an object: found and checked first, then made as a whole.

use std::ops::Range;

use glam::DVec3;

use super::super::{
    PreparedScene,
    block_tree::{above, distinct},
    chunk::Chunk,
    pack::{self, Packed},
    radii::RadiusCounts,
};
use crate::{
    error::{Error, Result},
    scene::{Clip, DefectCounts, Shapes, Splats},
    shaders::config::BLOCK_SPLATS,
    vk::{Copies, Device},
};

/// Splats that are between two changed ones and are copied with them, rather than begin a copy of its own.
const MOST_BETWEEN: u32 = 16;

/// How far from its chunk's origin a changed splat may reach, in the chunk's own unit, which is about as large as what was uploaded: an upload gives what is farther a chunk of its own.
const FARTHEST: f64 = 1e18;

/// What changes of a scene are found with, one after the other: memory that stays.
#[derive(Default)]
pub(crate) struct Changes {
    /// Of each chunk that the change at hand touches, and of more.
    of_chunks: Vec<Change>,
    /// How many those of this change are.
    len: usize,
    packed: Packed,
    radii: RadiusCounts,
}

/// What a change writes into a chunk.
#[derive(Default)]
struct Change {
    /// The chunk's number.
    chunk: usize,
    /// Of each splat the number among those that are given, and the place in the chunk, by which they are in order.
    splats: Vec<[u32; 2]>,
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
    fn change(&self, first: u32, splats: &Splats, into: &mut Change) -> Result<bool> {
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
            return Ok(false);
        }
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
        into.splats.clear();
        // As many as there can be, so that the next change of as many has room.
        into.splats.reserve(splats.len());
        into.splats.extend(among.iter().map(|[number, place]| [number - first, *place]));
        into.splats.sort_unstable_by_key(|[_, place]| *place);
        Ok(true)
    }

    /// Bytes of what a change copies.
    fn bytes_of(&self, change: &Change) -> u64 {
        let survey = self.packing();
        let each = (survey.shape_bytes() + survey.color_bytes()) as u64;
        change.runs().map(|run| u64::from(run.end - run.start) * each).sum()
    }

    /// Changes what is known of it, and copies what has changed, where it is on a device.
    fn apply(
        &mut self,
        (change, splats): (&Change, &Splats),
        (packed, counts): (&mut Packed, &mut RadiusCounts),
        copies: Option<&mut Copies<'_>>,
    ) {
        let survey = self.packing();
        let Some(shadow) = &mut self.shadow else { return };
        shadow.put(splats, &change.splats, &survey, packed);
        if let (Some(memory), Some(copies)) = (&self.memory, copies) {
            for (part, each) in self.bytes_each.into_iter().enumerate() {
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
        self.largest_radius = self.blocks.iter().map(|block| block.largest_radius).fold(0.0, f64::max);
        counts.clear();
        // Of its block the largest: more than it is, but bounded without a look at all.
        self.blocks.iter().for_each(|block| counts.add_several(block.largest_radius, block.count));
        self.radii.clear();
        // One a block at most, whichever they are after the next change.
        self.radii.reserve(self.blocks.len());
        self.radii.extend(counts.each_step());
    }
}

/// A change that was found and is to be made.
pub(crate) struct Update<'s> {
    scene: &'s mut PreparedScene,
    splats: &'s Splats,
    bytes: u64,
}

impl Update<'_> {
    /// Bytes that are copied to the device.
    pub fn bytes(&self) -> u64 {
        self.bytes
    }

    /// Makes it, with copies for the device where the scene is on one.
    pub fn apply(self, mut copies: Option<&mut Copies<'_>>) {
        let PreparedScene { chunks, changes, .. } = self.scene;
        let Changes { of_chunks, len, packed, radii } = changes;
        for change in &of_chunks[..*len] {
            let chunk = &mut chunks[change.chunk];
            chunk.apply((change, self.splats), (&mut *packed, &mut *radii), copies.as_deref_mut());
        }
    }
}

impl PreparedScene {
    /// Finds what is to change where splats of an object, from this number on, become these.
    ///
    /// # Errors
    /// As [`crate::renderer::Renderer::update`].
    pub(crate) fn update<'s>(
        &'s mut self,
        device: Option<&Device>,
        object: usize,
        first: u32,
        splats: &'s Splats,
    ) -> Result<Update<'s>> {
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
        let Self { chunks, changes: Changes { of_chunks, len, .. }, .. } = self;
        *len = 0;
        let (mut found, mut bytes) = (0, 0);
        for (number, chunk) in chunks.iter().enumerate().filter(|(_, chunk)| chunk.object == object) {
            if *len == of_chunks.len() {
                of_chunks.push(Change::default());
            }
            let change = &mut of_chunks[*len];
            if chunk.change(first, splats, change)? {
                change.chunk = number;
                found += change.splats.len();
                bytes += chunk.bytes_of(change);
                *len += 1;
            }
        }
        if found != splats.len() {
            let (has, of) = (found, splats.len());
            return refused(format!(
                "object {object} has {has} of the {of} splats from {first} on: fewer are there, or were left out by the upload"
            ));
        }
        Ok(Update { scene: self, splats, bytes })
    }
}
