//! From a chunk's coarsest bounds down to its blocks, where that tells more: no more looks than a frame has time for, however many blocks there are.

use std::ops::Range;

use super::{BlockCullView, Place, balls::Eye, look_at};
use crate::{
    arena::{Arena, ArenaVec},
    passes::plan::seen::PotentiallyVisibleRun,
    prepare::{Block, CHILDREN, Chunk, Quad},
    shaders::config::BAND_ROW,
};

/// Looks at bounds of a chunk, beside those on top.
const MOST_LOOKS: usize = 256;

/// The same of levels of detail: how many splats lists have room for is then known from blocks alone.
const MOST_LOOKS_AT_LEVELS: usize = 4096;

/// Runs in place of which there are to be their parts, for what that tells; where memory for lists is short, so that it matters how many splats there are, and then in which rows.
#[derive(Clone, Copy)]
pub(crate) enum Closer<'a> {
    /// Those of which something may be hidden: most of what is listed for nothing lies at silhouettes.
    InPart,
    /// Those that reach over many rows.
    Tall,
    /// Those that reach over one of these rows, at which bands are to end.
    Cut(&'a [u32]),
}

/// A run is tall that reaches over more than one of so many parts of the image.
const TALL: u32 = 8;

impl Closer<'_> {
    /// Looks at a chunk.
    fn most_looks(self) -> usize {
        match self {
            Self::InPart => 4096,
            Self::Tall => 256,
            Self::Cut(_) => 2048,
        }
    }

    fn wants(self, run: &PotentiallyVisibleRun, rows: u32) -> bool {
        match self {
            Self::InPart => !run.all_seen,
            Self::Tall => run.rows.len() as u32 * TALL > rows,
            Self::Cut(ends) => ends.iter().any(|row| run.rows.start < *row && *row < run.rows.end),
        }
    }
}

/// The blocks of a chunk some of whose splats may be seen, in their order. What is left out here, every stage that sets splats up
/// would leave out: what faces away, what is nearer than the near plane, and what is beside the image, by the bounds of
/// `glsl/mark_visible.comp.glsl`, of a ball in place of a splat.
///
/// The ball has all points within 2 R of a center. A splat's image, a filter's h aside, reaches R √(1 + c²) / (p_z − R) from its center's
/// image c at most (there). The image of a ball of 2 R about that center reaches 2 R √(1 + c²) / (p_z + 2 R) at least, which is
/// no less where p_z ≥ 4 R; and it is, where the whole ball's reach is within a quarter of its depth. Under parallel rays all of that is as
/// large as it is.
///
/// Runs of blocks are looked at from the top of their tree: of one that is seen as a whole nothing below is. So what is looked at by itself is at silhouettes, at borders of the
/// image, near, and where one level of detail follows another; where that is more than so many looks, the rest is left to the device.
pub(in super::super) fn potentially_visible_runs<'m>(
    arena: &'m Arena,
    chunk: &Chunk,
    look: &BlockCullView<'_>,
) -> &'m [PotentiallyVisibleRun] {
    let blocks = &chunk.blocks;
    // Of a chunk that a host writes, the blocks have the same bounds: one is looked at for all.
    let mut top = arena.growing();
    if let (true, Some(first)) = (chunk.is_dynamic(), blocks.first()) {
        let all = Quad::of(&[Block { count: chunk.count, levels: None, ..*first }]);
        let end = blocks.len() as u32;
        let place = Place { first: 0, each: end, end, of_detail: &[], blocks: &[] };
        look_at(&mut top, place, &all, (look, &look.eye()));
        return top.into_bump_slice();
    }
    let Some(level) = chunk.tree.levels.len().checked_sub(1) else { return &[] };
    top.reserve(chunk.tree.levels[level].len() * CHILDREN);
    let eye = look.eye();
    look_at_quads(&mut top, chunk, (level, 0..usize::MAX), (look, &eye));
    let most = if look.levels.is_some() { MOST_LOOKS_AT_LEVELS } else { MOST_LOOKS };
    looked_into(arena, chunk, (look, &eye), top, most, |run| !run.all_seen || !run.all_of_level)
}

/// All blocks of a chunk that lies within the view, as one run, with no more splats than may face the eye: known by one look, however many there are. `None` where more has to be looked at: where some may be outside of the
/// view, or the eye is near; or where there is only one quad of them.
pub(in super::super) fn run_of_all<'m>(
    arena: &'m Arena,
    chunk: &Chunk,
    look: &BlockCullView<'_>,
) -> Option<&'m [PotentiallyVisibleRun]> {
    let facing = chunk.facing.as_ref().filter(|_| look.culls && look.planes.is_empty())?;
    let end = chunk.blocks.len() as u32;
    let mut runs = arena.growing();
    runs.reserve(1);
    look_at(
        &mut runs,
        Place { first: 0, each: end, end, of_detail: &[], blocks: &[] },
        &facing.whole,
        (&BlockCullView { culls: false, ..*look }, &look.eye()),
    );
    let Some(run) = runs.first_mut() else { return Some(&[]) };
    if !run.all_in_view {
        return None;
    }
    // Which way they face is told by their number alone.
    run.all_seen = false;
    run.count = match look.bound.is_orthographic {
        true => facing.most(-look.view.rotation.row(2), true)?,
        false => {
            let origin = look.view.origin_from_eye;
            let near = facing.farthest() * look.view.view_from_local_scale / origin.length();
            facing.most_toward(-origin, near)?
        }
    };
    Some(runs.into_bump_slice())
}

/// These runs, and in place of some of them their parts.
pub(in super::super) fn closer_runs<'m>(
    arena: &'m Arena,
    chunk: &Chunk,
    look: &BlockCullView<'_>,
    runs: &[PotentiallyVisibleRun],
    closer: Closer<'_>,
) -> &'m [PotentiallyVisibleRun] {
    let mut front = arena.growing();
    front.reserve(runs.len());
    front.extend(runs.iter().cloned());
    if chunk.is_dynamic() {
        return front.into_bump_slice();
    }
    let rows = (look.bound.size_px[1] as u32).div_ceil(BAND_ROW);
    looked_into(arena, chunk, (look, &look.eye()), front, closer.most_looks(), |run| closer.wants(run, rows))
}

/// Looks at some quads of a level of a chunk's tree.
fn look_at_quads(
    runs: &mut ArenaVec<'_, PotentiallyVisibleRun>,
    chunk: &Chunk,
    (level, range): (usize, Range<usize>),
    look: (&BlockCullView<'_>, &Eye),
) {
    let (quads, of_detail) = (&chunk.tree.levels[level], chunk.tree.of_detail.get(level));
    let each = CHILDREN.pow(level as u32);
    let end = chunk.blocks.len() as u32;
    let range = range.start..range.end.min(quads.len());
    for number in range {
        let first = number * CHILDREN * each;
        let blocks = if level == 0 { &chunk.blocks[first..] } else { &[] };
        let of_detail = of_detail.map_or(&[][..], |of_detail| &of_detail[number * CHILDREN..]);
        let place = Place { first: first as u32, each: each as u32, end, of_detail, blocks };
        look_at(runs, place, &quads[number], look);
    }
}

/// Runs, in place of which there are those below them where that is wanted, from the top down: of as many as so many looks are enough for, evenly some of them.
fn looked_into<'m>(
    arena: &'m Arena,
    chunk: &Chunk,
    (look, eye): (&BlockCullView<'_>, &Eye),
    mut front: ArenaVec<'m, PotentiallyVisibleRun>,
    mut looks: usize,
    wants: impl Fn(&PotentiallyVisibleRun) -> bool,
) -> &'m [PotentiallyVisibleRun] {
    for level in (1..chunk.tree.levels.len()).rev() {
        let each = CHILDREN.pow(level as u32);
        // The last run of a level may be short, and is then that of a lower one, too.
        let is_wanted = |run: &PotentiallyVisibleRun| {
            (each / CHILDREN + 1..=each).contains(&(run.blocks as usize)) && wants(run)
        };
        let wanted = front.iter().filter(|run| is_wanted(run)).count();
        let chosen = wanted.min(looks / CHILDREN);
        if chosen == 0 {
            continue;
        }
        looks -= chosen * CHILDREN;
        let (mut share, mut below) = (Share { wanted, chosen, met: 0 }, arena.growing());
        below.reserve(front.len() + chosen * (CHILDREN - 1));
        for run in front {
            if is_wanted(&run) && share.next() {
                let quad = run.first as usize / each;
                look_at_quads(&mut below, chunk, (level - 1, quad..quad + 1), (look, eye));
            } else {
                below.push(run);
            }
        }
        front = below;
    }
    front.into_bump_slice()
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
