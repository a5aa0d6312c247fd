//! What all passes of a frame are given: of the whole scene, of one part of it, of one band of the image.

use ash::vk;

use crate::passes::{
    pass::{Place, Source},
    pipeline::constants::FinalizeConstants,
    place::Tints,
    plan::{
        SplatMethod, SurfacePlan, bands::Band, block_list::ListedBlocks, draws::Draw, mesh_draws::MeshDraw,
        range::DepthRange, tiles::TilePlan,
    },
};
use crate::{
    arena::Arena,
    graph::ImageDesc,
    math::srgb::linear_from_srgb,
    scene::{Camera, Settings},
    vk::Occlusion,
};

/// What all passes of a frame are given.
#[derive(Clone, Copy)]
pub struct Inputs<'a> {
    /// The splats that are drawn.
    pub draws: &'a [Draw<'a>],
    /// The polygons.
    pub meshes: &'a [MeshDraw<'a>],
    /// Bands of tiles, where splats are drawn so.
    pub bands: &'a [Band<'a>],
    /// Where the splats are looked for that are listed, where only those are set up.
    pub listed: Option<ListedBlocks<'a>>,
    /// What is hidden is left out before sums.
    pub culls_hidden: bool,
    /// The scene's own lights.
    pub lights: u32,
    /// From where.
    pub camera: &'a Camera,
    /// How deep an orthographic camera sees.
    pub range: DepthRange,
    /// How.
    pub settings: &'a Settings,
    /// Where pipelines and sets come from; the pool of sets lives as long as the frame and has room for [`crate::passes::needs`].
    pub source: Source<'a>,
    /// The tints of what is opaque and of what is transparent, where there are any.
    pub tints: [Option<Tints>; 2],
    /// The queries of [`crate::passes::needs`], where it has any.
    pub occlusion: Option<&'a Occlusion>,
}

impl<'a> Inputs<'a> {
    /// Those of a frame in which nothing is drawn yet.
    pub fn new(camera: &'a Camera, settings: &'a Settings, place: Place<'a>) -> Self {
        let (draws, meshes): (&[Draw<'_>], &[MeshDraw<'_>]) = (&[], &[]);
        Self {
            draws,
            meshes,
            bands: &[],
            listed: None,
            culls_hidden: false,
            lights: 0,
            camera,
            range: DepthRange::default(),
            settings,
            source: Source::new(place, camera),
            tints: [None; 2],
            occlusion: None,
        }
    }

    /// Inputs for the opaque or the transparent things of a scene.
    pub(crate) fn of(self, plan: &'a SurfacePlan<'a>) -> Self {
        let culls_hidden = matches!(plan.method, SplatMethod::Primitives { culls_hidden: true, .. });
        Self {
            draws: plan.splats,
            meshes: plan.meshes,
            settings: &plan.settings,
            bands: plan.bands(),
            listed: plan.visible(),
            culls_hidden,
            source: Source { tints: self.tints[usize::from(plan.is_transparent())], ..self.source },
            ..self
        }
    }

    /// Inputs for each band of tiles, with what goes in front of its tiles in the names of passes (nothing where there
    /// is one) and how it is drawn.
    pub(crate) fn of_bands(self, arena: &'a Arena) -> impl Iterator<Item = (&'a str, Self, &'a TilePlan)> {
        let of = move |(number, band): (usize, &'a Band<'a>)| {
            let name = if self.bands.len() > 1 { arena.text(format_args!("band-{number} ")) } else { "" };
            (name, Self { draws: band.splats, listed: band.visible, ..self }, &band.plan)
        };
        (1..).zip(self.bands).map(of)
    }

    /// Whether polygons are drawn with several samples of a pixel.
    pub(crate) fn samples_polygons(&self) -> bool {
        !self.meshes.is_empty() && self.bands.iter().any(|band| band.plan.samples_polygons)
    }

    pub(crate) fn extent(&self) -> vk::Extent2D {
        let [width, height] = self.settings.size_px;
        vk::Extent2D { width, height }
    }

    pub(crate) fn image(&self, format: vk::Format) -> ImageDesc {
        ImageDesc { format, extent: self.extent() }
    }

    /// What passes over the whole image are told of it.
    pub(crate) fn finalize_constants(&self) -> FinalizeConstants {
        let [width, height] = self.settings.size_px;
        FinalizeConstants {
            background: self.settings.background.map_or([0.0; 4], |srgb| {
                let [r, g, b] = srgb.map(linear_from_srgb);
                [r, g, b, 1.0]
            }),
            half_size_px: [0.5 * width as f32, 0.5 * height as f32],
            middle_px: self.camera.middle_px(self.settings.size_px).map(|at| at as f32),
            focal_px: self.camera.focal_px(height) as f32,
            tile_height: 0, // quads of tiles bring their own
            near: if self.camera.is_orthographic() { self.range.end } else { self.camera.near() } as f32,
            eye_to_depth: self.range.from_eye as f32,
        }
    }
}
