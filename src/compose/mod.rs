//! From descriptions of objects to a scene: models are loaded, placed, colored, and become splats or triangles that can
//! be drawn; with a sentence on each that says what was done.
//!
//! Meshes are placed before they become splats, so that the splats are round and leave no hole where they are drawn.

mod beyond;
mod facts;
mod from_mesh;
mod from_points;
mod hybrid;
mod levels;
mod memory;
mod object;
mod parts;
mod sharp;
mod words;

use std::path::Path;

pub use from_mesh::resampled;
pub use levels::{is_in_levels, open_levels};
pub use memory::check_memory;
pub use object::{BuiltObject, make, make_loaded, make_model, refuse_triangles};
pub use sharp::sharpened;
pub use words::{finish, splats_kind};

use crate::{
    error::{Error, Result},
    load::{LoadOptions, ObjectDescription, PictureDescription, load_scene_file},
    progress::Progress,
    report::InputReport,
    scene::{Ball, CameraParts, HybridLevels, Light, Scene},
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
/// As [`load_scene_file`] and [`build`]; a camera that looks at an object that is not there.
pub fn compose(path: &Path, options: &LoadOptions, progress: &dyn Progress) -> Result<Composed> {
    let file = load_scene_file(path, options)?;
    let (scene, reports) = build(&file.objects, file.lights, options, progress, &mut |_| {})?;
    let mut camera = file.camera.unwrap_or_default();
    if let Some(name) = &file.camera_target {
        camera.subject = Some(ball_of_target(&scene, name, path)?);
    }
    Ok(Composed { scene, camera, picture: file.picture, reports })
}

/// A ball around the object that the camera of a scene file looks at.
///
/// # Errors
/// [`crate::ErrorKind::Input`] where no object has this name.
pub fn ball_of_target(scene: &Scene, name: &str, scene_file: &Path) -> Result<Ball> {
    scene.ball_named(name).ok_or_else(|| {
        let problem = format!("no object is called '{name}'; expected the name of one, or three numbers");
        Error::input(scene_file, "camera, target", problem)
    })
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
        let levels = built.levels.map(|levels| HybridLevels { mesh: scene.meshes.len(), ..levels });
        scene.hybrids.extend(levels);
        scene.meshes.extend(built.triangles);
    }
    Ok((scene, reports))
}

#[cfg(test)]
mod tests;
