//! The blocks of splats that may be seen (`blocks.rs`), and how many of their splats may touch which rows of tiles.

use std::ops::Range;

use crate::arena::Arena;

/// Blocks in a row some of whose splats may be seen.
#[derive(Clone, Debug, PartialEq)]
pub struct PotentiallyVisibleRun {
    /// The number of the first in its chunk.
    pub first: u32,
    /// How many there are.
    pub blocks: u32,
    /// Their splats, of levels of detail those that may be drawn.
    pub count: u32,
    /// What no splat's box exceeds, in pixels; infinite where one may come near the eye plane.
    pub box_px: f64,
    /// The rows of tiles that they may touch.
    pub rows: Range<u32>,
    /// None of them faces away, where such are not drawn, or is nearer than the near plane or beside the image.
    pub all_seen: bool,
    /// The same whichever way they face.
    pub all_in_view: bool,
    /// All of them are of the level of detail that is drawn.
    pub all_of_level: bool,
}

impl PotentiallyVisibleRun {
    /// Whether none of its splats is left out for where it is, where splats are looked for in these rows.
    pub fn is_within(&self, rows: &Range<u32>) -> bool {
        self.all_seen && self.is_in_view(rows)
    }

    /// The same whichever way they face.
    pub fn is_in_view(&self, rows: &Range<u32>) -> bool {
        self.all_in_view && rows.start <= self.rows.start && self.rows.end <= rows.end
    }

    /// Whether it may touch any of these rows.
    pub fn touches(&self, rows: &Range<u32>) -> bool {
        self.rows.start < rows.end && rows.start < self.rows.end
    }
}

/// The blocks of all chunks that may be seen, and how many of their splats may touch which rows.
#[derive(Clone, Copy)]
pub struct PotentiallyVisibleBlocks<'a> {
    /// Chunk by chunk.
    pub chunks: &'a [&'a [PotentiallyVisibleRun]],
    /// The sizes of boxes that there are, the smallest first.
    sizes_px: &'a [f64],
    /// Of each row, and of the end, all sizes: how many splats are in blocks that begin before it, and in such that end before it.
    before: &'a [[u32; 2]],
    /// The rows that any of them may touch; none where there is none.
    rows: [u32; 2],
}

/// What is not told apart of boxes: within a whole pixel ([`crate::math::size::pixels_along`]) they are in as many tiles.
fn whole_px_of(run: &PotentiallyVisibleRun) -> u32 {
    // Not `floor`, which is a call where a processor has no instruction for it.
    (run.box_px - 1.5) as u32
}

/// The largest box of so many whole pixels.
fn size_of(whole_px: u32) -> f64 {
    if whole_px < u32::MAX { f64::from(whole_px) + 2.499 } else { f64::INFINITY }
}

/// Sizes below that have a place in a table: nearly all are, and to search for each, where none is as the one before, takes as long as all else.
const SMALL_PX: usize = 256;

/// The sizes of boxes that there are, the smallest first, and where each is among them.
struct Sizes<'a> {
    /// In whole pixels.
    all: &'a [u32],
    small: [u32; SMALL_PX],
}

impl<'a> Sizes<'a> {
    fn of(arena: &'a Arena, runs: impl Iterator<Item = &'a PotentiallyVisibleRun>) -> Self {
        let (mut is_there, mut large) = ([false; SMALL_PX], arena.growing::<u32>());
        for run in runs {
            let whole_px = whole_px_of(run);
            match is_there.get_mut(whole_px as usize) {
                Some(is_there) => *is_there = true,
                None => {
                    if let Err(place) = large.binary_search(&whole_px) {
                        large.insert(place, whole_px);
                    }
                }
            }
        }
        let (mut all, mut small) = (arena.growing(), [0; SMALL_PX]);
        for (whole_px, _) in (0..).zip(&is_there).filter(|(_, is_there)| **is_there) {
            small[whole_px as usize] = all.len() as u32;
            all.push(whole_px);
        }
        all.extend_from_slice_copy(&large);
        Self { all: all.into_bump_slice(), small }
    }

    /// The place of one that there is.
    fn place_of(&self, whole_px: u32) -> usize {
        match self.small.get(whole_px as usize) {
            Some(place) => *place as usize,
            None => self.all.partition_point(|other| *other < whole_px),
        }
    }
}

impl<'a> PotentiallyVisibleBlocks<'a> {
    /// Those of some runs, in an image with so many rows of tiles.
    pub fn new(arena: &'a Arena, chunks: &'a [&'a [PotentiallyVisibleRun]], rows: u32) -> Self {
        let runs = || chunks.iter().copied().flatten();
        let sizes = Sizes::of(arena, runs());
        let count = sizes.all.len();
        let mut before = arena.growing();
        before.resize(count * (rows as usize + 1), [0; 2]);
        let mut touched = [u32::MAX, 0];
        for run in runs() {
            let size = sizes.place_of(whole_px_of(run));
            touched = [touched[0].min(run.rows.start), touched[1].max(run.rows.end)];
            // In the row behind the one where it begins or ends; then summed up.
            before[(run.rows.start as usize + 1) * count + size][0] += run.count;
            before[run.rows.end as usize * count + size][1] += run.count;
        }
        for place in count..before.len() {
            let [begun, ended] = before[place - count];
            before[place][0] += begun;
            before[place][1] += ended;
        }
        let sizes_px = arena.list(sizes.all.iter().map(|whole_px| size_of(*whole_px)));
        let before = before.into_bump_slice();
        Self { chunks, sizes_px, before, rows: touched }
    }

    /// Of each row, and of the end, what all splats cost of blocks that begin before it, and of such that end before it, by what one costs with a box of so many pixels.
    pub fn costs<'m>(&self, arena: &'m Arena, of_one: impl Fn(f64) -> u64) -> &'m [[u64; 2]] {
        let of_sizes = arena.list(self.sizes_px.iter().map(|px| of_one(*px)));
        let sum = |of_row: &[[u32; 2]]| {
            let of_size =
                |[begun, ended]: [u32; 2], cost: u64| [begun, ended].map(|count| u64::from(count) * cost);
            let costs = of_row.iter().zip(of_sizes).map(|(counts, cost)| of_size(*counts, *cost));
            costs.fold([0; 2], |[a, b], [begun, ended]| [a + begun, b + ended])
        };
        arena.list(self.before.chunks(self.sizes_px.len().max(1)).map(sum))
    }

    /// How many splats have boxes up to how many pixels, of the blocks that may touch these rows.
    pub fn boxes(&self, rows: &Range<u32>) -> impl Iterator<Item = (u32, f64)> + Clone + use<'a> {
        let (sizes_px, before) = (self.sizes_px, self.before);
        let of_row = |row: u32| &before[row as usize * sizes_px.len()..][..sizes_px.len()];
        let (end, start) = (of_row(rows.end), of_row(rows.start));
        let of = |((end, start), size_px): ((&[u32; 2], &[u32; 2]), &f64)| (end[0] - start[1], *size_px);
        end.iter().zip(start).zip(sizes_px).map(of).filter(|(count, _)| *count > 0)
    }

    /// How many blocks there are.
    pub fn block_count(&self) -> usize {
        self.chunks.iter().copied().flatten().map(|run| run.blocks as usize).sum()
    }

    /// The rows that any of them may touch; `None` where there is none.
    pub fn rows(&self) -> Option<Range<u32>> {
        let [start, end] = self.rows;
        (start < end).then_some(start..end)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_are_those_of_all_runs_wherever_the_first_and_the_last_are() {
        let run = |rows: Range<u32>| PotentiallyVisibleRun {
            first: 0,
            blocks: 1,
            count: 256,
            box_px: 4.0,
            rows,
            all_seen: true,
            all_in_view: true,
            all_of_level: true,
        };
        let arena = Arena::new();
        let rows = |chunks: &[&[PotentiallyVisibleRun]]| {
            PotentiallyVisibleBlocks::new(
                &arena,
                arena.list(chunks.iter().map(|runs| arena.list(runs.iter().cloned()))),
                20,
            )
            .rows()
        };
        assert_eq!(rows(&[&[run(5..7), run(2..4)], &[run(9..12), run(6..8)]]), Some(2..12));
        assert_eq!(rows(&[&[], &[run(3..4)]]), Some(3..4));
        assert_eq!(rows(&[&[], &[]]), None);
    }

    /// Sizes on either side of the table's end, and without a bound.
    #[test]
    fn boxes_of_rows_are_those_of_the_runs_there() {
        let sizes_px = [4.2, 4.9, 3.5, 258.4, 257.6, 256.6, 1000.0, f64::INFINITY, 5000.5];
        let runs: Vec<PotentiallyVisibleRun> = (0..200_u32)
            .map(|i| PotentiallyVisibleRun {
                first: i,
                blocks: 1,
                count: 1 + i * i % 256,
                box_px: sizes_px[(i * 7 % 9) as usize],
                rows: i % 17..i % 17 + 1 + i % 4,
                all_seen: true,
                all_in_view: true,
                all_of_level: true,
            })
            .collect();
        let arena = Arena::new();
        let seen = PotentiallyVisibleBlocks::new(&arena, arena.list([&runs[..90], &runs[90..]]), 20);
        for rows in [0..20, 3..4, 5..11, 19..20] {
            let found: Vec<(u32, f64)> = seen.boxes(&rows).collect();
            assert!(found.is_sorted_by(|a, b| a.1 < b.1), "{found:?}");
            for (count, px) in &found {
                let is_of_size = |run: &&PotentiallyVisibleRun| {
                    run.touches(&rows) && run.box_px <= *px && run.box_px + 1.0 >= *px
                };
                let expected: u32 = runs.iter().filter(is_of_size).map(|run| run.count).sum();
                assert_eq!(*count, expected, "{px} in {rows:?}");
            }
            let all: u32 = runs.iter().filter(|run| run.touches(&rows)).map(|run| run.count).sum();
            assert_eq!(found.iter().map(|(count, _)| count).sum::<u32>(), all, "{rows:?}");
        }
    }
}
