//! From the inputs on the command line to a scene.

use std::path::{Path, PathBuf};

use surfel::{
    Error, Result,
    geometry::{DEFAULT_OVERLAP, MeshReport, splats_from_mesh},
    load::{Model, builtin, load},
    report::InputReport,
    scene::{Ball, Mesh, Object, Scene, Shapes, Splats},
};

use crate::{
    console::{self, Bars},
    steps::Steps,
};

/// A scene with its extent and where it came from.
pub struct Loaded {
    /// The scene; every splat of it can be drawn.
    pub scene: Scene,
    /// A ball around all disks.
    pub ball: Ball,
    /// One an object.
    pub inputs: Vec<InputReport>,
}

/// Loads all inputs, or the built-in model where there is none, and tells in a line each what was done with it.
///
/// # Errors
/// As [`load`]; an input without any splat that can be drawn.
pub fn load_scene(inputs: &[PathBuf], bars: &Bars, steps: &mut Steps) -> Result<Loaded> {
    let mut scene = Scene::default();
    let mut reports = Vec::new();
    let mut take = |(object, report): (Object, InputReport)| {
        console::say(&report.summary);
        scene.objects.push(object);
        reports.push(report);
    };
    if inputs.is_empty() {
        let object =
            steps.time("make the built-in model", || builtin::relief(builtin::DEFAULT_RELIEF_SPLATS));
        take(finish(object, String::new(), None));
    }
    for path in inputs {
        let loaded = load_object(path, bars, steps);
        bars.clear();
        take(loaded?);
    }
    let ball = scene.ball().ok_or_else(|| Error::input("scene", "", "has no splat"))?;
    Ok(Loaded { scene, ball, inputs: reports })
}

/// The splats of one input, without those that can't be drawn.
///
/// # Errors
/// As [`load_scene`].
pub fn load_object(path: &Path, bars: &Bars, steps: &mut Steps) -> Result<(Object, InputReport)> {
    let name = path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned();
    let model = steps.time(format!("read {name}"), || load(path, bars))?;
    let (object, report) = match model {
        Model::Splats { splats, closed } => finish(Object { name, splats, closed }, String::new(), None),
        Model::Mesh(mesh) => {
            let step = format!("normals and radii of {name}");
            let (splats, report) = steps.time(step, || splats_from_mesh(&mesh, DEFAULT_OVERLAP, bars));
            let done = format!("; {}", computed(&report, splats.len()));
            let counts = [mesh.positions.len(), mesh.triangles.len()];
            let head = mesh_head(&mesh, &report);
            finish(Object { name, splats, closed: report.closed }, head + &done, Some(counts))
        }
    };
    match report.splats {
        0 => Err(Error::input(path, "", format!("no splat can be drawn ({})", report.summary))),
        _ => Ok((object, report)),
    }
}

/// Drops what can't be drawn and puts it all in words. `head` is what a mesh was, empty for splats.
pub fn finish(mut object: Object, head: String, mesh: Option<[usize; 2]>) -> (Object, InputReport) {
    let defects = object.splats.drop_defective();
    let mut summary = match head.is_empty() {
        true => format!("{}: {}", object.name, splats_head(&object)),
        false => format!("{}: {head}", object.name),
    };
    if defects.total() > 0 {
        summary += &format!("; {} splats left out: {defects}", defects.total());
    }
    let report = InputReport {
        name: object.name.clone(),
        vertices: mesh.map(|[vertices, _]| vertices),
        triangles: mesh.map(|[_, triangles]| triangles),
        splats: object.splats.len(),
        dropped: defects.total(),
        summary,
    };
    (object, report)
}

/// A file of splats in words.
fn splats_head(object: &Object) -> String {
    let closed = if object.closed { ", closed" } else { "" };
    format!("{} {}{closed}", object.splats.len(), kind(&object.splats))
}

/// What splats are, in the plural.
pub fn kind(splats: &Splats) -> &'static str {
    match splats.shapes {
        Shapes::Disks { .. } => "disks",
        Shapes::Ellipses { .. } => "ellipses",
    }
}

/// A mesh in words.
pub fn mesh_head(mesh: &Mesh, report: &MeshReport) -> String {
    format!("{} vertices, {} triangles: {report}", mesh.positions.len(), mesh.triangles.len())
}

/// What was missing in the file.
fn computed(report: &MeshReport, splats: usize) -> String {
    match report.normals_from_file {
        0 => "normals and radii computed".to_owned(),
        n if n >= splats => "radii computed".to_owned(),
        n => format!("{} normals and all radii computed", splats - n),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    fn load_text(name: &str, text: &str) -> std::result::Result<InputReport, String> {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join(name);
        fs::write(&path, text).unwrap();
        let loaded = load_scene(&[path], &Bars::new(), &mut Steps::default());
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
