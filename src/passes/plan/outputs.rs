//! What a frame is to leave beside its picture, and what follows from it.

use crate::{
    passes::{pipeline::formats::sum_format, plan::SurfacePlan},
    scene::{Accumulate, Edges, Settings},
};

/// What is wanted of a frame beside its picture, and in which format that is.
#[derive(Clone, Copy)]
pub(crate) struct Outputs {
    /// The opaque surface as data: sums, of depth too, are read everywhere.
    pub surface: bool,
    /// The opaque surface's own depth, for a host that draws beside it.
    pub depth: bool,
    /// Transparent layers lie before the opaque surface.
    pub layers: bool,
    /// The picture's format.
    pub target_format: ash::vk::Format,
}

impl Outputs {
    /// Sums and depth are read everywhere, not only where finalization shades.
    pub fn reads_whole_images(self) -> bool {
        self.surface || self.depth || self.layers
    }

    /// Depth is summed where sums are.
    pub fn sums_depth(self) -> bool {
        self.surface || self.depth
    }

    /// Whether tiles of these opaque things can be shaded at once. Where they cover pixels in part, they leave layers a depth beside
    /// what they show.
    pub fn may_be_shaded(self, opaque: &SurfacePlan<'_>) -> bool {
        let read = self.surface || self.layers && opaque.settings.edges == Edges::Hard;
        !read && opaque.tiles_can_shade(&opaque.settings)
    }

    /// The precision of samples of polygons, of which there are four a pixel: no more than the target has.
    pub fn sample_precision(self) -> Accumulate {
        match self.target_format == sum_format(Accumulate::F32) {
            true => Accumulate::F32,
            false => Accumulate::F16,
        }
    }

    /// The format of tiles that are shaded at once: a target of 32 bits loses nothing by them.
    pub fn shaded_precision(self, settings: &Settings) -> Accumulate {
        match self.target_format == sum_format(Accumulate::F32) {
            true => Accumulate::F32,
            false => settings.accumulate,
        }
    }
}
