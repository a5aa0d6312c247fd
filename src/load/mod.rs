//! Models from files, and the one that needs none.
//!
//! The format is told by the content, not by the name alone. No file is opened because another one names it, but for
//! those of a scene file, which lie in its folder or below.

pub mod builtin;
mod input;
mod loaded;
#[cfg(test)]
mod mutate;
mod obj;
mod options;
mod ply;
mod scene_file;
mod sniff;

use std::path::Path;

use crate::{error::Result, progress::Progress};
use input::{Input, read_file};

pub use loaded::{Loaded, Model};
pub use options::{Limits, LoadOptions};
pub use scene_file::{
    BuiltIn, MOST_BUILT_IN_SPLATS, MOST_OBJECTS, MOST_SCENE_FILE_BYTES, ObjectDescription, Polygons,
    Representation, Samples, SceneFile, Source, is_scene_file, load_scene_file,
};

/// Reads a PLY (ascii or binary) or OBJ file whole.
///
/// Elements that can't be drawn (not finite, zero size) stay in: the scene and geometry modules drop and count them.
///
/// # Errors
/// [`crate::ErrorKind::File`] if the file can't be read; [`crate::ErrorKind::Input`], naming element and number or the line, if
/// its content is not what its format demands, or is of a format that surfel does not know.
pub fn load(path: &Path, options: &LoadOptions, progress: &dyn Progress) -> Result<Loaded> {
    let bytes = read_file(path)?;
    let input = Input { path, bytes: &bytes, options, progress };
    match sniff::format(path, &bytes)? {
        sniff::Format::Ply => ply::parse(&input),
        sniff::Format::Obj => obj::parse(&input),
    }
}

/// The file's own name, without its folder.
pub fn file_name(path: &Path) -> String {
    path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned()
}
