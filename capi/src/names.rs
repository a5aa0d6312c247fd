//! Names of what is on the device.

use std::ffi::c_char;

use crate::{
    handle::{get, told},
    renderer::SurfelPreparedScene,
    result::{Failure, Result, SurfelResult, guard},
};

/// Tells the name of an object of a scene on the device, by its number as `surfel_pick_read` tells it and `surfel_update` takes it: the file's, or the one that it was given. `length` is how many bytes the name has. Of
/// these, and a closing zero, at most `capacity` are written to `name`, the last one a zero; `name` may be NULL where `capacity` is 0.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn surfel_prepared_scene_object_name(
    scene: *const SurfelPreparedScene,
    object: u64,
    name: *mut c_char,
    capacity: u64,
    length: *mut u64,
) -> SurfelResult {
    guard("surfel_prepared_scene_object_name", || {
        // SAFETY: the contract of the header.
        unsafe {
            let scene = get(scene, "scene")?;
            told(named(&scene.0.objects, object)?, (name, capacity, "name"), length)
        }
    })
}

fn named(objects: &[String], object: u64) -> Result<&str> {
    let own = usize::try_from(object).ok().and_then(|number| objects.get(number));
    own.map(String::as_str)
        .ok_or_else(|| Failure::invalid(format!("object {object}: the scene has {}", objects.len())))
}
