//! The blocks of splats in which those are looked for that may be seen (`blocks.rs`).

use std::ops::Range;

use crate::arena::Arena;
use crate::passes::plan::{
    draws::{Draw, DrawPlace},
    seen::PotentiallyVisibleRun,
};
use crate::shaders::config::{ALL_IN_VIEW, ALL_OF_LEVEL, ALL_VISIBLE, BLOCK_SPLATS, HAS_BOUNDS, LEVEL_WORDS};

/// Words in front of the runs: the rows, and how many runs there are.
const HEAD_WORDS: usize = 3;

/// Words of a list at least: few runs are soon twice as many.
const LEAST_WORDS: usize = 256;

/// The blocks of all chunks in which splats are looked for, as `glsl/inc/list.glsl` has them: the rows of tiles, and how many runs of blocks there are; the runs of all
/// chunks one behind the other; where each chunk begins among all blocks that are looked in, and where the last ends; then, where some have levels of detail, how the camera sees them, the last chunk's first.
#[derive(Clone, Copy)]
pub struct ListedBlocks<'a> {
    words: &'a [u32],
    most_splats: u64,
}

impl<'a> ListedBlocks<'a> {
    /// Those of the runs of each chunk that may touch some rows of tiles; gives each chunk its number, and that of its first splat
    /// among those that are looked at.
    pub fn of(
        arena: &'a Arena,
        draws: &mut [Draw<'_>],
        seen: &[&[PotentiallyVisibleRun]],
        rows: Range<u32>,
    ) -> Self {
        let mut words = arena.growing();
        let most = HEAD_WORDS + 2 * seen.iter().map(|runs| runs.len().max(1)).sum::<usize>() + seen.len() + 1;
        words.reserve(most.next_power_of_two().max(LEAST_WORDS));
        words.extend([rows.start, rows.end, 0]);
        let (mut place, mut most_splats, mut begins) = (0, 0, arena.growing());
        begins.reserve(seen.len() + 1);
        for (number, (draw, runs)) in (0..).zip(draws.iter_mut().zip(seen)) {
            let (before, mut last) = (place, None);
            let has_bounds = draw.has_bounds();
            begins.push(place);
            let first_record = place * BLOCK_SPLATS;
            for run in runs.iter().filter(|run| run.touches(&rows)) {
                let known = |is: bool, what: u32| if is { what } else { 0 };
                let all_visible = known(run.is_within(&rows), ALL_VISIBLE);
                let all_of_level = known(run.all_of_level, ALL_OF_LEVEL);
                let by_bounds = known(has_bounds && all_visible == 0, HAS_BOUNDS);
                let in_view = known(by_bounds != 0 && run.is_in_view(&rows), ALL_IN_VIEW);
                let what = run.first | all_visible | all_of_level | by_bounds | in_view;
                most_splats += u64::from(run.count);
                // Neighbors of which the same is known are one.
                if last.is_none_or(|(begin, of_last)| of_last + (place - begin) != what) {
                    words.extend_from_slice_copy(&[place, what]);
                    last = Some((place, what));
                }
                place += run.blocks;
            }
            if place == before {
                // There is one in any case, for whoever counts what is listed: behind all splats.
                words.extend([place, u32::MAX / BLOCK_SPLATS]);
                place += 1;
            }
            draw.place = DrawPlace { number, first_record, listed_blocks: place - before };
        }
        begins.push(place);
        words[HEAD_WORDS - 1] = ((words.len() - HEAD_WORDS) / 2) as u32;
        words.extend_from_slice_copy(&begins);
        // With every move of a camera there are others, of which buffers shall not be too small.
        words.resize(words.len().next_power_of_two().max(LEAST_WORDS), 0);
        if draws.iter().any(|draw| draw.levels.is_some()) {
            let none = [0; LEVEL_WORDS as usize];
            let views = draws.iter().rev().map(|draw| draw.levels.map_or(none, |levels| levels.words()));
            words.extend(views.flatten());
        }
        Self { words: words.into_bump_slice(), most_splats }
    }

    /// The words, in their order.
    pub(crate) fn words(&self) -> &'a [u32] {
        self.words
    }

    /// No more splats of them may be seen.
    pub(crate) fn most_splats(&self) -> u64 {
        self.most_splats
    }
}
