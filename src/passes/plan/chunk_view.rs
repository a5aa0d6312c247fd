//! A chunk as a frame's camera sees it, however it is drawn.

use glam::DVec4;

use crate::{
    math::{
        size::{SizeBound, box_within_px},
        within::is_within_px,
    },
    passes::pipeline::constants::FrameConstants,
    passes::plan::{
        blocks::BlockCullView,
        in_view::{center_and_half, wholly_in_view},
        levels::LevelView,
    },
    prepare::{Chunk, ViewFromLocal},
};

/// Splats of a prepared scene as a camera sees them. All draws of them share it: lists of draws are copied, band by band.
#[derive(Clone, Copy)]
pub struct ChunkView<'a> {
    /// The splats.
    pub chunk: &'a Chunk,
    /// The number of their scene among those that the frame shows.
    pub placed: u32,
    /// What no box exceeds of its level of detail that is drawn, in pixels; infinite where there is none.
    pub(super) of_level_px: f64,
    /// From where, for lists of blocks.
    pub(super) view: ViewFromLocal,
    pub(super) bound: SizeBound,
    /// As `in_view.rs` has it.
    pub(super) by_origin: f64,
    /// The planes that cut what is seen, in view space: unit normals toward what is left, and by how much the eye is inside.
    pub(super) planes: &'a [DVec4],
    /// As [`crate::math::size::half_image`] has it.
    pub(super) half_image: f64,
    /// What shaders are told, wherever it is among others.
    pub constants: FrameConstants,
}

impl ChunkView<'_> {
    /// What no splat's box exceeds, in pixels; infinite where one may come near the eye plane.
    pub fn largest_box_px(&self) -> f64 {
        self.box_px(self.bound.largest_radius)
    }

    /// Whether that is more than so many pixels.
    pub(super) fn exceeds(&self, px: f64) -> bool {
        !is_within_px(&self.bound, self.half_image, px) && self.largest_box_px() > px
    }

    fn box_px(&self, radius: f64) -> f64 {
        box_within_px(&self.bound, radius, self.half_image).min(self.of_level_px)
    }

    /// How many splats have boxes up to how many pixels, as far as that is told apart; infinite as [`Self::largest_box_px`].
    pub(crate) fn boxes(&self) -> impl Iterator<Item = (u32, f64)> + Clone {
        self.chunk.radii.iter().map(|step| {
            let radius = step.radius * self.view.view_from_local_scale;
            (step.count, self.box_px(radius))
        })
    }

    /// Whether no splat's center lies outside of the view, nor may be cut off, as far as a box around all of them tells.
    pub(super) fn is_wholly_in_view(&self) -> bool {
        self.planes.is_empty() && wholly_in_view(self.chunk, &self.view, &self.bound)
    }

    /// How its blocks are looked at where what faces away is not drawn, or is, and of its levels of detail as these are seen.
    pub(super) fn look<'b>(&'b self, culls: bool, levels: Option<&'b LevelView>) -> BlockCullView<'b> {
        let Self { view, bound, planes, by_origin, half_image, .. } = self;
        BlockCullView { view, bound, culls, levels, planes, by_origin: *by_origin, half_image: *half_image }
    }

    /// The largest depth of a splat's center, in view space.
    pub(super) fn farthest_z(&self) -> f64 {
        let row = self.view.rotation.row(2);
        let [center, half] = center_and_half(self.chunk);
        (row.dot(center) + row.abs().dot(half)) * self.view.view_from_local_scale + self.view.translation.z
    }
}
