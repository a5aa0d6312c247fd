//! Uploads: bytes go to a buffer that the host can write, from there to the device's own by a copy.

use std::sync::{
    Arc,
    atomic::{AtomicBool, AtomicU32, Ordering},
};

use ash::vk;

use super::{
    buffer::{Buffer, BufferDesc},
    device::Device,
    memory::MemoryUse,
    memory_needs::MemoryNeeds,
};
use crate::error::{Error, Result};

/// One batch of uploads. Fill it, record it, and keep it until the submission has finished (or drop it any time
/// after the submission: the memory waits for its epoch).
pub struct Staging {
    device: Device,
    buffer: Buffer,
    used: usize,
    copies: Vec<(vk::Buffer, vk::BufferCopy)>,
    recorded: Arc<AtomicBool>,
}

impl Staging {
    /// A batch with room for `bytes` in all (above 0).
    ///
    /// # Errors
    /// Whatever the driver or the allocator answers.
    pub fn new(device: &Device, name: &str, bytes: u64) -> Result<Self> {
        let told = bytes.next_multiple_of(TOLD_BYTES);
        let mut buffer = Buffer::new(device, Self::desc(name, bytes), MemoryUse::Upload)?;
        // SAFETY: it is new.
        let word = unsafe { buffer.bytes_mut() }.get_mut(told as usize..);
        word.into_iter().flatten().for_each(|byte| *byte = 0);
        Ok(Self { device: device.clone(), buffer, used: 0, copies: Vec::new(), recorded: Arc::default() })
    }

    /// The buffer of a batch.
    fn desc(name: &str, bytes: u64) -> BufferDesc<'_> {
        let usage = vk::BufferUsageFlags::TRANSFER_SRC | vk::BufferUsageFlags::TRANSFER_DST;
        BufferDesc { name, size: bytes.next_multiple_of(TOLD_BYTES) + TOLD_BYTES, usage }
    }

    /// Adds what memory a batch will ask for to what is needed.
    ///
    /// # Errors
    /// As [`Self::new`], but for those of the driver and the allocator.
    pub(crate) fn tell(device: &Device, name: &str, bytes: u64, needs: &mut MemoryNeeds) -> Result<()> {
        needs.buffer(device, Self::desc(name, bytes), MemoryUse::Upload)
    }

    /// Adds bytes for `target`, whose usage includes `TRANSFER_DST`, from its byte `offset` on.
    ///
    /// # Errors
    /// [`crate::ErrorKind::Option`] if the batch or the target has no room for them, and if the target is another device's or not to be copied to.
    pub fn push(&mut self, target: &Buffer, offset: u64, bytes: &[u8]) -> Result<()> {
        if !target.takes_copies(&self.device) {
            return Err(Error::option("upload", "the target is of another device, or without TRANSFER_DST"));
        }
        let (begin, end) = (self.used, self.told() as usize);
        // SAFETY: `record` asks that nothing be added while the device reads.
        let all = unsafe { self.buffer.bytes_mut() }.get_mut(..end);
        let room = all.and_then(|all| all.get_mut(begin..begin + bytes.len()));
        let fits = offset.checked_add(bytes.len() as u64).is_some_and(|end| end <= target.size());
        let Some(room) = room.filter(|_| fits) else {
            let problem = format!("no room for {} bytes after {begin}, or in their target", bytes.len());
            return Err(Error::option("upload", problem));
        };
        room.copy_from_slice(bytes);
        self.used += bytes.len();
        let region =
            vk::BufferCopy::default().src_offset(begin as u64).dst_offset(offset).size(bytes.len() as u64);
        if !bytes.is_empty() {
            self.copies.push((target.raw(), region));
        }
        Ok(())
    }

    /// Tells whether it was recorded, also once it is gone.
    pub(crate) fn is_recorded(&self) -> impl Fn() -> bool + use<> {
        let recorded = self.recorded.clone();
        move || recorded.load(Ordering::Acquire)
    }

    /// Records all copies and what makes them visible to the vertex and compute stages of every later command, and as
    /// indices.
    ///
    /// # Safety
    /// `commands` are of this device, and must be recording outside of rendering; they are submitted in the epoch in which the batch is dropped, or before. No two of the
    /// batch's copies overlap. The targets are alive until the commands have run, what was done with them before is waited for, and nothing is
    /// [pushed](Self::push) until then.
    pub unsafe fn record(&self, commands: vk::CommandBuffer) {
        let device = self.device.raw();
        // SAFETY: this function's contract; each region lies within both buffers.
        unsafe {
            for (target, region) in &self.copies {
                device.cmd_copy_buffer(commands, self.buffer.raw(), *target, std::slice::from_ref(region));
            }
            make_visible(&self.device, commands);
        }
        self.recorded.store(true, Ordering::Release);
    }

    /// The same, and that the device tells when it has run them ([`Self::has_run`]).
    ///
    /// # Safety
    /// As [`Self::record`]; but they are submitted in any epoch, while the batch is there, or never.
    pub(crate) unsafe fn record_and_tell(&self, commands: vk::CommandBuffer) {
        let device = self.device.raw();
        let barrier = |[from, to]: [vk::PipelineStageFlags2; 2], [of, by]: [vk::AccessFlags2; 2]| {
            let barriers = [vk::MemoryBarrier2::default()
                .src_stage_mask(from)
                .src_access_mask(of)
                .dst_stage_mask(to)
                .dst_access_mask(by)];
            let info = vk::DependencyInfo::default().memory_barriers(&barriers);
            // SAFETY: this function's contract.
            unsafe { device.cmd_pipeline_barrier2(commands, &info) };
        };
        let (copy, clear, host) =
            (vk::PipelineStageFlags2::COPY, vk::PipelineStageFlags2::CLEAR, vk::PipelineStageFlags2::HOST);
        let none = vk::AccessFlags2::NONE;
        // SAFETY: this function's contract; the word lies within the buffer, at a multiple of 4, and nothing else writes it.
        unsafe {
            self.record(commands);
            barrier([copy, clear], [none, none]);
            device.cmd_fill_buffer(commands, self.buffer.raw(), self.told(), TOLD_BYTES, HAS_RUN);
            barrier([clear, host], [vk::AccessFlags2::TRANSFER_WRITE, vk::AccessFlags2::HOST_READ]);
        }
    }

    /// Where in the buffer the device tells that, behind the bytes that there is room for.
    fn told(&self) -> u64 {
        self.buffer.size() - TOLD_BYTES
    }

    /// Whether the device has told that it has run the copies; what they are submitted in may go on.
    pub(super) fn has_run(&self) -> bool {
        let word = self.buffer.mapped().map(|first| first.as_ptr().wrapping_add(self.told() as usize));
        let word = word.map(|word| word.cast::<AtomicU32>()).filter(|word| word.is_aligned());
        // SAFETY: within the buffer, whose memory is mapped as long as it is here, and coherent; aligned. The device writes all of it at once.
        word.is_some_and(|word| unsafe { &*word }.load(Ordering::Acquire) == HAS_RUN)
    }
}

/// Behind a batch's bytes is a word, which the device sets to this where it is to tell that it has run the copies.
const TOLD_BYTES: u64 = 4;
const HAS_RUN: u32 = 1;

/// Makes copies before visible to the vertex and compute stages of every later command, and as indices.
///
/// # Safety
/// `commands` are of this device, and recording outside of rendering.
pub(super) unsafe fn make_visible(device: &Device, commands: vk::CommandBuffer) {
    let barriers = [vk::MemoryBarrier2::default()
        .src_stage_mask(vk::PipelineStageFlags2::COPY)
        .src_access_mask(vk::AccessFlags2::TRANSFER_WRITE)
        .dst_stage_mask(
            vk::PipelineStageFlags2::INDEX_INPUT
                | vk::PipelineStageFlags2::VERTEX_SHADER
                | vk::PipelineStageFlags2::COMPUTE_SHADER,
        )
        .dst_access_mask(vk::AccessFlags2::INDEX_READ | vk::AccessFlags2::SHADER_STORAGE_READ)];
    let info = vk::DependencyInfo::default().memory_barriers(&barriers);
    // SAFETY: this function's contract.
    unsafe { device.raw().cmd_pipeline_barrier2(commands, &info) };
}
