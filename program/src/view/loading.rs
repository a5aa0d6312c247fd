//! The thread that reads files and prepares scenes, while the window goes on.

use std::{
    sync::{
        Arc,
        atomic::{AtomicBool, AtomicU64, Ordering},
        mpsc::{Receiver, RecvTimeoutError, Sender, channel, sync_channel},
    },
    thread::JoinHandle,
    time::Duration,
};

use surfel::{
    Error, Result,
    levels_file::LevelsFile,
    prepare::{PreparedScene, SplatSetLayout, prepare},
    scene::{Light, Scene, Settings, Storage},
    vk::{Device, Limits},
};
use winit::event_loop::EventLoopProxy;

use super::{
    edits::{Edits, part_of},
    opening::open,
    told::{News, Prepared, Step},
};
use crate::{camera::CameraChoice, console::Bars, inputs::Inputs};

/// A part of a scene is shown first where it has more splats.
const PART_FROM: usize = 200_000;
/// So many are a part of it.
const PART_SPLATS: usize = 60_000;
/// Levels of detail are made of more splats.
pub const LEVELS_FROM: usize = 300_000;

enum Job {
    Open {
        number: u64,
        files: Inputs,
        size_px: [u32; 2],
    },
    Prepare {
        number: u64,
        scene: Arc<Scene>,
        files: Arc<[LevelsFile]>,
        edits: Edits,
        device: Device,
        in_parts: bool,
    },
}

/// The thread, as the window knows it.
pub struct Loader {
    proxy: EventLoopProxy<News>,
    jobs: Option<Sender<Job>>,
    thread: Option<JoinHandle<()>>,
    newest: Arc<AtomicU64>,
    newest_files: Arc<AtomicU64>,
    is_reading: Arc<AtomicBool>,
    is_closing: Arc<AtomicBool>,
}

/// The thread, as it knows itself.
struct Worker {
    proxy: EventLoopProxy<News>,
    newest: Arc<AtomicU64>,
    /// Of the jobs that read files, which a scene that is prepared meanwhile does not replace.
    newest_files: Arc<AtomicU64>,
    is_reading: Arc<AtomicBool>,
    /// Nothing that the window is asked for is done any more.
    is_closing: Arc<AtomicBool>,
    limits: Limits,
    wants: Wants,
    bars: Bars,
}

/// What the command line wants of any scene.
pub struct Wants {
    pub camera: CameraChoice,
    /// In the place of a scene's own, if there are any.
    pub lights: Vec<Light>,
    pub storage: Storage,
    /// What frames are drawn with at first. Of a budget of splats all have to be known.
    pub settings: Settings,
    /// Names of the options that the user gave.
    pub said: Vec<&'static str>,
}

impl Loader {
    /// Starts the thread.
    pub fn new(proxy: EventLoopProxy<News>, limits: Limits, wants: Wants) -> Self {
        let (jobs, received) = channel();
        let [newest, newest_files] = [(); 2].map(|()| Arc::new(AtomicU64::new(0)));
        let (is_reading, is_closing) = (Arc::new(AtomicBool::new(false)), Arc::new(AtomicBool::new(false)));
        let worker = Worker {
            proxy: proxy.clone(),
            newest: Arc::clone(&newest),
            newest_files: Arc::clone(&newest_files),
            is_reading: Arc::clone(&is_reading),
            is_closing: Arc::clone(&is_closing),
            limits,
            wants,
            bars: Bars::new(),
        };
        let thread = std::thread::spawn(move || worker.run(&received));
        Self { proxy, jobs: Some(jobs), thread: Some(thread), newest, newest_files, is_reading, is_closing }
    }

    /// By which threads tell the window.
    pub fn proxy(&self) -> EventLoopProxy<News> {
        self.proxy.clone()
    }

    /// Reads files; the camera is for a picture of this size.
    pub fn open(&self, files: Inputs, size_px: [u32; 2]) {
        let number = self.next();
        self.newest_files.store(number, Ordering::Release);
        self.send(Job::Open { number, files, size_px });
    }

    /// Brings a scene with changes to a device, and those of the files beside it that are changed; a part of it first, if so wanted.
    pub fn prepare(
        &self,
        (scene, files, edits): (&Arc<Scene>, &Arc<[LevelsFile]>, &Edits),
        device: Device,
        in_parts: bool,
    ) {
        let number = self.next();
        let (scene, files, edits) = (Arc::clone(scene), Arc::clone(files), edits.clone());
        self.send(Job::Prepare { number, scene, files, edits, device, in_parts });
    }

    /// Whether a result is of the newest job.
    pub fn is_newest(&self, job: u64) -> bool {
        job == self.newest.load(Ordering::Acquire)
    }

    fn next(&self) -> u64 {
        self.newest.fetch_add(1, Ordering::AcqRel) + 1
    }

    fn send(&self, job: Job) {
        if let Some(jobs) = &self.jobs {
            // A thread that is gone has told why.
            let _ = jobs.send(job);
        }
    }
}

impl Drop for Loader {
    fn drop(&mut self) {
        // What it is at is of no use any more, and what it waits for does not come: this is the thread that would do it.
        self.next();
        self.is_closing.store(true, Ordering::Release);
        self.jobs = None;
        // Reading can't be interrupted, and has nothing of the device.
        if let Some(thread) = self.thread.take().filter(|_| !self.is_reading.load(Ordering::Acquire)) {
            let _ = thread.join();
        }
    }
}

impl Worker {
    fn run(&self, jobs: &Receiver<Job>) {
        while let Ok(job) = jobs.recv() {
            match job {
                Job::Open { number, .. } if number != self.newest_files.load(Ordering::Acquire) => {}
                Job::Prepare { number, .. } if !self.is_newest(number) => {}
                Job::Open { files, size_px, .. } => {
                    self.is_reading.store(true, Ordering::Release);
                    let opened = open(files, size_px, &self.wants, &self.bars);
                    self.is_reading.store(false, Ordering::Release);
                    self.tell(match opened {
                        Ok(document) => News::Opened(Box::new(document)),
                        Err(error) => News::Unread(error),
                    });
                }
                Job::Prepare { number, scene, files, edits, device, in_parts } => {
                    if let Err(error) = self.prepare(number, (&scene, &files, &edits), &device, in_parts) {
                        self.tell(News::Failed(error));
                    }
                }
            }
        }
    }

    /// Nobody hears it once the window is closed.
    fn tell(&self, news: News) {
        let _ = self.proxy.send_event(news);
    }

    fn is_newest(&self, job: u64) -> bool {
        job == self.newest.load(Ordering::Acquire)
    }

    /// Step by step, until another job comes.
    fn prepare(
        &self,
        job: u64,
        (scene, files, edits): (&Arc<Scene>, &[LevelsFile], &Edits),
        device: &Device,
        in_parts: bool,
    ) -> Result<()> {
        let mut edited;
        let scene = match edits.are_none() {
            true => &**scene,
            false => {
                edited = edits.of(scene);
                edited.objects.extend(edits.whole_files(scene, files, &self.bars)?);
                self.bars.clear();
                edited.epsilons.resize(edited.objects.len(), None);
                &edited
            }
        };
        let splats = scene.splat_count();
        let has_levels = scene.has_levels() || scene.levels;
        let mut steps = Vec::new();
        if in_parts && splats > PART_FROM {
            steps.push(Step::Part);
        }
        steps.push(if has_levels { Step::Leveled } else { Step::Whole });
        // Beside pages all of it is drawn, however coarse they are.
        if splats > LEVELS_FROM && !has_levels && files.is_empty() {
            steps.push(Step::Leveled);
        }
        let last = steps.last().copied();
        for step in steps {
            let is_last = Some(step) == last;
            let part;
            let scene = match step {
                Step::Part => {
                    part = part_of(scene, PART_SPLATS);
                    &part
                }
                Step::Leveled if !has_levels => {
                    part = Scene { levels: true, ..scene.clone() };
                    &part
                }
                _ => scene,
            };
            match self.upload(job, scene, device) {
                Ok(scene) => self.tell(News::Prepared(Box::new(Prepared { scene, step, is_last, job }))),
                // Nobody waits for it any more.
                Err(_) if !self.is_newest(job) => return Ok(()),
                Err(error) => return Err(error),
            }
        }
        Ok(())
    }

    /// Prepares a scene; the window's thread, which has the queue, submits.
    fn upload(&self, job: u64, scene: &Scene, device: &Device) -> Result<PreparedScene> {
        let left = || Error::option("scene", "another one has come, or the window is closed");
        let layout = SplatSetLayout::new(device)?;
        let mut submit = |staging| {
            let (answer, answered) = sync_channel(1);
            if !self.is_newest(job) || self.proxy.send_event(News::Upload(staging, job, answer)).is_err() {
                return Err(left());
            }
            loop {
                // Even if the job is not the newest any more: the window may be about to record the copies.
                match answered.recv_timeout(Duration::from_millis(50)) {
                    Ok(answer) => return answer,
                    Err(RecvTimeoutError::Timeout) if !self.is_closing.load(Ordering::Acquire) => {}
                    Err(_) => return Err(left()),
                }
            }
        };
        prepare(device, &self.limits, &layout, scene, &mut submit, &|_, _| {})
    }
}
