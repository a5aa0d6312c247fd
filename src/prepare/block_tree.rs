//! Runs of a chunk's blocks, and runs of those, each with bounds of all that is in it: a frame looks at few of them, however many splats there are.

use std::f64::consts::PI;

use glam::DVec3;

use super::{blocks::Block, level_bounds::LevelBounds, quad::Quad};

/// Nodes that have one above them: as many as a [`Quad`] has bounds.
pub const CHILDREN: usize = 4;

/// Nodes on top at most: with their blocks' splats on a Z-curve they lie apart from each other.
const MOST_ON_TOP: usize = 32;

/// Bounds of blocks and of runs of them, which lie near each other as their splats do.
#[derive(Clone, Debug, Default)]
pub struct BlockTree {
    /// The blocks; then those above them, level by level up to the top.
    pub levels: Vec<Vec<Quad>>,
    /// What decides about the levels of detail of each of them, alike, one by one; nothing where there are none.
    pub of_detail: Vec<Vec<LevelBounds>>,
}

impl BlockTree {
    /// Over these blocks.
    pub(super) fn new(blocks: &[Block]) -> Self {
        let quads = |blocks: &[Block]| blocks.chunks(CHILDREN).map(Quad::of).collect();
        let mut levels = vec![quads(blocks)];
        levels.extend(above(blocks).iter().map(|blocks| quads(blocks)));
        let bounds: Option<Vec<LevelBounds>> =
            blocks.iter().map(|block| Some(block.levels.as_ref()?.bounds)).collect();
        let mut of_detail = Vec::from_iter(bounds);
        while let Some(below) = of_detail.last().filter(|_| of_detail.len() < levels.len()) {
            of_detail.push(below.chunks(CHILDREN).map(LevelBounds::around).collect());
        }
        Self { levels, of_detail }
    }
}

impl BlockTree {
    /// Takes over changes of some of the blocks, by their numbers in order, none of which has levels of detail; `above` has what [`above`] made of the blocks before, and has then
    /// what it makes of these.
    pub(super) fn renew(
        &mut self,
        blocks: &[Block],
        above: &mut [Vec<Block>],
        changed: impl Iterator<Item = usize> + Clone,
    ) {
        let mut of_quad = CHILDREN;
        for level in 0..self.levels.len() {
            let (done, rest) = above.split_at_mut(level);
            let own: &[Block] = done.last().map_or(blocks, |own| own);
            for place in distinct(changed.clone().map(|block| block / of_quad)) {
                let end = own.len().min((place + 1) * CHILDREN);
                let children = &own[place * CHILDREN..end];
                self.levels[level][place] = Quad::of(children);
                if let Some(next) = rest.first_mut() {
                    next[place] = around(children);
                }
            }
            of_quad *= CHILDREN;
        }
    }
}

/// Numbers in order, each once.
pub(super) fn distinct<N: PartialEq + Copy>(numbers: impl Iterator<Item = N>) -> impl Iterator<Item = N> {
    let mut last = None;
    numbers.filter(move |number| last.replace(*number) != Some(*number))
}

/// Bounds of [`CHILDREN`] of these blocks, then of as many of those, and so on up to the top. None of few blocks.
pub(super) fn above(blocks: &[Block]) -> Vec<Vec<Block>> {
    let mut levels: Vec<Vec<Block>> = Vec::new();
    loop {
        let below = levels.last().map_or(blocks, |level| level);
        if below.len() <= MOST_ON_TOP {
            return levels;
        }
        let level = below.chunks(CHILDREN).map(around).collect();
        levels.push(level);
    }
}

/// Bounds of the splats of blocks. Angles between directions add up at most; a rounding has a reserve where bounds are looked at.
fn around(blocks: &[Block]) -> Block {
    let blocks = || blocks.iter().filter(|block| block.count > 0);
    if blocks().next().is_none() {
        return Block::EMPTY;
    }
    let [lo, hi] = blocks().fold([DVec3::INFINITY, DVec3::NEG_INFINITY], |[lo, hi], block| {
        [lo.min(block.center - block.radius), hi.max(block.center + block.radius)]
    });
    let center = 0.5 * (lo + hi);
    let sum: DVec3 = blocks().map(|block| block.axis).sum();
    let axis = sum.try_normalize();
    let spread_of = |axis: DVec3| {
        blocks().map(|block| axis.angle_between(block.axis) + block.spread_rad).fold(0.0, f64::max)
    };
    let spread_rad = axis.map_or(PI, spread_of).min(PI);
    Block {
        count: blocks().map(|block| block.count).sum(),
        center,
        radius: blocks().map(|block| block.center.distance(center) + block.radius).fold(0.0, f64::max),
        axis: axis.unwrap_or(DVec3::Z),
        spread_rad,
        spread_sin_cos: spread_rad.sin_cos().into(),
        largest_radius: blocks().map(|block| block.largest_radius).fold(0.0, f64::max),
        levels: None,
    }
}
