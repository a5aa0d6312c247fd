//! What the window does until the pipelines of other settings are there: it goes on with the settings of before, from where the camera is now.

use std::sync::Arc;

use surfel::{
    Result,
    scene::{Camera, Encoding, Settings},
};

use super::{
    ahead::Job, document::Document, on_device::OnDevice, picture::Use, steps::Choice, told::Step,
    viewer::Viewer,
};

/// What was drawn last.
pub struct Before {
    pub settings: Settings,
    pub camera: Camera,
    pub encoding: Encoding,
    pub scene_number: u64,
    /// The method that it was compared with, if it was.
    pub other: Option<Settings>,
}

impl Viewer {
    /// Makes some of the pipelines of these pictures; whether all are there, and have run on another device where that is of use. `whole`: how all of the picture is drawn.
    ///
    /// # Errors
    /// As [`surfel::Renderer::make_pipelines`].
    pub fn has_pipelines(&mut self, choice: &Choice, whole: &Settings) -> Result<bool> {
        let scene = self.prepared.as_ref().map(OnDevice::scene).or(self.warm.as_ref());
        let views = scene.map_or(Vec::new(), |scene| choice.views(scene));
        let made = || self.gpu.headless.renderer.shaders().made();
        let before = made();
        let are_made = self.gpu.make_pipelines(&views)?;
        let is_new = made() != before;
        if !are_made {
            self.window.request_redraw();
        }
        // The first picture has nothing to go on with. Pages are another view's when they are there.
        let (Some(ahead), Some(_), Some(document), Some(OnDevice::Whole(_, step)), Some(camera)) =
            (&mut self.ahead, &self.drawn, &self.document, &self.prepared, &self.navigation)
        else {
            return Ok(are_made);
        };
        let Document { scene, .. } = document;
        let pictures = choice.pictures.iter().map(|(_, settings)| settings);
        let coarse = self.pace.size_px(whole.size_px);
        let settings = pictures.flat_map(|settings| {
            let all = Settings { size_px: whole.size_px, lod: whole.lod, ..settings.clone() };
            let moving = Settings { size_px: coarse, lod: self.pace.lod(whole.lod), ..settings.clone() };
            [all, moving]
        });
        let job = Job {
            scene: Arc::clone(scene),
            edits: self.edits.clone(),
            has_levels: *step == Step::Leveled && !scene.has_levels(),
            camera: camera.camera,
            settings: settings.collect(),
            is_light: !self.encoding.is_plain(),
        };
        Ok(ahead.is_ready(job, is_new) && are_made)
    }

    /// The picture as it was, of a camera that has moved since; `None` where that can't be drawn.
    pub fn as_before(&self) -> Option<Choice> {
        let before = self.drawn.as_ref()?;
        let camera = self.camera().filter(|camera| *camera != before.camera)?;
        let is_parallel = |camera: &Camera| camera.orthographic_height.is_some();
        let is_same = (before.encoding, before.scene_number) == (self.encoding, self.scene_number);
        if !is_same || is_parallel(&camera) != is_parallel(&before.camera) || before.other.is_some() != self.comparing.is_some() {
            return None;
        }
        let whole = self.at_rest(&Settings { size_px: self.window_px(), ..before.settings.clone() });
        let (which, settings) = match self.pace.is_finest() {
            true => (Use::Still, whole),
            false => (Use::Moving, self.coarse(&whole)),
        };
        let Settings { size_px, lod, .. } = settings;
        let other = before.other.iter().map(|other| (Use::Other, Settings { size_px, lod, ..other.clone() }));
        let pictures: Vec<_> = [(which, settings)].into_iter().chain(other).collect();
        let check = |(_, settings): &(Use, Settings)| self.gpu.headless.renderer.check(&camera, settings);
        pictures.iter().try_for_each(check).ok()?;
        let input = self.input_at;
        Some(Choice { input, ..self.choice_of(pictures, Some(camera), "moving") })
    }
}
