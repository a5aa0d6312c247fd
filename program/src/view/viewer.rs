//! A scene in a window: what it is made of.

use std::{sync::Arc, time::Instant};

use glam::DVec3;
use surfel::{
    instruments::Counting,
    prepare::PreparedScene,
    scene::{Encoding, Samples, Scene, Settings},
};
use winit::window::Window;

use super::{
    ViewArguments,
    ahead::Ahead,
    anchor::Anchor,
    capture::Clipboard,
    document::Document,
    edits::Edits,
    files::Files,
    gpu::Gpu,
    hidden::Hidden,
    input::Input,
    keys::Comparing,
    loading::Loader,
    meanwhile::Before,
    navigation::Navigation,
    on_device::OnDevice,
    options::Options,
    pace::Pace,
    path::Path,
    picture::Use,
    steps::Steps,
    tidy::Tidies,
    ui::Ui,
    warm,
    writing::{Saving, Writing},
};
use crate::console;

/// A window, and all that is shown in it.
pub struct Viewer {
    pub window: Arc<Window>,
    pub gpu: Gpu,
    pub loader: Loader,
    /// Draws pictures of other settings before the window does, where that is of use.
    pub ahead: Option<Ahead>,
    pub input: Input,
    pub files: Files,
    pub path: Path,
    pub ui: Ui,
    /// The scene of the document comes to the device.
    pub prepares: bool,
    /// The first files are not read to their end yet.
    pub reads_first: bool,
    /// What the files hold, once they are read.
    pub document: Option<Document>,
    /// The scene on the device.
    pub prepared: Option<OnDevice>,
    /// The files that it is of, and what is changed of them.
    pub prepared_of: Option<(Arc<Scene>, Edits)>,
    /// Another one, for which pipelines are made.
    pub coming: Option<OnDevice>,
    /// What is drawn before there is a scene, and not shown.
    pub warm: Option<PreparedScene>,
    pub navigation: Option<Navigation>,
    /// With one sample a pixel.
    pub settings: Settings,
    /// The samples of a picture, as somebody says.
    pub samples: Samples,
    pub encoding: Encoding,
    /// Both as they were at first.
    pub first: (Settings, Encoding),
    pub edits: Edits,
    /// The thing of the scene that keys change.
    pub thing: usize,
    /// What was drawn last.
    pub drawn: Option<Before>,
    /// The method that is compared with, and how, if it is.
    pub other: Settings,
    pub comparing: Option<Comparing>,
    pub split: f32,
    pub clipboard: Clipboard,
    /// What the wheel goes toward.
    pub anchor: Anchor,
    /// The point that was measured last.
    pub measured: Option<DVec3>,
    pub options: Options,
    pub pace: Pace,
    /// When the picture last moved, until it rests.
    pub moved: Option<Instant>,
    /// So many frames in a row are of those that move.
    pub moving_frames: u32,
    /// How coarse the last one of them was whose pipelines had all run before.
    pub moving: Option<Pace>,
    /// The last input, until the whole picture answers to it.
    pub input_at: Option<Instant>,
    /// What is shown is not the scene, or not from the camera, of now.
    pub is_stale: bool,
    /// The picture may need pipelines that are not there yet.
    pub is_unsure: bool,
    /// What was drawn for its pipelines alone.
    pub hidden: Vec<Hidden>,
    /// Pictures that are drawn in steps.
    pub steps: Option<Steps>,
    /// A picture that is being written.
    pub writing: Option<Writing>,
    /// One that a thread writes.
    pub saving: Option<Saving>,
    /// Counts the changes of what is on the device.
    pub scene_number: u64,
    /// The picture that is shown.
    pub shown: Use,
    /// How many steps to the picture at rest are drawn.
    pub refined: usize,
    /// Of those, something coarser comes before all of the picture.
    pub is_hasty: bool,
    /// How many splats the picture at rest is made of, once they are counted.
    pub splats_drawn: Option<u64>,
    /// The device counts them.
    pub counting: Option<Counting>,
    /// When the next one may be.
    pub refines: Option<Instant>,
    /// When the costs of frames are looked for.
    pub looks_for_costs: Option<Instant>,
    /// When memory is given back, if nothing is to be drawn by then.
    pub tidies: Tidies,
    /// When pages are looked for that are to come.
    pub looks_for_pages: Option<Instant>,
    /// The program is to end.
    pub ends: bool,
    /// The camera of files that are read stays what it is.
    pub keeps_camera: bool,
    /// When the device was lost last.
    pub lost: Option<Instant>,
}

impl Viewer {
    /// Nothing is shown yet.
    pub fn new(
        window: Arc<Window>,
        gpu: Gpu,
        loader: Loader,
        settings: Settings,
        path: Path,
        arguments: &ViewArguments,
    ) -> Self {
        let warm = warm::scene(&gpu.headless);
        let ui = Ui::new(window.scale_factor() as f32);
        let samples = settings.samples;
        let settings = Settings { samples: Samples(1), ..settings };
        let encoding = arguments.encoding.over(Encoding::default());
        Self {
            other: settings.clone(),
            first: (settings.clone(), encoding),
            encoding,
            options: Options::of(arguments),
            window,
            ahead: Ahead::new(gpu.headless.device(), loader.proxy()),
            gpu,
            loader,
            ui,
            settings,
            samples,
            input: Input::default(),
            files: Files::default(),
            path,
            drawn: None,
            prepares: false,
            reads_first: true,
            document: None,
            prepared: None,
            prepared_of: None,
            coming: None,
            warm,
            navigation: None,
            edits: Edits { things: Vec::new(), splat_scale: 1.0 },
            thing: 0,
            comparing: None,
            split: 0.5,
            clipboard: Clipboard::default(),
            anchor: Anchor::default(),
            measured: None,
            pace: Pace::default(),
            moved: None,
            moving_frames: 0,
            moving: None,
            input_at: None,
            is_stale: true,
            is_unsure: true,
            hidden: Vec::new(),
            refined: 0,
            is_hasty: false,
            splats_drawn: None,
            counting: None,
            refines: None,
            looks_for_costs: None,
            looks_for_pages: None,
            tidies: Tidies::default(),
            steps: None,
            writing: None,
            saving: None,
            scene_number: 0,
            shown: Use::Still,
            ends: false,
            keeps_camera: false,
            lost: None,
        }
    }

    /// Width and height of the window's pictures.
    pub fn window_px(&self) -> [u32; 2] {
        self.gpu.window_px().map(|side| side.max(1))
    }

    /// The camera has moved.
    pub fn moved(&mut self) {
        self.moved = Some(Instant::now());
        self.input_at = self.moved;
        self.is_stale = true;
        self.window.request_redraw();
    }

    /// Something that the picture shows has changed, other than by a camera that moves on.
    pub fn changed(&mut self) {
        self.is_stale = true;
        self.hidden.clear();
        self.begin_anew();
        self.anchor.forget();
        self.window.request_redraw();
    }

    /// Tells something, in the window and on the standard error.
    pub fn tell(&mut self, text: &str) {
        console::say(text);
        self.ui.tell(text);
        self.window.request_redraw();
    }

    /// Closes the window; keeps what was compiled. What another device compiles is under way still.
    pub fn close(mut self) -> Option<Ahead> {
        if let Some(ahead) = &mut self.ahead {
            ahead.stop();
        }
        self.finish_writing();
        let Self { window, gpu, loader, ahead, prepared, coming, warm, .. } = self;
        drop(loader);
        drop((prepared, coming, warm));
        // A lost cache costs the next run some time, that is all.
        let _ = gpu.headless.renderer.shaders().save_cache();
        drop((gpu, window));
        ahead
    }
}
