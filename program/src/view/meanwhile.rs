//! What the window does until the pipelines of other settings are there: it goes on with the settings of before, from where the camera is now.

use std::sync::Arc;

use surfel::{
    Result,
    prepare::PreparedScene,
    scene::{Camera, Encoding, Scene, Settings},
};

use super::{
    ahead::Job, edits::Edits, gpu::Pipelines, on_device::OnDevice, picture::Use, steps::Choice, told::Step,
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
    /// Takes another scene that has come in the place of the one that is shown, once there are pipelines for it; a first one at once.
    pub fn take_scene(&mut self) {
        // A picture that is being written is of the one that is shown.
        let Some(coming) = self.coming.take_if(|_| self.writing.is_none()) else { return };
        if self.prepared.is_some() {
            let whole = self.whole();
            let mut pictures = vec![(Use::Still, whole.clone())];
            pictures.extend(self.comparing.map(|_| (Use::Other, self.other_of(&whole))));
            let choice = self.choice_of(pictures, self.camera(), "whole");
            // An error comes with its first frame, too.
            if matches!(self.has_pipelines(&choice, &whole, Some(&coming)), Ok(false)) {
                self.coming = Some(coming);
                return;
            }
        }
        self.scene_number += 1;
        self.pace.forget_whole();
        self.prepared = Some(coming);
        self.prepared_of = self.newest();
        self.changed();
    }

    /// The files that were read last, and what is to be changed of them.
    fn newest(&self) -> Option<(Arc<Scene>, Edits)> {
        Some((Arc::clone(&self.document.as_ref()?.scene), self.edits.clone()))
    }

    /// Whether what is on the device can be drawn so. It may be older than what the settings were chosen for: what was transparent until now has no eye-dome lighting.
    pub fn can_be_drawn(&self, settings: &Settings) -> bool {
        let scene = self.prepared.as_ref().map(OnDevice::scene);
        let is_transparent = scene.is_some_and(PreparedScene::is_transparent);
        !is_transparent || settings.check_eye_dome("the scene", "transparent").is_ok()
    }

    /// There may be pipelines to make.
    pub fn begin_anew(&mut self) {
        self.is_unsure = true;
        if let Some(ahead) = &mut self.ahead {
            ahead.begin();
        }
    }

    /// The method that is compared with, at the size of a picture.
    pub fn other_of(&self, settings: &Settings) -> Settings {
        Settings { size_px: settings.size_px, lod: settings.lod, ..self.other.clone() }
    }

    /// Makes some of the pipelines of these pictures; whether all are there, and have run on another device where that is of use. `whole`: how all of the picture is drawn; `coming`: another
    /// scene than the one that is shown.
    ///
    /// # Errors
    /// As [`surfel::Renderer::make_pipelines`].
    pub fn has_pipelines(
        &mut self,
        choice: &Choice,
        whole: &Settings,
        coming: Option<&OnDevice>,
    ) -> Result<bool> {
        let prepared = coming.or(self.prepared.as_ref());
        let scene = prepared.map(OnDevice::scene).or(self.warm.as_ref());
        let views = scene.map_or(Vec::new(), |scene| choice.views(scene));
        let Pipelines { are_made, have_run } = self.gpu.make_pipelines(&views)?;
        if !are_made {
            self.window.request_redraw();
        }
        if self.ahead.is_none() || have_run {
            return Ok(are_made);
        }
        // The window goes on with the scene before until the one that comes is there.
        let of = if coming.is_some() { self.newest() } else { self.prepared_of.clone() };
        let pictures = choice.camera.map(|camera| self.next_and_soon(choice, camera, whole));
        // The first picture has nothing to go on with. Pages are another view's when they are there.
        let (Some(ahead), Some(_), Some((scene, edits)), Some(OnDevice::Whole(_, step)), Some([next, soon])) =
            (&mut self.ahead, &self.drawn, of, prepared, pictures)
        else {
            return Ok(are_made);
        };
        let job = Job {
            has_levels: *step == Step::Leveled && !scene.has_levels(),
            scene,
            edits,
            is_light: !self.encoding.is_plain(),
            next,
            soon,
            is_hidden: choice.hidden.is_some(),
        };
        Ok(ahead.leaves(job) && are_made)
    }

    /// Whether this can be drawn at once: its pipelines are there, and have run where a driver compiles them then.
    ///
    /// # Errors
    /// As [`surfel::Renderer::make_pipelines`].
    pub fn is_at_hand(&self, choice: &Choice) -> Result<bool> {
        let Some(scene) = self.prepared.as_ref().map(OnDevice::scene).filter(|_| self.ahead.is_some()) else {
            return Ok(true);
        };
        Ok(self.gpu.make_pipelines(&choice.views(scene))? == Pipelines { are_made: true, have_run: true })
    }

    /// The pictures of a choice, and what may be drawn soon after them: all of the picture and a moving one; of those that nobody sees the others that come with them.
    fn next_and_soon(
        &self,
        choice: &Choice,
        camera: Camera,
        whole: &Settings,
    ) -> [Vec<(Camera, Settings)>; 2] {
        let Choice { pictures, hidden, .. } = choice;
        let next: Vec<_> = pictures.iter().map(|(_, settings)| (camera, settings.clone())).collect();
        if let Some(hidden) = hidden {
            let others =
                self.hidden_pictures(whole).into_iter().filter(|other| other.what.comes_with(*hidden));
            return [next, others.map(|other| (other.camera, other.settings)).collect()];
        }
        let coarse = self.pace.size_px(whole.size_px);
        let soon = next.iter().flat_map(|(_, settings)| {
            let all = Settings { size_px: whole.size_px, lod: whole.lod, ..settings.clone() };
            let moving = Settings { size_px: coarse, lod: self.pace.lod(whole.lod), ..settings.clone() };
            [(camera, all), (camera, moving)]
        });
        let soon = soon.collect();
        [next, soon]
    }

    /// The picture as it was, of a camera that has moved since: with the settings of before, or those of now as coarse as what moved last; `None` where that can't be drawn.
    pub fn as_before(&self) -> Option<Choice> {
        let before = self.drawn.as_ref()?;
        let camera = self.camera().filter(|camera| *camera != before.camera)?;
        let is_parallel = |camera: &Camera| camera.orthographic_height.is_some();
        let is_same = (before.encoding, before.scene_number) == (self.encoding, self.scene_number);
        let other = self.comparing.map(|_| &self.other);
        let takes_others = (&before.settings, before.other.as_ref()) != (&self.settings, other);
        if !is_same
            || is_parallel(&camera) != is_parallel(&before.camera)
            || before.other.is_some() != self.comparing.is_some()
        {
            return None;
        }
        let whole = self.at_rest(&Settings { size_px: self.window_px(), ..before.settings.clone() });
        let (which, settings) = match (takes_others, self.pace.is_finest()) {
            (false, _) => (Use::Moving, self.coarse_by(self.moving.as_ref()?, &whole)),
            (true, true) => (Use::Still, whole),
            (true, false) => (Use::Moving, self.coarse(&whole)),
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
