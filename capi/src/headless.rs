//! A device of our own, for programs that have none: pictures in memory.

use std::{
    ffi::{c_char, c_void},
    path::PathBuf,
};

use surfel::{
    Frame, Headless, HeadlessOptions, Settings, Validation, Wanted, ash::vk, embed::PassFigures,
    progress::Progress,
};

use crate::{
    camera::camera_of,
    device::SurfelDevice,
    frame::measures_of,
    handle::{Out, Place, destroy, get, get_mut, null, text, told},
    listener::{Listener, SurfelListener},
    measured::{SurfelPassMeasured, tell, tell_span},
    picture::{SurfelHeadlessFrame, SurfelPicture, picture_of},
    renderer::SurfelPreparedScene,
    result::{SurfelResult, guard},
    scene::SurfelScene,
    structs::{Struct, SurfelStructureType, read, write},
};

/// A device and a queue of our own, which draws pictures to memory and waits for each. One thread at a time may use it.
pub struct SurfelHeadless {
    headless: Headless,
    /// The frame that was drawn last.
    frame: Option<Frame>,
}

/// How a device of our own is opened.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct SurfelHeadlessInfo {
    /// `SURFEL_STRUCTURE_TYPE_HEADLESS_INFO`.
    pub s_type: u32,
    /// `sizeof(SurfelHeadlessInfo)`.
    pub size: u32,
    /// NULL.
    pub p_next: *const c_void,
    /// The device: its index, or a part of its name; NULL: the best one.
    pub device: *const c_char,
    /// The folder in which pipelines are kept from run to run, as UTF-8; NULL: they are not.
    pub cache_folder: *const c_char,
    /// The validation layer watches (`surfel_headless_messages`).
    pub validates: vk::Bool32,
    /// 0; else it is refused.
    pub reserved: u32,
}

// SAFETY: it begins so, and a test looks for padding.
unsafe impl Struct for SurfelHeadlessInfo {
    const TYPE: SurfelStructureType = SurfelStructureType::HeadlessInfo;

    fn reserved(&self) -> u32 {
        self.reserved
    }
}

/// Opens a device of our own: the loader of Vulkan is looked for by name. `info` may be NULL. Where no device will do, or there is no loader, the answer is `SURFEL_RESULT_NO_DEVICE`; of a name that none has, `SURFEL_RESULT_OPTION`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn surfel_headless_create(
    info: *const SurfelHeadlessInfo,
    headless: *mut *mut SurfelHeadless,
) -> SurfelResult {
    guard("surfel_headless_create", || {
        // SAFETY: the contract of the header, here and below.
        let out = unsafe { Out::new(headless, "headless") }?;
        let mut options = HeadlessOptions::default();
        if !info.is_null() {
            // SAFETY: as above.
            let given = unsafe { read(info, "info") }?;
            // SAFETY: as above.
            let words = |words: *const c_char, name| match words.is_null() {
                true => Ok(None),
                // SAFETY: as above.
                false => unsafe { text(words, name) }.map(|words| Some(words.to_owned())),
            };
            options.device = words(given.device, "device")?;
            options.cache_folder = words(given.cache_folder, "cacheFolder")?.map(PathBuf::from);
            if given.validates != vk::FALSE {
                options.validation = Validation::On;
            }
        }
        out.give(SurfelHeadless { headless: Headless::new(&options)?, frame: None })
    })
}

/// Tells the name of the device, as `surfel_prepared_scene_object_name` does.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn surfel_headless_device_name(
    headless: *const SurfelHeadless,
    name: *mut c_char,
    capacity: u64,
    length: *mut u64,
) -> SurfelResult {
    guard("surfel_headless_device_name", || {
        // SAFETY: the contract of the header.
        unsafe {
            let headless = &get(headless, "headless")?.headless;
            told(&headless.device().facts().name, (name, capacity, "name"), length)
        }
    })
}

/// Gives the device, for `surfel_device_memory` and `surfel_device_memory_report`: its epochs are ended, and told to be done, by `surfel_headless_render` and `surfel_headless_prepare` alone. To be destroyed as any other.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn surfel_headless_device(
    headless: *const SurfelHeadless,
    device: *mut *mut SurfelDevice,
) -> SurfelResult {
    guard("surfel_headless_device", || {
        // SAFETY: the contract of the header.
        let (out, headless) = unsafe { (Out::new(device, "device")?, get(headless, "headless")?) };
        out.give(SurfelDevice(headless.headless.device().clone()))
    })
}

/// Tells how many messages the validation layer has given so far, of a device that it watches.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn surfel_headless_messages(
    headless: *const SurfelHeadless,
    count: *mut u64,
) -> SurfelResult {
    guard("surfel_headless_messages", || {
        // SAFETY: the contract of the header.
        let (headless, count) = unsafe { (get(headless, "headless")?, Place::new(count, "count")?) };
        count.write(headless.headless.device().instance().messages().all().len() as u64);
        Ok(())
    })
}

/// Brings a scene to the device, and waits for that; `scene` may be destroyed at once. `listener` may be NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn surfel_headless_prepare(
    headless: *const SurfelHeadless,
    scene: *const SurfelScene,
    listener: *const SurfelListener,
    prepared: *mut *mut SurfelPreparedScene,
) -> SurfelResult {
    guard("surfel_headless_prepare", || {
        // SAFETY: the contract of the header.
        let (out, headless, scene, listener) = unsafe {
            (
                Out::new(prepared, "prepared")?,
                get(headless, "headless")?,
                get(scene, "scene")?,
                Listener::new(listener)?,
            )
        };
        let step = |done, total| listener.step("prepare the scene", done, total);
        out.give(SurfelPreparedScene(headless.headless.prepare(&scene.0, &step)?))
    })
}

/// Draws a picture, and waits for it. Where this fails, `picture` is as it was, and what it led to before is gone.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn surfel_headless_render(
    headless: *mut SurfelHeadless,
    frame: *const SurfelHeadlessFrame,
    picture: *mut SurfelPicture,
) -> SurfelResult {
    guard("surfel_headless_render", || {
        // SAFETY: the contract of the header, here and below.
        let (SurfelHeadless { headless, frame: kept }, given) =
            unsafe { (get_mut(headless, "headless")?, read(frame, "frame")?) };
        *kept = None;
        // SAFETY: as above.
        let (scene, camera) = unsafe { (get(given.scene, "scene")?, read(given.camera, "camera")?) };
        let size_px = [given.width, given.height];
        let settings = match given.settings.is_null() {
            true => Settings { size_px, ..Settings::default() },
            // SAFETY: as above.
            false => Settings { size_px, ..unsafe { get(given.settings, "settings") }?.0.clone() },
        };
        let wanted = Wanted {
            picture: given.without_picture == vk::FALSE,
            linear: given.linear != vk::FALSE,
            surface: given.surface != vk::FALSE,
            profile: measures_of(given.measures, None)?,
        };
        let frame = kept.insert(headless.render(&scene.0, &camera_of(&camera), &settings, wanted)?);
        // SAFETY: as above.
        unsafe { write(picture, "picture", &picture_of(frame)) }
    })
}

/// Tells what each pass cost of the picture that was drawn last, as `surfel_view_measured` does.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn surfel_headless_measured(
    headless: *const SurfelHeadless,
    each: SurfelPassMeasured,
    user: *mut c_void,
    span_secs: *mut f64,
) -> SurfelResult {
    guard("surfel_headless_measured", || {
        // SAFETY: the contract of the header, here and below.
        let headless = unsafe { get(headless, "headless") }?;
        let each = each.ok_or_else(|| null("each"))?;
        let profile = headless.frame.as_ref().and_then(|frame| frame.profile.as_ref());
        for pass in profile.iter().flat_map(|profile| &profile.passes) {
            let (name, secs) = (pass.name.as_str(), pass.secs);
            let pass = PassFigures { name, secs, counts: pass.counts, invocations: pass.invocations };
            // SAFETY: as above.
            unsafe { tell(each, user, pass) };
        }
        // SAFETY: as above.
        unsafe { tell_span(span_secs, profile.and_then(|profile| profile.span_secs)) }
    })
}

/// Gives back the memory that pictures are drawn in, of a program that draws none for a while.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn surfel_headless_forget(headless: *mut SurfelHeadless) -> SurfelResult {
    guard("surfel_headless_forget", || {
        // SAFETY: the contract of the header.
        let SurfelHeadless { headless, frame } = unsafe { get_mut(headless, "headless") }?;
        *frame = None;
        Ok(headless.forget_frames()?)
    })
}

/// Destroys a device of our own; NULL is nothing. Scenes that were brought there may be destroyed later.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn surfel_headless_destroy(headless: *mut SurfelHeadless) {
    // SAFETY: the contract of the header.
    unsafe { destroy("surfel_headless_destroy", headless) };
}
