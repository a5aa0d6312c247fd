//! From a chunk's coarsest bounds down to its blocks, where that tells more: no more looks than a frame has time for, however many blocks there are.

use super::{BlockCullView, look_at};
use crate::{
    arena::{Arena, ArenaVec},
    passes::plan::seen::PotentiallyVisibleRun,
    prepare::{Block, CHILDREN, Chunk},
};

/// Looks at bounds of a chunk, beside those on top; and where memory for lists is short, so that it matters how many splats may be in which rows.
const MOST_LOOKS: usize = 256;
const MOST_CLOSE_LOOKS: usize = 16_384;

/// The blocks of a chunk some of whose splats may be seen, in their order. What is left out here, every stage that sets splats up
/// would leave out: what faces away, what is nearer than the near plane, and what is beside the image, by the bounds of
/// `glsl/mark_visible.comp.glsl`, of a ball in place of a splat.
///
/// The ball has all points within 2 R of a center. A splat's image, a filter's h aside, reaches R √(1 + c²) / (p_z − R) from its center's
/// image c at most (there). The image of a ball of 2 R about that center reaches 2 R √(1 + c²) / (p_z + 2 R) at least, which is
/// no less where p_z ≥ 4 R; and it is, where the whole ball's reach is within a quarter of its depth. Under parallel rays all of that is as
/// large as it is.
///
/// Runs of blocks are looked at from the top of their tree: of one that is seen as a whole nothing below is, unless `closely`, for fewer rows. So what is looked at by
/// itself is at silhouettes, at borders of the image, and near; where that is more than so many looks, the rest is left to the device.
pub(in crate::passes::plan) fn potentially_visible_runs<'m>(
    arena: &'m Arena,
    chunk: &Chunk,
    look: &BlockCullView<'_>,
    closely: bool,
) -> &'m [PotentiallyVisibleRun] {
    let blocks = &chunk.blocks;
    // Of a chunk that a host writes, the blocks have the same bounds: one is looked at for all.
    if let (true, Some(first)) = (chunk.is_dynamic(), blocks.first()) {
        let all = Block { count: chunk.count, levels: None, ..*first };
        return arena.list(look_at(0, blocks.len() as u32, &all, look));
    }
    let levels = &chunk.tree.levels;
    let add = |front: &mut ArenaVec<'m, (PotentiallyVisibleRun, Closer)>,
               [number, each]: [usize; 2],
               nodes: &[Block]| {
        let firsts = (number * each..).step_by(each);
        let runs = firsts.zip(nodes).filter_map(|(first, node)| {
            look_at(first as u32, each.min(blocks.len() - first) as u32, node, look)
        });
        front.extend(runs.map(|run| {
            let closer = match run.all_seen {
                false => Closer::First,
                true if closely => Closer::Perhaps,
                true => Closer::No,
            };
            (run, closer)
        }));
    };
    let mut each = CHILDREN.pow(levels.len() as u32);
    let mut front = arena.growing();
    add(&mut front, [0, each], levels.last().unwrap_or(blocks));
    let mut left = if closely { MOST_CLOSE_LOOKS } else { MOST_LOOKS };
    for level in levels.iter().rev().skip(1).chain([blocks]).take(levels.len()) {
        let count = |of: Closer| front.iter().filter(|(_, closer)| *closer == of).count();
        // Where there are too many, evenly some of them.
        let mut shares = [Closer::First, Closer::Perhaps].map(|of| {
            let wanted = count(of);
            let chosen = wanted.min(left / CHILDREN);
            left -= chosen * CHILDREN;
            Share { wanted, chosen, met: 0 }
        });
        if shares.iter().all(|share| share.chosen == 0) {
            break;
        }
        each /= CHILDREN;
        let mut closer = arena.growing();
        for (run, of) in front {
            let is_chosen = match of {
                Closer::First => shares[0].next(),
                Closer::Perhaps => shares[1].next(),
                Closer::No => false,
            };
            if is_chosen {
                let first = run.first as usize / each;
                add(&mut closer, [first, each], &level[first..level.len().min(first + CHILDREN)]);
            } else {
                closer.push((run, Closer::No));
            }
        }
        front = closer;
    }
    arena.list(front.into_iter().map(|(run, _)| run))
}

/// Whether what is below a run is looked at.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Closer {
    /// Some of it may not be seen.
    First,
    /// All of it is seen; its parts are in fewer rows, and have smaller boxes.
    Perhaps,
    No,
}

/// Some of those that want something, evenly chosen.
struct Share {
    wanted: usize,
    chosen: usize,
    met: usize,
}

impl Share {
    /// Whether the next one is chosen.
    fn next(&mut self) -> bool {
        self.met += 1;
        self.met * self.chosen / self.wanted > (self.met - 1) * self.chosen / self.wanted
    }
}
