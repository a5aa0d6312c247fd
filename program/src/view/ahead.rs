//! Pictures that nobody sees, drawn by a thread and a device of their own before the window draws with other settings: a driver that compiles a pipeline when it first runs, as those of CPUs do,
//! holds up its queue for as long as that takes. What it has compiled it keeps on disk, where it finds it for the window's device within milliseconds. The validation layer watches that device, too,
//! where it watches the window's.

mod kind;

use std::{
    sync::{
        Arc,
        atomic::{AtomicBool, Ordering},
        mpsc::{Receiver, Sender, channel},
    },
    thread::JoinHandle,
};

use kind::{Kind, Known, Of};
use surfel::{
    Headless, Result,
    frame::{FrameSlot, HeadlessTarget},
    renderer::{SceneFrame, Seen},
    scene::{Camera, Scene, Settings, TileMemory},
    vk::{Device, Instance},
};
use winit::event_loop::EventLoopProxy;

use super::{
    edits::{Edits, some_of},
    frame_desc::format,
    told::News,
};

/// Of a scene with more splats so many are drawn: half of them, where the others face away, are more than one dispatch takes of a tile, which is another pipeline's beyond, as of the scene itself. They keep
/// their size, by which tiles are as high as for all of them, and have all the memory that lists want: bands of few splats would have none beyond.
const MOST_SPLATS: usize = 600_000;
const MOST_MEMORY: TileMemory = TileMemory::Most(1 << 40);

/// Pictures, one after the other.
pub struct Job {
    pub scene: Arc<Scene>,
    pub edits: Edits,
    /// Levels of detail are made for moving pictures.
    pub has_levels: bool,
    pub is_light: bool,
    /// Those that the window draws next.
    pub next: Vec<(Camera, Settings)>,
    /// Those that it may draw soon.
    pub soon: Vec<(Camera, Settings)>,
    /// The window does not show the next.
    pub is_hidden: bool,
}

impl Job {
    fn kinds<'a>(&self, pictures: impl Iterator<Item = &'a (Camera, Settings)>) -> Vec<Kind> {
        let mut kinds: Vec<Kind> = Vec::new();
        for (camera, settings) in pictures {
            let of = Of::new((&self.scene, &self.edits, self.has_levels), camera, self.is_light);
            let kind = Kind { camera: *camera, settings: settings.clone(), of };
            if !kinds.contains(&kind) {
                kinds.push(kind);
            }
        }
        kinds
    }

    fn all(&self) -> Vec<Kind> {
        self.kinds(self.next.iter().chain(&self.soon))
    }

    /// All of the scene, or some of one that is large, with all that decides about pipelines.
    fn scene(&self) -> Scene {
        let own = &*self.scene;
        let some = Scene {
            storage: own.storage,
            budget: own.budget,
            numbered: own.numbered,
            hybrids: own.hybrids.clone(),
            without_auto_epsilon: own.without_auto_epsilon,
            levels: self.has_levels,
            ..some_of(own, MOST_SPLATS).0
        };
        if self.edits.are_none() { some } else { self.edits.of(&some) }
    }
}

/// What the thread has done of a job.
pub struct Ran {
    /// The pictures of the job.
    kinds: Vec<Kind>,
    /// So many of them are drawn, the others were left for another job.
    drawn: usize,
    /// The pipelines that ran for these, by [`surfel::passes::Shaders::numbers`].
    pub pipelines: Vec<u64>,
}

/// The thread, as the window knows it.
pub struct Ahead {
    jobs: Option<Sender<Job>>,
    thread: Option<JoinHandle<()>>,
    is_closing: Arc<AtomicBool>,
    known: Known,
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
        Some(Self { jobs: Some(jobs), thread: Some(thread), is_closing, known: Known::default() })
    }

    /// Whether the window is to draw the next pictures though some of their pipelines have run nowhere; else the thread draws them first.
    pub fn leaves(&mut self, job: Job) -> bool {
        let next = job.kinds(job.next.iter());
        if self.known.wait(&next, job.is_hidden) {
            // A thread that is gone answers nothing any more.
            return self.is_finished();
        }
        if self.known.are_drawn(&next) || self.known.is_behind() {
            return true;
        }
        let (all, is_hidden) = (job.all(), job.is_hidden);
        let sent = self.jobs.as_ref().is_some_and(|jobs| jobs.send(job).is_ok());
        if sent {
            self.known.ask(all, is_hidden);
        }
        !sent
    }

    /// Other pictures are to be drawn, or the same ones from elsewhere, which may have other pipelines.
    pub fn begin(&mut self) {
        self.known.begin();
    }

    /// The thread has drawn these.
    pub fn are_done(&mut self, ran: Ran) {
        self.known.are_done(ran.kinds, ran.drawn);
    }

    /// Nothing more is begun. What is under way is waited for where this is dropped: a driver can't be interrupted while it compiles.
    pub fn stop(&mut self) {
        self.is_closing.store(true, Ordering::Release);
        self.jobs = None;
    }

    /// Whether nothing is under way any more, and nothing will be.
    pub fn is_finished(&self) -> bool {
        self.thread.as_ref().is_none_or(JoinHandle::is_finished)
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
                let kinds = job.all();
                let drawn = self.draw(&job, &kinds, || {
                    waiting.extend(jobs.try_iter());
                    job.is_hidden && waiting.iter().any(|other| !other.is_hidden)
                });
                // What is wrong with it the window tells, which draws it next.
                let (drawn, pipelines) = drawn.unwrap_or((kinds.len(), Vec::new()));
                // Nobody hears it once the window is closed.
                let _ = self.proxy.send_event(News::Ran(Ran { kinds, drawn, pipelines }));
            }
        }
    }

    /// Mesa writes what it has compiled by a thread of the least priority. An instance waits for that thread where it is destroyed, so that each job has its own.
    /// How many pictures are drawn before another job is more urgent, or the window is closed; and by which pipelines.
    fn draw(&self, job: &Job, kinds: &[Kind], mut ends: impl FnMut() -> bool) -> Result<(usize, Vec<u64>)> {
        let device = Device::new(&self.instance.another()?, Some(&self.device))?;
        let headless = Headless::on(device, None)?;
        let some = job.scene();
        let tile_memory = (some.splat_count() < job.scene.splat_count()).then_some(MOST_MEMORY);
        let scene = headless.prepare(&some, &|_, _| {})?;
        drop(some);
        let mut drawn = 0;
        for kind in kinds {
            if self.is_closing.load(Ordering::Acquire) || ends() {
                break;
            }
            let tile_memory = tile_memory.unwrap_or(kind.settings.tile_memory);
            let settings = Settings { tile_memory, ..kind.settings.clone() };
            draw(&headless, Seen { scene: &scene, camera: &kind.camera, settings: &settings }, job.is_light)?;
            drawn += 1;
        }
        Ok((drawn, headless.renderer.shaders().numbers()))
    }
}

/// Draws a picture to an image of the window's format, for a format has its own pipelines.
fn draw(headless: &Headless, seen: Seen<'_>, is_light: bool) -> Result<()> {
    // Before any image of that size is made.
    headless.renderer.check(seen.camera, seen.settings)?;
    let image = HeadlessTarget::new(headless.device(), format(is_light), seen.settings.size_px)?;
    let (target, mut slot) = (image.target(), FrameSlot::new(headless.device()));
    headless.queue().run_once("ahead", |commands| {
        // SAFETY: recording; the slot is new, and `run_once` waits while all of these are alive.
        unsafe { headless.renderer.record(commands, &mut slot, &SceneFrame::new(seen, &target)) }.map(drop)
    })
}
