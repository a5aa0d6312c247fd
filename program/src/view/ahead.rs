//! Pictures that nobody sees, drawn by a thread and a device of their own before the window draws with other settings: a driver that compiles a pipeline when it first runs, as those of CPUs do,
//! holds up its queue for as long as that takes. What it has compiled it keeps on disk, where it finds it for the window's device within milliseconds. The validation layer watches that device, too,
//! where it watches the window's.

use std::{
    sync::{
        Arc,
        atomic::{AtomicBool, Ordering},
        mpsc::{Receiver, Sender, channel},
    },
    thread::JoinHandle,
};

use surfel::{
    Headless, Result,
    renderer::Wanted,
    scene::{Camera, Lod, Scene, Settings},
    vk::{Device, Instance},
};
use winit::event_loop::EventLoopProxy;

use super::{
    edits::{Edits, part_of},
    told::News,
};

/// Of a scene with more splats a part is drawn.
const MOST_SPLATS: usize = 200_000;

/// What decides which pipelines a picture has, but for the place of the camera, and for sizes.
#[derive(Clone, Debug, PartialEq)]
pub struct Kind {
    settings: Vec<Settings>,
    is_light: bool,
    is_parallel: bool,
    edits: Edits,
    has_levels: bool,
    /// Which files they are of, by where their scene is in memory.
    files: usize,
}

/// A picture, or several.
pub struct Job {
    pub scene: Arc<Scene>,
    pub edits: Edits,
    /// Levels of detail are made for moving pictures.
    pub has_levels: bool,
    pub camera: Camera,
    pub settings: Vec<Settings>,
    pub is_light: bool,
}

impl Job {
    fn kind(&self) -> Kind {
        let of = |settings: &Settings| Settings { size_px: [0; 2], lod: Lod::Auto, ..settings.clone() };
        Kind {
            settings: self.settings.iter().map(of).collect(),
            is_light: self.is_light,
            is_parallel: self.camera.orthographic_height.is_some(),
            edits: self.edits.clone(),
            has_levels: self.has_levels,
            files: Arc::as_ptr(&self.scene).addr(),
        }
    }

    /// All of the scene, or a part of one that is large, with all that decides about pipelines.
    fn scene(&self) -> Scene {
        let part = part_of(&self.scene, MOST_SPLATS);
        let part = Scene {
            storage: self.scene.storage,
            budget: self.scene.budget,
            numbered: self.scene.numbered,
            hybrids: self.scene.hybrids.clone(),
            levels: self.has_levels,
            ..part
        };
        if self.edits.are_none() { part } else { self.edits.of(&part) }
    }
}

/// The thread, as the window knows it.
pub struct Ahead {
    jobs: Option<Sender<Job>>,
    thread: Option<JoinHandle<()>>,
    is_closing: Arc<AtomicBool>,
    /// Those that were asked for since [`Self::begin`] or are not done yet, and whether they are.
    kinds: Vec<(Kind, bool)>,
}

impl Ahead {
    /// For a device that compiles pipelines when they first run; `None` for others.
    pub fn new(device: &Device, proxy: EventLoopProxy<News>) -> Option<Self> {
        if !device.facts().limits.is_cpu {
            return None;
        }
        let (jobs, received) = channel();
        let is_closing = Arc::new(AtomicBool::new(false));
        let worker = Worker {
            instance: device.instance().clone(),
            device: device.facts().name.clone(),
            proxy,
            is_closing: Arc::clone(&is_closing),
        };
        let thread = std::thread::spawn(move || worker.run(&received));
        Some(Self { jobs: Some(jobs), thread: Some(thread), is_closing, kinds: Vec::new() })
    }

    /// Whether pipelines of such pictures have run, as far as is known; they are drawn, once, where some of them were made just now: `is_new`.
    pub fn is_ready(&mut self, job: Job, is_new: bool) -> bool {
        let kind = job.kind();
        if let Some((_, is_done)) = self.kinds.iter().find(|(known, _)| *known == kind) {
            // A thread that is gone answers nothing any more.
            return *is_done || self.thread.as_ref().is_none_or(JoinHandle::is_finished);
        }
        let sent = is_new && self.jobs.as_ref().is_some_and(|jobs| jobs.send(job).is_ok());
        if sent {
            self.kinds.push((kind, false));
        }
        !sent
    }

    /// Other pictures are to be drawn, or the same ones of other sizes, which may have other pipelines.
    pub fn begin(&mut self) {
        self.kinds.retain(|(_, is_done)| !is_done);
    }

    /// The thread has drawn them.
    pub fn is_done(&mut self, kind: &Kind) {
        let kinds = self.kinds.iter_mut().filter(|(known, _)| known == kind);
        kinds.for_each(|(_, is_done)| *is_done = true);
    }

    /// Nothing more is begun. What is under way is waited for where this is dropped: a driver can't be interrupted while it compiles.
    pub fn stop(&mut self) {
        self.is_closing.store(true, Ordering::Release);
        self.jobs = None;
    }
}

impl Drop for Ahead {
    fn drop(&mut self) {
        self.stop();
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}

/// The thread, as it knows itself.
struct Worker {
    /// The window's.
    instance: Instance,
    /// Its name.
    device: String,
    proxy: EventLoopProxy<News>,
    is_closing: Arc<AtomicBool>,
}

impl Worker {
    fn run(&self, jobs: &Receiver<Job>) {
        let mut waiting = Vec::new();
        while let Ok(job) = jobs.recv() {
            waiting.push(job);
            // The newest is what the window waits for.
            while let Some(job) = {
                waiting.extend(jobs.try_iter());
                waiting.pop()
            } {
                if self.is_closing.load(Ordering::Acquire) {
                    return;
                }
                // What is wrong with it the window tells, which draws it next.
                let _ = self.draw(&job);
                // Nobody hears it once the window is closed.
                let _ = self.proxy.send_event(News::Ran(Box::new(job.kind())));
            }
        }
    }

    /// Mesa writes what it has compiled by a thread of the least priority. An instance waits for that thread where it is destroyed, so that each job has its own.
    fn draw(&self, job: &Job) -> Result<()> {
        let device = Device::new(&self.instance.another()?, Some(&self.device))?;
        let mut headless = Headless::on(device, None)?;
        let scene = headless.prepare(&job.scene(), &|_, _| {})?;
        let wanted = Wanted { linear: job.is_light, ..Wanted::PICTURE };
        for settings in &job.settings {
            if self.is_closing.load(Ordering::Acquire) {
                break;
            }
            headless.render(&scene, &job.camera, settings, wanted)?;
        }
        Ok(())
    }
}
