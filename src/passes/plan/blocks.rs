//! Which blocks of a chunk may be seen, and in which rows of tiles: found on the host, by what bounds all splats of a block.

pub(super) mod walk;

use std::ops::Range;

use glam::{DVec3, DVec4};

use crate::passes::plan::{
    levels::{LevelView, OfBlock},
    seen::PotentiallyVisibleRun,
};
use crate::{
    math::size::{SizeBound, box_within_px},
    prepare::{Block, ViewFromLocal},
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

/// What a device finds in f32 of a unit vector may differ from this file's f64 by so much of an angle: some roundings of 2⁻²⁴, and a
/// packed normal's; much less than this.
const ANGLE_RESERVE_RAD: f64 = 1e-3;

/// Its cosine; its sine is itself but for a ten-thousandth of a millionth.
const COS_RESERVE: f64 = 0.999_999_5;

/// The same of a place, as a part of its distance from the eye; and of the distances of the chunk's origin from both, whose difference it
/// is to a device: its sum of four terms is off by some 6 roundings of 2⁻²⁴ of them, 4e-7.
const LENGTH_RESERVE: f64 = 1e-5;
const ORIGIN_RESERVE: f64 = 1e-6;

/// So far beyond a splat's image a device looks for what a filter makes of it, 2 h (`glsl/inc/outside.glsl`) with h up to √2: less than 3 pixels, roundings and all.
const FILTER_RESERVE_PX: f64 = 3.0;

/// What no box of a block's splats exceeds that are no nearer, and no farther from the middle along x and y in the image plane.
fn box_at_px(block: &Block, nearest_z: f64, most_x: f64, look: &BlockCullView<'_>) -> f64 {
    let largest_radius = block.largest_radius * look.view.view_from_local_scale;
    // A box is the smaller the farther off.
    let bound = SizeBound { nearest_z: nearest_z.max(look.bound.nearest_z), largest_radius, ..*look.bound };
    box_within_px(&bound, largest_radius, most_x.min(look.half_image))
}

/// What is seen of a block, or of several that lie in a row within its bounds. Whether it is seen is asked once, at the end: a branch that is predicted
/// wrongly takes as long as half of the rest. In line, as the caller's loads of what it returned would wait for its stores, which are of other widths.
#[inline(always)]
fn look_at(
    first: u32,
    blocks: u32,
    block: &Block,
    look: &BlockCullView<'_>,
) -> Option<PotentiallyVisibleRun> {
    let of_levels = match (look.levels, &block.levels) {
        (Some(view), Some(block)) => view.of(block),
        _ => OfBlock::All,
    };
    if of_levels == OfBlock::None {
        return None;
    }
    let ball = Ball::of(block, look);
    let [faces_away, faces_eye] = ball.faces(block, look);
    let Image { rows, most_x, is_seen, is_whole } = ball.image(look);
    if !is_seen | (look.culls & faces_away) || look.planes.iter().any(|plane| ball.is_beyond(*plane, look)) {
        return None;
    }
    let of_level = match (look.levels, &block.levels) {
        (Some(view), Some(block)) => view.largest_box_px(block, look.bound.filter_px),
        _ => f64::INFINITY,
    };
    Some(PotentiallyVisibleRun {
        first,
        blocks,
        count: match (look.levels, &block.levels) {
            (Some(view), Some(levels)) => view.most_drawn(levels, block.count),
            _ => block.count,
        },
        box_px: box_at_px(block, ball.z - ball.reach, most_x, look).min(of_level),
        rows,
        all_seen: is_whole & look.planes.is_empty() & (!look.culls | faces_eye),
        all_of_level: of_levels == OfBlock::All,
    })
}

/// A block from the eye, in the view's unit.
struct Ball {
    /// Its middle from the eye, in the local space's axes.
    middle: DVec3,
    /// How far from there centers are.
    radius: f64,
    /// How far anything of its splats is.
    reach: f64,
    /// Its middle in view space.
    x: f64,
    y: f64,
    z: f64,
}

/// Where a block's splats may be seen.
struct Image {
    /// In which rows of tiles.
    rows: Range<u32>,
    /// No farther from the middle, along x and y in the image plane.
    most_x: f64,
    /// Some of it may be within the image.
    is_seen: bool,
    /// None of it is beside the image.
    is_whole: bool,
}

impl Ball {
    #[inline(always)]
    fn of(block: &Block, look: &BlockCullView<'_>) -> Self {
        let scale = look.view.view_from_local_scale;
        let middle = block.center * scale + look.view.origin_from_eye;
        // Of any splat: its block's middle may be the chunk's origin, and the eye. No less than its distance.
        let distance = middle.x.abs() + middle.y.abs() + middle.z.abs();
        let reserve = LENGTH_RESERVE * distance + ORIGIN_RESERVE * look.by_origin;
        let radius = block.radius * scale + reserve;
        let [x, y, z] = (look.view.rotation * middle).into();
        // A splat's points are within its radius, its image within that of twice as much.
        Self { middle, radius, reach: radius + 2.0 * block.largest_radius * scale, x, y, z }
    }

    /// Whether all that is drawn of its splats is on the side of a plane that is cut off: no farther from a splat than it is large and a filter, which is the larger
    /// the deeper, reaches.
    fn is_beyond(&self, plane: DVec4, look: &BlockCullView<'_>) -> bool {
        let depth = if look.bound.is_orthographic { 1.0 } else { self.z + self.reach };
        let of_filter = FILTER_RESERVE_PX / look.bound.focal_px * depth.max(0.0);
        let inside = plane.truncate().dot(DVec3::new(self.x, self.y, self.z)) + plane.w;
        let reserve = LENGTH_RESERVE * (plane.w.abs() + self.z.abs());
        inside < -(self.reach + of_filter + reserve)
    }

    /// Where it may be seen.
    #[inline(always)]
    fn image(&self, look: &BlockCullView<'_>) -> Image {
        let ([width, height], [axis_x_px, axis_y_px]) = (look.bound.size_px, look.bound.middle_px);
        let end = (height as u32).div_ceil(BAND_ROW);
        let is_orthographic = look.bound.is_orthographic;
        let is_far = is_orthographic | (self.reach <= 0.25 * self.z); // NaN is not
        // A point d from the middle is seen (d_x − c d_z) / (z + d_z) from the middle's image c, |d| √(1 + c²) / (z − |d|) at most.
        let (per_z, away_per_z) = match is_orthographic {
            true => (1.0, self.reach),
            false => (1.0 / self.z, self.reach / (self.z - self.reach)),
        };
        let [x, y] = [self.x, self.y].map(|side| {
            let c = side * per_z;
            (c, if is_orthographic { away_per_z } else { away_per_z * (1.0 + c.abs()) })
        });
        let in_px = |(c, away): (f64, f64), axis_px: f64| {
            let (middle_px, away_px) = (axis_px + c * look.bound.focal_px, away * look.bound.focal_px);
            [middle_px - away_px - FILTER_RESERVE_PX, middle_px + away_px + FILTER_RESERVE_PX]
        };
        let (x_px, y_px) = (in_px(x, axis_x_px), in_px(y, axis_y_px));
        let is_beside = (x_px[1] < 0.0) | (x_px[0] > width) | (y_px[1] < 0.0) | (y_px[0] > height);
        let row = |y: f64| (y.clamp(0.0, height) as u32) / BAND_ROW;
        let [first, last] = y_px.map(|y| row(y).min(end - 1));
        let within = |px: [f64; 2], side: f64| (px[0] >= 0.0) & (px[1] <= side);
        let is_within = (self.z - self.reach > look.bound.near) & within(x_px, width) & within(y_px, height);
        let is_too_near = self.z + self.reach < look.bound.near; // NaN is not
        let most_x = (x.0.abs() + x.1).max(y.0.abs() + y.1);
        Image {
            rows: if is_far { first..last + 1 } else { 0..end },
            most_x: if is_far { most_x } else { f64::INFINITY },
            is_seen: !is_too_near & !(is_far & is_beside),
            is_whole: is_far & is_within,
        }
    }

    /// Whether all splats face away, and whether all face the eye. Where a normal and the ray to its center have an angle above 90° it is the face. From outside a ball is seen within
    /// the arc sine α of its radius over its distance; angles of directions add up at most: with the spread σ of normals about an axis, which has an angle θ with
    /// the ray to the middle, all angles are above 90° where θ − α − σ is, cos θ < −sin(α + σ), and below where θ + α + σ is, cos θ > sin(α + σ); if α + σ
    /// itself is less.
    #[inline(always)]
    fn faces(&self, block: &Block, look: &BlockCullView<'_>) -> [bool; 2] {
        let (middle, squared, radius) = match look.bound.is_orthographic {
            true => (look.view.rotation.row(2), 1.0, 0.0),
            false => (self.middle, self.middle.length_squared(), self.radius),
        };
        let is_outside = radius * radius < squared; // NaN is not
        let [sin, cos] = block.spread_sin_cos;
        let (sin, cos) =
            (sin * COS_RESERVE + cos * ANGLE_RESERVE_RAD, cos * COS_RESERVE - sin * ANGLE_RESERVE_RAD);
        // Times the distance, as the sum of two angles has them.
        let tangent = (squared - radius * radius).sqrt();
        let (sin_of_sum, cos_of_sum) = (radius * cos + tangent * sin, tangent * cos - radius * sin);
        let along = block.axis.dot(middle);
        let is_known = is_outside & (cos_of_sum > 0.0);
        [is_known & (along > sin_of_sum), is_known & (along < -sin_of_sum)]
    }
}

#[cfg(test)]
mod tests;
