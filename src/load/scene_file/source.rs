//! Where an object's model comes from.

use std::path::{Path, PathBuf};

use super::{
    description::{BuiltIn, MOST_BUILT_IN_SPLATS, Source},
    document::{Table, Value},
};
use crate::{
    error::Result,
    load::{
        beside::{self, Refusal},
        builtin::{DEFAULT_SPHERE_TRIANGLES, MOST_SPHERE_TRIANGLES},
    },
};

/// `outside`: files may lie outside of the scene file's folder.
pub(super) fn read(table: &Table<'_>, outside: bool) -> Result<Source> {
    match (table.get("file"), table.get("builtin")) {
        (Some(file), None) => {
            table.refuse("splats", "for a file; expected resample, which spreads splats over a mesh")?;
            table.refuse("triangles", "for a file")?;
            find(table.document.path, &file, outside).map(Source::File)
        }
        (None, Some(name)) => {
            let model = name.one_of(BuiltIn::NAMES)?;
            let count = |key, most| table.get(key).map(|value| value.whole(1, most)).transpose();
            let splats = count("splats", MOST_BUILT_IN_SPLATS)?.unwrap_or(model.default_splats());
            let triangles = count("triangles", MOST_SPHERE_TRIANGLES)?.unwrap_or(DEFAULT_SPHERE_TRIANGLES);
            Ok(Source::BuiltIn { model, splats, triangles })
        }
        (Some(file), Some(_)) => Err(file.fault("beside builtin; expected one or the other")),
        (None, None) => Err(table.fault("neither file nor builtin; expected one of them")),
    }
}

/// The file that the scene file names.
fn find(scene_file: &Path, file: &Value<'_>, outside: bool) -> Result<PathBuf> {
    let name = file.text("the name of a file of a model")?;
    let folder = match scene_file.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    beside::find(folder, name, outside).map_err(|refusal| match refusal {
        Refusal::Rooted => file.expected("a path relative to the scene file's folder, or --allow-outside"),
        Refusal::Outside => {
            file.expected("a file within the scene file's folder, links followed, or --allow-outside")
        }
        Refusal::Missing(path, e) => file.fault(&format!("{}: cannot read: {e}", path.display())),
    })
}
