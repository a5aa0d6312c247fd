//! Measures the floor under the three passes; see [`passes::floor_frame`].

use ash::vk;

use super::{Headless, headless::submit_and_wait};
use crate::{
    error::{Error, Result},
    frame::{FrameSlot, HeadlessTarget},
    graph::{
        BufferDesc as GraphBufferDesc, BufferState, Graph, ImageDesc,
        execute::{FrameProfile, Physical, Profile, Transients, execute, memory_need},
    },
    passes::{self, FLOOR_POINT_BYTES, Inputs},
    prepare::PreparedScene,
    scene::{Camera, Settings},
    vk::{Buffer, BufferDesc, MemoryUse, PoolRoom},
};

/// The floor of one scene, camera and choice of settings, ready to be drawn again and again.
pub struct Floor<'a> {
    scene: &'a PreparedScene,
    camera: Camera,
    settings: Settings,
    points: Buffer,
    count: u32,
    target: HeadlessTarget,
    slot: FrameSlot,
}

impl<'a> Floor<'a> {
    /// Precomputes the points. `survivors`: leave out those that the splat passes don't draw, which shortens the
    /// vertex stage too; else they stay, outside of the clip volume.
    ///
    /// # Errors
    /// [`crate::error::ErrorKind::Option`] for a scene of more than one chunk or with splats larger than the device's
    /// points; whatever the driver answers.
    pub fn new(
        headless: &Headless,
        scene: &'a PreparedScene,
        camera: &Camera,
        settings: &Settings,
        survivors: bool,
    ) -> Result<Self> {
        let device = headless.device();
        let draws = passes::draws(scene, camera, settings, &headless.renderer.limits);
        let [draw] = draws.as_slice() else {
            return Err(Error::option("bench floor", "the floor is measured with one object of one chunk"));
        };
        if draw.may_be_large {
            let problem = "a splat may exceed the device's largest point: choose a farther camera";
            return Err(Error::option("bench floor", problem));
        }
        let buffer = |memory| {
            let size = u64::from(draw.chunk.count) * FLOOR_POINT_BYTES;
            let desc = BufferDesc { name: "floor points", size, usage: vk::BufferUsageFlags::STORAGE_BUFFER };
            Buffer::new(device, desc, memory)
        };
        let mut floor = Self {
            scene,
            camera: *camera,
            settings: settings.clone(),
            points: buffer(MemoryUse::Readback)?,
            count: draw.chunk.count,
            target: HeadlessTarget::new(device, vk::Format::R8G8B8A8_SRGB, settings.size_px)?,
            slot: FrameSlot::new(device),
        };
        floor.record(headless, None, true)?;
        if survivors {
            let drawn: Vec<[f32; 4]> = floor
                .points
                .bytes()
                .chunks_exact(FLOOR_POINT_BYTES as usize)
                .map(bytemuck::pod_read_unaligned::<[f32; 4]>)
                .filter(|point| point[0] < 2.0)
                .collect();
            floor.count = drawn.len() as u32;
            let bytes: &[u8] = bytemuck::cast_slice(&drawn);
            let mut kept = buffer(MemoryUse::Upload)?;
            kept.bytes_mut()[..bytes.len()].copy_from_slice(bytes);
            floor.points = kept;
        }
        Ok(floor)
    }

    /// How many points are drawn.
    pub fn count(&self) -> u32 {
        self.count
    }

    /// Draws one frame and measures it.
    ///
    /// # Errors
    /// Whatever the driver answers.
    pub fn frame(&mut self, headless: &Headless, profile: Profile) -> Result<FrameProfile> {
        self.record(headless, Some(profile), false)?;
        self.slot.profiler().map_or_else(|| Ok(FrameProfile::default()), |profiler| profiler.read())
    }

    fn record(&mut self, headless: &Headless, profile: Option<Profile>, precompute: bool) -> Result<()> {
        let device = headless.device();
        let draws = passes::draws(self.scene, &self.camera, &self.settings, &headless.renderer.limits);
        // SAFETY: every frame is waited for.
        unsafe { self.slot.begin(PoolRoom { sets: 3, buffers: 12, ..PoolRoom::default() }, profile) }?;
        let (descriptors, transients, profiler) = self.slot.parts()?;
        let inputs = Inputs {
            draws: &draws,
            camera: &self.camera,
            settings: &self.settings,
            shaders: &headless.renderer.shaders,
            descriptors,
        };
        let mut graph = Graph::new();
        let desc = GraphBufferDesc { size_bytes: self.points.size() };
        let host = BufferState { stages: vk::PipelineStageFlags2::HOST, access: vk::AccessFlags2::HOST_READ };
        let mut points = graph.import_buffer("floor points", desc, BufferState::default(), Some(host));
        let mut imports = vec![(points.id(), Physical::Buffer(self.points.raw()))];
        if precompute {
            passes::floor_points(&mut graph, inputs, &mut points)?;
        } else {
            let target = self.target.target();
            let desc = ImageDesc { format: target.format, extent: target.extent };
            let mut image = graph.import_image("target", desc, target.initial, None);
            imports.push((image.id(), Physical::Image(target.image, target.view)));
            passes::floor_frame(&mut graph, inputs, &points, self.count, &mut image, target.format)?;
        }
        let compiled = graph.compile(|_, desc, usage| Ok(memory_need(device, desc, usage)))?;
        let transients = match transients {
            Some(kept) if kept.fit(&compiled.plan) => kept,
            other => other.insert(Transients::new(device, &compiled.plan)?),
        };
        submit_and_wait(headless, |commands| {
            // SAFETY: recording; all that is used is alive until the wait.
            unsafe { execute(device, commands, compiled, transients, &imports, profiler) }
        })
    }
}
