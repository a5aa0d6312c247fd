//! Models from files, and the one that needs none.
//!
//! The format is told by the content, not by the name alone. No file is opened because another one names it, but for
//! those of a scene file, which lie in its folder or below.

pub mod builtin;
mod obj;
mod ply;
mod scene_file;
mod sniff;

use std::{fs, path::Path};

use crate::{
    error::{Error, Result},
    progress::Progress,
    scene::{Mesh, Points, Splats},
};

pub use scene_file::{
    BuiltIn, MOST_BUILT_IN_SPLATS, MOST_OBJECTS, MOST_SCENE_FILE_BYTES, ObjectDescription, Polygons,
    Representation, Samples, SceneFile, Source, is_scene_file, load_scene_file,
};

/// The contents of a file.
#[derive(Clone, Debug)]
pub enum Model {
    /// Disks, ready to be drawn once [`Splats::drop_defective`] was called.
    Splats {
        /// The disks.
        splats: Splats,
        /// The file says that they sample a closed surface and that their normals point outward, as
        /// [`crate::scene::Object::closed`] wants it.
        closed: bool,
    },
    /// Triangles; [`crate::geometry::splats_from_mesh`] makes splats of them.
    Mesh(Mesh),
    /// Points that lack normals, radii or both; [`crate::geometry::splats_from_points`] makes splats of them.
    Points(Points),
}

impl Model {
    /// What a file of this holds, in the plural, for messages.
    pub fn contents(&self) -> &'static str {
        match self {
            Self::Splats { .. } => "splats",
            Self::Mesh(_) => "triangles",
            Self::Points(_) => "points",
        }
    }
}

/// Reads a PLY (ascii or binary) or OBJ file whole.
///
/// Elements that can't be drawn (not finite, zero size) stay in: the scene and geometry modules drop and count them.
///
/// # Errors
/// [`crate::ErrorKind::File`] if the file can't be read; [`crate::ErrorKind::Input`], naming element and number or the line, if
/// its content is not what its format demands, or is of a format that surfel does not know.
pub fn load(path: &Path, progress: &dyn Progress) -> Result<Model> {
    let bytes = read_file(path)?;
    match sniff::format(path, &bytes)? {
        sniff::Format::Ply => ply::parse(path, &bytes, progress),
        sniff::Format::Obj => obj::parse(path, &bytes, progress),
    }
}

/// The whole file. Only regular files: a device or a pipe may never end, and counts are checked against the size.
fn read_file(path: &Path) -> Result<Vec<u8>> {
    let metadata = fs::metadata(path).map_err(|e| Error::file(path, "read", e))?;
    if !metadata.is_file() {
        return Err(Error::input(path, "", "not a file; expected a PLY or OBJ file"));
    }
    fs::read(path).map_err(|e| Error::file(path, "read", e))
}

/// The file's own name, without its folder.
pub fn file_name(path: &Path) -> String {
    path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned()
}
