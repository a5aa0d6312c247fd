//! What the panel shows, and what it changes.

use surfel::{
    Result,
    scene::{Edges, Encoding, Settings, Tonemap},
};

use super::{
    compared::names,
    document::Document,
    edits::Edits,
    keys::{Action, Comparing},
    told::Step,
    viewer::Viewer,
};

/// What the panel shows.
pub struct State {
    pub settings: Settings,
    pub encoding: Encoding,
    pub edits: Edits,
    /// Names and kinds of the scene's things.
    pub things: Vec<(String, String)>,
    /// The one that keys change.
    pub thing: usize,
    pub facts: Vec<(&'static str, String)>,
    /// The edges that are drawn, where they are not those of the settings.
    pub drawn_edges: Option<&'static str>,
    /// How two methods are compared, if they are, and what they are called.
    pub compared: Option<(Comparing, [String; 2])>,
}

/// What is to be changed.
pub enum Change {
    /// Other settings.
    Settings(Settings),
    /// Other exposure, in stops.
    Exposure(f64),
    /// Another curve.
    Tonemap(Tonemap),
    /// Other things seen, or another alpha of them.
    Edits(Edits),
    /// Splats of another size.
    SplatScale(f32),
    /// What a key does, too.
    Act(Action),
}

impl State {
    /// That of now.
    pub fn of(viewer: &Viewer) -> Self {
        let gpu = &viewer.gpu;
        let device = gpu.headless.device();
        let mib = |bytes: u64| format!("{:.1} MiB", bytes as f64 / f64::from(1 << 20));
        let [width, height] = viewer.window_px();
        let mut facts = vec![
            ("device", device.facts().name.clone()),
            ("window", format!("{width} x {height}")),
            ("device memory", mib(device.memory_held())),
            ("of pictures", mib(gpu.transient_bytes())),
        ];
        if let Some(prepared) = &viewer.prepared {
            let scene = prepared.scene();
            let how = match prepared.step() {
                Step::Part => " (a part for now)",
                Step::Whole => "",
                Step::Leveled => " (in levels)",
            };
            facts.push(("splats", format!("{}{how}", scene.splat_count())));
            if let Some(drawn) = viewer.splats_drawn.filter(|drawn| *drawn > 0) {
                facts.push(("drawn of them", drawn.to_string()));
            }
            facts.push(("triangles", scene.triangle_count().to_string()));
            facts.push(("of the scene", mib(scene.bytes())));
            facts.extend(prepared.pages().map(|pages| ("pages", pages.words())));
        }
        Self {
            settings: viewer.settings.clone(),
            encoding: viewer.encoding,
            edits: viewer.edits.clone(),
            things: viewer.document.as_ref().map(Document::things).unwrap_or_default(),
            thing: viewer.thing,
            facts,
            drawn_edges: viewer.drawn_edges(),
            compared: viewer.comparing.map(|how| (how, names([&viewer.settings, &viewer.other]))),
        }
    }
}

impl Viewer {
    /// The edges of splats as they are drawn, where the method has not those that are asked for.
    pub fn drawn_edges(&self) -> Option<&'static str> {
        let (Some(camera), Some(prepared)) = (self.camera(), &self.prepared) else { return None };
        let scene = prepared.scene();
        if self.settings.edges != Edges::Coverage || scene.chunks().is_empty() {
            return None;
        }
        let settings = self.at_rest(&Settings { size_px: self.window_px(), ..self.settings.clone() });
        let covers = self.gpu.headless.renderer.covers_in_part(scene, &camera, &settings);
        covers.is_ok_and(|covers| !covers).then_some("hard")
    }

    /// Does what the panel asks for.
    ///
    /// # Errors
    /// Of the device.
    pub fn change(&mut self, change: Change) -> Result<()> {
        match change {
            Change::Settings(settings) => self.set(settings),
            Change::Exposure(stops) => self.set_exposure(stops),
            Change::Tonemap(tonemap) => {
                self.encoding.tonemap = tonemap;
                self.changed();
            }
            Change::Edits(edits) => self.edit(edits),
            Change::SplatScale(_) if self.tells_why_not(Action::SplatScale(1.0)) => {}
            Change::SplatScale(scale) => self.set_splat_scale(scale),
            Change::Act(action) => self.act(action)?,
        }
        Ok(())
    }
}
