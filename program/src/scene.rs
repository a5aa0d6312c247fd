//! The scene of the inputs on the command line.

use std::path::{Path, PathBuf};

use glam::DVec3;
use surfel::{
    Error, ErrorKind, Progress as _, Result,
    compose::{build, resampled},
    geometry::{FoundUp, up_of_shape},
    levels_file::LevelsFile,
    load::{Model, PictureDescription, Samples, Source, file_name},
    prepare::PreparedScene,
    renderer::Headless,
    report::{InputReport, Step},
    scene::{Ball, Bounds, CameraParts, Mesh, Object, Scene},
};

use crate::{
    console::{Bars, Repeated},
    described::{Described, describe},
    inputs::Inputs,
    octrees::Octrees,
    oddities, up,
};

/// A scene with its extent and where it came from.
pub struct Loaded {
    /// The scene; every splat of it can be drawn.
    pub scene: Scene,
    /// A ball around all disks and triangles.
    pub ball: Ball,
    /// The scene file that has a camera, and that camera.
    pub camera: Option<(PathBuf, CameraParts)>,
    /// What scene files say of the picture.
    pub picture: PictureDescription,
    /// The direction that is up, where a file or the scene's shape tells it.
    pub up: Option<FoundUp>,
    /// One an object.
    pub inputs: Vec<InputReport>,
    /// The steps of loading.
    pub steps: Vec<Step>,
    /// Files of which a view reads what it needs; they are in none of the above but ball, up and inputs.
    pub hierarchies: Vec<LevelsFile>,
    /// The same of points.
    pub octrees: Octrees,
}

impl Loaded {
    /// Whether each view reads something of its own.
    pub fn is_read_by_view(&self) -> bool {
        !self.hierarchies.is_empty() || !self.octrees.files.is_empty()
    }

    /// The extent of the whole along x, y and z.
    pub fn extent(&self) -> DVec3 {
        let of_files = self.hierarchies.iter().map(LevelsFile::bounds);
        let of_octrees = self.octrees.files.iter().map(|file| file.bounds());
        let all = self.scene.bounds().into_iter().chain(of_files).chain(of_octrees);
        all.reduce(Bounds::union).map_or(DVec3::ZERO, |bounds| bounds.max - bounds.min)
    }
}

/// Loads all inputs, or the built-in model where there is none, and tells in a line each what was done with it. Meshes are
/// drawn as `inputs` says, but for those of scene files, which say it themselves.
///
/// # Errors
/// As [`describe`] and [`load_described`].
pub fn load_scene(inputs: &Inputs, bars: &Bars) -> Result<Loaded> {
    bars.held(|| load_described(describe(inputs, bars)?, Vec::new(), inputs, bars))
}

/// Loads what is described, beside files that views read, of which something is told elsewhere.
///
/// # Errors
/// As [`build`]; a camera that looks at an object that is not there; with `strict`, anything that is not drawn as its file says it.
pub fn load_described(
    described: Described,
    hierarchies: Vec<LevelsFile>,
    inputs: &Inputs,
    bars: &Bars,
) -> Result<Loaded> {
    let Described { objects, lights, camera, picture: (_, picture) } = described;
    let mut steps = Vec::new();
    let mut ups = Vec::new();
    let mut lines = Repeated::default();
    let built = build(&objects, lights, &inputs.options, bars, &mut |object| {
        bars.clear();
        steps.extend(object.steps.iter().cloned());
        ups.extend(object.up.map(|up| (up, object.report.name.clone())));
        lines.say(&object.report.summary, bars);
    });
    bars.clear();
    lines.end(bars);
    let (scene, reports) = built?;
    if inputs.strict {
        reports.iter().try_for_each(refuse_losses)?;
    }
    let seen = scene.ball().map(|whole| oddities::seen(&scene, &whole, bars));
    let ball = seen.into_iter().chain(hierarchies.iter().map(LevelsFile::ball)).reduce(Ball::union);
    let ball = ball.ok_or_else(|| Error::input("scene", "", "has nothing to draw"))?;
    let is_of_files = objects.iter().any(|object| matches!(object.source, Source::File(_)));
    let up = up::of(ups, bars).or_else(|| is_of_files.then(|| up_of_shape(&scene)).flatten());
    let camera = camera.map(|camera| camera.of(&scene, &hierarchies)).transpose()?;
    let octrees = Octrees::default();
    Ok(Loaded { scene, ball, camera, picture, up, inputs: reports, steps, hierarchies, octrees })
}

/// Refuses what is not drawn as its file says it.
///
/// # Errors
/// [`ErrorKind::Input`] with the first of it.
pub fn refuse_losses(report: &InputReport) -> Result<()> {
    let losses: Vec<_> = report.notes.iter().filter(|note| note.deed.is_loss()).collect();
    let Some(first) = losses.first() else { return Ok(()) };
    let others = match losses.len() - 1 {
        0 => String::new(),
        others => format!(", and {others} more of that kind"),
    };
    let problem = format!("{first}{others}; expected nothing of it with --strict");
    Err(Error::input(&report.name, "", problem))
}

/// Brings a scene to the device.
pub fn upload(headless: &Headless, scene: &Scene, bars: &Bars) -> Result<PreparedScene> {
    let prepared = headless.prepare(scene, &|done, total| bars.step("upload", done, total));
    bars.clear();
    prepared
}

/// Why nothing is made of a file of splats or points that is made of meshes, and what it would be made for.
pub fn not_a_mesh(path: &Path, model: &Model, purpose: &str) -> Error {
    let contents = model.contents();
    let problem = format!("the file holds {contents}; expected a mesh, {purpose}");
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

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    fn load_text(name: &str, text: &str) -> std::result::Result<InputReport, String> {
        let folder = temp_dir::TempDir::new().unwrap();
        let path = folder.path().join(name);
        fs::write(&path, text).unwrap();
        let loaded = load_scene(&Inputs::splats_of(vec![path]), &Bars::new());
        loaded.map(|mut loaded| loaded.inputs.remove(0)).map_err(|e| e.to_string())
    }

    #[test]
    fn what_was_done_with_a_mesh_is_told() {
        let triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
        let report = load_text("a.obj", triangle).unwrap();
        let expected = "a.obj: 3 vertices, 1 triangle: open, 3 boundary edges; normals and radii computed";
        assert_eq!(report.summary, expected);
        assert_eq!((report.vertices, report.triangles, report.splats), (Some(3), Some(1), 3));
        let with_normals = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nf 1//1 2//1 3//1\n";
        assert!(load_text("a.obj", with_normals).unwrap().summary.ends_with("; radii computed"));
    }

    #[test]
    fn a_file_that_is_missing_is_told_before_another_is_read() {
        let folder = temp_dir::TempDir::new().unwrap();
        let [broken, none] = ["broken.ply", "none.ply"].map(|name| folder.path().join(name));
        fs::write(&broken, "ply\n").unwrap();
        let told = |files: &[&PathBuf]| {
            let files = files.iter().map(|path| (*path).clone()).collect();
            load_scene(&Inputs::splats_of(files), &Bars::new()).err().unwrap().to_string()
        };
        assert_eq!(told(&[&broken, &none]), told(&[&none]));
        assert_ne!(told(&[&broken, &none]), told(&[&broken]));
    }

    const SPLATS: &str = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty \
        float z\nproperty float nx\nproperty float ny\nproperty float nz\nproperty float radius\nend_header\n";

    #[test]
    fn splats_that_cannot_be_drawn_are_counted_once() {
        let report =
            load_text("a.ply", &format!("{SPLATS}0 0 0 0 0 1 1\n1 0 0 0 0 1 0\n2 0 0 0 0 0 1\n")).unwrap();
        let expected = "a.ply: 1 disk; 2 splats left out: 1 normal zero or not finite, 1 radius not \
            above zero or not finite";
        assert_eq!(report.summary, expected);
        assert_eq!((report.splats, report.dropped), (1, 2));
        let none = load_text("a.ply", &format!("{SPLATS}0 0 0 0 0 1 0\n1 0 0 0 0 1 0\n2 0 0 0 0 0 1\n"));
        assert!(
            none.unwrap_err().contains("a.ply: no splat can be drawn (a.ply: 0 disks; 3 splats left out: ")
        );
    }
}
