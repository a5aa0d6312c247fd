//! Buffers.

use std::ptr::NonNull;

use ash::vk;

use super::{
    device::Device,
    garbage::Retired,
    host_memory::{MemoryRequest, Piece},
    memory::{Memory, MemoryUse},
    result::VkResultExt,
};
use crate::error::{Error, Result};

/// The description of a buffer.
#[derive(Clone, Copy, Debug)]
pub struct BufferDesc<'a> {
    /// Its debug name.
    pub name: &'a str,
    /// Bytes, above 0.
    pub size: u64,
    /// Its uses.
    pub usage: vk::BufferUsageFlags,
}

impl BufferDesc<'_> {
    /// Refuses what the device does not have.
    ///
    /// # Errors
    /// [`crate::ErrorKind::Option`] for a size or a usage.
    pub(crate) fn check(&self, device: &Device) -> Result<()> {
        let Self { name, size, usage } = *self;
        if size == 0 {
            return Err(Error::option(name, "a buffer of 0 bytes: at least 1"));
        }
        let largest = device.facts().limits.max_buffer_size;
        if size > largest {
            return Err(Error::option(
                name,
                format!("a buffer of {size} bytes: the device makes at most {largest}"),
            ));
        }
        if usage.is_empty() || !usages_of_all().contains(usage) {
            return Err(Error::option(name, format!("a buffer for {usage:?}")));
        }
        Ok(())
    }
}

/// A buffer with memory of its own or in a shared block.
pub struct Buffer {
    device: Device,
    raw: vk::Buffer,
    texels: vk::BufferView,
    size: u64,
    usage: vk::BufferUsageFlags,
    allocation: Option<Piece>,
}

impl Buffer {
    /// A buffer with memory of its own.
    ///
    /// # Errors
    /// [`crate::ErrorKind::Option`] for a size of 0, for no usage, and for one that not every device has; whatever the driver or the allocator answers.
    pub fn new(device: &Device, desc: BufferDesc<'_>, memory: MemoryUse) -> Result<Self> {
        let mut buffer = Self::unbound(device, desc)?;
        let raw = buffer.raw;
        // SAFETY: the buffer was just made from this device.
        let requirements = unsafe { device.raw().get_buffer_memory_requirements(raw) };
        let request = MemoryRequest { name: desc.name, requirements, touched_by: memory, linear: true };
        let allocation = device.allocate(&request)?;
        // SAFETY: the memory outlives the buffer: both are retired together, the buffer destroyed first.
        let bound = unsafe {
            let (memory, offset) = allocation.place();
            device.raw().bind_buffer_memory(raw, memory, offset)
        };
        buffer.allocation = Some(allocation);
        bound.of_call("vkBindBufferMemory", desc.name)?;
        Ok(buffer)
    }

    /// A buffer at an offset of a shared block; the block must be dropped after it.
    ///
    /// # Errors
    /// Whatever the driver answers.
    pub(crate) fn placed(
        device: &Device,
        desc: BufferDesc<'_>,
        memory: &Memory,
        offset: u64,
    ) -> Result<Self> {
        let buffer = Self::unbound(device, desc)?;
        let raw = buffer.raw;
        let (block, start) = memory.raw();
        // SAFETY: the buffer was just made from this device.
        let needed = unsafe { device.raw().get_buffer_memory_requirements(raw) };
        memory.check_room(desc.name, offset, needed)?;
        // SAFETY: the caller keeps the block until after this buffer; the place was checked.
        unsafe { device.raw().bind_buffer_memory(raw, block, start + offset) }
            .of_call("vkBindBufferMemory", desc.name)?;
        Ok(buffer)
    }

    /// This buffer, read by texels of a format, too; its usage is `UNIFORM_TEXEL_BUFFER` among others.
    ///
    /// # Errors
    /// [`crate::ErrorKind::Option`] for another format than the few that are used so, and for more texels than the device has;
    /// whatever the driver answers.
    pub(crate) fn with_texels(mut self, name: &str, format: vk::Format) -> Result<Self> {
        debug_assert!(self.texels().is_none(), "{name} has texels already");
        let Some(texel_bytes) = texel_bytes(format) else {
            return Err(Error::option(name, format!("texels of {format:?}: not one of those in use")));
        };
        let (texels, most) = (self.size / texel_bytes, self.device.facts().limits.max_texels);
        if texels > u64::from(most) {
            return Err(Error::option(name, format!("{texels} texels: the device has at most {most}")));
        }
        let info = vk::BufferViewCreateInfo::default().buffer(self.raw).format(format).range(vk::WHOLE_SIZE);
        // SAFETY: the buffer is bound; every device has the format, and so many texels.
        self.texels = unsafe { self.device.raw().create_buffer_view(&info, None) }
            .of_call("vkCreateBufferView", name)?;
        self.device.set_name(self.texels, name);
        Ok(self)
    }

    /// The raw buffer.
    pub fn raw(&self) -> vk::Buffer {
        self.raw
    }

    /// The view of its texels, where it is read by them.
    pub fn texels(&self) -> Option<vk::BufferView> {
        (self.texels != vk::BufferView::null()).then_some(self.texels)
    }

    /// Its size in bytes.
    pub fn size(&self) -> u64 {
        self.size
    }

    /// Whether it is of a device, and copies to it are allowed.
    pub(super) fn takes_copies(&self, device: &Device) -> bool {
        self.device.is(device) && self.usage.contains(vk::BufferUsageFlags::TRANSFER_DST)
    }

    /// Its first byte, where the host can see it: there as long as the buffer is. Whoever writes there minds what the device reads.
    pub(super) fn mapped(&self) -> Option<NonNull<u8>> {
        self.allocation.as_ref()?.mapped()
    }

    /// Its bytes, where the host can see them ([`MemoryUse::Upload`], [`MemoryUse::Readback`]); else empty.
    ///
    /// # Safety
    /// The device writes none of them while they are borrowed: all submissions that do have finished.
    pub unsafe fn bytes(&self) -> &[u8] {
        let mapped = self.allocation.as_ref().map(Piece::bytes).unwrap_or_default();
        &mapped[..mapped.len().min(usize::try_from(self.size).unwrap_or(usize::MAX))]
    }

    /// Its bytes for writing, where the host can see them; else empty.
    ///
    /// # Safety
    /// The device neither reads nor writes any of them while they are borrowed: all submissions that do have finished.
    pub unsafe fn bytes_mut(&mut self) -> &mut [u8] {
        let mapped = self.allocation.as_mut().map(Piece::bytes_mut).unwrap_or_default();
        let size = mapped.len().min(usize::try_from(self.size).unwrap_or(usize::MAX));
        &mut mapped[..size]
    }

    /// The buffer without memory and view: an owner already, so that no failure after it leaks the handle.
    fn unbound(device: &Device, desc: BufferDesc<'_>) -> Result<Self> {
        desc.check(device)?;
        let info = vk::BufferCreateInfo::default().size(desc.size).usage(desc.usage);
        // SAFETY: the device is alive; the size is above 0 and within the device's; every device has the usage.
        let raw = unsafe { device.raw().create_buffer(&info, None) }.of_call("vkCreateBuffer", desc.name)?;
        device.set_name(raw, desc.name);
        let BufferDesc { size, usage, .. } = desc;
        Ok(Self {
            device: device.clone(),
            raw,
            texels: vk::BufferView::null(),
            size,
            usage,
            allocation: None,
        })
    }
}

/// The usages that need no feature: those of Vulkan 1.0.
fn usages_of_all() -> vk::BufferUsageFlags {
    use vk::BufferUsageFlags as U;
    let read =
        U::TRANSFER_SRC | U::UNIFORM_TEXEL_BUFFER | U::UNIFORM_BUFFER | U::INDEX_BUFFER | U::VERTEX_BUFFER;
    read | U::TRANSFER_DST | U::STORAGE_TEXEL_BUFFER | U::STORAGE_BUFFER | U::INDIRECT_BUFFER
}

/// Bytes of a texel of the formats that buffers are read in: some of those that Vulkan demands of every device.
pub(crate) fn texel_bytes(format: vk::Format) -> Option<u64> {
    match format {
        vk::Format::R32_UINT => Some(4),
        vk::Format::R32G32B32A32_UINT | vk::Format::R32G32B32A32_SFLOAT => Some(16),
        _ => None,
    }
}

impl Drop for Buffer {
    fn drop(&mut self) {
        self.device.retire(Retired::Buffer(self.raw, self.texels, self.allocation.take()));
    }
}
