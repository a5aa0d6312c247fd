//! What all passes of a frame are given: of the whole scene, of one part of it, of one band of the image.

use ash::vk;

use super::{Draw, MeshDraw, Part, Shaders, TilePlan, listed::Listed, tiles::Band};
use crate::{
    graph::ImageDesc,
    scene::{Camera, Settings},
    vk::{DescriptorPool, Occlusion},
};

/// What all passes of a frame are given.
#[derive(Clone, Copy)]
pub struct Inputs<'a> {
    /// The splats that are drawn.
    pub draws: &'a [Draw<'a>],
    /// The polygons.
    pub meshes: &'a [MeshDraw<'a>],
    /// How the splats are drawn by tiles, where they are.
    pub tiles: Option<&'a TilePlan>,
    /// Bands of the image, where that is drawn in more than one.
    pub bands: &'a [Band<'a>],
    /// Where the splats are looked for that are listed, where only those are set up.
    pub kept: Option<&'a Listed>,
    /// What is hidden is left out before sums.
    pub leaves_hidden_out: bool,
    /// The scene's own lights.
    pub lights: u32,
    /// From where.
    pub camera: &'a Camera,
    /// How.
    pub settings: &'a Settings,
    /// Pipelines and their layouts.
    pub shaders: &'a Shaders,
    /// Descriptor sets that live as long as the frame; room for [`super::needs`].
    pub descriptors: &'a DescriptorPool,
    /// The queries of [`super::needs`], where it has any.
    pub occlusion: Option<&'a Occlusion>,
}

impl<'a> Inputs<'a> {
    /// Those of a frame in which nothing is drawn yet.
    pub fn new(
        camera: &'a Camera,
        settings: &'a Settings,
        shaders: &'a Shaders,
        descriptors: &'a DescriptorPool,
    ) -> Self {
        let (draws, meshes): (&[Draw<'_>], &[MeshDraw<'_>]) = (&[], &[]);
        Self {
            draws,
            meshes,
            tiles: None,
            bands: &[],
            kept: None,
            leaves_hidden_out: false,
            lights: 0,
            camera,
            settings,
            shaders,
            descriptors,
            occlusion: None,
        }
    }

    /// The same for one part of the scene.
    pub(super) fn of(self, part: &'a Part<'a>) -> Self {
        Self {
            draws: &part.splats,
            meshes: &part.meshes,
            tiles: part.tiles.as_ref(),
            bands: &part.bands,
            kept: part.kept.as_ref(),
            leaves_hidden_out: part.leaves_hidden_out(self.settings),
            ..self
        }
    }

    /// The same for each band by tiles, with what goes in front of its tiles in the names of passes.
    pub(super) fn of_bands(self) -> Vec<(String, Self)> {
        if self.bands.is_empty() {
            return vec![(String::new(), self)];
        }
        let of = |(number, band): (usize, &'a Band<'a>)| {
            let (draws, tiles, kept) = (band.splats.as_slice(), Some(&band.plan), Some(&band.listed));
            (format!("band-{number} "), Self { draws, tiles, kept, bands: &[], ..self })
        };
        (1..).zip(self.bands).map(of).collect()
    }

    pub(super) fn extent(&self) -> vk::Extent2D {
        let [width, height] = self.settings.size_px;
        vk::Extent2D { width, height }
    }

    pub(super) fn image(&self, format: vk::Format) -> ImageDesc {
        ImageDesc { format, extent: self.extent() }
    }
}
