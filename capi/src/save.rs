//! Splats and pictures to files. A file appears whole, or not at all.

use std::ffi::c_char;

use crate::{
    listener::SurfelListener,
    result::{Result, SurfelResult, guard},
    scene::SurfelScene,
};

/// Writes the splats of an object as a PLY file, with clip curves and whether they are `closed`, from which `surfel_scene_add_file` reads the same ones; those that can't be drawn, too. `up`, three numbers, is the direction
/// that is up, which the file then tells; NULL: it does not. `path` as in `surfel_scene_add_file`; `listener` may be NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn surfel_scene_save_splats(
    scene: *const SurfelScene,
    object: u64,
    path: *const c_char,
    up: *const f64,
    listener: *const SurfelListener,
) -> SurfelResult {
    guard("surfel_scene_save_splats", || {
        // SAFETY: the contract of the header.
        unsafe { save_splats(scene, object, path, up, listener) }
    })
}

/// Writes a PNG of 8 bits a channel: sRGB bytes row by row from the top left, with red, green and blue where `channels` is 3, and straight alpha where it is 4.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn surfel_save_png(
    path: *const c_char,
    width: u32,
    height: u32,
    channels: u32,
    pixels: *const u8,
) -> SurfelResult {
    guard("surfel_save_png", || {
        // SAFETY: the contract of the header.
        unsafe { save_png(path, [width, height], channels, pixels) }
    })
}

/// Writes an OpenEXR file of 32-bit floats, without loss: all channels of a pixel together, row by row from the top left. `channels` leads to their names, such as `R`, `G`, `B`, `A` or `Z`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn surfel_save_exr(
    path: *const c_char,
    width: u32,
    height: u32,
    channels: *const *const c_char,
    channel_count: u32,
    values: *const f32,
) -> SurfelResult {
    guard("surfel_save_exr", || {
        // SAFETY: the contract of the header.
        unsafe { save_exr(path, [width, height], (channels, channel_count), values) }
    })
}

#[cfg(feature = "files")]
use to_files::{save_exr, save_png, save_splats};

#[cfg(feature = "files")]
mod to_files {
    use surfel::save;

    use super::*;
    use crate::{
        arrays::array,
        contents::numbered,
        handle::{get, text},
        listener::Listener,
        load::path_of,
    };

    /// # Safety
    /// The contract of the header.
    pub unsafe fn save_splats(
        scene: *const SurfelScene,
        object: u64,
        path: *const c_char,
        up: *const f64,
        listener: *const SurfelListener,
    ) -> Result<()> {
        // SAFETY: this function's contract, here and below.
        let (scene, path, listener) =
            unsafe { (&get(scene, "scene")?.0, path_of(path, "path")?, Listener::new(listener)?) };
        let up = match up.is_null() {
            true => None,
            // SAFETY: as above.
            false => Some(unsafe { array(up.cast::<[f64; 3]>(), 1, "up") }?[0].into()),
        };
        let own = numbered(scene, object)?;
        save::splats(path, &own.splats, own.closed, up, &listener)?;
        Ok(())
    }

    /// Values of a picture; too many for any memory are refused with the array.
    fn count([width, height]: [u32; 2], channels: u32) -> u64 {
        (u64::from(width) * u64::from(height)).saturating_mul(channels.into())
    }

    /// # Safety
    /// The contract of the header.
    pub unsafe fn save_png(
        path: *const c_char,
        size_px: [u32; 2],
        channels: u32,
        pixels: *const u8,
    ) -> Result<()> {
        // SAFETY: this function's contract.
        let (path, pixels) =
            unsafe { (path_of(path, "path")?, array(pixels, count(size_px, channels), "pixels")?) };
        Ok(save::png(path, size_px, channels as usize, pixels)?)
    }

    /// # Safety
    /// The contract of the header.
    pub unsafe fn save_exr(
        path: *const c_char,
        size_px: [u32; 2],
        (channels, channel_count): (*const *const c_char, u32),
        values: *const f32,
    ) -> Result<()> {
        // SAFETY: this function's contract, here and below.
        let (path, channels, values) = unsafe {
            (
                path_of(path, "path")?,
                array(channels, channel_count.into(), "channels")?,
                array(values, count(size_px, channel_count), "values")?,
            )
        };
        // SAFETY: as above.
        let names = channels.iter().map(|name| unsafe { text(*name, "a channel") });
        let names = names.collect::<Result<Vec<_>>>()?;
        Ok(save::exr(path, size_px, &names, values)?)
    }
}

#[cfg(not(feature = "files"))]
unsafe fn save_splats(
    _scene: *const SurfelScene,
    _object: u64,
    _path: *const c_char,
    _up: *const f64,
    _listener: *const SurfelListener,
) -> Result<()> {
    Err(crate::result::Failure::without_files())
}

#[cfg(not(feature = "files"))]
unsafe fn save_png(
    _path: *const c_char,
    _size_px: [u32; 2],
    _channels: u32,
    _pixels: *const u8,
) -> Result<()> {
    Err(crate::result::Failure::without_files())
}

#[cfg(not(feature = "files"))]
unsafe fn save_exr(
    _path: *const c_char,
    _size_px: [u32; 2],
    _channels: (*const *const c_char, u32),
    _values: *const f32,
) -> Result<()> {
    Err(crate::result::Failure::without_files())
}
