//! What a headless frame draws into, and how it is read.

use std::sync::Arc;

use ash::vk;

use super::{Frame, Wanted};
use crate::{
    error::Result,
    frame::HeadlessTarget,
    graph::{Plan, execute::FrameProfile},
    passes::Exported,
    renderer::{Readbacks, SampleSum, bytes_per_pixel},
    vk::{Buffer, BufferDesc, Device, Image, ImageDesc, MemoryUse},
};

/// The target and the buffers that it is read through, for one size and one choice of [`Wanted`].
pub(super) struct Targets {
    pub size_px: [u32; 2],
    pub wanted: Wanted,
    pub target: HeadlessTarget,
    pub picture: Option<Buffer>,
    pub surface: Option<[Buffer; 4]>,
    /// Where samples are added up, once there are some.
    pub samples: Option<Image>,
}

impl Targets {
    pub(super) fn new(device: &Device, size_px: [u32; 2], wanted: Wanted) -> Result<Self> {
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
    pub(super) fn sample(&mut self, device: &Device, (first, last): (bool, bool)) -> Result<SampleSum> {
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

    pub(super) fn readbacks(&self) -> Readbacks {
        Readbacks {
            target: self.picture.as_ref().map(Buffer::raw),
            surface: self.surface.as_ref().map(|buffers| buffers.each_ref().map(Buffer::raw)),
            sample: None,
        }
    }

    /// Copies what was wanted out of the buffers.
    ///
    /// # Safety
    /// The frame has finished.
    pub(super) unsafe fn frame(
        &self,
        plan: Arc<Plan>,
        profile: Option<FrameProfile>,
        is_read: bool,
        wall_secs: f64,
        record_secs: f64,
    ) -> Frame {
        let bytes = |buffer| {
            // SAFETY: this function's contract.
            unsafe { Buffer::bytes(buffer) }
        };
        let picture = self.picture.as_ref().filter(|_| is_read).map(bytes).unwrap_or_default();
        let (srgb, linear) = match self.wanted.linear {
            false => (copied(picture), Vec::new()),
            true => (Vec::new(), copied(picture)),
        };
        let surface = |i: usize| self.surface.as_ref().map(|buffers| bytes(&buffers[i])).unwrap_or_default();
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

pub(super) fn copied<T: bytemuck::AnyBitPattern>(bytes: &[u8]) -> Vec<T> {
    match bytemuck::try_cast_slice(bytes) {
        Ok(values) => values.to_vec(),
        // Memory that does not begin where a value may.
        Err(_) => bytes.chunks_exact(size_of::<T>()).map(bytemuck::pod_read_unaligned).collect(),
    }
}
