//! What is drawn when: a picture that moves is as coarse as it must be, one at rest is the whole one, and where nothing has changed
//! nothing is drawn.

use std::time::{Duration, Instant};

use surfel::{
    Result,
    graph::execute::Profile,
    renderer::Seen,
    scene::{Camera, Lod, Settings},
};

use super::{
    document::Document,
    frame_desc::{Drawn, FrameDesc, SceneView},
    keys::Comparing,
    on_device::{OnDevice, Paged},
    overlay::OverlayFrame,
    picture::Use,
    printed,
    refine::Refinement,
    show::{ShowDesc, Shown},
    told::Step,
    viewer::Viewer,
};
use crate::console;

/// How soon the cost of a frame is looked for again that is not done.
const COST: Duration = Duration::from_millis(10);
/// How soon pages are looked for again.
const PAGES: Duration = Duration::from_millis(15);
/// Memory is given back once nothing was drawn for so long.
const TIDY: Duration = Duration::from_millis(500);

impl Viewer {
    /// When there is something to do without an event.
    pub fn next_wake(&mut self, now: Instant) -> Option<Instant> {
        let rest = self.moved.filter(|_| !self.anchor.waits()).map(|moved| moved + self.pace.rest());
        let refines = self.refines.filter(|_| self.moved.is_none());
        let looks = [self.looks_for_costs, self.looks_for_pages, refines, self.tidies];
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
        if self.hear_anchor().is_err() {
            self.window.request_redraw();
        }
        let rests = !self.anchor.waits() && self.moved.is_some_and(|moved| now >= moved + self.pace.rest());
        let is_due = |when: Option<Instant>| when.is_some_and(|when| now >= when);
        if is_due(self.tidies) {
            // As above.
            let rests = self.moved.is_none() && self.gpu.is_idle().unwrap_or(true);
            self.tidies = (!rests).then(|| now + TIDY);
            if rests {
                let _ = self.gpu.tidy(self.comparing.is_some());
                if self.options.prints_frames {
                    let _ = console::print(&printed::at_rest(self.gpu.headless.device()));
                }
                if self.ui.shows_times() && self.splats_drawn.is_none() && !self.is_stale {
                    let _ = self.count_drawn();
                }
                self.look_under_cursor();
            }
        }
        let pages = self.prepared.as_ref().and_then(OnDevice::pages);
        let pages_are_there = is_due(self.looks_for_pages) && pages.is_none_or(Paged::has_arrived);
        if is_due(self.looks_for_pages) {
            self.looks_for_pages = Some(now + PAGES);
        }
        // As above.
        let refines = self.moved.is_none() && self.can_refine().unwrap_or(false);
        if rests || refines || is_due(self.ui.next_wake()) || is_due(self.looks_for_costs) || pages_are_there
        {
            self.window.request_redraw();
        }
    }

    /// Draws a frame.
    ///
    /// # Errors
    /// As [`super::gpu::Gpu::draw`].
    pub fn redraw(&mut self) -> Result<()> {
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
        let (drawn, which) = self.draw(is_moving, overlay.as_ref())?;
        self.tidies = Some(now + TIDY);
        match drawn {
            Drawn::Hidden => {}
            Drawn::Again => {
                self.is_stale = true;
                self.window.request_redraw();
            }
            Drawn::Shown => {
                if let (Some(which), Some(camera)) = (which, self.camera()) {
                    (self.is_stale, self.shown) = (false, which);
                    self.drawn = Some((self.settings.clone(), camera));
                    self.looks_for_costs = self.shows_costs().then(|| Instant::now() + COST);
                }
                if self.input.flies() || self.path.plays() {
                    self.window.request_redraw();
                }
            }
        }
        Ok(())
    }

    /// Draws the scene, if it is to be drawn, and shows what there is; for what use it was drawn.
    fn draw(&mut self, is_moving: bool, overlay: Option<&OverlayFrame>) -> Result<(Drawn, Option<Use>)> {
        let window_px = self.window_px();
        let whole = self.at_rest(&Settings { size_px: window_px, ..self.settings.clone() });
        let is_coarse = self.shown == Use::Moving && !is_moving;
        if self.is_stale || is_coarse {
            self.splats_drawn = None;
            (self.refined, self.refines, self.is_hasty) = (0, None, self.pace.is_slow());
        }
        let refinement = self.next_refinement(&whole);
        let camera = self.camera();
        let (which, camera, settings, sample) = match (camera, refinement) {
            (Some(camera), _) if is_moving && !self.pace.is_finest() => {
                (Use::Moving, Some(camera), self.coarse(&whole), None)
            }
            (Some(camera), Some(step)) => {
                let (camera, settings, sample) = step.of(camera, &whole);
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
        let is_light = !self.encoding.is_plain();
        let drawn_so = |settings: Settings| match is_light {
            true => Settings { background: None, ..settings },
            false => settings,
        };
        let other = self.comparing.zip(settings.as_ref()).map(|(_, settings)| {
            drawn_so(Settings { size_px: settings.size_px, lod: settings.lod, ..self.other.clone() })
        });
        let background = self.settings.background;
        let settings = settings.map(drawn_so);
        let wants = (self.is_stale || is_coarse || refines) && !begins_again;
        let mut views = Vec::new();
        if let (true, Some(prepared), Some(camera), Some(settings)) =
            (wants, &self.prepared, &camera, &settings)
        {
            let seen = |settings| Seen { scene: prepared.scene(), camera, settings };
            let view = |settings| SceneView { seen: seen(settings), is_light, sample };
            views.push((which, view(settings)));
            views.extend(other.as_ref().map(|other| (Use::Other, view(other))));
        }
        // The window goes on with the picture that is there until the pipelines of another are.
        let is_asked = !views.is_empty();
        if self.is_unsure && is_asked {
            self.is_unsure = !self.gpu.make_pipelines(&views)?;
            if self.is_unsure {
                views.clear();
                self.window.request_redraw();
            }
        }
        if self.ui.set_compiling(self.is_unsure && is_asked) {
            self.window.request_redraw();
        }
        let drawn = (!views.is_empty()).then_some(which);
        let comparing = self.comparing.filter(|_| drawn.is_some() || self.gpu.has_picture(Use::Other));
        let first = drawn.unwrap_or(self.shown);
        let (pictures, shown) = match comparing {
            None | Some(Comparing::Keep) => ([first; 2], Shown::One),
            Some(Comparing::Flicker) => ([Use::Other; 2], Shown::One),
            Some(Comparing::Split) => ([first, Use::Other], Shown::Both(self.split * window_px[0] as f32)),
            Some(Comparing::Difference) => ([first, Use::Other], Shown::Difference),
        };
        let light = is_light.then_some(self.encoding);
        let show = ShowDesc { window_px, light, background, shown };
        let shown = self.prepared.is_some().then_some((pictures, show));
        let profile = Some(if self.ui.shows_times() { Profile::Times } else { Profile::Frame });
        let what = match which {
            Use::Moving => "moving",
            _ => refinement.unwrap_or(Refinement::Whole).what(),
        };
        let desc = FrameDesc { views: &views, shown, overlay, profile, what, input: self.input_at };
        let done = self.gpu.draw(&desc)?;
        if done == Drawn::Shown && drawn == Some(Use::Still) && self.prepared.is_some() {
            // What comes after the whole picture answers to something else.
            self.input_at.take_if(|_| what == "whole" && !is_moving);
            self.refine(&whole);
        }
        Ok((done, drawn))
    }

    /// The settings with which what is there can be drawn; `None` where nothing is. `whole`: those of the picture at rest.
    fn with_pages(&mut self, settings: Settings, whole: Settings) -> Result<Option<Settings>> {
        self.looks_for_pages = None;
        let (Some(OnDevice::Paged(paged)), Some(camera)) = (&mut self.prepared, self.navigation.as_ref())
        else {
            return Ok(Some(settings));
        };
        let before = (paged.now(&whole), paged.pages());
        let wanted = [&settings, &whole];
        let wanted = if settings == whole { &wanted[1..] } else { &wanted[..] };
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

    /// Learns what frames have cost.
    fn learn(&mut self, is_moving: bool) -> Result<()> {
        self.looks_for_costs = None;
        // With what it takes to show the picture, too.
        let period = self.gpu.take_period().filter(|_| is_moving && self.was_moving);
        self.was_moving = is_moving;
        for which in Use::ALL {
            let (costs, all) = self.gpu.take_costs(which)?;
            for cost in costs.into_iter().filter(|_| which != Use::Other) {
                // A picture at rest tells of moving ones where they are the same.
                if is_moving && (which == Use::Moving || self.pace.is_finest()) {
                    let secs = period.map_or(cost.secs, |period| period.as_secs_f64());
                    self.pace.learn(secs, cost.compiles);
                }
                if cost.what == "whole" && !cost.compiles {
                    self.pace.learn_whole(cost.secs);
                }
                self.ui.history.push(&cost);
                if self.options.prints_frames {
                    console::print(&printed::frame(&cost))?;
                }
            }
            if !all && self.shows_costs() {
                self.looks_for_costs = Some(Instant::now() + COST);
            }
        }
        Ok(())
    }

    fn shows_costs(&self) -> bool {
        self.ui.shows_times() || self.options.prints_frames
    }

    /// As coarse as a moving picture is.
    fn coarse(&self, whole: &Settings) -> Settings {
        let has_levels = self.prepared.as_ref().is_some_and(|prepared| prepared.step() == Step::Leveled);
        let lod = if has_levels { self.pace.lod(whole.lod) } else { whole.lod };
        Settings { size_px: self.pace.size_px(whole.size_px), lod, ..whole.clone() }
    }

    /// As all of it is drawn: levels of detail that were made for moving pictures are for those alone.
    pub fn at_rest(&self, settings: &Settings) -> Settings {
        let has_levels = |document: &Document| document.paged.is_some() || document.scene.has_levels();
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
