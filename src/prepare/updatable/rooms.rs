//! Places of a chunk in which there is no splat: their radius is [`NOBODY`], by which a device knows them.

use super::{
    super::{PreparedScene, block_tree::above, chunk::Chunk, pack::Packed, pack::Survey},
    Shadow,
};
use crate::shaders::config::BLOCK_SPLATS;

/// The radius of a splat that is not there; no other is below 0.
const NOBODY: f32 = -1.0;

/// The numbers of an object that has room.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RoomOf {
    /// Those that it was uploaded with.
    pub own: u32,
    /// Those behind.
    pub splats: u32,
}

impl RoomOf {
    /// Behind its last number.
    pub fn end(self) -> u32 {
        self.own + self.splats
    }
}

/// So many places with nobody, over surfaces of which this is what weights are multiplied by.
pub(in super::super) fn empties(count: usize, survey: &Survey, inverse_overlap: u32) -> Packed {
    let (shape, color) = (survey.shape_bytes() / 16, survey.color_bytes() / 4);
    let one = [[0, 0, 0, NOBODY.to_bits()], [0, 0, 0, inverse_overlap], [0; 4], [0; 4]];
    Packed {
        count: count as u32,
        shapes: std::iter::repeat_n(&one[..shape], count).flatten().copied().collect(),
        colors: vec![0; count * color],
        clips: Vec::new(),
    }
}

/// Whether a radius is one of somebody.
pub(in super::super) fn is_there(radius: f32) -> bool {
    !radius.is_sign_negative()
}

impl Shadow {
    /// The mean over splats is what new ones get.
    pub(in super::super) fn sum_of_inverse_overlaps(&self, survey: &Survey) -> f64 {
        let of_splat = |words: &[[u32; 4]]| f64::from(words[1][3] >> 16) / 16_384.0;
        self.splats.shapes.chunks_exact(survey.shape_bytes() / 16).map(of_splat).sum()
    }

    /// Whether there is a splat in a place.
    pub(super) fn is_filled(&self, place: u32, survey: &Survey) -> bool {
        is_there(f32::from_bits(self.splats.shapes[place as usize * (survey.shape_bytes() / 16)][3]))
    }

    /// Takes a splat out of a place.
    pub(super) fn empty(&mut self, place: u32, survey: &Survey) {
        self.splats.shapes[place as usize * (survey.shape_bytes() / 16)][3] = NOBODY.to_bits();
    }

    /// Its number, of the splat in a place, of a chunk whose places have the order of numbers.
    fn first_number(&self) -> Option<u32> {
        self.places.first().map(|[number, _]| *number)
    }
}

impl Chunk {
    /// What a change of it takes of memory, so that the first one finds it.
    pub(in super::super) fn make_ready(&mut self) {
        self.radii.reserve(self.blocks.len());
        if let Some(shadow) = &mut self.shadow {
            shadow.above = above(&self.blocks);
        }
    }

    /// Of a sparse one, how many places there are up to the last that is filled.
    pub(super) fn filled_places(&self, survey: &Survey) -> u32 {
        let (Some(shadow), Some(last)) =
            (&self.shadow, self.blocks.iter().rposition(|block| block.count > 0))
        else {
            return 0;
        };
        let first = last as u32 * BLOCK_SPLATS;
        let end = shadow.places.len().min((last + 1) * BLOCK_SPLATS as usize) as u32;
        (first..end).rev().find(|place| shadow.is_filled(*place, survey)).map_or(first, |last| last + 1)
    }
}

impl PreparedScene {
    /// How many splats [`crate::renderer::Renderer::append`] has room for yet, behind the last one that an object has there; `None` of one that has no room.
    pub fn room_of(&self, object: usize) -> Option<u32> {
        let room = self.rooms.get(object).copied().flatten()?;
        Some(room.end() - self.end_of(object, room))
    }

    /// The number behind the last that is taken of an object's room.
    pub(super) fn end_of(&self, object: usize, room: RoomOf) -> u32 {
        let of_object = self.chunks.iter().filter(|chunk| chunk.object == object && chunk.count > 0);
        let ends = of_object.filter_map(|chunk| {
            let first = chunk.shadow.as_ref()?.first_number()?;
            (first >= room.own).then_some(first + chunk.count)
        });
        ends.fold(room.own, u32::max)
    }
}
