//! What keys and the panel change.

use std::time::Instant;

use surfel::{
    Result,
    scene::{Layers, MOST_LAYERS, OptionValue as _, Settings, Stops, Tonemap},
};

use super::{
    document::Document,
    edits::Edits,
    keys::{self, Action, Comparing},
    panel, values,
    viewer::Viewer,
};

/// Splats may be made so much smaller and larger.
const SPLAT_SCALES: [f32; 2] = [0.1, 10.0];

impl Viewer {
    /// A key, by its character or name.
    ///
    /// # Errors
    /// Of the device.
    pub fn key(&mut self, key: &str) -> Result<()> {
        match keys::action(key) {
            Some(action) => self.act(action),
            None => Ok(()),
        }
    }

    /// Does what a key is for.
    ///
    /// # Errors
    /// Of the device.
    pub fn act(&mut self, action: Action) -> Result<()> {
        let window_px = self.window_px();
        let begun = Instant::now();
        self.window.request_redraw();
        if self.anchor.holds(action) || self.tells_why_not(action) {
            return Ok(());
        }
        match action {
            Action::Quit => self.ends = true,
            Action::Panel => {
                self.ui.toggle_panel();
                // Its frames are timed by passes.
                self.changed();
            }
            Action::Keys => self.ui.toggle_keys(),
            Action::Close => self.ui.close(),
            Action::Home | Action::Fit | Action::See(_) | Action::Turns | Action::NextUp => {
                let seen = self.document.as_ref().map(|document| document.ball_of_seen(&self.edits));
                let (Some(navigation), Some(seen)) = (&mut self.navigation, seen) else { return Ok(()) };
                let beside_panel_px = match self.ui.shows_times() {
                    true => panel::beside_px(window_px[0], self.ui.px_a_point),
                    false => window_px[0],
                };
                match action {
                    Action::Home => navigation.go_home(),
                    Action::Fit => navigation.fit(&seen, window_px, beside_panel_px),
                    Action::See(view) => navigation.see_from(view, &seen, window_px, beside_panel_px),
                    Action::NextUp => self.ui.tell(&format!("{} is up", navigation.next_axis())),
                    _ => navigation.is_free = !navigation.is_free,
                }
                if action == Action::Turns {
                    let how = if navigation.is_free { "free turns" } else { "turntable" };
                    self.ui.tell(how);
                }
                self.changed();
            }
            Action::Projection => self.toggle_projection(),
            Action::Setting(name, step) => self.step_setting(name, step),
            Action::Layers(by) => self.add_layers(by),
            Action::Exposure(by) => {
                let Stops(stops) = self.encoding.exposure;
                self.set_exposure(stops + by);
            }
            Action::Tonemap => {
                let all = Tonemap::NAMES;
                let now = all.iter().position(|(_, tonemap)| *tonemap == self.encoding.tonemap).unwrap_or(0);
                let (name, tonemap) = all[(now + 1) % all.len()];
                self.encoding.tonemap = tonemap;
                self.ui.tell(&format!("tonemap: {name}"));
                self.changed();
            }
            Action::SplatScale(by) => {
                let [least, most] = SPLAT_SCALES;
                let now = self.edits.splat_scale;
                let scale = (now * by as f32).clamp(least, most);
                if scale == now {
                    self.ui.tell(&format!("splats {scale:.2} times as large: as far as it goes"));
                }
                self.set_splat_scale(scale);
            }
            Action::Screenshot => self.write_picture(),
            Action::CopyCamera(how) => self.copy_camera(how),
            Action::Cut(how) => self.cut(how),
            Action::Thing(what) => self.on_thing(what),
            Action::Reset => self.reset(),
            Action::Compare(how) => self.compare(how),
            Action::Path(what) => self.on_path(what),
            Action::Pick => self.measure()?,
            Action::Reload => self.reload(),
        }
        if self.is_stale {
            self.input_at = Some(begun);
        }
        Ok(())
    }

    /// Other settings, if they can be drawn.
    pub fn set(&mut self, settings: Settings) {
        if settings == self.settings {
            return;
        }
        match self.check(&settings) {
            Ok(()) => {
                self.settings = settings;
                self.changed();
            }
            Err(error) => self.tell(&error.to_string()),
        }
    }

    /// Refuses settings that the device, the camera or the scene rule out.
    ///
    /// # Errors
    /// What rules them out.
    pub fn check(&self, settings: &Settings) -> Result<()> {
        let settings = Settings { size_px: self.window_px(), ..settings.clone() };
        self.gpu.headless.renderer.check_settings(&settings)?;
        if let Some(camera) = self.camera() {
            self.gpu.headless.renderer.check(&camera, &settings)?;
            if let Some(paged) = self.prepared.as_ref().filter(|prepared| prepared.pages().is_some()) {
                self.gpu.headless.renderer.check_levels(paged.scene(), &camera, &settings)?;
            }
        }
        let Some(document) = &self.document else { return Ok(()) };
        document.check(&self.edits, &settings, self.options.most_paged_bytes)?;
        settings.check_scene(&document.scene)
    }

    /// Other changes of the scene, if they can be drawn.
    pub fn edit(&mut self, edits: Edits) {
        let Some(document) = &self.document else { return };
        match document.check(&edits, &self.settings, self.options.most_paged_bytes) {
            Ok(()) => {
                self.edits = edits;
                self.prepare(false);
            }
            Err(error) => self.tell(&error.to_string()),
        }
    }

    /// All but the camera as it was at first.
    fn reset(&mut self) {
        let (settings, encoding) = self.first.clone();
        (self.comparing, self.split) = (None, 0.5);
        self.encoding = encoding;
        self.set(settings);
        let edits = self.document.as_ref().map(Document::no_edits);
        if let Some(edits) = edits.filter(|edits| *edits != self.edits) {
            self.edits = edits;
            self.prepare(false);
        }
        self.ui.tell("as at the beginning");
        self.changed();
    }

    fn step_setting(&mut self, name: &str, step: keys::Step) {
        let accept = |settings: &Settings| self.check(settings);
        let Some(settings) = values::stepped(&self.settings, name, step, accept) else { return };
        self.set(settings);
        if let Some(setting) = values::setting(name) {
            let drawn = self.drawn_edges().filter(|_| name == "edges");
            let drawn = drawn.map_or(String::new(), |drawn| format!(" ({drawn} by this method)"));
            self.ui.tell(&format!("{name}: {}{drawn}", (setting.get)(&self.settings)));
        }
    }

    fn add_layers(&mut self, by: i64) {
        let (Layers::Fixed(layers) | Layers::Auto(layers)) = self.settings.layers;
        let before = layers;
        let layers = (i64::from(layers) + by).clamp(1, i64::from(MOST_LAYERS)) as u32;
        let end = if layers == before { ": as far as it goes" } else { "" };
        let layers = match self.settings.layers {
            Layers::Fixed(_) => Layers::Fixed(layers),
            Layers::Auto(_) => Layers::Auto(layers),
        };
        self.ui.tell(&format!("layers: {}{end}", layers.word()));
        self.set(Settings { layers, ..self.settings.clone() });
    }

    /// Light so many stops brighter than it is.
    pub fn set_exposure(&mut self, stops: f64) {
        let stops = Stops(stops);
        if stops.check().is_ok() && stops != self.encoding.exposure {
            self.encoding.exposure = stops;
            self.ui.tell(&format!("exposure: {} stops", stops.0));
            self.changed();
        }
    }

    /// Splats so many times as large as in the files.
    pub fn set_splat_scale(&mut self, scale: f32) {
        // Where steps up and down meet again, it is the files' own.
        let scale = if (scale - 1.0).abs() < 1e-3 { 1.0 } else { scale };
        if self.edits.splat_scale != scale {
            self.ui.tell(&format!("splats {scale:.2} times as large"));
            self.edit(Edits { splat_scale: scale, ..self.edits.clone() });
        }
    }

    fn toggle_projection(&mut self) {
        let Some(navigation) = &mut self.navigation else { return };
        let before = navigation.clone();
        navigation.toggle_projection();
        let camera = navigation.camera;
        if let Err(error) = self.settings.check_camera(&camera) {
            self.navigation = Some(before);
            self.tell(&error.to_string());
        } else {
            self.changed();
        }
    }

    fn compare(&mut self, how: Comparing) {
        if how == Comparing::Keep {
            self.other = self.settings.clone();
            self.ui.tell("kept as the other method; x, z and Space compare with it");
        } else {
            self.comparing = if self.comparing == Some(how) { None } else { Some(how) };
        }
        self.changed();
    }
}
