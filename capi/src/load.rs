//! Models of files: on disk, or in the host's memory.

use std::ffi::{c_char, c_void};

use surfel::ash::vk;

use crate::{
    description::SurfelDescription,
    handle::{get_mut, null},
    listener::SurfelListener,
    result::{Result, SurfelResult, guard},
    scene::SurfelScene,
    structs::{Struct, SurfelStructureType},
};

/// How files are read. Of each limit 0 is the default: as much as any file of use has.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct SurfelLoadOptions {
    /// `SURFEL_STRUCTURE_TYPE_LOAD_OPTIONS`.
    pub s_type: u32,
    /// `sizeof(SurfelLoadOptions)`.
    pub size: u32,
    /// NULL.
    pub p_next: *const c_void,
    /// What the columns of rows of numbers are, by the words of `surfel render --columns`: `x,y,z,-,r,g,b`; NULL: as the file tells it.
    pub columns: *const c_char,
    /// Who is told how far it is, and what was noticed; NULL: nobody.
    pub listener: *const SurfelListener,
    /// Files that a file names may lie outside of its folder.
    pub allow_outside: vk::Bool32,
    /// 0; else it is refused.
    pub reserved: u32,
    /// Points or vertices at most.
    pub most_points: u64,
    /// Triangles at most.
    pub most_faces: u64,
    /// Bytes of a line of text at most.
    pub most_line_bytes: u64,
    /// Bytes of a header of text at most.
    pub most_header_bytes: u64,
    /// Corners of a polygon at most.
    pub most_list_items: u64,
    /// Bytes of standard input, of which no size is known beforehand.
    pub most_piped_bytes: u64,
    /// Bytes to which the compressed points of any LAZ or PCD file may expand, however small it is.
    pub expanded_bytes: u64,
    /// The same of files that are compressed as a whole.
    pub unpacked_bytes: u64,
    /// Bytes to which each byte of a larger compressed file may expand beyond these.
    pub expansion: u64,
    /// The same of the records of LAZ files.
    pub laz_expansion: u64,
}

// SAFETY: it begins so, and a test looks for padding.
unsafe impl Struct for SurfelLoadOptions {
    const TYPE: SurfelStructureType = SurfelStructureType::LoadOptions;

    fn reserved(&self) -> u32 {
        self.reserved
    }
}

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

/// A path of C's.
///
/// # Safety
/// `path` is NULL or ends with a zero.
pub unsafe fn path_of<'a>(path: *const c_char, name: &str) -> Result<&'a std::path::Path> {
    if path.is_null() {
        return Err(null(name));
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
use of_files::{add_bytes, add_file};

#[cfg(feature = "files")]
mod of_files {
    use surfel::{
        compose::{compose, make, make_loaded},
        load::{Limits, LoadOptions, is_scene_file, load_bytes},
    };

    use super::*;
    use crate::{
        arrays::copied,
        description::{built, described},
        handle::text,
        listener::Listener,
        result::Failure,
        structs::read,
    };

    /// How C wants files to be read, and who listens.
    ///
    /// # Safety
    /// `given` is NULL or leads to as much as it says.
    unsafe fn options_of(given: *const SurfelLoadOptions) -> Result<(LoadOptions, Listener)> {
        if given.is_null() {
            // SAFETY: nobody listens.
            return Ok((LoadOptions::default(), unsafe { Listener::new(std::ptr::null()) }?));
        }
        // SAFETY: this function's contract, here and below.
        let given = unsafe { read(given, "options") }?;
        let or = |given: u64, usual: u64| if given == 0 { usual } else { given };
        let size = |given: u64, usual: usize| match given {
            0 => usual,
            _ => usize::try_from(given).unwrap_or(usize::MAX),
        };
        let usual = Limits::DEFAULT;
        let limits = Limits {
            // Their numbers are kept in 32 bits, whatever is allowed.
            points: or(given.most_points, usual.points).min(usual.points),
            faces: or(given.most_faces, usual.faces).min(usual.faces),
            line_bytes: size(given.most_line_bytes, usual.line_bytes),
            header_bytes: size(given.most_header_bytes, usual.header_bytes),
            list_items: size(given.most_list_items, usual.list_items),
            piped_bytes: or(given.most_piped_bytes, usual.piped_bytes),
            expanded_bytes: or(given.expanded_bytes, usual.expanded_bytes),
            unpacked_bytes: or(given.unpacked_bytes, usual.unpacked_bytes),
            expansion: or(given.expansion, usual.expansion),
            laz_expansion: or(given.laz_expansion, usual.laz_expansion),
        };
        let columns = match given.columns.is_null() {
            true => None,
            // SAFETY: as above.
            false => Some(unsafe { text(given.columns, "columns") }?.parse()?),
        };
        let options = LoadOptions { limits, allow_outside: given.allow_outside != vk::FALSE, columns };
        // SAFETY: as above.
        Ok((options, unsafe { Listener::new(given.listener) }?))
    }

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
unsafe fn add_bytes(
    _scene: *mut SurfelScene,
    _name: *const c_char,
    _bytes: (*const u8, u64),
    _options: *const SurfelLoadOptions,
    _description: *const SurfelDescription,
) -> Result<()> {
    Err(crate::result::Failure::without_files())
}
