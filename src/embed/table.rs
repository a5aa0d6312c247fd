//! Tables that a view writes for the device, each frame where they are needed, in memory that both see.

use ash::vk;

use crate::{
    error::Result,
    vk::{Buffer, BufferDesc, Device, MemoryNeeds, MemoryUse},
};

/// A table that is kept from frame to frame, in a storage buffer.
#[derive(Default)]
pub(super) struct Table(Option<Buffer>);

impl Table {
    /// Writes it, where there is room or in a new buffer, which it gives, with how many bytes it has.
    ///
    /// # Safety
    /// The frame has finished that read it last.
    ///
    /// # Errors
    /// Whatever the allocator answers.
    pub unsafe fn write<T: bytemuck::Pod>(
        &mut self,
        device: &Device,
        name: &str,
        all: &[T],
    ) -> Result<(vk::Buffer, u64)> {
        let bytes: &[u8] = bytemuck::cast_slice(all);
        let used = bytes.len() as u64;
        let buffer = match self.0.take().filter(|kept| kept.size() >= used) {
            Some(kept) => kept,
            None => Buffer::new(device, desc(name, used), MemoryUse::Upload)?,
        };
        let buffer = self.0.insert(buffer);
        // SAFETY: this function's contract.
        let room = unsafe { buffer.bytes_mut() };
        room[..bytes.len()].copy_from_slice(bytes);
        Ok((buffer.raw(), used))
    }

    /// Adds what memory the first such table will ask for to what is needed.
    ///
    /// # Errors
    /// As [`MemoryNeeds::buffer`].
    pub fn tell(device: &Device, name: &str, bytes: u64, needs: &mut MemoryNeeds) -> Result<()> {
        needs.buffer(device, desc(name, bytes), MemoryUse::Upload)
    }

    /// Bytes of device memory.
    pub fn bytes(&self) -> u64 {
        self.0.as_ref().map_or(0, Buffer::size)
    }
}

/// The buffer of a table of so many bytes.
fn desc(name: &str, bytes: u64) -> BufferDesc<'_> {
    let usage = vk::BufferUsageFlags::STORAGE_BUFFER;
    BufferDesc { name, size: bytes.max(1).next_power_of_two(), usage }
}
