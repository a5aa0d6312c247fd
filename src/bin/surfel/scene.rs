//! The scene of the inputs on the command line.

use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use surfel::{
    Error, ErrorKind, Progress as _, Result,
    compose::{build, make, resampled},
    load::{
        BuiltIn, Model, ObjectDescription, Representation, Samples, file_name, is_scene_file, load_scene_file,
    },
    prepare::PreparedScene,
    renderer::Headless,
    report::{InputReport, Step},
    scene::{Ball, CameraParts, Light, Mesh, Object, Scene},
};

use crate::console::{self, Bars};

/// The manual of inputs.
pub const INPUTS: &str = "Inputs are PLY files (splats, meshes or points), OBJ files (meshes or points), and scene files (.toml: objects, each \
with its place and looks, lights and a camera; `surfel render --help` has their keys); a mesh becomes disks at its \
vertices, points become disks that close their surface, with normals from their neighbors. Several inputs are one scene; none is the built-in model. Lengths are in the files' own unit; +y is up unless \
--up says otherwise. The camera looks along -z at the whole scene unless told otherwise.";

/// The inputs.
#[derive(Args)]
pub struct InputArguments {
    /// PLY, OBJ or scene files (.toml); none is the built-in model
    #[arg(value_name = "INPUT")]
    pub inputs: Vec<PathBuf>,

    /// The primitives of inputs that are no scene files
    #[arg(long, value_name = "WHAT", default_value = "splats")]
    representation: Primitives,
}

/// The primitives of an input.
#[derive(Clone, Copy, ValueEnum)]
enum Primitives {
    /// Splats; a mesh with a disk at each vertex
    Splats,
    /// The triangles of a mesh
    Mesh,
}

impl InputArguments {
    /// The primitives of inputs that are no scene files.
    pub fn representation(&self) -> Representation {
        match self.representation {
            Primitives::Splats => Representation::Splats,
            Primitives::Mesh => Representation::Mesh,
        }
    }
}

/// A scene with its extent and where it came from.
pub struct Loaded {
    /// The scene; every splat of it can be drawn.
    pub scene: Scene,
    /// A ball around all disks and triangles.
    pub ball: Ball,
    /// The scene file that has a camera, and that camera.
    pub camera: Option<(PathBuf, CameraParts)>,
    /// One an object.
    pub inputs: Vec<InputReport>,
    /// The steps of loading.
    pub steps: Vec<Step>,
}

/// Loads all inputs, or the built-in model where there is none, and tells in a line each what was done with it. Meshes are
/// drawn as `meshes` says, but for those of scene files, which say it themselves.
///
/// # Errors
/// As [`load_scene_file`] and [`build`]; two scene files that both have a camera.
pub fn load_scene(inputs: &[PathBuf], meshes: Representation, bars: &Bars) -> Result<Loaded> {
    let Described { objects, lights, camera } = describe(inputs, meshes)?;
    let mut steps = Vec::new();
    let built = build(&objects, lights, bars, &mut |object| {
        bars.clear();
        steps.extend(object.steps.iter().cloned());
        console::say(&object.report.summary);
    });
    bars.clear();
    let (scene, inputs) = built?;
    let ball = scene.ball().ok_or_else(|| Error::input("scene", "", "has nothing to draw"))?;
    Ok(Loaded { scene, ball, camera, inputs, steps })
}

/// Brings a scene to the device.
pub fn upload(headless: &Headless, scene: &Scene, bars: &Bars) -> Result<PreparedScene> {
    let prepared = headless.prepare(scene, &|done, total| bars.step("upload", done, total));
    bars.clear();
    prepared
}

/// The splats of one input that is no scene file, without those that can't be drawn.
pub fn load_object(path: &Path, bars: &Bars) -> Result<(Object, InputReport)> {
    let built = make(&ObjectDescription::of_file(path), bars);
    bars.clear();
    let built = built?;
    let splats = built.splats.ok_or_else(|| Error::input(path, "", "has no splat"))?;
    Ok((splats, built.report))
}

/// Why a file of splats or points can't be resampled.
pub fn not_a_mesh(path: &Path, model: &Model) -> Error {
    let contents = model.contents();
    let problem = format!("the file holds {contents}; expected a mesh, to take samples of its triangles");
    Error::input(path, "", problem)
}

/// Splats spread evenly over the mesh of the file at `path`.
pub fn resample_mesh(
    mesh: &Mesh,
    path: &Path,
    count: u64,
    seed: u64,
    bars: &Bars,
) -> Result<(Object, InputReport)> {
    resampled(mesh, file_name(path), Samples { count, seed }, bars).map_err(|error| match error.kind() {
        // The library knows no file.
        ErrorKind::Input { problem, .. } => Error::input(path, "", problem),
        _ => error,
    })
}

/// The descriptions in the inputs.
struct Described {
    objects: Vec<ObjectDescription>,
    lights: Vec<Light>,
    camera: Option<(PathBuf, CameraParts)>,
}

fn describe(inputs: &[PathBuf], meshes: Representation) -> Result<Described> {
    let mut described = Described { objects: Vec::new(), lights: Vec::new(), camera: None };
    if inputs.is_empty() {
        if meshes != Representation::Splats {
            let problem = "mesh: the built-in model is made of splats; expected an input";
            return Err(Error::option("--representation", problem));
        }
        described.objects.push(ObjectDescription::of_built_in(BuiltIn::Relief));
    }
    for path in inputs {
        if !is_scene_file(path) {
            let representation = meshes;
            described.objects.push(ObjectDescription { representation, ..ObjectDescription::of_file(path) });
            continue;
        }
        let file = load_scene_file(path)?;
        described.objects.extend(file.objects);
        described.lights.extend(file.lights);
        if let Some(camera) = file.camera {
            if let Some((other, _)) = &described.camera {
                let problem = format!("{} has one too; expected one camera", other.display());
                return Err(Error::input(path, "camera", problem));
            }
            described.camera = Some((file.path, camera));
        }
    }
    Ok(described)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    fn load_text(name: &str, text: &str) -> std::result::Result<InputReport, String> {
        let folder = temp_dir::TempDir::new().unwrap();
        let path = folder.path().join(name);
        fs::write(&path, text).unwrap();
        let loaded = load_scene(&[path], Representation::Splats, &Bars::new());
        loaded.map(|mut loaded| loaded.inputs.remove(0)).map_err(|e| e.to_string())
    }

    #[test]
    fn what_was_done_with_a_mesh_is_told() {
        let triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
        let report = load_text("a.obj", triangle).unwrap();
        let expected = "a.obj: 3 vertices, 1 triangles: open, 3 boundary edges; normals and radii computed";
        assert_eq!(report.summary, expected);
        assert_eq!((report.vertices, report.triangles, report.splats), (Some(3), Some(1), 3));
        let with_normals = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nf 1//1 2//1 3//1\n";
        assert!(load_text("a.obj", with_normals).unwrap().summary.ends_with("; radii computed"));
    }

    const SPLATS: &str = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty \
        float z\nproperty float nx\nproperty float ny\nproperty float nz\nproperty float radius\nend_header\n";

    #[test]
    fn splats_that_cannot_be_drawn_are_counted_once() {
        let report =
            load_text("a.ply", &format!("{SPLATS}0 0 0 0 0 1 1\n1 0 0 0 0 1 0\n2 0 0 0 0 0 1\n")).unwrap();
        let expected = "a.ply: 1 disks; 2 splats left out: 1 normal zero or not finite, 1 radius not \
            above zero or not finite";
        assert_eq!(report.summary, expected);
        assert_eq!((report.splats, report.dropped), (1, 2));
        let none = load_text("a.ply", &format!("{SPLATS}0 0 0 0 0 1 0\n1 0 0 0 0 1 0\n2 0 0 0 0 0 1\n"));
        assert!(
            none.unwrap_err().contains("a.ply: no splat can be drawn (a.ply: 0 disks; 3 splats left out: ")
        );
    }
}
