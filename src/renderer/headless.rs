//! A host of our own: a device, a queue, one frame at a time, pictures instead of a window.

mod in_parts;
mod samples;
mod targets;

use std::{
    path::{Path, PathBuf},
    sync::Arc,
    time::Instant,
};

use ash::vk;

use in_parts::Parts;
pub use in_parts::{LayerSums, PartSums, PartsAround};
use targets::Targets;

use super::{Readbacks, Renderer, SceneFrame, Seen};
use crate::{
    error::{Error, Result},
    frame::FrameSlot,
    graph::{
        Plan,
        execute::{FrameProfile, Profile},
    },
    prepare::PreparedScene,
    scene::{Camera, Scene, Settings},
    vk::{CommandPool, Device, Instance, Queue, Validation},
};

/// How a [`Headless`] is set up.
#[derive(Clone, Debug, Default)]
pub struct HeadlessOptions {
    /// Whether the validation layer watches.
    pub validation: Validation,
    /// The device: an index or a part of its name; `None` takes the best.
    pub device: Option<String>,
    /// Where compiled pipelines are kept; `None` keeps them in memory.
    pub cache_folder: Option<PathBuf>,
}

/// Renders to memory.
pub struct Headless {
    /// The renderer.
    pub renderer: Renderer,
    device: Device,
    queue: Queue,
    commands: CommandPool,
    slot: FrameSlot,
    targets: Option<Targets>,
    /// Of frames in parts, once there is one.
    parts: Option<Parts>,
}

/// What is wanted of a frame, beside its being drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Wanted {
    /// The picture: 8-bit sRGB, or linear 32-bit floats.
    pub picture: bool,
    /// The picture's pixels are linear 32-bit floats instead of 8-bit sRGB.
    pub linear: bool,
    /// The normalized surface.
    pub surface: bool,
    /// Times or counts of the passes.
    pub profile: Option<Profile>,
}

impl Wanted {
    /// The picture in 8-bit sRGB, and nothing else.
    pub const PICTURE: Self = Self { picture: true, linear: false, surface: false, profile: None };
}

/// A frame that is done. Images are row-major, top row first.
#[derive(Clone, Debug)]
pub struct Frame {
    /// Width and height in pixels.
    pub size_px: [u32; 2],
    /// RGBA, 8-bit sRGB (alpha linear); empty unless wanted so.
    pub srgb: Vec<[u8; 4]>,
    /// RGBA, linear; empty unless wanted so.
    pub linear: Vec<[f32; 4]>,
    /// Σ of weights; empty unless the surface was wanted, as are the three below.
    pub weight: Vec<f32>,
    /// Linear albedo; alpha is 1 where covered.
    pub albedo: Vec<[f32; 4]>,
    /// Unit normal in view space; the fourth is 1 where covered.
    pub normal: Vec<[f32; 4]>,
    /// View-space z of the normalized surface in world units, +∞ where empty.
    pub depth: Vec<f32>,
    /// What the passes cost, where it was asked for.
    pub profile: Option<FrameProfile>,
    /// Seconds from the submission to the end of the wait for it.
    pub wall_secs: f64,
    /// Seconds in which the host recorded it.
    pub record_secs: f64,
    /// What was recorded.
    pub plan: Arc<Plan>,
}

#[cfg(feature = "files")]
impl Frame {
    /// Writes the picture, [`Self::srgb`], as a PNG with straight alpha.
    ///
    /// # Errors
    /// As [`crate::save::png`]; [`crate::ErrorKind::Option`] where no such picture was wanted.
    pub fn save_png(&self, path: impl AsRef<Path>) -> Result<()> {
        crate::save::png(path.as_ref(), self.size_px, 4, self.srgb.as_flattened())
    }
}

impl Headless {
    /// Opens a device.
    ///
    /// # Errors
    /// As [`Instance::new`] and [`Device::new`].
    pub fn new(options: &HeadlessOptions) -> Result<Self> {
        let instance = Instance::new(options.validation)?;
        let device = Device::new(&instance, options.device.as_deref())?;
        Self::on(device, options.cache_folder.as_deref())
    }

    /// A host on a device of our own whose queue nobody has taken. `cache_folder`: as [`HeadlessOptions::cache_folder`].
    ///
    /// # Errors
    /// As [`Queue::new`]; whatever the driver answers.
    pub fn on(device: Device, cache_folder: Option<&Path>) -> Result<Self> {
        Ok(Self {
            renderer: Renderer::new(&device, cache_folder)?,
            queue: Queue::new(&device)?,
            commands: CommandPool::new(&device, "frame")?,
            slot: FrameSlot::new(&device),
            targets: None,
            parts: None,
            device,
        })
    }

    /// The device.
    pub fn device(&self) -> &Device {
        &self.device
    }

    /// The queue, for work beside frames.
    pub fn queue(&self) -> &Queue {
        &self.queue
    }

    /// Bytes of device memory in transients of the frame rendered last.
    pub fn transient_bytes(&self) -> u64 {
        self.slot.frame_bytes()
    }

    /// Gives back all that frames were drawn in and read through, for hosts that render nothing for a while: it is as much as the last frame has needed. The next frame makes its own anew.
    ///
    /// # Errors
    /// Whatever the driver answers, such as a lost device.
    pub fn forget_frames(&mut self) -> Result<()> {
        self.queue.wait_submitted()?;
        self.slot = FrameSlot::new(&self.device);
        (self.targets, self.parts) = (None, None);
        Ok(())
    }

    /// Refuses a renderer of another device, which nobody is kept from putting in the place of this one's.
    pub(super) fn check_renderer(&self) -> Result<()> {
        match self.renderer.device().is(&self.device) {
            true => Ok(()),
            false => Err(Error::option("renderer", "is of another device")),
        }
    }

    /// Uploads a scene and waits for it.
    ///
    /// # Errors
    /// Whatever the allocator or the driver answers.
    pub fn prepare(&self, scene: &Scene, progress: &dyn Fn(u64, u64)) -> Result<PreparedScene> {
        self.check_renderer()?;
        let mut submit = |staging: crate::vk::Staging| {
            self.queue.run_once("upload", |commands| {
                // SAFETY: recording; `run_once` waits, and the chunk that owns the targets is alive till then.
                unsafe { staging.record(commands) };
                Ok(())
            })
        };
        self.renderer.prepare(scene, &mut submit, progress)
    }

    /// Renders one frame and waits for it; of a picture with several samples one for each. Its times are those of all samples together, its
    /// plan and profile those of the last one; the surface is that of one sample in the middle.
    ///
    /// # Errors
    /// As [`Renderer::check`], and whatever driver or allocator answer.
    pub fn render(
        &mut self,
        scene: &PreparedScene,
        camera: &Camera,
        settings: &Settings,
        wanted: Wanted,
    ) -> Result<Frame> {
        if settings.samples.0 > 1 {
            return self.render_samples(scene, camera, settings, wanted);
        }
        self.render_frame(scene, camera, settings, wanted, None)
    }

    /// `sample`: whether it is the first one, and the last one.
    fn render_frame(
        &mut self,
        scene: &PreparedScene,
        camera: &Camera,
        settings: &Settings,
        wanted: Wanted,
        sample: Option<(bool, bool)>,
    ) -> Result<Frame> {
        self.check_renderer()?;
        // Before any image of that size is made.
        self.renderer.check(camera, settings)?;
        // What is measured changes no image: frames that are measured in different ways find the same memory, touched.
        let read = Wanted { profile: None, ..wanted };
        if self.targets.as_ref().is_none_or(|t| t.size_px != settings.size_px || t.wanted != read) {
            self.targets = None;
        }
        let targets = match &mut self.targets {
            Some(targets) => targets,
            none => none.insert(Targets::new(&self.device, settings.size_px, read)?),
        };
        let sample = sample.map(|ends| targets.sample(&self.device, ends)).transpose()?;
        // Once more, in case that the wait for the frame before failed.
        self.queue.wait_submitted()?;
        let begun = Instant::now();
        // SAFETY: every submission was waited for.
        let commands = unsafe { self.commands.begin() }?;
        let target = targets.target.target();
        let frame = SceneFrame {
            readbacks: Readbacks { sample, ..targets.readbacks() },
            profile: wanted.profile,
            ..SceneFrame::new(Seen { scene, camera, settings }, &target)
        };
        // SAFETY: recording; all that the frame uses is alive until the wait below; the same for the slot.
        let plan = unsafe { self.renderer.record_frame(commands, &mut self.slot, &frame) }?;
        let commands = self.commands.end()?;
        let record_secs = begun.elapsed().as_secs_f64();
        let submitted = Instant::now();
        // SAFETY: recorded just now; waited for at once.
        let epoch = unsafe { self.queue.submit(commands) }?;
        self.queue.wait(epoch)?;
        let wall_secs = submitted.elapsed().as_secs_f64();
        // SAFETY: waited for.
        let profile = self.slot.profiler().map(|profiler| unsafe { profiler.read() }).transpose()?;
        let is_read = sample.is_none_or(|sample| sample.last);
        // SAFETY: waited for.
        Ok(unsafe { targets.frame(plan, profile, is_read, wall_secs, record_secs) })
    }
}

/// Records, submits and waits with the headless host's own command buffer.
pub(crate) fn submit_and_wait(
    headless: &Headless,
    record: impl FnOnce(vk::CommandBuffer) -> Result<()>,
) -> Result<()> {
    headless.queue.wait_submitted()?;
    // SAFETY: every submission was waited for.
    record(unsafe { headless.commands.begin() }?)?;
    // SAFETY: recorded just now; waited for at once.
    let epoch = unsafe { headless.queue.submit(headless.commands.end()?) }?;
    headless.queue.wait(epoch)
}
