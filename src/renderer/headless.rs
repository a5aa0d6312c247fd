//! A host of our own: a device, a queue, one frame at a time, pictures instead of a window.

use std::{path::PathBuf, sync::Arc, time::Instant};

use ash::vk;

use super::{Readbacks, Renderer, SampleSum, bytes_per_pixel};
use crate::{
    error::{Error, Result},
    frame::{FrameSlot, HeadlessTarget},
    graph::{
        Plan,
        execute::{FrameProfile, Profile},
    },
    passes::Exported,
    prepare::PreparedScene,
    scene::{Camera, Samples, Scene, Settings},
    vk::{Buffer, BufferDesc, CommandPool, Device, Image, ImageDesc, Instance, MemoryUse, Queue, Validation},
};

/// How a [`Headless`] is set up.
#[derive(Clone, Debug)]
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
}

/// The target and the buffers that it is read through, for one size and one choice of [`Wanted`].
struct Targets {
    size_px: [u32; 2],
    wanted: Wanted,
    target: HeadlessTarget,
    picture: Option<Buffer>,
    surface: Option<[Buffer; 4]>,
    /// Where samples are added up, once there are some.
    samples: Option<Image>,
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

impl Headless {
    /// Opens a device.
    ///
    /// # Errors
    /// As [`Instance::new`] and [`Device::new`].
    pub fn new(options: &HeadlessOptions) -> Result<Self> {
        let instance = Instance::new(options.validation)?;
        let device = Device::new(&instance, options.device.as_deref())?;
        Ok(Self {
            renderer: Renderer::new(&device, options.cache_folder.as_deref())?,
            queue: Queue::new(&device)?,
            commands: CommandPool::new(&device, "frame")?,
            slot: FrameSlot::new(&device),
            targets: None,
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
        self.slot.transient_bytes()
    }

    /// Uploads a scene and waits for it.
    ///
    /// # Errors
    /// Whatever the allocator or the driver answers.
    pub fn prepare(&self, scene: &Scene, progress: &dyn Fn(u64, u64)) -> Result<PreparedScene> {
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
    /// As [`Renderer::record`].
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

    fn render_samples(
        &mut self,
        scene: &PreparedScene,
        camera: &Camera,
        settings: &Settings,
        wanted: Wanted,
    ) -> Result<Frame> {
        let surface = match wanted.surface {
            true => {
                let one = Settings { samples: Samples(1), ..settings.clone() };
                Some(self.render_frame(scene, camera, &one, Wanted { profile: None, ..wanted }, None)?)
            }
            false => None,
        };
        let wanted = Wanted { surface: false, ..wanted };
        let offsets_px = settings.samples.offsets_px(settings.kernel);
        let mut before = [0.0; 2];
        let mut last = None;
        for (number, offset_px) in offsets_px.iter().enumerate() {
            let ends = (number == 0, number + 1 == offsets_px.len());
            let frame = self.render_frame(scene, &camera.sample(*offset_px), settings, wanted, Some(ends))?;
            before = [before[0] + frame.wall_secs, before[1] + frame.record_secs];
            last = Some(frame);
        }
        let Some(frame) = last else { return Err(Error::option("--samples", "0: expected 1 or more")) };
        let [wall_secs, record_secs] = before;
        let frame = Frame { wall_secs, record_secs, ..frame };
        Ok(match surface {
            Some(Frame { weight, albedo, normal, depth, .. }) => {
                Frame { weight, albedo, normal, depth, ..frame }
            }
            None => frame,
        })
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
        // SAFETY: recording; all that the frame uses is alive until the wait below; the same for the slot.
        let plan = unsafe {
            self.renderer.record(
                commands,
                &mut self.slot,
                scene,
                camera,
                settings,
                &targets.target.target(),
                Readbacks { sample, ..targets.readbacks() },
                wanted.profile,
            )
        }?;
        let commands = self.commands.end()?;
        let record_secs = begun.elapsed().as_secs_f64();
        let submitted = Instant::now();
        // SAFETY: recorded just now; waited for at once.
        let epoch = unsafe { self.queue.submit(commands) }?;
        self.queue.wait(epoch)?;
        let wall_secs = submitted.elapsed().as_secs_f64();
        let profile = self.slot.profiler().map(|profiler| profiler.read()).transpose()?;
        let is_read = sample.is_none_or(|sample| sample.last);
        Ok(targets.frame(plan, profile, is_read, wall_secs, record_secs))
    }
}

impl Targets {
    fn new(device: &Device, size_px: [u32; 2], wanted: Wanted) -> Result<Self> {
        let format = match wanted.linear {
            true => vk::Format::R32G32B32A32_SFLOAT,
            false => vk::Format::R8G8B8A8_SRGB,
        };
        let buffer = |name: &str, format| {
            let pixels = u64::from(size_px[0]) * u64::from(size_px[1]);
            let size = pixels * bytes_per_pixel(format);
            let desc = BufferDesc { name, size, usage: vk::BufferUsageFlags::TRANSFER_DST };
            Buffer::new(device, desc, MemoryUse::Readback)
        };
        let surface = || -> Result<[Buffer; 4]> {
            let [weight, albedo, normal, depth] = Exported::FORMATS;
            Ok([
                buffer("read-back of weight", weight)?,
                buffer("read-back of albedo", albedo)?,
                buffer("read-back of normal", normal)?,
                buffer("read-back of depth", depth)?,
            ])
        };
        Ok(Self {
            size_px,
            wanted,
            target: HeadlessTarget::new(device, format, size_px)?,
            picture: wanted.picture.then(|| buffer("read-back of target", format)).transpose()?,
            surface: wanted.surface.then(surface).transpose()?,
            samples: None,
        })
    }

    /// The sum of samples, for the first one, the last one, or one in between.
    fn sample(&mut self, device: &Device, (first, last): (bool, bool)) -> Result<SampleSum> {
        let [width, height] = self.size_px;
        let image = match self.samples.take() {
            Some(image) => image,
            None => Image::new(
                device,
                ImageDesc {
                    name: "sum of samples",
                    format: vk::Format::R32G32B32A32_SFLOAT,
                    extent: vk::Extent2D { width, height },
                    usage: vk::ImageUsageFlags::COLOR_ATTACHMENT | vk::ImageUsageFlags::SAMPLED,
                },
            )?,
        };
        let sum = SampleSum { image: image.raw(), view: image.view(), first, last };
        self.samples = Some(image);
        Ok(sum)
    }

    fn readbacks(&self) -> Readbacks {
        Readbacks {
            target: self.picture.as_ref().map(Buffer::raw),
            surface: self.surface.as_ref().map(|buffers| buffers.each_ref().map(Buffer::raw)),
            sample: None,
        }
    }

    /// Copies what was wanted out of the buffers.
    fn frame(
        &self,
        plan: Arc<Plan>,
        profile: Option<FrameProfile>,
        is_read: bool,
        wall_secs: f64,
        record_secs: f64,
    ) -> Frame {
        let picture = self.picture.as_ref().filter(|_| is_read).map(Buffer::bytes).unwrap_or_default();
        let (srgb, linear) = match self.wanted.linear {
            false => (copied(picture), Vec::new()),
            true => (Vec::new(), copied(picture)),
        };
        let surface = |i: usize| self.surface.as_ref().map(|buffers| buffers[i].bytes()).unwrap_or_default();
        Frame {
            size_px: self.size_px,
            srgb,
            linear,
            weight: copied(surface(0)),
            albedo: copied(surface(1)),
            normal: copied(surface(2)),
            depth: copied(surface(3)),
            profile,
            wall_secs,
            record_secs,
            plan,
        }
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

fn copied<T: bytemuck::AnyBitPattern>(bytes: &[u8]) -> Vec<T> {
    bytes.chunks_exact(size_of::<T>()).map(bytemuck::pod_read_unaligned).collect()
}
