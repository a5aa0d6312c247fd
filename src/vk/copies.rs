//! Copies out of a ring of staging, recorded as they come.

use ash::vk;

use super::{buffer::Buffer, device::Device, staging::make_visible, staging_ring::Region};
use crate::inline_vec::InlineVec;

/// Copies that are recorded by one call, where they are to one buffer.
const AT_ONCE: usize = 32;

/// Copies of bytes to buffers that commands before read, into commands.
pub(crate) struct Copies<'a> {
    device: &'a Device,
    commands: vk::CommandBuffer,
    region: Region,
    target: vk::Buffer,
    waiting: InlineVec<vk::BufferCopy, AT_ONCE>,
}

impl<'a> Copies<'a> {
    /// Waits for vertex and compute stages of commands before, which read what the copies change.
    ///
    /// # Safety
    /// `commands` are of this device, and recording outside of rendering; they are submitted in the epoch in which the region was reserved, or never. All targets are alive
    /// until they have run, and no two copies overlap.
    pub unsafe fn begin(device: &'a Device, commands: vk::CommandBuffer, region: Region) -> Self {
        let barriers = [vk::MemoryBarrier2::default()
            .src_stage_mask(vk::PipelineStageFlags2::VERTEX_SHADER | vk::PipelineStageFlags2::COMPUTE_SHADER)
            .dst_stage_mask(vk::PipelineStageFlags2::COPY)
            .src_access_mask(vk::AccessFlags2::NONE)
            .dst_access_mask(vk::AccessFlags2::TRANSFER_WRITE)];
        let info = vk::DependencyInfo::default().memory_barriers(&barriers);
        // SAFETY: this function's contract.
        unsafe { device.raw().cmd_pipeline_barrier2(commands, &info) };
        Self { device, commands, region, target: vk::Buffer::null(), waiting: InlineVec::new() }
    }

    /// Bytes for a buffer of the device, from its byte `offset` on, which has room for them, as the region has; else nothing is copied.
    pub fn push(&mut self, target: &Buffer, offset: u64, bytes: &[u8]) {
        let fits = offset.checked_add(bytes.len() as u64).is_some_and(|end| end <= target.size());
        let goes = fits && !bytes.is_empty() && target.takes_copies(self.device);
        debug_assert!(goes, "{} bytes at {offset} of {}", bytes.len(), target.size());
        let Some(from) = Some(()).filter(|()| goes).and_then(|()| self.region.push(bytes)) else { return };
        if self.target != target.raw() || self.waiting.len() == AT_ONCE {
            self.record();
        }
        self.target = target.raw();
        self.waiting.push(vk::BufferCopy { src_offset: from, dst_offset: offset, size: bytes.len() as u64 });
    }

    /// Makes all of them visible to the vertex and compute stages of every later command.
    pub fn end(mut self) {
        self.record();
        // SAFETY: the contract of `begin`.
        unsafe { make_visible(self.device, self.commands) };
    }

    fn record(&mut self) {
        if self.waiting.is_empty() {
            return;
        }
        let (from, to) = (self.region.buffer(), self.target);
        // SAFETY: the contract of `begin`; each region lies within both buffers.
        unsafe { self.device.raw().cmd_copy_buffer(self.commands, from, to, &self.waiting) };
        self.waiting = InlineVec::new();
    }
}
