//! A scene in a window: what it is made of, and what comes from elsewhere.

use std::{sync::Arc, time::Instant};

use glam::DVec3;
use surfel::{
    Error, Result,
    levels_file::LevelsFile,
    scene::{Camera, Encoding, Samples, Settings},
};
use winit::window::Window;

use super::{
    ViewArguments,
    capture::Clipboard,
    document::Document,
    edits::Edits,
    files::Files,
    gpu::Gpu,
    input::Input,
    keys::Comparing,
    loading::{Loader, News},
    navigation::Navigation,
    on_device::{OnDevice, Paged},
    options::Options,
    pace::Pace,
    path::Path,
    picture::Use,
    ui::Ui,
};
use crate::console;

/// A window, and all that is shown in it.
pub struct Viewer {
    pub window: Arc<Window>,
    pub gpu: Gpu,
    pub loader: Loader,
    pub input: Input,
    pub files: Files,
    pub path: Path,
    pub ui: Ui,
    /// What the files hold, once they are read.
    pub document: Option<Document>,
    /// The scene on the device.
    pub prepared: Option<OnDevice>,
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
    pub drawn: Option<(Settings, Camera)>,
    /// The method that is compared with, and how, if it is.
    pub other: Settings,
    pub comparing: Option<Comparing>,
    pub split: f32,
    pub clipboard: Clipboard,
    /// The point that was measured last.
    pub measured: Option<DVec3>,
    pub options: Options,
    pub pace: Pace,
    /// When the picture last moved, until it rests.
    pub moved: Option<Instant>,
    /// The frame before was one of those that move.
    pub was_moving: bool,
    /// The last input, until the whole picture answers to it.
    pub input_at: Option<Instant>,
    /// What is shown is not the scene, or not from the camera, of now.
    pub is_stale: bool,
    /// The picture may need pipelines that are not there yet.
    pub is_unsure: bool,
    /// The picture that is shown.
    pub shown: Use,
    /// How many steps to the picture at rest are drawn.
    pub refined: usize,
    /// Of those, something coarser comes before all of the picture.
    pub is_hasty: bool,
    /// How many splats the picture at rest is made of, once they are counted.
    pub splats_drawn: Option<u64>,
    /// When the next one may be.
    pub refines: Option<Instant>,
    /// When the costs of frames are looked for.
    pub looks_for_costs: Option<Instant>,
    /// When memory is given back, if nothing is to be drawn by then.
    pub tidies: Option<Instant>,
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
            gpu,
            loader,
            ui,
            settings,
            samples,
            input: Input::default(),
            files: Files::default(),
            path,
            drawn: None,
            document: None,
            prepared: None,
            navigation: None,
            edits: Edits { things: Vec::new(), splat_scale: 1.0 },
            thing: 0,
            comparing: None,
            split: 0.5,
            clipboard: Clipboard::default(),
            measured: None,
            pace: Pace::default(),
            moved: None,
            was_moving: false,
            input_at: None,
            is_stale: true,
            is_unsure: true,
            refined: 0,
            is_hasty: false,
            splats_drawn: None,
            refines: None,
            looks_for_costs: None,
            looks_for_pages: None,
            tidies: None,
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
        (self.is_stale, self.is_unsure) = (true, true);
        self.window.request_redraw();
    }

    /// Tells something, in the window and on the standard error.
    pub fn tell(&mut self, text: &str) {
        console::say(text);
        self.ui.tell(text);
        self.window.request_redraw();
    }

    /// News of the thread that reads files.
    ///
    /// # Errors
    /// Of the first files, or the device.
    pub fn hear(&mut self, news: News) -> Result<()> {
        match news {
            News::Opened(document) => self.opened(*document),
            News::Prepared(prepared) if self.loader.is_newest(prepared.job) => {
                self.prepared = Some(OnDevice::Whole(prepared.scene, prepared.step));
                self.changed();
                Ok(())
            }
            News::Prepared(_) => Ok(()),
            // It may be for a device that is lost.
            News::Upload(_, job, answer) if !self.loader.is_newest(job) => {
                let _ = answer.send(Err(Error::option("scene", "another one has come")));
                Ok(())
            }
            News::Upload(staging, _, answer) => {
                let done = self.gpu.headless.queue().run_once("upload", |commands| {
                    // SAFETY: recording; the thread keeps what it uploads to until it has the answer, which comes after the wait.
                    unsafe { staging.record(commands) };
                    Ok(())
                });
                // A thread that is gone needs no answer.
                let _ = answer.send(done);
                Ok(())
            }
            #[cfg(feature = "live-shaders")]
            News::Shaders(compiled) => {
                self.take_shaders(compiled);
                Ok(())
            }
            News::Failed(error) if self.document.is_none() => Err(error),
            News::Failed(error) => {
                self.ui.reading = None;
                self.tell(&error.to_string());
                Ok(())
            }
        }
    }

    fn opened(&mut self, document: Document) -> Result<()> {
        let first = self.document.is_none();
        if first {
            let said = (self.options.said)(document.picture.over(self.settings.clone()));
            self.samples = said.samples;
            self.settings = Settings { samples: Samples(1), ..said };
            self.other = self.settings.clone();
            self.first.0 = self.settings.clone();
        }
        if let Err(error) = self.settings.check_scene(&document.scene) {
            if first {
                return Err(error);
            }
            // What is shown stays.
            self.ui.reading = None;
            self.keeps_camera = false;
            self.tell(&error.to_string());
            return Ok(());
        }
        match &mut self.navigation {
            Some(navigation) if self.keeps_camera => navigation.set_ball(document.ball),
            navigation => *navigation = Some(Navigation::new(document.camera, document.ball)),
        }
        if !(self.keeps_camera && self.edits.things.len() == Edits::none(&document.scene).things.len()) {
            (self.edits, self.thing) = (Edits::none(&document.scene), 0);
        }
        let names: Vec<_> = document.inputs.iter().map(|input| input.name.as_str()).collect();
        self.window.set_title(&format!("{} - surfel (? shows the keys)", names.join(", ")));
        self.ui.reading = None;
        self.files.watch(&document.files.files);
        self.document = Some(document);
        let is_other = !std::mem::take(&mut self.keeps_camera);
        // Pages of what the file was.
        self.prepared.take_if(|prepared| prepared.pages().is_some());
        self.prepare(is_other);
        self.changed();
        Ok(())
    }

    /// Brings the scene to the device, with the changes of now. `is_other`: it is not that which is shown, so that a part of it is better
    /// than nothing.
    pub fn prepare(&mut self, is_other: bool) {
        let Some(document) = &self.document else { return };
        let Some(path) = &document.paged else {
            let device = self.gpu.headless.device().clone();
            self.loader.prepare(Arc::clone(&document.scene), self.edits.clone(), device, is_other);
            return;
        };
        if !is_other && self.edits.splat_scale != 1.0 {
            self.edits.splat_scale = 1.0;
            self.ui.tell("splats of files that are read in pages keep their size");
        }
        if is_other || self.prepared.as_ref().is_none_or(|prepared| prepared.pages().is_none()) {
            let paged = LevelsFile::open(path).and_then(|file| {
                Paged::new(file, self.options.most_paged_bytes, document.scene.lights.clone())
            });
            match paged {
                Ok(paged) => self.prepared = Some(OnDevice::Paged(Box::new(paged))),
                Err(error) => self.tell(&error.to_string()),
            }
        }
    }

    /// Closes the window; keeps what was compiled.
    pub fn close(self) {
        let Self { gpu, loader, prepared, .. } = self;
        drop(loader);
        drop(prepared);
        // A lost cache costs the next run some time, that is all.
        let _ = gpu.headless.renderer.shaders().save_cache();
    }
}
