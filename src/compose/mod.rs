//! From descriptions of objects to a scene: models are loaded, placed, colored, and become splats or triangles that can
//! be drawn; with a sentence on each that says what was done.
//!
//! Meshes are placed before they become splats, so that the splats are round and leave no hole where they are drawn.

mod facts;
mod from_mesh;
mod from_points;
mod hybrid;
mod memory;
mod object;
mod parts;
mod sharp;
mod words;

use std::path::Path;

pub use from_mesh::resampled;
pub use memory::check_memory;
pub use object::{BuiltObject, make};
pub use sharp::sharpened;
pub use words::{finish, splats_kind};

use crate::{
    error::Result,
    load::{LoadOptions, ObjectDescription, PictureDescription, load_scene_file},
    progress::Progress,
    report::InputReport,
    scene::{CameraParts, Light, Scene},
};

/// The scene of a scene file.
#[derive(Debug)]
pub struct Composed {
    /// Its objects and lights; every splat can be drawn.
    pub scene: Scene,
    /// The parts of its camera: [`CameraParts::camera`] makes one for [`Scene::ball`].
    pub camera: CameraParts,
    /// What it says of the picture: [`PictureDescription::over`] gives the settings.
    pub picture: PictureDescription,
    /// The reports of what was done, one an object of the file.
    pub reports: Vec<InputReport>,
}

/// Loads a scene file and all that it names.
///
/// # Errors
/// As [`load_scene_file`] and [`build`].
pub fn compose(path: &Path, options: &LoadOptions, progress: &dyn Progress) -> Result<Composed> {
    let file = load_scene_file(path, options)?;
    let (scene, reports) = build(&file.objects, file.lights, options, progress, &mut |_| {})?;
    Ok(Composed { scene, camera: file.camera.unwrap_or_default(), picture: file.picture, reports })
}

/// Makes all objects and puts them into a scene; tells of each when it is made. With it what was done, one an object.
///
/// # Errors
/// As [`check_memory`] and [`make`].
pub fn build(
    objects: &[ObjectDescription],
    lights: Vec<Light>,
    options: &LoadOptions,
    progress: &dyn Progress,
    tell: &mut dyn FnMut(&BuiltObject),
) -> Result<(Scene, Vec<InputReport>)> {
    check_memory(objects)?;
    let mut scene = Scene { lights, ..Scene::default() };
    let mut reports = Vec::new();
    for object in objects {
        let built = make(object, options, progress)?;
        tell(&built);
        reports.push(built.report);
        if built.splats.is_some() {
            scene.epsilons.push(object.epsilon);
        }
        scene.objects.extend(built.splats);
        scene.meshes.extend(built.triangles);
    }
    Ok((scene, reports))
}

#[cfg(test)]
mod tests;
