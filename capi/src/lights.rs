//! Lights of a scene that is on the device.

use std::ffi::c_char;

use surfel::{
    Error,
    scene::{Light, MOST_LIGHTS},
};

use crate::{
    arrays::array,
    handle::{get_mut, text},
    renderer::SurfelPreparedScene,
    result::{Result, SurfelResult, guard},
};

/// # Safety
/// `words` is NULL or ends with a zero.
pub unsafe fn light(words: *const c_char, name: &str) -> Result<Light> {
    // SAFETY: this function's contract.
    let words = unsafe { text(words, name) }?;
    Ok(Light::parse(words).map_err(|problem| Error::option("light", problem))?)
}

/// Gives a scene on the device other lights, each by words as `surfel_scene_add_light` has them, at most 16; none: a white one at the eye.
/// Frames show them that are prepared later; where it had none before, or has none now, they may need other pipelines. `scene` may be one of
/// `surfel_dynamic_create`. Nothing else may use it meanwhile.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn surfel_prepared_scene_set_lights(
    scene: *mut SurfelPreparedScene,
    lights: *const *const c_char,
    count: u32,
) -> SurfelResult {
    guard("surfel_prepared_scene_set_lights", || {
        // SAFETY: the contract of the header, here and below.
        let scene = unsafe { get_mut(scene, "scene") }?;
        if count as usize > MOST_LIGHTS {
            let problem = format!("{count} of them: expected at most {MOST_LIGHTS}");
            return Err(Error::option("light", problem).into());
        }
        // SAFETY: as above.
        let words = unsafe { array(lights, count.into(), "lights") }?;
        // SAFETY: as above.
        let all = words.iter().map(|words| unsafe { light(*words, "a light") });
        scene.0.lights = all.collect::<Result<_>>()?;
        Ok(())
    })
}
