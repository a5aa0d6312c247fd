//! Frames in parts by the headless host: stage by stage, each of which it waits for. Who reduces over parts is the caller.

mod layers;

use std::{sync::Arc, time::Instant};

use ash::vk;

use super::super::Seen;
use super::{Frame, Headless, Targets, Wanted, targets::copied};
use crate::{
    error::{Error, Result},
    frame::FrameSlot,
    graph::Plan,
    prepare::PreparedScene,
    renderer::Stage,
    scene::{Camera, Settings},
    vk::{Buffer, BufferDesc, Device, MemoryUse},
};

use layers::LayerParts;
pub use layers::{LayerSums, PartsAround};

/// The sums of splats of a part, or of all: four values a pixel, row by row from the top left.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PartSums {
    /// Σ weight · linear red, green, blue; Σ weight.
    pub colors: Vec<f32>,
    /// Σ weight · normal in view space; Σ weight · z / z_visible where it was asked for, of a transparent layer Σ weight · alpha.
    pub normals: Vec<f32>,
}

/// What lives as long as the host, for pictures of one size.
pub(super) struct Parts {
    size_px: [u32; 2],
    /// Of the stages before the picture, so that each finds its frame of before.
    slots: [FrameSlot; 2],
    depth: Buffer,
    sums: [Buffer; 2],
    /// Of pictures that have transparent layers.
    layers: Option<LayerParts>,
}

impl Parts {
    fn new(device: &Device, size_px: [u32; 2]) -> Result<Self> {
        Ok(Self {
            size_px,
            slots: [(); 2].map(|()| FrameSlot::new(device)),
            depth: buffer(device, size_px, "depth of parts", 4)?,
            sums: [
                buffer(device, size_px, "colors of parts", 16)?,
                buffer(device, size_px, "normals of parts", 16)?,
            ],
            layers: None,
        })
    }

    fn sums(&self) -> [vk::Buffer; 2] {
        self.sums.each_ref().map(Buffer::raw)
    }
}

#[cfg(feature = "inside")]
impl Headless {
    /// What is seen of a part: near / z of the nearest surface at each pixel, 0 where there is none. Of all parts it is the largest.
    ///
    /// # Errors
    /// As [`crate::renderer::Renderer::record_stage`].
    pub fn see_part(
        &mut self,
        scene: &PreparedScene,
        camera: &Camera,
        settings: &Settings,
    ) -> Result<Vec<f32>> {
        let mut parts = self.parts(settings)?;
        let stage = Stage::See { depth: parts.depth.raw() };
        self.run_stage(&mut parts.slots[0], scene, camera, settings, stage)?;
        // SAFETY: waited for.
        let depth = copied(unsafe { parts.depth.bytes() });
        self.parts = Some(parts);
        Ok(depth)
    }

    /// What is summed of a part, of what is not behind `depth`, that of all parts. Of all parts it is the sum.
    ///
    /// # Errors
    /// As [`crate::renderer::Renderer::record_stage`]; [`crate::ErrorKind::Option`] for another number of pixels.
    pub fn sum_part(
        &mut self,
        scene: &PreparedScene,
        camera: &Camera,
        settings: &Settings,
        depth: &[f32],
        with_depth: bool,
    ) -> Result<PartSums> {
        let mut parts = self.parts(settings)?;
        // SAFETY: every submission was waited for.
        unsafe { fill(&mut parts.depth, depth) }?;
        let stage = Stage::Sum { depth: parts.depth.raw(), sums: parts.sums(), with_depth };
        self.run_stage(&mut parts.slots[1], scene, camera, settings, stage)?;
        // SAFETY: waited for.
        let [colors, normals] = parts.sums.each_ref().map(|buffer| copied(unsafe { buffer.bytes() }));
        self.parts = Some(parts);
        Ok(PartSums { colors, normals })
    }

    /// The picture of all parts, by their depth, their sums and, where there are transparent ones, their layers, as [`Self::compose_parts`] has left them. Of
    /// the scene, which may be any part, lights are taken alone.
    ///
    /// # Errors
    /// As [`Self::sum_part`].
    pub fn shade_parts(
        &mut self,
        scene: &PreparedScene,
        camera: &Camera,
        settings: &Settings,
        (depth, sums, layers): (&[f32], &PartSums, Option<&[f32]>),
        wanted: Wanted,
    ) -> Result<Frame> {
        let mut parts = self.parts(settings)?;
        // SAFETY: every submission was waited for.
        unsafe { fill(&mut parts.depth, depth) }?;
        for (buffer, values) in parts.sums.iter_mut().zip([&sums.colors, &sums.normals]) {
            // SAFETY: as above.
            unsafe { fill(buffer, values) }?;
        }
        let layers = match layers {
            None => None,
            // SAFETY: as above.
            Some(layers) => Some(unsafe { parts.fill_layers(&self.device, layers) }?),
        };
        let begun = Instant::now();
        let wanted = Wanted { profile: None, ..wanted };
        let targets = Targets::new(&self.device, settings.size_px, wanted)?;
        let stage = Stage::Shade {
            depth: parts.depth.raw(),
            sums: parts.sums(),
            layers,
            target: &targets.target.target(),
            readbacks: targets.readbacks(),
        };
        let mut slot = FrameSlot::new(&self.device);
        let plan = self.run_stage(&mut slot, scene, camera, settings, stage)?;
        self.parts = Some(parts);
        // SAFETY: waited for.
        Ok(unsafe { targets.frame(plan, None, true, begun.elapsed().as_secs_f64(), 0.0) })
    }

    /// All submissions were waited for.
    fn parts(&mut self, settings: &Settings) -> Result<Parts> {
        settings.validate()?;
        // Once more, in case that the wait for the stage before failed.
        self.queue.wait_submitted()?;
        match self.parts.take().filter(|parts| parts.size_px == settings.size_px) {
            Some(parts) => Ok(parts),
            None => Parts::new(&self.device, settings.size_px),
        }
    }

    fn run_stage(
        &self,
        slot: &mut FrameSlot,
        scene: &PreparedScene,
        camera: &Camera,
        settings: &Settings,
        stage: Stage<'_>,
    ) -> Result<Arc<Plan>> {
        self.check_renderer()?;
        self.queue.wait_submitted()?;
        // SAFETY: every submission was waited for.
        let commands = unsafe { self.commands.begin() }?;
        let seen = Seen { scene, camera, settings };
        // SAFETY: recording; all that the stage uses is alive until the wait below; buffers have four or sixteen bytes a pixel.
        let plan = unsafe { self.renderer.record_stage(commands, slot, seen, stage) }?;
        let commands = self.commands.end()?;
        // SAFETY: recorded just now; waited for at once.
        let epoch = unsafe { self.queue.submit(commands) }?;
        self.queue.wait(epoch)?;
        Ok(plan)
    }
}

/// A buffer of so many bytes a pixel, which the device writes and the host, and both read.
fn buffer(device: &Device, size_px: [u32; 2], name: &str, bytes: u64) -> Result<Buffer> {
    let pixels = u64::from(size_px[0]) * u64::from(size_px[1]);
    let usage = vk::BufferUsageFlags::TRANSFER_DST | vk::BufferUsageFlags::TRANSFER_SRC;
    Buffer::new(device, BufferDesc { name, size: pixels * bytes, usage }, MemoryUse::Readback)
}

/// # Safety
/// The device does nothing with the buffer.
unsafe fn fill(buffer: &mut Buffer, values: &[f32]) -> Result<()> {
    let bytes: &[u8] = bytemuck::cast_slice(values);
    // SAFETY: this function's contract.
    let room = unsafe { buffer.bytes_mut() };
    if room.len() != bytes.len() {
        let problem = format!("{} bytes of a part; expected {}, as the picture has", bytes.len(), room.len());
        return Err(Error::option("size", problem));
    }
    room.copy_from_slice(bytes);
    Ok(())
}
