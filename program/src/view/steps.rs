//! What of the scene a frame draws; and pictures whose pipelines run for the first time, which some drivers compile then. These are drawn in steps, between which the window hears
//! events and shows what there is: what a step draws stays as it was chosen, and what changes meanwhile is drawn next.

use std::time::{Duration, Instant};

use surfel::{
    Result,
    graph::execute::Profile,
    prepare::PreparedScene,
    renderer::Seen,
    scene::{Camera, Settings},
};

use super::{
    frame_desc::{Ends, SceneView},
    hidden::{Hidden, HiddenPicture},
    picture::Use,
    refine::Refinement,
    viewer::Viewer,
    warm,
};

/// How soon the device is looked at again.
const LOOK: Duration = Duration::from_millis(3);

/// What of the scene a frame draws.
pub struct Choice {
    /// Each for its use.
    pub pictures: Vec<(Use, Settings)>,
    pub camera: Option<Camera>,
    pub sample: Option<Ends>,
    pub is_light: bool,
    pub profile: Option<Profile>,
    /// What the first is to the picture at rest, in a word.
    pub what: &'static str,
    /// The input that it answers to.
    pub input: Option<Instant>,
    /// The scene of which it is.
    pub scene_number: u64,
    /// It is drawn for its pipelines, and not shown.
    pub hidden: Option<Hidden>,
}

/// A choice of which some steps are drawn.
pub struct Steps {
    pub choice: Choice,
    /// When the device is looked at.
    pub next_look: Instant,
}

impl Choice {
    /// The pictures of a scene.
    pub fn views<'a>(&'a self, scene: &'a PreparedScene) -> Vec<(Use, SceneView<'a>)> {
        let Self { sample, is_light, scene_number, profile, .. } = *self;
        let Some(camera) = &self.camera else { return Vec::new() };
        let view = |(which, settings): &'a (Use, Settings)| {
            let seen = Seen { scene, camera, settings };
            (*which, SceneView { seen, is_light, sample, scene_number, profile })
        };
        self.pictures.iter().map(view).collect()
    }
}

impl Viewer {
    /// How all of the picture is drawn at rest.
    pub fn whole(&self) -> Settings {
        self.at_rest(&Settings { size_px: self.window_px(), ..self.settings.clone() })
    }

    /// What the next frame draws of the scene, if anything.
    ///
    /// # Errors
    /// Of the device.
    pub fn choose(&mut self, is_moving: bool, whole: &Settings) -> Result<Choice> {
        if self.prepared.is_none() && self.warm.is_some() {
            return Ok(self.choice_of(vec![(Use::Other, whole.clone())], Some(warm::camera()), "other"));
        }
        self.warm = None;
        let is_coarse = self.shown == Use::Moving && !is_moving;
        if self.is_stale || is_coarse {
            (self.splats_drawn, self.counting) = (None, None);
            (self.refined, self.refines, self.is_hasty) = (0, None, self.pace.is_slow());
        }
        let refinement = self.next_refinement(whole);
        let (which, camera, settings, sample) = match (self.camera(), refinement) {
            (Some(camera), _) if is_moving && !self.pace.is_finest() => {
                (Use::Moving, Some(camera), self.coarse(whole), None)
            }
            (Some(camera), Some(step)) => {
                let (camera, settings, sample) = step.of(camera, whole);
                (Use::Still, Some(camera), settings, sample)
            }
            (camera, _) => (Use::Still, camera, whole.clone(), None),
        };
        let refines = refinement.is_some() && !is_moving && self.can_refine()?;
        let settings = self.with_pages(settings, whole.clone())?;
        // Pages have come: samples of what was there before are of no use.
        let begins_again = self.is_stale && sample.is_some();
        if begins_again {
            self.refined = 0;
            self.window.request_redraw();
        }
        // What was kept for another camera, or another scene.
        if let Some(error) = self.comparing.and_then(|_| self.check(&self.other).err()) {
            self.comparing = None;
            self.tell(&format!("no comparison: {error}"));
        }
        // Until then the picture stays.
        let can_be_drawn =
            self.can_be_drawn(whole) && (self.comparing.is_none() || self.can_be_drawn(&self.other));
        let wants = (self.is_stale || is_coarse || refines) && !begins_again && can_be_drawn;
        if !wants && !is_moving && refinement.is_none() && can_be_drawn && self.can_refine()? {
            if let Some(HiddenPicture { what, camera, settings }) = self.next_hidden(whole) {
                let choice = self.choice_of(vec![(Use::Moving, settings)], Some(camera), what.word());
                return Ok(Choice { hidden: Some(what), ..choice });
            }
            self.refines = None;
        }
        let mut pictures = Vec::new();
        if let Some(settings) = settings.filter(|_| wants && self.prepared.is_some()) {
            let other = self.comparing.map(|_| (Use::Other, self.other_of(&settings)));
            pictures.push((which, settings));
            pictures.extend(other);
        }
        let what = match which {
            Use::Moving => "moving",
            _ => refinement.unwrap_or(Refinement::Whole).what(),
        };
        let input = self.input_at;
        Ok(Choice { sample, input, ..self.choice_of(pictures, camera, what) })
    }

    /// Such pictures of the scene of now, for no input.
    pub fn choice_of(
        &self,
        mut pictures: Vec<(Use, Settings)>,
        camera: Option<Camera>,
        what: &'static str,
    ) -> Choice {
        let is_light = !self.encoding.is_plain();
        if is_light {
            // A curve is of what is drawn alone.
            pictures.iter_mut().for_each(|(_, settings)| settings.background = None);
        }
        let profile = Some(if self.ui.shows_times() { Profile::Times } else { Profile::Frame });
        let scene_number = self.scene_number;
        Choice {
            pictures,
            camera,
            sample: None,
            is_light,
            profile,
            what,
            input: None,
            scene_number,
            hidden: None,
        }
    }

    /// Steps of it are drawn, and others are to come. `is_step`: it was so before.
    pub fn go_on_later(&mut self, choice: Choice, is_step: bool) {
        if !is_step && !self.is_unsure {
            self.is_stale = false;
        }
        self.steps = Some(Steps { choice, next_look: Instant::now() + LOOK });
        if self.ui.set_compiling(true) {
            self.window.request_redraw();
        }
    }

    /// Whether a step is under way on the device, which is looked at again soon.
    ///
    /// # Errors
    /// Of the device.
    pub fn waits_for_step(&mut self) -> Result<bool> {
        let Some(steps) = &mut self.steps else { return Ok(false) };
        let is_idle = self.gpu.is_idle()?;
        if !is_idle {
            steps.next_look = Instant::now() + LOOK;
        }
        Ok(!is_idle)
    }
}
