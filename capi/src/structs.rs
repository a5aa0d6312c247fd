//! Structs that C fills. Each begins alike, with its kind and the size that its header gave it. A later version appends members, in whole
//! words of 8 bytes, so that no padding becomes a member; zero is what was before.

use std::{ffi::c_void, mem::MaybeUninit};

use crate::{
    handle::check as check_pointer,
    result::{Failure, Result, SurfelResult},
};

/// What a struct says it is: its `sType`.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SurfelStructureType {
    /// `SurfelRequirements`.
    Requirements = 1,
    /// `SurfelImport`.
    Import = 2,
    /// `SurfelRendererInfo`.
    RendererInfo = 3,
    /// `SurfelSceneInfo`.
    SceneInfo = 4,
    /// `SurfelSplats`.
    Splats = 5,
    /// `SurfelPreparedSceneInfo`.
    PreparedSceneInfo = 6,
    /// `SurfelRendering`.
    Rendering = 7,
    /// `SurfelDepthImage`.
    DepthImage = 8,
    /// `SurfelFrame`.
    Frame = 9,
    /// `SurfelDynamicSplats`.
    DynamicSplats = 10,
    /// `SurfelHostImage`.
    HostImage = 11,
    /// `SurfelMemoryRequest`.
    MemoryRequest = 12,
    /// `SurfelMemory`.
    Memory = 13,
    /// `SurfelMesh`.
    Mesh = 14,
    /// `SurfelRoom`.
    Room = 15,
    /// `SurfelMemoryReport`.
    MemoryReport = 16,
    /// `SurfelPicked`.
    Picked = 17,
    /// `SurfelLevels`.
    Levels = 18,
    /// `SurfelHybridLevels`.
    HybridLevels = 19,
    /// `SurfelListener`.
    Listener = 20,
    /// `SurfelLoadOptions`.
    LoadOptions = 21,
    /// `SurfelDescription`.
    Description = 22,
    /// `SurfelPoints`.
    Points = 23,
    /// `SurfelSharp`.
    Sharp = 24,
    /// `SurfelSceneContents`.
    SceneContents = 25,
    /// `SurfelCamera`.
    Camera = 26,
    /// `SurfelHeadlessInfo`.
    HeadlessInfo = 27,
    /// `SurfelHeadlessFrame`.
    HeadlessFrame = 28,
    /// `SurfelPicture`.
    Picture = 29,
    /// `SurfelMemoryNeeds`.
    MemoryNeeds = 30,
}

/// No struct is larger in any version: a size beyond is none that a header gave it.
const MOST_BYTES: usize = 1 << 16;

/// How each begins.
#[repr(C)]
#[derive(Clone, Copy)]
struct Head {
    s_type: u32,
    size: u32,
    p_next: *const c_void,
}

/// A struct that C fills.
///
/// # Safety
/// It begins as [`Head`] does, is `repr(C)`, has no padding, and may be all zeros.
pub unsafe trait Struct: Copy {
    const TYPE: SurfelStructureType;

    /// What must be 0, so that a later version can give it a meaning.
    fn reserved(&self) -> u32 {
        0
    }
}

/// How many bytes of a struct are both given and known.
///
/// # Safety
/// `given` is NULL or begins as [`Head`] does, and has the size that it says.
unsafe fn check<T: Struct>(given: *const T, name: &str) -> Result<usize> {
    check_pointer(given, name)?;
    // SAFETY: this function's contract.
    let Head { s_type, size, p_next } = unsafe { given.cast::<Head>().read() };
    let unknown = |text| Failure { code: SurfelResult::UnknownStruct, text };
    if s_type != T::TYPE as u32 {
        let expected = T::TYPE as u32;
        return Err(unknown(format!("{name}: sType {s_type}: expected {expected} ({:?})", T::TYPE)));
    }
    if !p_next.is_null() {
        // SAFETY: what `pNext` leads to begins alike.
        let next = unsafe { p_next.cast::<u32>().read_unaligned() };
        return Err(unknown(format!("{name}: pNext leads to sType {next}, which does not extend it")));
    }
    let (size, known) = (size as usize, size_of::<T>());
    if !(size_of::<Head>()..=MOST_BYTES).contains(&size) {
        return Err(Failure::invalid(format!("{name}: size {size}: expected its sizeof")));
    }
    // SAFETY: this function's contract, and bytes that are not ours to name are still bytes.
    let beyond = (known..size).any(|at| unsafe { given.cast::<u8>().add(at).read() } != 0);
    if beyond {
        let text = format!(
            "{name}: size {size}: this library knows {known} bytes of it, and what is beyond is not zero"
        );
        return Err(Failure { code: SurfelResult::NewerStruct, text });
    }
    Ok(size.min(known))
}

/// A struct as it was given; what its header did not have is zero.
///
/// # Safety
/// As [`check`].
pub unsafe fn read<T: Struct>(given: *const T, name: &str) -> Result<T> {
    // SAFETY: this function's contract, and the trait's.
    let whole = unsafe {
        let bytes = check(given, name)?;
        let mut whole = MaybeUninit::<T>::zeroed();
        given.cast::<u8>().copy_to_nonoverlapping(whole.as_mut_ptr().cast(), bytes);
        whole.assume_init()
    };
    match whole.reserved() {
        0 => Ok(whole),
        other => {
            let text = format!("{name}: reserved is {other}: this library knows 0");
            Err(Failure { code: SurfelResult::NewerStruct, text })
        }
    }
}

/// Fills a struct as far as its header has it. Of `value` all but its head counts.
///
/// # Safety
/// As [`check`], and it may be written.
pub unsafe fn write<T: Struct>(given: *mut T, name: &str, value: &T) -> Result<()> {
    let head = size_of::<Head>();
    // SAFETY: this function's contract.
    unsafe {
        let bytes = check(given, name)? - head;
        let from = std::ptr::from_ref(value).cast::<u8>().add(head);
        from.copy_to_nonoverlapping(given.cast::<u8>().add(head), bytes);
    }
    Ok(())
}
