//! The blocks of splats that may be seen (`blocks.rs`), and how many of their splats may touch which rows of tiles.

use std::{collections::BTreeMap, ops::Range};

/// A block some of whose splats may be seen.
#[derive(Clone, Debug, PartialEq)]
pub struct PotentiallyVisibleBlock {
    /// Its number in its chunk.
    pub number: u32,
    /// Its splats, of levels of detail those that may be drawn.
    pub count: u32,
    /// What no splat's box exceeds, in pixels; infinite where one may come near the eye plane.
    pub box_px: f64,
    /// The rows of tiles that they may touch.
    pub rows: Range<u32>,
    /// None of them faces away, where such are not drawn, or is nearer than the near plane or beside the image.
    pub all_seen: bool,
    /// All of them are of the level of detail that is drawn.
    pub all_of_level: bool,
}

impl PotentiallyVisibleBlock {
    /// Whether none of its splats is left out for where it is, where splats are looked for in these rows.
    pub fn is_within(&self, rows: &Range<u32>) -> bool {
        self.all_seen && rows.start <= self.rows.start && self.rows.end <= rows.end
    }

    /// Whether it may touch any of these rows.
    pub fn touches(&self, rows: &Range<u32>) -> bool {
        self.rows.start < rows.end && rows.start < self.rows.end
    }
}

/// The blocks of all chunks that may be seen, and how many of their splats may touch which rows.
pub struct PotentiallyVisibleBlocks {
    /// Chunk by chunk.
    pub chunks: Vec<Vec<PotentiallyVisibleBlock>>,
    classes: Vec<SizeClass>,
}

/// Splats with boxes up to a size.
struct SizeClass {
    box_px: f64,
    /// For each row: how many are in blocks that begin before it, and in such that end before it.
    begun: Vec<u32>,
    ended: Vec<u32>,
}

/// Boxes are told apart by so many pixels.
const SIZE_STEP_PX: f64 = 0.25;

impl PotentiallyVisibleBlocks {
    /// Those of some blocks, in an image with so many rows of tiles.
    pub fn new(chunks: Vec<Vec<PotentiallyVisibleBlock>>, rows: u32) -> Self {
        let mut classes: BTreeMap<u64, SizeClass> = BTreeMap::new();
        for block in chunks.iter().flatten() {
            let box_px = (block.box_px / SIZE_STEP_PX).ceil() * SIZE_STEP_PX;
            let none = || vec![0; rows as usize + 1];
            let class = classes.entry(box_px.to_bits()).or_insert_with(|| SizeClass {
                box_px,
                begun: none(),
                ended: none(),
            });
            // In the row behind the one where it begins or ends; then summed up.
            class.begun[block.rows.start as usize + 1] += block.count;
            class.ended[block.rows.end as usize] += block.count;
        }
        let mut classes: Vec<_> = classes.into_values().collect();
        for class in &mut classes {
            for row in 1..=rows as usize {
                class.begun[row] += class.begun[row - 1];
                class.ended[row] += class.ended[row - 1];
            }
        }
        Self { chunks, classes }
    }

    /// How many splats have boxes up to how many pixels, of the blocks that may touch these rows.
    pub fn boxes(&self, rows: &Range<u32>) -> Vec<(u32, f64)> {
        let of = |class: &SizeClass| {
            (class.begun[rows.end as usize] - class.ended[rows.start as usize], class.box_px)
        };
        self.classes.iter().map(of).filter(|(count, _)| *count > 0).collect()
    }

    /// The rows that any of them may touch; `None` where there is none.
    pub fn rows(&self) -> Option<Range<u32>> {
        let rows = || self.chunks.iter().flatten().map(|block| &block.rows);
        Some(rows().map(|rows| rows.start).min()?..rows().map(|rows| rows.end).max()?)
    }
}
