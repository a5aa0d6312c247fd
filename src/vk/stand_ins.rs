//! Stand-ins for what a shader names and its specialization does not use: Vulkan wants a valid descriptor for it all the same.

use std::sync::OnceLock;

use ash::vk;

use super::{
    buffer::{Buffer, BufferDesc},
    descriptor::Descriptor,
    device::Device,
    image::{Image, ImageDesc},
    memory::MemoryUse,
    memory_needs::MemoryNeeds,
};
use crate::error::Result;

/// A float that every device samples, filters and stores without naming it in the shader.
const IMAGE_FORMAT: vk::Format = vk::Format::R16G16B16A16_SFLOAT;

/// Bytes of the buffers: as much as a uniform block of ours, and no power of two (`one_shape` of the graph's transients).
pub(crate) const STAND_IN_BYTES: u64 = 1040;

const FLOATS: &str = "stand-in of floats";
const INTEGERS: &str = "stand-in of integers";

/// The image.
const IMAGE: ImageDesc<'_> = ImageDesc {
    name: "stand-in",
    format: IMAGE_FORMAT,
    extent: vk::Extent2D { width: 3, height: 3 },
    usage: vk::ImageUsageFlags::from_raw(
        vk::ImageUsageFlags::SAMPLED.as_raw() | vk::ImageUsageFlags::STORAGE.as_raw(),
    ),
};

/// One of the buffers.
fn buffer_desc(name: &str) -> BufferDesc<'_> {
    let usage = vk::BufferUsageFlags::STORAGE_BUFFER
        | vk::BufferUsageFlags::UNIFORM_BUFFER
        | vk::BufferUsageFlags::UNIFORM_TEXEL_BUFFER;
    BufferDesc { name, size: STAND_IN_BYTES, usage }
}

/// A small buffer of each kind and an image of a few texels, whose contents mean nothing; made when a set first needs one, for pipelines
/// are compiled for devices, too, that have no memory.
pub struct StandIns {
    device: Device,
    made: OnceLock<Made>,
}

struct Made {
    floats: Buffer,
    integers: Buffer,
    image: Image,
}

impl StandIns {
    /// Stand-ins on a device, none of them made yet.
    pub fn new(device: &Device) -> Self {
        Self { device: device.clone(), made: OnceLock::new() }
    }

    fn made(&self) -> Result<&Made> {
        match self.made.get() {
            Some(made) => Ok(made),
            None => {
                let new = Made::new(&self.device)?;
                Ok(self.made.get_or_init(|| new))
            }
        }
    }

    /// Adds what memory they will ask for to what is needed, where they are not made yet.
    ///
    /// # Errors
    /// As those of making them, but for those of the driver and the allocator.
    pub(crate) fn tell(&self, needs: &mut MemoryNeeds) -> Result<()> {
        if self.made.get().is_some() {
            return Ok(());
        }
        for name in [FLOATS, INTEGERS] {
            needs.buffer(&self.device, buffer_desc(name), MemoryUse::Device)?;
        }
        needs.image(&self.device, IMAGE)
    }

    /// Records what brings the image into its layout: once a frame, before its passes, so that no frame depends on another.
    ///
    /// # Errors
    /// Whatever the driver or the allocator answers.
    ///
    /// # Safety
    /// `commands` must be recording outside of rendering, and the stand-ins alive until it has run.
    pub unsafe fn make_ready(&self, commands: vk::CommandBuffer) -> Result<()> {
        let range = vk::ImageSubresourceRange::default()
            .aspect_mask(vk::ImageAspectFlags::COLOR)
            .level_count(1)
            .layer_count(1);
        // Of the frame before, and of this one.
        let shaders = vk::PipelineStageFlags2::FRAGMENT_SHADER | vk::PipelineStageFlags2::COMPUTE_SHADER;
        let barriers = [vk::ImageMemoryBarrier2::default()
            .src_stage_mask(shaders)
            .dst_stage_mask(shaders)
            .dst_access_mask(vk::AccessFlags2::SHADER_READ)
            .new_layout(vk::ImageLayout::GENERAL)
            .src_queue_family_index(vk::QUEUE_FAMILY_IGNORED)
            .dst_queue_family_index(vk::QUEUE_FAMILY_IGNORED)
            .image(self.made()?.image.raw())
            .subresource_range(range)];
        let info = vk::DependencyInfo::default().image_memory_barriers(&barriers);
        // SAFETY: this function's contract.
        unsafe { self.device.raw().cmd_pipeline_barrier2(commands, &info) };
        Ok(())
    }

    /// The one for a binding of this kind; `integers`: its texels are unsigned integers, else floats.
    pub(super) fn of(&self, kind: vk::DescriptorType, integers: bool) -> Result<Descriptor> {
        let made = self.made()?;
        let buffer = if integers { &made.integers } else { &made.floats };
        Ok(match kind {
            vk::DescriptorType::UNIFORM_TEXEL_BUFFER => {
                Descriptor::Texels(buffer.texels().unwrap_or_default())
            }
            vk::DescriptorType::STORAGE_IMAGE => Descriptor::Storage(made.image.view()),
            vk::DescriptorType::SAMPLED_IMAGE | vk::DescriptorType::COMBINED_IMAGE_SAMPLER => {
                Descriptor::Sampled(made.image.view(), vk::ImageLayout::GENERAL)
            }
            _ => Descriptor::Buffer(buffer.raw(), buffer.size()),
        })
    }
}

impl Made {
    fn new(device: &Device) -> Result<Self> {
        let buffer = |name, format| {
            Buffer::new(device, buffer_desc(name), MemoryUse::Device)?.with_texels(name, format)
        };
        Ok(Self {
            floats: buffer(FLOATS, vk::Format::R32G32B32A32_SFLOAT)?,
            integers: buffer(INTEGERS, vk::Format::R32_UINT)?,
            image: Image::new(device, IMAGE)?,
        })
    }
}
