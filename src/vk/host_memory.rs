//! Device memory that an embedding host gives, in place of an allocator of ours.

use std::ptr::NonNull;

use ash::vk;
use gpu_allocator::{
    AllocationError,
    vulkan::{Allocation, AllocationCreateDesc, AllocationScheme, Allocator},
};

use super::{budget::MemoryInUse, memory::MemoryUse};
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
/// ```no_run
/// use std::ptr::NonNull;
/// use surfel::{ash::{self, vk}, embed::{HostAllocation, HostMemory, MemoryRequest, MemoryUse}};
///
/// /// A memory object for each piece: of a host that knows no better.
/// struct Plain(ash::Device, vk::PhysicalDeviceMemoryProperties);
///
/// unsafe impl HostMemory for Plain {
///     fn allocate(&self, request: &MemoryRequest<'_>) -> Result<HostAllocation, vk::Result> {
///         let (device, needs) = (&self.0, request.requirements);
///         let wanted = match request.touched_by {
///             MemoryUse::Device => vk::MemoryPropertyFlags::empty(),
///             _ => vk::MemoryPropertyFlags::HOST_VISIBLE | vk::MemoryPropertyFlags::HOST_COHERENT,
///         };
///         let will_do = |i: &u32| {
///             needs.memory_type_bits >> i & 1 == 1 && self.1.memory_types[*i as usize].property_flags.contains(wanted)
///         };
///         let of_type = (0..self.1.memory_type_count).find(will_do).ok_or(vk::Result::ERROR_OUT_OF_DEVICE_MEMORY)?;
///         let info = vk::MemoryAllocateInfo::default().allocation_size(needs.size).memory_type_index(of_type);
///         // SAFETY: the device is alive, and the type is one of its.
///         let memory = unsafe { device.allocate_memory(&info, None) }?;
///         // SAFETY: the memory is new, is not mapped, and the host sees it.
///         let mapped = match wanted.is_empty() {
///             true => None,
///             false => NonNull::new(unsafe { device.map_memory(memory, 0, needs.size, vk::MemoryMapFlags::empty()) }?.cast()),
///         };
///         Ok(HostAllocation { memory, offset: 0, mapped, token: 0 })
///     }
///
///     fn free(&self, allocation: HostAllocation) {
///         // SAFETY: it was allocated above, and nobody uses it any more.
///         unsafe { self.0.free_memory(allocation.memory, None) }
///     }
/// }
/// ```
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
pub(super) struct Piece {
    of: PieceOf,
    touched_by: MemoryUse,
    linear: bool,
}

enum PieceOf {
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
        match &self.of {
            // SAFETY: this function's contract.
            PieceOf::Ours(allocation) => (unsafe { allocation.memory() }, allocation.offset()),
            PieceOf::Host(allocation, _) => (allocation.memory, allocation.offset),
        }
    }

    pub fn size(&self) -> u64 {
        match &self.of {
            PieceOf::Ours(allocation) => allocation.size(),
            PieceOf::Host(_, size) => *size,
        }
    }

    /// Its first byte, where the processor sees it.
    pub fn mapped(&self) -> Option<NonNull<u8>> {
        match &self.of {
            PieceOf::Ours(allocation) => allocation.mapped_ptr().map(NonNull::cast),
            PieceOf::Host(allocation, _) => allocation.mapped,
        }
    }

    /// Its bytes, where the processor sees them; else none.
    pub fn bytes(&self) -> &[u8] {
        match &self.of {
            PieceOf::Ours(allocation) => allocation.mapped_slice().unwrap_or_default(),
            PieceOf::Host(HostAllocation { mapped: Some(first), .. }, size) => {
                // SAFETY: the host's contract: so many bytes are mapped there, and nobody else's.
                unsafe { std::slice::from_raw_parts(first.as_ptr(), *size as usize) }
            }
            PieceOf::Host(..) => &[],
        }
    }

    /// The same for writing.
    pub fn bytes_mut(&mut self) -> &mut [u8] {
        match &mut self.of {
            PieceOf::Ours(allocation) => allocation.mapped_slice_mut().unwrap_or_default(),
            PieceOf::Host(HostAllocation { mapped: Some(first), .. }, size) => {
                // SAFETY: as in `bytes`.
                unsafe { std::slice::from_raw_parts_mut(first.as_ptr(), *size as usize) }
            }
            PieceOf::Host(..) => &mut [],
        }
    }
}

/// Where memory comes from.
pub(super) struct Source {
    from: From,
    in_use: MemoryInUse,
    pieces: usize,
}

enum From {
    Ours(Box<Allocator>),
    Host(std::sync::Arc<dyn HostMemory>),
}

impl Source {
    pub fn ours(allocator: Allocator) -> Self {
        Self { from: From::Ours(Box::new(allocator)), in_use: MemoryInUse::default(), pieces: 0 }
    }

    pub fn host(host: std::sync::Arc<dyn HostMemory>) -> Self {
        Self { from: From::Host(host), in_use: MemoryInUse::default(), pieces: 0 }
    }

    pub fn allocate(&mut self, request: &MemoryRequest<'_>) -> Result<Piece, Error> {
        let MemoryRequest { name, requirements, touched_by, linear } = *request;
        let failed = |reason: String| -> Error {
            ErrorKind::Memory { object: name.to_owned(), bytes: requirements.size, reason }.into()
        };
        let of = match &mut self.from {
            From::Ours(allocator) => {
                let desc = AllocationCreateDesc {
                    name,
                    requirements,
                    location: touched_by.location(),
                    linear,
                    allocation_scheme: AllocationScheme::GpuAllocatorManaged,
                };
                allocator.allocate(&desc).map(PieceOf::Ours).map_err(|error| told(error, name, failed))?
            }
            From::Host(host) => {
                let given = host.allocate(request);
                let given =
                    given.map_err(|result| failed(format!("the host's allocator answered {result}")))?;
                if touched_by != MemoryUse::Device && given.mapped.is_none() {
                    host.free(given);
                    return Err(failed("the host's allocator gave memory that is not mapped".to_owned()));
                }
                PieceOf::Host(given, requirements.size)
            }
        };
        let piece = Piece { of, touched_by, linear };
        *self.part(&piece) += piece.size();
        self.pieces += 1;
        Ok(piece)
    }

    pub fn free(&mut self, piece: Piece) {
        *self.part(&piece) -= piece.size();
        self.pieces -= 1;
        match (&mut self.from, piece.of) {
            (From::Ours(allocator), PieceOf::Ours(allocation)) => {
                // Freeing fails only for an allocation of another allocator, which can't come here.
                let freed = allocator.free(allocation);
                debug_assert!(freed.is_ok(), "{freed:?}");
            }
            (From::Host(host), PieceOf::Host(allocation, _)) => host.free(allocation),
            _ => debug_assert!(false, "a piece of another source"),
        }
    }

    /// Where a piece counts.
    fn part(&mut self, piece: &Piece) -> &mut u64 {
        match (piece.touched_by, piece.linear) {
            (MemoryUse::Device, true) => &mut self.in_use.buffers,
            (MemoryUse::Device, false) => &mut self.in_use.images,
            (MemoryUse::Upload, _) => &mut self.in_use.upload,
            (MemoryUse::Readback, _) => &mut self.in_use.readback,
        }
    }

    /// Bytes in use, and how many pieces they are.
    pub fn in_use(&self) -> (u64, usize) {
        (self.in_use.total(), self.pieces)
    }

    /// The same by what it is for, and what is idle beside it.
    pub fn by_use(&self) -> MemoryInUse {
        MemoryInUse { idle: self.held() - self.in_use.total(), ..self.in_use }
    }

    /// Bytes that are taken from the device, idle ones included.
    pub fn held(&self) -> u64 {
        match &self.from {
            From::Ours(allocator) => allocator.capacity(),
            From::Host(_) => self.in_use.total(),
        }
    }
}

/// An error of the allocator's as one of the call of Vulkan's that failed. A device that is lost has memory.
fn told(error: AllocationError, name: &str, failed: impl Fn(String) -> Error) -> Error {
    let lost = vk::Result::ERROR_DEVICE_LOST;
    match error {
        AllocationError::OutOfMemory => failed("vkAllocateMemory: out of memory".to_owned()),
        // The allocator tells only in words what was answered.
        AllocationError::Internal(text) if text.ends_with(&format!("vkAllocateMemory: {lost:?}")) => {
            Error::vulkan("vkAllocateMemory", name, lost)
        }
        AllocationError::FailedToMap(text) if text == lost.to_string() => {
            Error::vulkan("vkMapMemory", name, lost)
        }
        AllocationError::FailedToMap(text) => failed(format!("vkMapMemory: {text}")),
        other => failed(other.to_string()),
    }
}
