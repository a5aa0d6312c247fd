//! What is drawn when: a picture that moves is as coarse as it must be, one at rest is the whole one, and where nothing has changed
//! nothing is drawn.

use std::time::{Duration, Instant};

use surfel::{
    Result,
    scene::{Camera, Lod, Settings},
};

use super::{
    costs::COST,
    device::is_device_lost,
    document::Document,
    frame_desc::{Drawn, FrameDesc},
    keys::Comparing,
    meanwhile::Before,
    on_device::{OnDevice, Paged},
    overlay::OverlayFrame,
    pace::Pace,
    picture::Use,
    show::{ShowDesc, Shown},
    tidy::Tidies,
    told::Step,
    viewer::Viewer,
};

/// How soon pages are looked for again.
const PAGES: Duration = Duration::from_millis(15);

impl Viewer {
    /// When there is something to do without an event.
    pub fn next_wake(&mut self, now: Instant) -> Option<Instant> {
        let rest = self.moved.filter(|_| !self.anchor.waits()).map(|moved| moved + self.pace.rest());
        let refines = self.refines.filter(|_| self.moved.is_none());
        let step = self.steps.as_ref().map(|steps| steps.next_look);
        let sample = self.next_sample(now);
        let count = self.counting.as_ref().map(|_| now + COST);
        let looks =
            [self.looks_for_costs, self.looks_for_pages, refines, self.tidies.next(), step, sample, count];
        let all = [rest, self.anchor.next_look(now), self.files.next_look(), self.ui.next_wake()]
            .into_iter()
            .chain(looks);
        all.flatten().min().map(|when| when.max(now))
    }

    /// That time has come.
    pub fn wake(&mut self) {
        let now = Instant::now();
        self.look_at_files();
        // Errors, such as a lost device, come with the next frame, too.
        if self.hear_anchor().and(self.hear_count()).is_err() {
            self.window.request_redraw();
        }
        let rests = !self.anchor.waits() && self.moved.is_some_and(|moved| now >= moved + self.pace.rest());
        self.tidy(now);
        if self.next_sample(now).is_some() {
            self.write_on();
        }
        let is_due = |when: Option<Instant>| when.is_some_and(|when| now >= when);
        let pages = self.prepared.as_ref().and_then(OnDevice::pages);
        let pages_are_there = is_due(self.looks_for_pages) && pages.is_none_or(Paged::has_arrived);
        if is_due(self.looks_for_pages) {
            self.looks_for_pages = Some(now + PAGES);
        }
        // As above.
        let refines = self.moved.is_none() && self.can_refine().unwrap_or(false);
        let steps = self.steps.is_some() && !self.waits_for_step().unwrap_or(false);
        if rests
            || refines
            || steps
            || is_due(self.ui.next_wake())
            || is_due(self.looks_for_costs)
            || pages_are_there
        {
            self.window.request_redraw();
        }
    }

    /// Draws a frame.
    ///
    /// # Errors
    /// As [`super::gpu::Gpu::draw`].
    pub fn redraw(&mut self) -> Result<()> {
        if self.waits_for_step()? {
            return Ok(());
        }
        self.hear_anchor()?;
        self.fly();
        self.play();
        let now = Instant::now();
        let is_moving = self.input.flies()
            || self.anchor.waits()
            || self.moved.is_some_and(|moved| now < moved + self.pace.rest());
        if !is_moving {
            self.moved = None;
        }
        // Nothing is drawn to a window without pixels, until it has some again.
        if !self.gpu.make_images()? {
            return Ok(());
        }
        self.learn(is_moving)?;
        let overlay = self.run_ui()?;
        let was_step = self.steps.is_some();
        let is_warming = self.prepared.is_none() && self.warm.is_some();
        let (drawn, which) = match self.draw(is_moving, overlay.as_ref()) {
            // What the picture that nobody sees can't have, the first one tells.
            Err(error) if is_warming && !is_device_lost(&error) => {
                (self.steps, self.warm) = (None, None);
                self.changed();
                return Ok(());
            }
            drawn => drawn?,
        };
        self.tidies = Tidies::after(now);
        match drawn {
            Drawn::Hidden => {}
            Drawn::Again => {
                self.is_stale = true;
                self.window.request_redraw();
            }
            Drawn::Shown => {
                if let (Some(which), Some(camera)) = (which, self.camera()) {
                    self.shown = which;
                    match &mut self.drawn {
                        // What has changed since its first step is drawn next.
                        Some(_) if was_step => {}
                        Some(drawn) if self.is_unsure => drawn.camera = camera,
                        drawn => {
                            let other = self.comparing.map(|_| self.other.clone());
                            let (settings, encoding) = (self.settings.clone(), self.encoding);
                            let scene_number = self.scene_number;
                            *drawn = Some(Before { settings, camera, encoding, scene_number, other });
                        }
                    }
                    self.is_stale &= was_step || self.is_unsure;
                }
                if self.input.flies() || self.path.plays() {
                    self.window.request_redraw();
                }
            }
        }
        Ok(())
    }

    /// Draws the scene, if it is to be drawn, and shows what there is; for what use it was drawn, once that picture is whole.
    fn draw(&mut self, is_moving: bool, overlay: Option<&OverlayFrame>) -> Result<(Drawn, Option<Use>)> {
        let window_px = self.window_px();
        let whole = self.whole();
        if self.steps.is_none() {
            self.take_scene();
        }
        let goes_on = self.steps.take().filter(|steps| steps.choice.scene_number == self.scene_number);
        let is_step = goes_on.is_some();
        let mut choice = match goes_on {
            Some(steps) => steps.choice,
            None => self.choose(is_moving, &whole)?,
        };
        let scene = self.prepared.as_ref().map(OnDevice::scene).or(self.warm.as_ref());
        // The window goes on with the settings of before until the pipelines of others are there. Where pipelines run on another device first, a camera that comes nearer waits for its own, too.
        let is_asked = scene.is_some() && !choice.pictures.is_empty();
        if (self.is_unsure || self.ahead.is_some()) && is_asked && !is_step {
            if !self.is_unsure {
                self.begin_anew();
            }
            self.is_unsure = !self.has_pipelines(&choice, &whole, None)?;
            if self.is_unsure {
                choice.pictures = Vec::new();
                if let Some(before) = self.as_before()
                    && self.is_at_hand(&before)?
                {
                    choice = before;
                }
            }
        }
        let scene = self.prepared.as_ref().map(OnDevice::scene).or(self.warm.as_ref());
        let views = scene.map_or(Vec::new(), |scene| choice.views(scene));
        if self.ui.set_compiling(is_step || self.is_unsure && is_asked) {
            self.window.request_redraw();
        }
        let drawn = views.first().map(|(which, _)| *which);
        let drawn = drawn.filter(|which| *which != Use::Other && choice.hidden.is_none());
        let comparing = self.comparing.filter(|_| drawn.is_some() || self.gpu.has_picture(Use::Other));
        let first = drawn.unwrap_or(self.shown);
        let (pictures, shown) = match comparing {
            None | Some(Comparing::Keep) => ([first; 2], Shown::One),
            Some(Comparing::Flicker) => ([Use::Other; 2], Shown::One),
            Some(Comparing::Split) => ([first, Use::Other], Shown::Both(self.split * window_px[0] as f32)),
            Some(Comparing::Difference) => ([first, Use::Other], Shown::Difference),
        };
        let is_light = !self.encoding.is_plain();
        let (light, background) = (is_light.then_some(self.encoding), self.settings.background);
        let show = ShowDesc { window_px, light, background, shown, is_ahead: choice.hidden.is_some() };
        let shown = self.prepared.is_some().then_some((pictures, show));
        let (what, input, hidden) = (choice.what, choice.input, choice.hidden);
        let desc = FrameDesc { views: &views, shown, before: self.shown, overlay, what, input };
        let done = self.gpu.draw(&desc)?;
        let (finished, asked) = (self.gpu.finished(), views.len());
        let drawn = drawn.filter(|_| finished > 0);
        if drawn == Some(Use::Moving) && !self.is_unsure && !is_step {
            self.moving = Some(self.pace.clone());
        }
        if finished > 0 {
            self.looks_for_costs = self.shows_costs().then(|| Instant::now() + COST);
        }
        if done != Drawn::Hidden && finished < asked {
            choice.pictures.drain(..finished);
            self.go_on_later(choice, is_step);
        } else if is_step {
            self.window.request_redraw();
        }
        if asked > 0 && finished == asked {
            self.hidden.extend(hidden);
            if hidden.is_some() {
                self.refines = self.next_hidden(&whole).map(|_| Instant::now());
            }
            self.warm.take_if(|_| self.prepared.is_none());
        }
        if done == Drawn::Shown && drawn == Some(Use::Still) && self.prepared.is_some() && !self.is_unsure {
            // What comes after the whole picture answers to something else.
            self.input_at.take_if(|at| what == "whole" && !is_moving && Some(*at) == input);
            self.refine(&whole);
        }
        Ok((done, drawn))
    }

    /// The settings with which what is there can be drawn; `None` where nothing is. `whole`: those of the picture at rest.
    pub fn with_pages(&mut self, settings: Settings, whole: Settings) -> Result<Option<Settings>> {
        self.looks_for_pages = None;
        let (Some(OnDevice::Paged(paged)), Some(camera)) = (&mut self.prepared, self.navigation.as_ref())
        else {
            return Ok(Some(settings));
        };
        let before = (paged.now(&whole), paged.pages());
        let wanted = [&settings, &whole];
        let wanted = if settings == whole { &wanted[1..] } else { &wanted[..] };
        self.scene_number += 1;
        let drawn = paged.update(&self.gpu.headless, &camera.camera, wanted)?;
        let fault = paged.take_fault();
        if paged.is_coming {
            self.looks_for_pages = Some(Instant::now() + PAGES);
        }
        self.is_stale |= before != (paged.now(&whole), paged.pages());
        if let Some(error) = fault {
            self.tell(&format!("{error}; the picture is as fine as it can be without it"));
        }
        Ok(drawn.into_iter().next().flatten())
    }

    /// As coarse as a moving picture is.
    pub fn coarse(&self, whole: &Settings) -> Settings {
        self.coarse_by(&self.pace, whole)
    }

    /// The same, by another pace.
    pub fn coarse_by(&self, pace: &Pace, whole: &Settings) -> Settings {
        let has_levels = self.prepared.as_ref().is_some_and(|prepared| prepared.step() == Step::Leveled);
        let lod = if has_levels { pace.lod(whole.lod) } else { whole.lod };
        Settings { size_px: pace.size_px(whole.size_px), lod, ..whole.clone() }
    }

    /// As all of it is drawn: levels of detail that were made for moving pictures are for those alone.
    pub fn at_rest(&self, settings: &Settings) -> Settings {
        let has_levels = |document: &Document| !document.paged.is_empty() || document.scene.has_levels();
        let own = self.document.as_ref().is_some_and(has_levels);
        let lod = match settings.lod {
            Lod::Auto if !own => Lod::Px(0.0),
            lod => lod,
        };
        Settings { lod, ..settings.clone() }
    }

    /// The camera of now.
    pub fn camera(&self) -> Option<Camera> {
        self.navigation.as_ref().map(|navigation| navigation.camera)
    }
}
