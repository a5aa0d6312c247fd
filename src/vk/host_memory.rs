//! Device memory that an embedding host gives, in place of an allocator of ours.

use std::ptr::NonNull;

use ash::vk;
use gpu_allocator::vulkan::{Allocation, AllocationCreateDesc, AllocationScheme, Allocator};

use super::memory::MemoryUse;
use crate::error::{Error, ErrorKind};

/// What is asked of a host's allocator.
#[derive(Clone, Copy, Debug)]
pub struct MemoryRequest<'a> {
    /// For what, in words.
    pub name: &'a str,
    /// What Vulkan says that it needs: bytes, alignment, memory types.
    pub requirements: vk::MemoryRequirements,
    /// Who touches it. Of `Upload` and `Readback`, it must be mapped, and coherent.
    pub touched_by: MemoryUse,
    /// For buffers; else for images of optimal tiling, of which `bufferImageGranularity` has to be kept.
    pub linear: bool,
}

/// A piece of a host's device memory.
#[derive(Clone, Copy, Debug)]
pub struct HostAllocation {
    /// The memory object.
    pub memory: vk::DeviceMemory,
    /// Where in it, in bytes.
    pub offset: u64,
    /// Where the host's processor sees the first byte, of what it touches.
    pub mapped: Option<NonNull<u8>>,
    /// Whatever the host knows it by.
    pub token: u64,
}

/// A host's allocator. It is asked from whichever thread uses a renderer or a view, and behind a lock of the device's: it must not call back.
///
/// # Safety
/// What [`Self::allocate`] gives is memory of the device, of a type among those asked for, aligned and as large as asked, used by nobody else until it is
/// given back, and mapped where that is asked for.
pub unsafe trait HostMemory: Send + Sync {
    /// Memory, or why there is none: `ERROR_OUT_OF_DEVICE_MEMORY` where a budget is used up. Then what needed it fails with [`ErrorKind::Memory`], and
    /// is asked for again when a frame needs it next.
    ///
    /// # Errors
    /// As a host decides.
    fn allocate(&self, request: &MemoryRequest<'_>) -> Result<HostAllocation, vk::Result>;

    /// Takes a piece back: nothing of the device's uses it any more.
    fn free(&self, allocation: HostAllocation);
}

/// Memory of one object.
pub(super) enum Piece {
    Ours(Allocation),
    Host(HostAllocation, u64),
}

// SAFETY: a mapped pointer is to memory that nobody else uses, and is dereferenced through `&self` and `&mut self` alone.
unsafe impl Send for Piece {}
// SAFETY: as above.
unsafe impl Sync for Piece {}

impl Piece {
    /// The memory object and where in it.
    ///
    /// # Safety
    /// The piece outlives what is bound to it.
    pub unsafe fn place(&self) -> (vk::DeviceMemory, u64) {
        match self {
            // SAFETY: this function's contract.
            Self::Ours(allocation) => (unsafe { allocation.memory() }, allocation.offset()),
            Self::Host(allocation, _) => (allocation.memory, allocation.offset),
        }
    }

    pub fn size(&self) -> u64 {
        match self {
            Self::Ours(allocation) => allocation.size(),
            Self::Host(_, size) => *size,
        }
    }

    /// Its first byte, where the processor sees it.
    pub fn mapped(&self) -> Option<NonNull<u8>> {
        match self {
            Self::Ours(allocation) => allocation.mapped_ptr().map(NonNull::cast),
            Self::Host(allocation, _) => allocation.mapped,
        }
    }

    /// Its bytes, where the processor sees them; else none.
    pub fn bytes(&self) -> &[u8] {
        match self {
            Self::Ours(allocation) => allocation.mapped_slice().unwrap_or_default(),
            Self::Host(HostAllocation { mapped: Some(first), .. }, size) => {
                // SAFETY: the host's contract: so many bytes are mapped there, and nobody else's.
                unsafe { std::slice::from_raw_parts(first.as_ptr(), *size as usize) }
            }
            Self::Host(..) => &[],
        }
    }

    /// The same for writing.
    pub fn bytes_mut(&mut self) -> &mut [u8] {
        match self {
            Self::Ours(allocation) => allocation.mapped_slice_mut().unwrap_or_default(),
            Self::Host(HostAllocation { mapped: Some(first), .. }, size) => {
                // SAFETY: as in `bytes`.
                unsafe { std::slice::from_raw_parts_mut(first.as_ptr(), *size as usize) }
            }
            Self::Host(..) => &mut [],
        }
    }
}

/// Where memory comes from.
pub(super) enum Source {
    Ours(Box<Allocator>),
    Host { host: std::sync::Arc<dyn HostMemory>, bytes: u64, pieces: usize },
}

impl Source {
    pub fn allocate(&mut self, request: &MemoryRequest<'_>) -> Result<Piece, Error> {
        let MemoryRequest { name, requirements, touched_by, linear } = *request;
        let failed = |reason: String| -> Error {
            ErrorKind::Memory { object: name.to_owned(), bytes: requirements.size, reason }.into()
        };
        match self {
            Self::Ours(allocator) => {
                let desc = AllocationCreateDesc {
                    name,
                    requirements,
                    location: touched_by.location(),
                    linear,
                    allocation_scheme: AllocationScheme::GpuAllocatorManaged,
                };
                allocator.allocate(&desc).map(Piece::Ours).map_err(|error| failed(error.to_string()))
            }
            Self::Host { host, bytes, pieces } => {
                let given = host.allocate(request);
                let given =
                    given.map_err(|result| failed(format!("the host's allocator answered {result}")))?;
                if touched_by != MemoryUse::Device && given.mapped.is_none() {
                    host.free(given);
                    return Err(failed("the host's allocator gave memory that is not mapped".to_owned()));
                }
                (*bytes, *pieces) = (*bytes + requirements.size, *pieces + 1);
                Ok(Piece::Host(given, requirements.size))
            }
        }
    }

    pub fn free(&mut self, piece: Piece) {
        match (self, piece) {
            (Self::Ours(allocator), Piece::Ours(allocation)) => {
                // Freeing fails only for an allocation of another allocator, which can't come here.
                let freed = allocator.free(allocation);
                debug_assert!(freed.is_ok(), "{freed:?}");
            }
            (Self::Host { host, bytes, pieces }, Piece::Host(allocation, size)) => {
                host.free(allocation);
                (*bytes, *pieces) = (*bytes - size, *pieces - 1);
            }
            _ => debug_assert!(false, "a piece of another source"),
        }
    }

    /// Bytes in use, and how many pieces they are.
    pub fn in_use(&self) -> (u64, usize) {
        match self {
            Self::Ours(allocator) => {
                let report = allocator.generate_report();
                (report.total_allocated_bytes, report.allocations.len())
            }
            Self::Host { bytes, pieces, .. } => (*bytes, *pieces),
        }
    }

    /// Bytes that are taken from the device, idle ones included.
    pub fn held(&self) -> u64 {
        match self {
            Self::Ours(allocator) => allocator.capacity(),
            Self::Host { bytes, .. } => *bytes,
        }
    }
}
