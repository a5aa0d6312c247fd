//! The blocks of splats in which those are looked for that may be seen (`blocks.rs`).

use std::ops::Range;

use crate::arena::Arena;
use crate::passes::plan::{draws::Draw, seen::PotentiallyVisibleBlock};
use crate::shaders::config::{ALL_OF_LEVEL, ALL_VISIBLE, BLOCK_SPLATS, LEVEL_WORDS};

/// Words in front of the blocks: the rows.
const ROW_WORDS: usize = 2;

/// The blocks of all chunks in which splats are looked for, as `glsl/inc/list.glsl` has them: the rows of tiles, then the
/// chunks' blocks one behind the other; then, where some have levels of detail, how the camera sees them, the last chunk's first.
#[derive(Clone, Copy)]
pub struct ListedBlocks<'a>(&'a [u32]);

impl<'a> ListedBlocks<'a> {
    /// Those of the blocks of each chunk that may touch some rows of tiles; gives each chunk its number, and that of its first splat
    /// among those that are looked at.
    pub fn of(
        arena: &'a Arena,
        draws: &mut [Draw<'_>],
        seen: &[&[PotentiallyVisibleBlock]],
        rows: Range<u32>,
    ) -> Self {
        let mut words = arena.growing();
        words.reserve(ROW_WORDS + seen.iter().map(|blocks| blocks.len().max(1)).sum::<usize>());
        words.extend([rows.start, rows.end]);
        for (number, (draw, blocks)) in (0..).zip(draws.iter_mut().zip(seen)) {
            let before = words.len();
            draw.constants.number_chunk(number);
            draw.constants.first_record = (before - ROW_WORDS) as u32 * BLOCK_SPLATS;
            let touching = blocks.iter().filter(|block| block.touches(&rows));
            words.extend(touching.map(|block| {
                let all_visible = if block.is_within(&rows) { ALL_VISIBLE } else { 0 };
                let all_of_level = if block.all_of_level { ALL_OF_LEVEL } else { 0 };
                block.number | all_visible | all_of_level
            }));
            if words.len() == before {
                // There is one in any case, for whoever counts what is listed: behind all splats.
                words.push(u32::MAX / BLOCK_SPLATS);
            }
            draw.constants.list_blocks((words.len() - before) as u32);
        }
        if draws.iter().any(|draw| draw.levels.is_some()) {
            let none = [0; LEVEL_WORDS as usize];
            let views = draws.iter().rev().map(|draw| draw.levels.map_or(none, |levels| levels.words()));
            words.extend(views.flatten());
        }
        Self(words.into_bump_slice())
    }

    /// The words, in their order.
    pub(crate) fn words(&self) -> &'a [u32] {
        self.0
    }
}
