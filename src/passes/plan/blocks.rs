//! Which blocks of a chunk may be seen, and in which rows of tiles: found on the host, by what bounds all splats of a block.

mod balls;
pub(super) mod walk;

use glam::{DVec4, Vec4};

use crate::passes::plan::{
    blocks::balls::{Balls, Eye},
    levels::{LevelView, OfBlock},
    seen::PotentiallyVisibleRun,
};
use crate::{
    arena::ArenaVec,
    math::size::{SizeBound, boxes_within_px},
    prepare::{Block, LevelBounds, Quad, ViewFromLocal},
    shaders::config::BAND_ROW,
};

/// How blocks are looked at.
#[derive(Clone, Copy)]
pub struct BlockCullView<'a> {
    /// The motion to view space.
    pub view: &'a ViewFromLocal,
    /// What bounds the images of the chunk's splats.
    pub bound: &'a SizeBound,
    /// Splats that face away are not drawn.
    pub culls: bool,
    /// Levels of detail, where some are drawn.
    pub levels: Option<&'a LevelView>,
    /// The planes that cut what is seen, in view space.
    pub planes: &'a [DVec4],
    /// How far the chunk's origin is from the eye, and from there the farthest of its centers, together, in the view's unit.
    pub by_origin: f64,
    /// [`half_image`] of the bound: the same for all blocks.
    pub half_image: f64,
}

impl BlockCullView<'_> {
    fn eye(&self) -> Eye {
        Eye::new(self.view, self.bound, self.by_origin)
    }
}

/// Where the blocks of a quad are, or the runs of blocks that it bounds.
#[derive(Clone, Copy)]
struct Place<'a> {
    /// The first block of all.
    first: u32,
    /// Blocks of each.
    each: u32,
    /// The end of the last.
    end: u32,
    /// What decides about their levels of detail, where there are any; and, of single ones, the blocks.
    of_detail: &'a [LevelBounds],
    blocks: &'a [Block],
}

/// What is seen of neighbors; each is a run of blocks, or one. All four are computed alike, without a branch on what is found: one that is predicted wrongly takes as long as half of the rest.
fn look_at(
    runs: &mut ArenaVec<'_, PotentiallyVisibleRun>,
    place: Place<'_>,
    quad: &Quad,
    (look, eye): (&BlockCullView<'_>, &Eye),
) {
    let balls = Balls::of(quad, eye);
    let image = balls.image(eye);
    let (mut seen, mut in_view) = (image.seen & quad.filled, image.whole);
    for plane in look.planes {
        (seen, in_view) = (seen & !balls.are_beyond(plane.as_vec4(), eye), 0);
    }
    let mut whole = in_view;
    if look.culls {
        let [faces_away, faces_eye] = balls.faces(quad, eye);
        (seen, whole) = (seen & !faces_away, whole & faces_eye);
    }
    let nearest_z = balls.nearest_z().max(Vec4::splat(look.bound.nearest_z as f32));
    let most_x = image.most_x.min(Vec4::splat(look.half_image as f32));
    let radius = quad.largest_radius * look.view.view_from_local_scale as f32;
    // A box is the smaller the farther off.
    let boxes_px = boxes_within_px(look.bound, [nearest_z, radius, most_x]).to_array();
    let (top_px, bottom_px) = (image.y_px[0].to_array(), image.y_px[1].to_array());
    let height = look.bound.size_px[1] as f32;
    let end = (height as u32).div_ceil(BAND_ROW);
    let row = |y_px: f32| (y_px.clamp(0.0, height) as u32 / BAND_ROW).min(end - 1);
    for i in (0..4).filter(|i| seen >> i & 1 != 0) {
        let is = |mask: u32| mask >> i & 1 != 0;
        let first = place.first + i as u32 * place.each;
        let mut run = PotentiallyVisibleRun {
            first,
            blocks: place.each.min(place.end - first),
            count: quad.counts[i],
            box_px: boxes_px[i].into(),
            // NaN is the whole image.
            rows: if is(image.far) && top_px[i] <= bottom_px[i] {
                row(top_px[i])..row(bottom_px[i]) + 1
            } else {
                0..end
            },
            all_seen: is(whole),
            all_in_view: is(in_view),
            all_of_level: true,
        };
        if let (Some(view), Some(bounds)) = (look.levels, place.of_detail.get(i)) {
            let drawn = view.of(bounds);
            if drawn == OfBlock::None {
                continue;
            }
            run.all_of_level = drawn == OfBlock::All;
            run.box_px = run.box_px.min(view.largest_box_px(bounds, look.bound.filter_px));
            let levels = place.blocks.get(i).filter(|_| !run.all_of_level);
            if let Some(levels) = levels.and_then(|block| block.levels.as_ref()) {
                run.count = view.most_drawn(levels, run.count);
            }
        }
        runs.push(run);
    }
}

#[cfg(test)]
mod at_once;
#[cfg(test)]
mod of_detail;
#[cfg(test)]
mod tests;
