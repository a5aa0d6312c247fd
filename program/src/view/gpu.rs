//! A window's device: what draws a scene to a picture, and pictures to the window, a few frames in flight.

mod between;
mod images;

pub use between::Pipelines;

use std::{
    sync::Arc,
    time::{Duration, Instant},
};

use ash::vk;
use surfel::{
    Headless, Result,
    renderer::{Readbacks, SceneFrame},
    vk::{PipelineCache, Surface, Swapchain, Turn, Window},
};

use super::{
    device::is_device_lost,
    frame::{Frame, begin_rendering, end_rendering},
    frame_desc::{Drawn, FrameDesc},
    hidden, memory,
    overlay::OverlayPass,
    picture::{Begun, Picture, Use},
    show::Show,
};

/// How many frames the host records ahead of the device.
const IN_FLIGHT: usize = 2;

/// Pipelines that are kept for settings that come again: some twenty are of a frame, and as many of what a hand comes to next, nearer or as coarse as it must be.
const MOST_PIPELINES: usize = 64;

/// So many that were given up are worth to look for the memory that they leave.
const MANY_PIPELINES: usize = 25;

/// The device of a window.
pub struct Gpu {
    frames: Vec<Frame>,
    number: usize,
    pictures: [Picture; Use::ALL.len()],
    drawing: Option<Drawing>,
    swapchain: Option<Swapchain>,
    surface: Surface,
    window: Arc<dyn Window>,
    /// The host under it, for pictures beside the window's.
    pub headless: Headless,
    cache: PipelineCache,
    window_px: [u32; 2],
    fits: bool,
    /// When the frame before began; none where the window rested.
    before: Option<Instant>,
    period: Option<Duration>,
    /// So many frames to come wait for one whose pipelines were made while it was recorded, and tell of that.
    compiling: usize,
    /// Pipelines that were given up since memory was given back.
    dropped: usize,
    /// How many pipelines were made when all pictures were whole last.
    made_when_whole: u64,
    /// How many of the views of the last frame are whole.
    finished: usize,
    /// An image is acquired, and nothing is submitted yet that waits for its semaphore.
    is_acquired: bool,
}

/// The passes that draw to windows of a format.
struct Drawing {
    format: vk::Format,
    show: Show,
    overlay: OverlayPass,
}

impl Gpu {
    /// A device that was opened for a surface of the window.
    ///
    /// # Errors
    /// Whatever the driver answers.
    pub fn new(headless: Headless, surface: Surface, window: Arc<dyn Window>) -> Result<Self> {
        let device = headless.device();
        let frames = (0..IN_FLIGHT).map(|number| Frame::new(device, number)).collect::<Result<_>>()?;
        Ok(Self {
            frames,
            number: 0,
            pictures: Use::ALL.map(|_| Picture::new(device)),
            drawing: None,
            swapchain: None,
            cache: PipelineCache::open(device, None)?,
            surface,
            window,
            headless,
            window_px: [0; 2],
            fits: false,
            before: None,
            period: None,
            compiling: 0,
            dropped: 0,
            made_when_whole: 0,
            finished: 0,
            is_acquired: false,
        })
    }

    /// Draws a frame and shows it.
    ///
    /// # Errors
    /// As [`surfel::Renderer::record`]; whatever the driver answers, such as a lost device.
    pub fn draw(&mut self, desc: &FrameDesc<'_>) -> Result<Drawn> {
        if !self.make_images()? {
            return Ok(Drawn::Hidden);
        }
        let Some(swapchain) = &self.swapchain else { return Ok(Drawn::Hidden) };
        let (frame, begun) = (&self.frames[self.number], Instant::now());
        self.headless.queue().wait(frame.epoch)?;
        // SAFETY: the submission that waited for the semaphore last is done, and each image is presented before the next is acquired.
        let index = match unsafe { swapchain.acquire(&frame.acquired) }? {
            Turn::Done(index) => index,
            Turn::Suboptimal(index) => {
                self.fits = false;
                index
            }
            Turn::OutOfDate => return self.again(false),
            Turn::SurfaceLost => return self.again(true),
        };
        // Where the host waits, frames follow each other as fast as they can, whatever it is that takes the time.
        let waited = begun.elapsed() > Duration::from_millis(1);
        let before = self.before.replace(begun).filter(|_| waited && self.compiling == 0);
        self.period = before.map(|before| begun - before);
        self.compiling = self.compiling.saturating_sub(1);
        self.is_acquired = true;
        match self.draw_to(index, desc) {
            Ok(drawn) => Ok(drawn),
            Err(error) => {
                // What was recorded is never submitted.
                desc.views.iter().for_each(|(which, _)| self.pictures[which.index()].forget());
                if self.is_acquired && !is_device_lost(&error) {
                    self.show_nothing(index)?;
                }
                Err(error)
            }
        }
    }

    /// Records, submits and presents.
    fn draw_to(&mut self, index: usize, desc: &FrameDesc<'_>) -> Result<Drawn> {
        let (Some(swapchain), Some(drawing)) = (&self.swapchain, &mut self.drawing) else {
            return Ok(Drawn::Hidden);
        };
        let Some(image) = swapchain.image(index) else { return Ok(Drawn::Again) };
        let (queue, frame) = (self.headless.queue(), &mut self.frames[self.number]);
        for (which, _) in desc.views {
            let slot = &mut self.pictures[which.index()];
            queue.wait(slot.next_epoch())?;
            slot.collect(|epoch| queue.is_done(epoch))?;
        }
        let begun = Instant::now();
        // SAFETY: acquired just now; submitted with this image below, or by `show_nothing`.
        unsafe { queue.tell_acquired(&frame.acquired, image) }?;
        // SAFETY: the frame's submission before was waited for.
        let commands = unsafe { frame.commands.begin() }?;
        let made = self.headless.renderer.shaders().made();
        let (mut compiles, mut unknown) = (false, 0);
        let mut steps = Vec::new();
        self.finished = 0;
        for (which, view) in desc.views {
            let slot = &mut self.pictures[which.index()];
            let first = slot.first_pass(view);
            let target = slot.target(self.headless.device(), view, made != self.made_when_whole)?;
            let sample = slot.sum(self.headless.device(), view)?;
            let readbacks = Readbacks { sample, ..Readbacks::default() };
            let drawn =
                SceneFrame { readbacks, profile: view.profile, ..SceneFrame::new(view.seen, &target) };
            // SAFETY: recording; the slot's frame or step before was waited for, and a step goes on with a picture that is the same in all that it depends on; scene, target and
            // renderer live until the queue is idle, for all that is dropped waits for its epoch.
            let step = unsafe { self.headless.renderer.record_step(commands, slot.slot(), &drawn, first) }?;
            slot.recorded(view, step.next);
            compiles |= step.new_pipelines > 0;
            unknown += step.unknown_pipelines;
            steps.push(first > 0 || step.next.is_some());
            if step.next.is_some() {
                break;
            }
            self.finished += 1;
        }
        // SAFETY: recording; the frame's submission before was waited for, so its pool and buffers are free; pictures are in the layout
        // that fragments sample them in once they were drawn.
        unsafe {
            frame.sets.reset();
            begin_rendering(self.headless.device(), commands, image, swapchain.extent());
            if let Some((uses, show)) = &desc.shown {
                let begun = steps.len().checked_sub(1).filter(|last| *last >= self.finished);
                let unfinished = begun.map(|last| desc.views[last].0);
                let uses = uses.map(|which| if unfinished == Some(which) { desc.before } else { which });
                let shots = uses.map(|which| self.pictures[which.index()].shot());
                if let [Some(first), Some(second)] = shots {
                    drawing.show.record(commands, (&self.cache, &frame.sets), [first, second], show)?;
                }
            }
            if let Some(overlay) = desc.overlay {
                let (sets, buffers) = (&frame.sets, &mut frame.overlay);
                drawing.overlay.record(commands, sets, buffers, overlay, self.window_px)?;
            }
            end_rendering(self.headless.device(), commands, image);
        }
        let commands = frame.commands.end()?;
        // SAFETY: recorded just now; `acquired` is to be signaled by the acquisition, `drawn` is waited for by the presentation below.
        let epoch = unsafe { queue.submit_for_window(commands, &frame.acquired, image) }?;
        (frame.epoch, self.is_acquired) = (epoch, false);
        let made_now = self.headless.renderer.shaders().made();
        compiles |= made_now != made;
        if compiles {
            self.compiling = IN_FLIGHT + 1;
        }
        if self.finished == desc.views.len() && !desc.views.is_empty() {
            self.made_when_whole = made_now;
        }
        for ((which, view), is_step) in desc.views.iter().zip(steps) {
            let slot = &mut self.pictures[which.index()];
            let what = match which {
                _ if slot.is_under_way() && hidden::is_of_hidden(desc.what) => hidden::STEP,
                _ if slot.is_under_way() => "step",
                Use::Other => "other",
                _ => desc.what,
            };
            let size_px = view.seen.settings.size_px;
            let input = desc.input;
            slot.submitted(epoch, Begun { at: begun, input, what, size_px, compiles, unknown, is_step });
        }
        self.number = (self.number + 1) % IN_FLIGHT;
        // Not while those of a picture are made, of which the first are the oldest.
        if !desc.views.is_empty() {
            // SAFETY: this thread alone records, and has submitted what it recorded.
            self.dropped += unsafe { self.headless.renderer.shaders().keep_newest(MOST_PIPELINES) };
        }
        if self.dropped >= MANY_PIPELINES {
            self.dropped = 0;
            memory::give_back();
        }
        // SAFETY: acquired and submitted above.
        match unsafe { queue.present(swapchain, index) }? {
            Turn::Done(()) => Ok(Drawn::Shown),
            Turn::Suboptimal(()) => {
                self.fits = false;
                Ok(Drawn::Shown)
            }
            Turn::OutOfDate => self.again(false),
            Turn::SurfaceLost => self.again(true),
        }
    }

    /// Shows an empty image in place of a frame that can't be recorded: an image that is acquired has to be presented, and its semaphore
    /// waited for.
    fn show_nothing(&mut self, index: usize) -> Result<()> {
        let Some(swapchain) = &self.swapchain else { return Ok(()) };
        let Some(image) = swapchain.image(index) else { return Ok(()) };
        let (device, queue, frame) =
            (self.headless.device(), self.headless.queue(), &mut self.frames[self.number]);
        // SAFETY: the frame's submission before was waited for, and what was recorded since is not submitted.
        let commands = unsafe { frame.commands.begin() }?;
        // SAFETY: recording; the image is acquired, and submitted below.
        unsafe {
            begin_rendering(device, commands, image, swapchain.extent());
            end_rendering(device, commands, image);
        }
        let commands = frame.commands.end()?;
        // SAFETY: as in `draw_to`.
        frame.epoch = unsafe { queue.submit_for_window(commands, &frame.acquired, image) }?;
        self.number = (self.number + 1) % IN_FLIGHT;
        (self.is_acquired, self.fits) = (false, false);
        // SAFETY: acquired and submitted above; what it comes to shows at the next frame.
        unsafe { queue.present(swapchain, index) }.map(drop)
    }
}
