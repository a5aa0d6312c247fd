//! Models of files: on disk, or in the host's memory.

use std::ffi::c_char;

use crate::{
    camera::SurfelCamera,
    description::SurfelDescription,
    load_options::SurfelLoadOptions,
    result::{Result, SurfelResult, guard},
    scene::SurfelScene,
    settings::SurfelSettings,
};

/// Adds what a file holds, as `surfel render` shows it: splats, a mesh or points of any format that the library was built with, or all
/// objects and lights of a scene file (`.toml`). `path` is UTF-8; on Unix any bytes that are a path. Files that a file names are opened in
/// its folder or below.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn surfel_scene_add_file(scene: *mut SurfelScene, path: *const c_char) -> SurfelResult {
    guard("surfel_scene_add_file", || {
        // SAFETY: the contract of the header.
        unsafe { add_file(scene, path, std::ptr::null(), std::ptr::null()) }
    })
}

/// The same, read as `options` say and drawn as `description` says; both may be NULL. A scene file describes its objects itself:
/// `description` is NULL then.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn surfel_scene_add_file_as(
    scene: *mut SurfelScene,
    path: *const c_char,
    options: *const SurfelLoadOptions,
    description: *const SurfelDescription,
) -> SurfelResult {
    guard("surfel_scene_add_file_as", || {
        // SAFETY: the contract of the header.
        unsafe { add_file(scene, path, options, description) }
    })
}

/// The same of a file of `count` bytes that is in memory, such as a part of an archive. `name` is its name in messages, and its ending tells the format where
/// the content leaves that open. No other file is opened, and it is no scene file.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn surfel_scene_add_file_of_memory(
    scene: *mut SurfelScene,
    name: *const c_char,
    bytes: *const u8,
    count: u64,
    options: *const SurfelLoadOptions,
    description: *const SurfelDescription,
) -> SurfelResult {
    guard("surfel_scene_add_file_of_memory", || {
        // SAFETY: the contract of the header.
        unsafe { add_bytes(scene, name, (bytes, count), options, description) }
    })
}

/// Tells the camera of a scene file for a picture of this size, of which what the file leaves open comes from `scene`, into which it was added; and sets of `settings`, which may be NULL, what the file says of the
/// picture. `options` may be NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn surfel_scene_file_camera(
    scene: *const SurfelScene,
    path: *const c_char,
    options: *const SurfelLoadOptions,
    width: u32,
    height: u32,
    camera: *mut SurfelCamera,
    settings: *mut SurfelSettings,
) -> SurfelResult {
    guard("surfel_scene_file_camera", || {
        // SAFETY: the contract of the header.
        unsafe { file_camera(scene, (path, options), [width, height], camera, settings) }
    })
}

/// A path of C's.
///
/// # Safety
/// `path` is NULL or ends with a zero.
#[cfg(feature = "files")]
pub unsafe fn path_of<'a>(path: *const c_char, name: &str) -> Result<&'a std::path::Path> {
    if path.is_null() {
        return Err(crate::handle::null(name));
    }
    // SAFETY: this function's contract.
    let path = unsafe { std::ffi::CStr::from_ptr(path) };
    #[cfg(unix)]
    let path = <std::ffi::OsStr as std::os::unix::ffi::OsStrExt>::from_bytes(path.to_bytes());
    #[cfg(not(unix))]
    let path = path.to_str().map_err(|_| crate::result::Failure::invalid(format!("{name} is not UTF-8")))?;
    Ok(std::path::Path::new(path))
}

#[cfg(feature = "files")]
use of_files::{add_bytes, add_file, file_camera};

#[cfg(feature = "files")]
mod of_files {
    use surfel::{
        compose::{ball_of_target, compose, make, make_loaded},
        load::{is_scene_file, load_bytes, load_scene_file},
    };

    use super::*;
    use crate::{
        arrays::copied,
        camera::fill,
        description::{built, described},
        handle::{get, get_mut},
        load_options::options_of,
        result::Failure,
    };

    /// # Safety
    /// The contract of the header.
    pub unsafe fn add_file(
        scene: *mut SurfelScene,
        path: *const c_char,
        options: *const SurfelLoadOptions,
        description: *const SurfelDescription,
    ) -> Result<()> {
        // SAFETY: this function's contract.
        let (scene, path, (options, listener)) =
            unsafe { (&mut get_mut(scene, "scene")?.0, path_of(path, "path")?, options_of(options)?) };
        if !is_scene_file(path) {
            // SAFETY: as above.
            let description = unsafe { described(description, path) }?;
            let made = make(&description, &options, &listener)?;
            built(scene, made, description.epsilon);
            return Ok(());
        }
        if !description.is_null() {
            return Err(Failure::invalid(
                "description: expected NULL: a scene file describes its objects itself",
            ));
        }
        let file = compose(path, &options, &listener)?.scene;
        scene.epsilons.resize(scene.objects.len(), None);
        scene.epsilons.extend(file.epsilons);
        scene.objects.extend(file.objects);
        scene.leveled.extend(file.leveled);
        let before = scene.meshes.len();
        scene.hybrids.extend(file.hybrids.into_iter().map(|mut hybrid| {
            hybrid.mesh += before;
            hybrid
        }));
        scene.meshes.extend(file.meshes);
        scene.lights.extend(file.lights);
        Ok(())
    }

    /// # Safety
    /// The contract of the header.
    pub unsafe fn file_camera(
        scene: *const SurfelScene,
        (path, options): (*const c_char, *const SurfelLoadOptions),
        size_px: [u32; 2],
        camera: *mut SurfelCamera,
        settings: *mut SurfelSettings,
    ) -> Result<()> {
        // SAFETY: this function's contract.
        let (scene, path, (options, _)) =
            unsafe { (&get(scene, "scene")?.0, path_of(path, "path")?, options_of(options)?) };
        let settings = match settings.is_null() {
            true => None,
            // SAFETY: as above.
            false => Some(&mut unsafe { get_mut(settings, "settings") }?.0),
        };
        let file = load_scene_file(path, &options)?;
        let mut parts = file.camera.unwrap_or_default();
        if let Some(name) = &file.camera_target {
            parts.subject = Some(ball_of_target(scene, name, path)?);
        }
        let ball = scene.ball().ok_or_else(|| Failure::invalid("there is nothing in the scene"))?;
        let made = parts.camera(&ball, size_px)?;
        // SAFETY: as above.
        unsafe { fill(camera, &made) }?;
        if let Some(settings) = settings {
            *settings = file.picture.over(settings.clone());
        }
        Ok(())
    }

    /// # Safety
    /// The contract of the header.
    pub unsafe fn add_bytes(
        scene: *mut SurfelScene,
        name: *const c_char,
        (bytes, count): (*const u8, u64),
        options: *const SurfelLoadOptions,
        description: *const SurfelDescription,
    ) -> Result<()> {
        // SAFETY: this function's contract.
        let (scene, name, (options, listener)) =
            unsafe { (&mut get_mut(scene, "scene")?.0, path_of(name, "name")?, options_of(options)?) };
        // SAFETY: as above.
        let (description, bytes) =
            unsafe { (described(description, name)?, copied(bytes, count, "bytes", |byte: u8| byte)?) };
        let made = make_loaded(load_bytes(name, bytes, &options, &listener)?, &description, &listener)?;
        built(scene, made, description.epsilon);
        Ok(())
    }
}

#[cfg(not(feature = "files"))]
unsafe fn add_file(
    _scene: *mut SurfelScene,
    _path: *const c_char,
    _options: *const SurfelLoadOptions,
    _description: *const SurfelDescription,
) -> Result<()> {
    Err(crate::result::Failure::without_files())
}

#[cfg(not(feature = "files"))]
unsafe fn file_camera(
    _scene: *const SurfelScene,
    _file: (*const c_char, *const SurfelLoadOptions),
    _size_px: [u32; 2],
    _camera: *mut SurfelCamera,
    _settings: *mut SurfelSettings,
) -> Result<()> {
    Err(crate::result::Failure::without_files())
}

#[cfg(not(feature = "files"))]
unsafe fn add_bytes(
    _scene: *mut SurfelScene,
    _name: *const c_char,
    _bytes: (*const u8, u64),
    _options: *const SurfelLoadOptions,
    _description: *const SurfelDescription,
) -> Result<()> {
    Err(crate::result::Failure::without_files())
}
