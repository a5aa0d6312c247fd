//! Device memory that a host gives, by two functions.

use std::{
    ffi::{CStr, CString, c_char, c_void},
    ptr::NonNull,
    sync::Arc,
};

use surfel::{
    ash::vk,
    embed::{HostAllocation, HostMemory, MemoryRequest, MemoryUse},
};

use crate::{
    handle::null,
    result::Result,
    structs::{Struct, SurfelStructureType, read},
};

/// What is asked of a host's allocator: a struct that the library fills, of which a later one may have more behind.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct SurfelMemoryRequest {
    /// `SURFEL_STRUCTURE_TYPE_MEMORY_REQUEST`.
    pub s_type: u32,
    /// Its size in the library.
    pub size: u32,
    /// NULL.
    pub p_next: *const c_void,
    /// For what, in words; valid during the call.
    pub name: *const c_char,
    /// How many bytes.
    pub bytes: u64,
    /// Of its offset.
    pub alignment: u64,
    /// A bit for each type of memory that will do, as in `VkMemoryRequirements`.
    pub memory_type_bits: u32,
    /// For buffers; else for images of optimal tiling, of which `bufferImageGranularity` has to be kept.
    pub linear: vk::Bool32,
    /// The host's processor writes there: it must be mapped, and coherent.
    pub written_by_host: vk::Bool32,
    /// The host's processor reads there: it must be mapped, and coherent.
    pub read_by_host: vk::Bool32,
}

/// A piece of a host's device memory.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct SurfelAllocation {
    /// The memory object.
    pub memory: vk::DeviceMemory,
    /// Where in it, in bytes.
    pub offset: u64,
    /// Where the host's processor sees the first byte, of what it touches; else NULL.
    pub mapped: *mut c_void,
    /// Whatever the host knows it by.
    pub token: u64,
}

/// Gives memory and answers `VK_SUCCESS`, or why there is none: `VK_ERROR_OUT_OF_DEVICE_MEMORY` where a budget is used up. Then what needed it
/// fails with `SURFEL_RESULT_OUT_OF_MEMORY`, and is asked for again when a frame needs it next. `allocation` is zero before. Must return.
pub type SurfelAllocate = Option<
    unsafe extern "C" fn(
        user: *mut c_void,
        request: *const SurfelMemoryRequest,
        allocation: *mut SurfelAllocation,
    ) -> vk::Result,
>;

/// Takes a piece back: nothing of the device's uses it any more. Must return.
pub type SurfelFree = Option<unsafe extern "C" fn(user: *mut c_void, allocation: *const SurfelAllocation)>;

/// A host's allocator. It is asked from whichever thread uses a renderer or a view, by one at a time, and must not call surfel back. What it gives is memory of the
/// device, of a type among those asked for, aligned and as large as asked, used by nobody else until it is given back. It must live until
/// all that was made from the device is destroyed and its last epoch is done.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct SurfelMemory {
    /// `SURFEL_STRUCTURE_TYPE_MEMORY`.
    pub s_type: u32,
    /// `sizeof(SurfelMemory)`.
    pub size: u32,
    /// NULL.
    pub p_next: *const c_void,
    /// What both functions are given first; may be NULL.
    pub user: *mut c_void,
    /// Gives memory.
    pub allocate: SurfelAllocate,
    /// Takes it back.
    pub free: SurfelFree,
}

// SAFETY: it begins so, and a test looks for padding.
unsafe impl Struct for SurfelMemory {
    const TYPE: SurfelStructureType = SurfelStructureType::Memory;
}

/// The functions of a host, both there.
struct OfHost {
    user: *mut c_void,
    allocate:
        unsafe extern "C" fn(*mut c_void, *const SurfelMemoryRequest, *mut SurfelAllocation) -> vk::Result,
    free: unsafe extern "C" fn(*mut c_void, *const SurfelAllocation),
}

// SAFETY: by the header's contract they are called from any thread, one at a time.
unsafe impl Send for OfHost {}
// SAFETY: as above.
unsafe impl Sync for OfHost {}

/// What is asked of a host, with a name that lives as long.
pub fn request_of(
    name: &CStr,
    requirements: vk::MemoryRequirements,
    (touched_by, linear): (MemoryUse, bool),
) -> SurfelMemoryRequest {
    let vk::MemoryRequirements { size: bytes, alignment, memory_type_bits } = requirements;
    SurfelMemoryRequest {
        s_type: SurfelStructureType::MemoryRequest as u32,
        size: size_of::<SurfelMemoryRequest>() as u32,
        p_next: std::ptr::null(),
        name: name.as_ptr(),
        bytes,
        alignment,
        memory_type_bits,
        linear: linear.into(),
        written_by_host: (touched_by == MemoryUse::Upload).into(),
        read_by_host: (touched_by == MemoryUse::Readback).into(),
    }
}

// SAFETY: the contract of the header is that of the trait.
unsafe impl HostMemory for OfHost {
    fn allocate(&self, request: &MemoryRequest<'_>) -> std::result::Result<HostAllocation, vk::Result> {
        let name = CString::new(request.name).unwrap_or_default();
        let request = request_of(&name, request.requirements, (request.touched_by, request.linear));
        let mut given = SurfelAllocation {
            memory: vk::DeviceMemory::null(),
            offset: 0,
            mapped: std::ptr::null_mut(),
            token: 0,
        };
        // SAFETY: the header's contract; both live during the call.
        match unsafe { (self.allocate)(self.user, &raw const request, &raw mut given) } {
            vk::Result::SUCCESS if given.memory == vk::DeviceMemory::null() => {
                Err(vk::Result::ERROR_OUT_OF_DEVICE_MEMORY)
            }
            vk::Result::SUCCESS => Ok(HostAllocation {
                memory: given.memory,
                offset: given.offset,
                mapped: NonNull::new(given.mapped.cast()),
                token: given.token,
            }),
            other => Err(other),
        }
    }

    fn free(&self, allocation: HostAllocation) {
        let HostAllocation { memory, offset, mapped, token } = allocation;
        let mapped = mapped.map_or(std::ptr::null_mut(), |first| first.as_ptr().cast());
        let allocation = SurfelAllocation { memory, offset, mapped, token };
        // SAFETY: as above.
        unsafe { (self.free)(self.user, &raw const allocation) };
    }
}

/// The allocator that C means; `None` of NULL.
///
/// # Safety
/// `given` is NULL or leads to as much as it says.
pub unsafe fn memory_of(given: *const SurfelMemory) -> Result<Option<Arc<dyn HostMemory>>> {
    if given.is_null() {
        return Ok(None);
    }
    // SAFETY: this function's contract.
    let SurfelMemory { user, allocate, free, .. } = unsafe { read(given, "memory") }?;
    match (allocate, free) {
        (Some(allocate), Some(free)) => Ok(Some(Arc::new(OfHost { user, allocate, free }))),
        (None, _) => Err(null("memory: allocate")),
        (_, None) => Err(null("memory: free")),
    }
}
