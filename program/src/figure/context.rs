//! The device and the options that all figures are drawn with.

use std::path::Path;

use surfel::{
    Result,
    prepare::PreparedScene,
    renderer::{Frame, Headless, Wanted},
    scene::{Camera, Scene, Settings},
};

use super::raster::Raster;
use crate::{console::Bars, scene::upload};

/// A device, and what the command line says.
pub struct FigureContext<'a> {
    pub headless: &'a mut Headless,
    pub bars: &'a Bars,
    /// Width and height of a panel or plot.
    pub size_px: [u32; 2],
    /// The file to show in place of the built-in model.
    pub model: Option<&'a Path>,
}

impl FigureContext<'_> {
    /// Uploads a scene.
    pub fn prepare(&self, scene: &Scene) -> Result<PreparedScene> {
        upload(self.headless, scene, self.bars)
    }

    /// Draws the picture.
    pub fn picture(&mut self, scene: &PreparedScene, camera: &Camera, settings: &Settings) -> Result<Raster> {
        let Frame { size_px, srgb, .. } = self.headless.render(scene, camera, settings, Wanted::PICTURE)?;
        Ok(Raster {
            size_px,
            pixels: srgb.into_iter().map(|[red, green, blue, _]| [red, green, blue]).collect(),
        })
    }

    /// Draws the sums of the weights, row by row from the top left.
    pub fn weights(
        &mut self,
        scene: &PreparedScene,
        camera: &Camera,
        settings: &Settings,
    ) -> Result<Vec<f32>> {
        let wanted = Wanted { surface: true, ..Wanted::default() };
        Ok(self.headless.render(scene, camera, settings, wanted)?.weight)
    }
}
