//! Splats that come to an object and go from it.

use std::ffi::c_void;

use surfel::{ash::vk, glam::DVec3, scene::Room};

use crate::{
    handle::{Place, get, get_mut},
    renderer::{SurfelPreparedScene, SurfelRenderer},
    result::{Failure, Result, SurfelResult, guard},
    splats::SurfelSplats,
    structs::{Struct, SurfelStructureType, read},
};

/// Numbers of an object of splats behind those that it is uploaded with, which have nothing yet: `surfel_append` and `surfel_update` put splats there. Of an object that has it,
/// `surfel_remove` takes splats away, its own ones, too. For scenes that are `updatable`.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct SurfelRoom {
    /// `SURFEL_STRUCTURE_TYPE_ROOM`.
    pub s_type: u32,
    /// `sizeof(SurfelRoom)`.
    pub size: u32,
    /// NULL.
    pub p_next: *const c_void,
    /// How many numbers, of 40 bytes on the device each, 56 of ellipses; with none, splats are only taken away, and put back.
    pub splats: u32,
    /// `around` is a place in the scene's own space near which they will be; else they will be near the object, or, of none, near the origin. What is farther from it than 2000 times its own
    /// smaller half axis is placed less exactly.
    pub has_around: vk::Bool32,
    /// That place.
    pub around: [f64; 3],
    /// How many disks will lie over a place of the surface, where they are fewest; 0: as many as in the object, and of none 2.
    pub overlap: f64,
}

// SAFETY: it begins so, and a test looks for padding.
unsafe impl Struct for SurfelRoom {
    const TYPE: SurfelStructureType = SurfelStructureType::Room;
}

/// The room that C means; `None` of NULL.
///
/// # Safety
/// As [`read`].
pub unsafe fn room(given: *const SurfelRoom) -> Result<Option<Room>> {
    if given.is_null() {
        return Ok(None);
    }
    // SAFETY: this function's contract.
    let SurfelRoom { splats, has_around, around, overlap, .. } = unsafe { read(given, "room") }?;
    let around = (has_around != vk::FALSE).then_some(DVec3::from_array(around));
    Ok(Some(Room { splats, around, overlap: (overlap != 0.0).then_some(overlap) }))
}

/// Records that splats are added to an object which has `room`, behind the last one there; `first` is the number of the first then, the others follow. By them `surfel_update` changes
/// and `surfel_remove` removes them: numbers of others stay. `first` may be NULL. All else is as of `surfel_update`; an object without enough room behind its last splat is refused.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn surfel_append(
    renderer: *const SurfelRenderer,
    commands: vk::CommandBuffer,
    scene: *mut SurfelPreparedScene,
    object: u64,
    splats: *const SurfelSplats,
    first: *mut u32,
) -> SurfelResult {
    guard("surfel_append", || {
        // SAFETY: the contract of the header, here and below.
        let (renderer, scene, given) =
            unsafe { (get(renderer, "renderer")?, get_mut(scene, "scene")?, read(splats, "splats")?) };
        if commands == vk::CommandBuffer::null() {
            return Err(crate::handle::null("commands"));
        }
        let first = match first.is_null() {
            true => None,
            // SAFETY: as above.
            false => Some(unsafe { Place::new(first, "first") }?),
        };
        let number = usize::try_from(object).unwrap_or(usize::MAX);
        // SAFETY: as above.
        let numbers = unsafe {
            renderer.with_splats(&given, |renderer, splats| {
                renderer.append(commands, &mut scene.0, number, splats)
            })
        }?;
        if let Some(first) = first {
            first.write(numbers.start);
        }
        Ok(())
    })
}

/// Records that `count` splats from number `first` on are taken out of an object which has `room`; numbers that have none are left alone. All else is as of `surfel_update`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn surfel_remove(
    renderer: *const SurfelRenderer,
    commands: vk::CommandBuffer,
    scene: *mut SurfelPreparedScene,
    object: u64,
    first: u32,
    count: u32,
) -> SurfelResult {
    guard("surfel_remove", || {
        // SAFETY: the contract of the header, here and below.
        let (renderer, scene) = unsafe { (get(renderer, "renderer")?, get_mut(scene, "scene")?) };
        if commands == vk::CommandBuffer::null() {
            return Err(crate::handle::null("commands"));
        }
        let end = first.checked_add(count);
        let end = end.ok_or_else(|| Failure::invalid(format!("{count} splats from {first} on")))?;
        let number = usize::try_from(object).unwrap_or(usize::MAX);
        // SAFETY: as above.
        Ok(unsafe { renderer.renderer.remove(commands, &mut scene.0, number, first..end) }?)
    })
}

/// Tells how many splats `surfel_append` has room for yet, behind the last one that an object has there; 0 of one without room.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn surfel_room_of(
    scene: *const SurfelPreparedScene,
    object: u64,
    splats: *mut u32,
) -> SurfelResult {
    guard("surfel_room_of", || {
        // SAFETY: the contract of the header.
        let (scene, place) = unsafe { (get(scene, "scene")?, Place::new(splats, "splats")?) };
        let number = usize::try_from(object).unwrap_or(usize::MAX);
        place.write(scene.0.room_of(number).unwrap_or(0));
        Ok(())
    })
}
