//! Measures the floor under the three passes; see [`super::floor_passes::floor_frame`].

use ash::vk;

use super::floor_passes::{FLOOR_POINT_BYTES, FloorPoints};
use crate::renderer::{Headless, headless::submit_and_wait};
use crate::{
    arena::Arena,
    error::{Error, Result},
    frame::{FrameSlot, HeadlessTarget, SlotParts},
    graph::{
        BufferDesc as GraphBufferDesc, BufferState, Graph, ImageDesc,
        execute::{FrameProfile, Physical, Profile, Profiler},
    },
    passes::{self, DepthRange, Inputs, Needs, Place},
    prepare::{Placed, PreparedScene},
    scene::{Camera, Settings},
    vk::{Buffer, BufferDesc, MemoryUse, Staging},
};

/// The floor of one scene, camera and choice of settings, ready to be drawn again and again.
pub struct Floor<'a> {
    scene: &'a PreparedScene,
    camera: Camera,
    settings: Settings,
    chunks: Vec<Points>,
    target: HeadlessTarget,
    slot: FrameSlot,
}

/// Points as the floor draws them: x, y and depth in clip space, size in pixels.
pub(super) struct Points {
    pub buffer: Buffer,
    pub count: u32,
}

impl Points {
    /// In memory of the device, as the splats are: what the host can see too may be slow for it.
    pub fn upload(headless: &Headless, points: &[[f32; 4]]) -> Result<Self> {
        let bytes: &[u8] = bytemuck::cast_slice(points);
        // A buffer has at least a byte, also where nothing is drawn.
        let size = (bytes.len() as u64).max(FLOOR_POINT_BYTES);
        let usage = vk::BufferUsageFlags::STORAGE_BUFFER | vk::BufferUsageFlags::TRANSFER_DST;
        let desc = BufferDesc { name: "floor points", size, usage };
        let buffer = Buffer::new(headless.device(), desc, MemoryUse::Device)?;
        let mut staging = Staging::new(headless.device(), "upload of floor points", size)?;
        staging.push(&buffer, 0, bytes)?;
        headless.queue().run_once("upload of floor points", |commands| {
            // SAFETY: recording; `run_once` waits, and the buffer is alive till then.
            unsafe { staging.record(commands) };
            Ok(())
        })?;
        Ok(Self { buffer, count: points.len() as u32 })
    }
}

impl<'a> Floor<'a> {
    /// Precomputes the points. `survivors`: leave out those that the splat passes don't draw, which shortens the
    /// vertex stage too; else they stay, outside of the clip volume.
    ///
    /// # Errors
    /// [`crate::error::ErrorKind::Option`] for a scene with splats larger than the device's points; whatever the driver
    /// answers.
    pub fn new(
        headless: &Headless,
        scene: &'a PreparedScene,
        camera: &Camera,
        settings: &Settings,
        survivors: bool,
    ) -> Result<Self> {
        let device = headless.device();
        let arena = Arena::new();
        let draws = passes::draws(
            &arena,
            Placed::at_home(scene),
            (camera, DepthRange::default()),
            settings,
            &headless.renderer.limits,
        );
        let draws: Vec<_> = draws.collect();
        if draws.iter().any(|draw| draw.may_be_large) {
            let problem = "a splat may exceed the device's largest point: expected more and smaller splats, or a smaller --size";
            return Err(Error::option("bench", problem));
        }
        let points = |draw: &passes::Draw<'_>| {
            let count = draw.chunk.count;
            let size = u64::from(count) * FLOOR_POINT_BYTES;
            let desc = BufferDesc { name: "floor points", size, usage: vk::BufferUsageFlags::STORAGE_BUFFER };
            Ok(Points { buffer: Buffer::new(device, desc, MemoryUse::Readback)?, count })
        };
        let mut floor = Self {
            scene,
            camera: *camera,
            settings: passes::with_sums(settings, &headless.renderer.limits),
            chunks: draws.iter().map(points).collect::<Result<_>>()?,
            target: HeadlessTarget::new(device, vk::Format::R8G8B8A8_SRGB, settings.size_px)?,
            slot: FrameSlot::new(device),
        };
        floor.record(headless, None, true)?;
        for chunk in &mut floor.chunks {
            // SAFETY: `record` has waited.
            let all = unsafe { chunk.buffer.bytes() }.chunks_exact(FLOOR_POINT_BYTES as usize);
            let kept: Vec<[f32; 4]> = all
                .map(bytemuck::pod_read_unaligned::<[f32; 4]>)
                .filter(|point| !survivors || point[0] < 2.0)
                .collect();
            *chunk = Points::upload(headless, &kept)?;
        }
        Ok(floor)
    }

    /// How many points are drawn.
    pub fn count(&self) -> u64 {
        self.chunks.iter().map(|chunk| u64::from(chunk.count)).sum()
    }

    /// Draws one frame and measures it. A driver need not run a shader that does nothing, and then counts no fragments of
    /// the first pass: its counts are `None`.
    ///
    /// # Errors
    /// Whatever the driver answers.
    pub fn frame(&mut self, headless: &Headless, profile: Profile) -> Result<FrameProfile> {
        self.record(headless, Some(profile), false)?;
        // SAFETY: waited for.
        let read = |profiler: &Profiler| unsafe { profiler.read() };
        let mut measured = self.slot.profiler().map_or_else(|| Ok(FrameProfile::default()), read)?;
        if let Some(depth) = measured.passes.first_mut() {
            depth.counts = depth.counts.filter(|counts| counts.fragments > 0);
        }
        Ok(measured)
    }

    fn record(&mut self, headless: &Headless, profile: Option<Profile>, precompute: bool) -> Result<()> {
        let arena = Arena::new();
        let draws = passes::draws(
            &arena,
            Placed::at_home(self.scene),
            (&self.camera, DepthRange::default()),
            &self.settings,
            &headless.renderer.limits,
        );
        let draws: Vec<_> = draws.collect();
        // Each chunk's points are a set in both passes that draw them.
        let room = passes::room_of_lists(2 * self.chunks.len() as u32);
        // Once more, in case that the wait for the frame before failed.
        headless.queue().wait_submitted()?;
        // SAFETY: every submission was waited for.
        unsafe { self.slot.begin(Needs { room, ..Needs::default() }, profile) }?;
        let SlotParts { descriptors, execution, .. } = self.slot.parts()?;
        let place = Place::Device(&headless.renderer.shaders, descriptors);
        let inputs = Inputs { draws: &draws, ..Inputs::new(&self.camera, &self.settings, place) };
        let mut graph = Graph::new(&arena);
        let host = BufferState { stages: vk::PipelineStageFlags2::HOST, access: vk::AccessFlags2::HOST_READ };
        let mut imports = Vec::new();
        let mut handles = Vec::new();
        for (number, chunk) in self.chunks.iter().enumerate() {
            let name = format!("floor points {number}");
            let desc = GraphBufferDesc::of_bytes(chunk.buffer.size());
            let last = precompute.then_some(host);
            let handle = graph.import_buffer(&name, desc, BufferState::default(), last);
            imports.push((handle.id(), Physical::Buffer(chunk.buffer.raw())));
            handles.push(handle);
        }
        if precompute {
            for (number, (draw, points)) in draws.iter().zip(&mut handles).enumerate() {
                super::floor_passes::floor_points(&mut graph, inputs, draw, number, points)?;
            }
        } else {
            let target = self.target.target();
            let desc = ImageDesc { format: target.format, extent: target.extent };
            let mut image = graph.import_image("target", desc, target.initial, None);
            imports.push((image.id(), Physical::Image(target.image, target.view)));
            let points: Vec<_> = handles
                .iter()
                .zip(&self.chunks)
                .map(|(buffer, chunk)| FloorPoints { buffer, count: chunk.count })
                .collect();
            super::floor_passes::floor_frame(&mut graph, inputs, &points, &mut image, target.format)?;
        }
        submit_and_wait(headless, |commands| {
            // SAFETY: recording; all that is used is alive until the wait.
            unsafe { execution.record(commands, &graph, &imports) }.map(drop)
        })
    }
}
