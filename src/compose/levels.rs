//! Objects that are files of levels of detail: opened, to be read as views need them.

use super::object::{name_of, refuse_triangles};
use crate::{
    error::{Error, Result},
    levels_file::{LevelsFile, Placed, is_levels_file},
    load::{ObjectDescription, Source},
};

/// Whether an object is a file of levels of detail.
pub fn is_in_levels(object: &ObjectDescription) -> bool {
    matches!(&object.source, Source::File(path) if is_levels_file(path))
}

/// Opens the file of levels of detail of an object, as it stands in the scene.
///
/// # Errors
/// As [`LevelsFile::open`], [`LevelsFile::placed_as`] and [`refuse_triangles`]; [`crate::ErrorKind::Input`] for what such an object can't have, and for one of no file.
pub fn open_levels(object: &ObjectDescription) -> Result<LevelsFile> {
    refuse_triangles(object, "splats")?;
    let Source::File(path) = &object.source else {
        return Err(Error::input(name_of(object), "", "built-in; expected a file of levels of detail"));
    };
    if object.epsilon.is_some() {
        let problem = "nodes of levels of detail have that of the picture; expected none of the object's own";
        return Err(Error::input(path, "epsilon", problem));
    }
    let ObjectDescription { world_from_object: world_from_file, color, alpha, .. } = *object;
    LevelsFile::open(path)?.placed_as(name_of(object), &Placed { world_from_file, color, alpha })
}
