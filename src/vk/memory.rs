//! Device memory: where it lies, and blocks that several transient resources share.

use ash::vk;
use gpu_allocator::MemoryLocation;

use super::{
    budget::MemoryInUse,
    device::Device,
    garbage::Retired,
    host_memory::{MemoryRequest, Piece},
};
use crate::error::{ErrorKind, Result};

/// Who touches a piece of memory.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MemoryUse {
    /// Only the device.
    Device,
    /// The host writes, the device reads.
    Upload,
    /// The device writes, the host reads.
    Readback,
}

impl MemoryUse {
    pub(super) fn location(self) -> MemoryLocation {
        match self {
            Self::Device => MemoryLocation::GpuOnly,
            Self::Upload => MemoryLocation::CpuToGpu,
            Self::Readback => MemoryLocation::GpuToCpu,
        }
    }
}

/// A block of device memory in which a render graph places its transient resources.
pub struct Memory {
    device: Device,
    allocation: Option<Piece>,
    size: u64,
}

impl Memory {
    /// Allocates a block. `linear` is true for buffers, false for images.
    ///
    /// # Errors
    /// [`crate::error::ErrorKind::Memory`].
    pub fn new(
        device: &Device,
        name: &str,
        requirements: vk::MemoryRequirements,
        linear: bool,
    ) -> Result<Self> {
        let request = MemoryRequest { name, requirements, touched_by: MemoryUse::Device, linear };
        let allocation = device.allocate(&request)?;
        Ok(Self { device: device.clone(), allocation: Some(allocation), size: requirements.size })
    }

    /// The block's size in bytes.
    pub fn size(&self) -> u64 {
        self.size
    }

    /// Refuses a place that is too small or not aligned for what is to be bound there.
    pub(super) fn check_room(&self, name: &str, offset: u64, needed: vk::MemoryRequirements) -> Result<()> {
        let (_, start) = self.raw();
        let aligned = (start + offset).is_multiple_of(needed.alignment.max(1));
        match aligned && offset + needed.size <= self.size {
            true => Ok(()),
            false => Err(ErrorKind::Memory {
                object: name.to_owned(),
                bytes: needed.size,
                reason: format!("its place at {offset} of a block of {} bytes does not fit it", self.size),
            }
            .into()),
        }
    }

    /// The raw memory and the block's offset in it.
    pub(super) fn raw(&self) -> (vk::DeviceMemory, u64) {
        self.allocation.as_ref().map_or((vk::DeviceMemory::null(), 0), |allocation| {
            // SAFETY: what is bound to the memory is retired before this block is: its owner drops it first, and
            // the queue of retired objects keeps the order.
            unsafe { allocation.place() }
        })
    }
}

impl Drop for Memory {
    fn drop(&mut self) {
        if let Some(allocation) = self.allocation.take() {
            self.device.retire(Retired::Memory(allocation));
        }
    }
}

impl Device {
    /// Memory for an object.
    pub(super) fn allocate(&self, request: &MemoryRequest<'_>) -> Result<Piece> {
        match self.memory().as_mut() {
            Some((source, _)) => source.allocate(request),
            None => {
                let (object, bytes) = (request.name.to_owned(), request.requirements.size);
                let reason = "the device is gone".to_owned();
                Err(ErrorKind::Memory { object, bytes, reason }.into())
            }
        }
    }

    /// Bytes of device memory that are allocated now, and how many allocations they are.
    pub fn memory_in_use(&self) -> (u64, usize) {
        self.memory().as_ref().map_or((0, 0), |(source, _)| source.in_use())
    }

    /// What of it is for what, and what lies idle. [`crate::prepare::PreparedScene::bytes`] and [`crate::embed::View::bytes`] are what one scene and one view have of it.
    pub fn memory_by_use(&self) -> MemoryInUse {
        self.memory().as_ref().map_or(MemoryInUse::default(), |(source, _)| source.by_use())
    }

    /// Bytes of device memory that are taken from the device now: what is allocated, and what lies idle in blocks of ours. Of a host's memory, what is
    /// allocated.
    pub fn memory_held(&self) -> u64 {
        self.memory().as_ref().map_or(0, |(source, _)| source.held())
    }
}
