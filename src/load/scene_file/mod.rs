//! Scene files: objects, lights and a camera in TOML. `surfel render --help` has the table of all keys.
//!
//! Descriptions are read here, checked as far as they can be without opening a model; [`crate::compose`] makes
//! a scene of them. An object's file lies in the scene file's folder or below it, links followed: a scene from elsewhere
//! opens nothing else, unless the user allows it.

mod camera;
mod description;
mod document;
mod light;
mod nearest;
mod object;
mod picture;
mod source;
#[cfg(test)]
mod tests;
mod transform;

use std::path::Path;

use toml::de::DeTable;

pub use description::{
    BuiltIn, MOST_BUILT_IN_SPLATS, ObjectDescription, PictureDescription, Polygons, Representation, Samples,
    SceneFile, Source,
};

use super::LoadOptions;
use crate::{error::Result, small_file::read_small_text};
use document::{Document, Table, one_line};

/// About what a thousand objects take: what is larger is something else, and the parser takes a hundred times as much.
pub const MOST_SCENE_FILE_BYTES: u64 = 256 << 10;

/// How deep arrays and tables may nest: as deep as the crate toml goes.
const MOST_NESTED: usize = 80;

/// The most objects of a scene file.
pub const MOST_OBJECTS: usize = 1024;

/// Whether a path names a scene file: its name ends in `.toml`.
pub fn is_scene_file(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("toml"))
}

/// Reads a scene file. No model is opened; whether their files are there and where they may be is looked at.
///
/// # Errors
/// [`crate::ErrorKind::File`] if it can't be read; [`crate::ErrorKind::Input`], naming the line, the object and the key,
/// for what is no TOML, a key that is unknown (with the nearest known one), missing or out of its range, an object's file
/// that is not there or not within the scene file's folder (unless [`LoadOptions::allow_outside`]), and more than [`MOST_OBJECTS`].
pub fn load_scene_file(path: &Path, options: &LoadOptions) -> Result<SceneFile> {
    let text = read_small_text(path, MOST_SCENE_FILE_BYTES, "a scene file")?;
    parse(path, &text, options)
}

fn parse(path: &Path, text: &str, options: &LoadOptions) -> Result<SceneFile> {
    let document = Document { path, text };
    let parsed = DeTable::parse(text).map_err(|e| {
        let at = e.span().map_or(0, |span| span.start);
        let problem = match e.message().starts_with("cannot recurse") {
            true => format!("nested too deeply; expected at most {MOST_NESTED} levels"),
            false => format!("not TOML: {}", one_line(e.message())),
        };
        document.fault(at, "", &problem)
    })?;
    let root = Table::of(
        &document,
        parsed.get_ref(),
        0,
        "",
        &["camera", "light", "object", "epsilon", "background", "shading", "clip_box", "clip_planes"],
    )?;
    let camera = root.table("camera", camera::KEYS)?.map(|table| camera::read(&table)).transpose()?;
    let (camera, camera_target) = camera.map_or((None, None), |(camera, target)| (Some(camera), target));
    let lights = root.tables("light", light::KEYS, crate::scene::MOST_LIGHTS)?;
    let lights = lights.iter().map(light::read).collect::<Result<_>>()?;
    let objects = root.tables("object", object::KEYS, MOST_OBJECTS)?;
    if objects.is_empty() {
        return Err(document.fault(0, "", "no [[object]]; expected at least one"));
    }
    let objects =
        objects.iter().map(|object| object::read(object, options.allow_outside)).collect::<Result<_>>()?;
    Ok(SceneFile {
        path: path.to_owned(),
        camera,
        camera_target,
        lights,
        objects,
        picture: picture::read(&root)?,
    })
}
