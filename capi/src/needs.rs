//! What memory scenes and views will ask for, told before anything is taken.

use std::ffi::{CString, c_void};

use surfel::{
    ash::vk,
    embed::{MemoryNeeds, MemoryPiece, MemoryUse},
};

use crate::{
    frame::{SceneList, SurfelFrame, with_frame},
    handle::{Out, get},
    memory::{SurfelMemoryRequest, request_of},
    renderer::{SurfelPreparedScene, SurfelRenderer},
    result::{Result, SurfelResult, guard},
    scene::SurfelScene,
    structs::{Struct, SurfelStructureType, read, write},
    view::{SurfelRendering, rendering_of},
};

/// A block of memory with room for some pieces, one behind the other.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct SurfelMemoryBlock {
    /// How many bytes.
    pub bytes: u64,
    /// Of its first byte.
    pub alignment: u64,
    /// A bit for each type of memory that will do for all of them, as in `VkMemoryRequirements`.
    pub memory_type_bits: u32,
    /// How many pieces.
    pub pieces: u32,
}

/// What memory will be asked for, told before. `surfel_scene_needs` and `surfel_view_needs` fill it.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct SurfelMemoryNeeds {
    /// `SURFEL_STRUCTURE_TYPE_MEMORY_NEEDS`.
    pub s_type: u32,
    /// `sizeof(SurfelMemoryNeeds)`.
    pub size: u32,
    /// NULL.
    pub p_next: *mut c_void,
    /// All of it in one block.
    pub all: SurfelMemoryBlock,
    /// What only the device touches.
    pub of_device: SurfelMemoryBlock,
    /// What the host's processor writes: it must be mapped, and coherent. Of scenes what is copied from, which goes once that has run.
    pub written_by_host: SurfelMemoryBlock,
}

// SAFETY: it begins so, and a test looks for padding.
unsafe impl Struct for SurfelMemoryNeeds {
    const TYPE: SurfelStructureType = SurfelStructureType::MemoryNeeds;
}

/// Is told of a piece, as a host's allocator will be asked for it; valid during the call. Must return.
pub type SurfelMemoryPiece =
    Option<unsafe extern "C" fn(user: *mut c_void, piece: *const SurfelMemoryRequest)>;

/// Tells what memory `surfel_upload` of a scene will ask for; takes none of the device's, but as long as the upload on the host. `granularity` is Vulkan's `bufferImageGranularity` where buffers and images
/// lie in one block; else 1. `each` is told of the pieces in the order in which they will be asked for; it, `user` and `needs` may be NULL. `measured`, which may be NULL, gets the scene as it would be uploaded, but on no
/// device: for frames that `surfel_view_needs` is asked of; others refuse it. It is destroyed as any other.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn surfel_scene_needs(
    renderer: *const SurfelRenderer,
    scene: *const SurfelScene,
    granularity: u64,
    each: SurfelMemoryPiece,
    user: *mut c_void,
    needs: *mut SurfelMemoryNeeds,
    measured: *mut *mut SurfelPreparedScene,
) -> SurfelResult {
    guard("surfel_scene_needs", || {
        // SAFETY: the contract of the header, here and below.
        let out = match measured.is_null() {
            true => None,
            // SAFETY: as above.
            false => Some(unsafe { Out::new(measured, "measured") }?),
        };
        // SAFETY: as above.
        let (renderer, scene) = unsafe { (get(renderer, "renderer")?, get(scene, "scene")?) };
        let (told, prepared) = renderer.renderer.scene_needs(&scene.0)?;
        // SAFETY: as above.
        unsafe { tell(&told, granularity, each, user, needs) }?;
        out.map_or(Ok(()), |out| out.give(SurfelPreparedScene(prepared)))
    })
}

/// Tells what memory the first `surfel_view_prepare` of a new view will ask for, for a frame like this, of scenes that are on the device or of `surfel_scene_needs`; of the first frame of a renderer with what that has of its
/// own. Takes none of the device's, and makes no pipeline. Frames of the view that need no more of any piece ask for nothing; how much one needs follows from which splats may be seen, and so from its camera. The other arguments are those of `surfel_scene_needs`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn surfel_view_needs(
    renderer: *const SurfelRenderer,
    rendering: *const SurfelRendering,
    frame: *const SurfelFrame,
    granularity: u64,
    each: SurfelMemoryPiece,
    user: *mut c_void,
    needs: *mut SurfelMemoryNeeds,
) -> SurfelResult {
    guard("surfel_view_needs", || {
        // SAFETY: the contract of the header, here and below.
        let (renderer, frame) = unsafe { (get(renderer, "renderer")?, read(frame, "frame")?) };
        // SAFETY: as above.
        let rendering = unsafe { rendering_of(&read(rendering, "rendering")?) }?;
        let mut told = MemoryNeeds::default();
        // SAFETY: as above.
        unsafe {
            with_frame(&frame, &mut SceneList::default(), |frame| {
                told = renderer.renderer.view_needs(&rendering, frame)?;
                Ok(())
            })?;
            tell(&told, granularity, each, user, needs)
        }
    })
}

/// # Safety
/// The contract of the header.
unsafe fn tell(
    told: &MemoryNeeds,
    granularity: u64,
    each: SurfelMemoryPiece,
    user: *mut c_void,
    needs: *mut SurfelMemoryNeeds,
) -> Result<()> {
    if !needs.is_null() {
        let block = |meant: &dyn Fn(&MemoryPiece) -> bool| {
            let vk::MemoryRequirements { size, alignment, memory_type_bits } = told.block(granularity, meant);
            let pieces = told.pieces.iter().filter(|piece| meant(piece)).count() as u32;
            SurfelMemoryBlock { bytes: size, alignment, memory_type_bits, pieces }
        };
        let filled = SurfelMemoryNeeds {
            s_type: 0,
            size: 0,
            p_next: std::ptr::null_mut(),
            all: block(&|_| true),
            of_device: block(&|piece| piece.touched_by == MemoryUse::Device),
            written_by_host: block(&|piece| piece.touched_by == MemoryUse::Upload),
        };
        // SAFETY: this function's contract.
        unsafe { write(needs, "needs", &filled) }?;
    }
    if let Some(each) = each {
        for piece in &told.pieces {
            let name = CString::new(piece.name.as_str()).unwrap_or_default();
            let request = request_of(&name, piece.requirements, (piece.touched_by, piece.linear));
            // SAFETY: this function's contract; it lives during the call.
            unsafe { each(user, &raw const request) };
        }
    }
    Ok(())
}
