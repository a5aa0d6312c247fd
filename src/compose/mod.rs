//! From descriptions of objects to a scene: models are loaded, placed, colored, and become splats or triangles that can
//! be drawn; with a sentence on each that says what was done.
//!
//! Meshes are placed before they become splats, so that the splats are round and leave no hole where they are drawn.

mod from_mesh;
mod hybrid;
mod memory;
mod object;
mod words;

use std::path::Path;

pub use from_mesh::resampled;
pub use memory::check_memory;
pub use object::{Made, make};
pub use words::{finish, splats_kind};

use crate::{
    error::Result,
    load::load_scene_file,
    progress::Progress,
    report::InputReport,
    scene::{CameraParts, Scene},
};

/// The scene of a scene file.
#[derive(Debug)]
pub struct Composed {
    /// Its objects and lights; every splat can be drawn.
    pub scene: Scene,
    /// What it says of the camera: [`CameraParts::camera`] makes one for [`Scene::ball`].
    pub camera: CameraParts,
    /// What was done, one an object of the file.
    pub reports: Vec<InputReport>,
}

/// Loads a scene file and all that it names.
///
/// # Errors
/// As [`load_scene_file`], [`check_memory`] and [`make`].
pub fn compose(path: &Path, progress: &dyn Progress) -> Result<Composed> {
    let file = load_scene_file(path)?;
    check_memory(&file.objects)?;
    let mut scene = Scene { lights: file.lights, ..Scene::default() };
    let mut reports = Vec::new();
    for object in &file.objects {
        let made = make(object, progress)?;
        reports.push(made.report.clone());
        made.add_to(&mut scene);
    }
    Ok(Composed { scene, camera: file.camera.unwrap_or_default(), reports })
}

#[cfg(test)]
mod tests;
