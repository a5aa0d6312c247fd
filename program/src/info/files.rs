//! What is in files, and what is made of it.

use std::fmt::Write as _;

use glam::DVec3;
use serde::Serialize;
use surfel::{
    Error, Result,
    geometry::{mean_edge, mean_spacing},
    levels_file::LevelsFile,
    load::{PointOctree, file_name},
    notes::counted,
    report::{CameraReport, InputReport, ModelReport},
    scene::{Bounds, MeshObject, Object, Settings, Splats},
};

use super::{numbers::number, octree::Octree};
use crate::{
    camera::{CameraArguments, CameraChoice},
    console::Bars,
    hierarchies::load_scene_by_view,
    inputs::Inputs,
    origin,
    scene::Loaded,
    up::Up,
};

/// The bytes of most splats on a device, and those of one in a scene that is too extended for these.
const DEVICE_BYTES: [u64; 2] = [32, 48];

/// The answer. Lengths are in the files' own unit.
#[derive(Serialize)]
pub struct FileInfo {
    surfel: &'static str,
    /// One an object: what its file holds, and what was done with it.
    inputs: Vec<InputReport>,
    /// What is drawn, one a part.
    drawn: Vec<Part>,
    scene: Whole,
    /// Which direction is up, and what tells it; `None` where nothing does and +y is taken.
    up: Option<([f64; 3], String)>,
    /// The camera that would be taken for a square picture.
    camera: CameraReport,
}

/// Splats or triangles that are drawn as one.
#[derive(Serialize)]
struct Part {
    name: String,
    /// `splats` or `triangles`.
    kind: &'static str,
    count: usize,
    /// The surface is closed, so that what faces away need not be drawn.
    closed: bool,
    /// The mean distance of a splat from the nearest other, or the mean length of a triangle's side.
    spacing: Option<f64>,
    /// Of splats: the smallest radius, the median and the largest.
    radii: Option<[f64; 3]>,
    /// Of a file that has levels of detail; their splats are in no memory yet.
    #[serde(skip_serializing_if = "Option::is_none")]
    levels: Option<Levels>,
    /// Of an octree of points, which are in no memory yet.
    #[serde(skip_serializing_if = "Option::is_none")]
    octree: Option<Octree>,
}

/// What a file has of levels of detail.
#[derive(Serialize)]
struct Levels {
    /// Splats that stand for others.
    nodes: u64,
    pages: u32,
    /// Of the whole file.
    bytes: u64,
}

/// All of it together.
#[derive(Serialize)]
struct Whole {
    min: [f64; 3],
    max: [f64; 3],
    extent: [f64; 3],
    /// About the point that is the origin on a device, where coordinates are so large that this matters.
    origin_shift: Option<[f64; 3]>,
    splats: usize,
    triangles: usize,
    /// Bytes of memory here.
    host_bytes: u64,
    /// Bytes of splats on a device, least and most.
    device_bytes: [u64; 2],
}

/// Loads files as `surfel render` does, and tells what came of it.
///
/// # Errors
/// As [`load_scene`]; a camera without a picture.
pub fn gather(inputs: &Inputs, camera: &CameraArguments) -> Result<FileInfo> {
    let choice = CameraChoice::of(camera)?;
    let bars = Bars::new();
    let mut loaded = load_scene_by_view(inputs, &bars)?;
    for file in &mut loaded.hierarchies {
        file.check(&bars)?;
    }
    let found = choice.camera(&loaded, Settings::default().size_px)?;
    for octree in &mut loaded.octrees.files {
        octree.choose(&|_| true)?;
    }
    let Loaded { scene, up, inputs, hierarchies, octrees, .. } = loaded;
    let of_octrees = octrees.files.iter().map(PointOctree::bounds);
    let of_files = hierarchies.iter().map(LevelsFile::bounds).chain(of_octrees);
    let bounds = of_files.chain(scene.bounds()).reduce(Bounds::union);
    let bounds = bounds.ok_or_else(|| Error::input("scene", "", "has nothing to draw"))?;
    let splats = scene.splat_count();
    let host_bytes = scene.objects.iter().map(|object| object.splats.bytes()).sum();
    let parts = scene
        .objects
        .iter()
        .map(splat_part)
        .chain(scene.meshes.iter().map(mesh_part))
        .chain(hierarchies.iter().map(hierarchy_part))
        .chain(octrees.files.iter().map(octree_part));
    Ok(FileInfo {
        surfel: env!("CARGO_PKG_VERSION"),
        inputs,
        drawn: parts.collect(),
        scene: Whole {
            min: bounds.min.into(),
            max: bounds.max.into(),
            extent: (bounds.max - bounds.min).into(),
            origin_shift: origin::shift(&scene, bounds.radius()).map(DVec3::into),
            splats,
            triangles: scene.meshes.iter().map(|object| object.mesh.triangles.len()).sum(),
            host_bytes,
            device_bytes: DEVICE_BYTES.map(|bytes| bytes * splats as u64),
        },
        up: match camera.up {
            Some(Up::Given(direction)) => Some((direction, "--up says so".to_owned())),
            Some(Up::Auto) | None => up.map(|up| (up.direction.into(), up.because)),
        },
        camera: (&found).into(),
    })
}

fn splat_part(object: &Object) -> Part {
    let Object { name, splats, closed } = object;
    Part {
        name: name.clone(),
        kind: "splats",
        count: splats.len(),
        closed: *closed,
        spacing: mean_spacing(&splats.positions),
        radii: radii(splats),
        levels: None,
        octree: None,
    }
}

fn hierarchy_part(file: &LevelsFile) -> Part {
    let header = file.header();
    Part {
        name: file.name().to_owned(),
        kind: "splats",
        count: usize::try_from(header.splats).unwrap_or(usize::MAX),
        closed: header.closed,
        spacing: None,
        radii: None,
        levels: Some(Levels { nodes: header.nodes, pages: header.pages, bytes: header.file_bytes() }),
        octree: None,
    }
}

fn octree_part(octree: &PointOctree) -> Part {
    let octree_info = Octree::of(octree);
    Part {
        name: file_name(octree.path()),
        kind: "points",
        count: octree_info.points(),
        closed: false,
        spacing: None,
        radii: None,
        levels: None,
        octree: Some(octree_info),
    }
}

fn mesh_part(object: &MeshObject) -> Part {
    let MeshObject { name, mesh, closed } = object;
    Part {
        name: name.clone(),
        kind: "triangles",
        count: mesh.triangles.len(),
        closed: *closed,
        spacing: mean_edge(mesh),
        radii: None,
        levels: None,
        octree: None,
    }
}

fn radii(splats: &Splats) -> Option<[f64; 3]> {
    let mut radii: Vec<f64> = (0..splats.len()).map(|i| splats.major_radius(i)).collect();
    radii.sort_unstable_by(f64::total_cmp);
    Some([*radii.first()?, *radii.get(radii.len() / 2)?, *radii.last()?])
}

/// For people.
pub fn text(info: &FileInfo) -> String {
    let mut text = String::new();
    // Writing to a string can't fail, here and below.
    for input in &info.inputs {
        let _ = writeln!(text, "{}", input.name);
        let holds = input.model.as_ref().map(model_rows).unwrap_or_default();
        let because = Some(("because", input.because.clone())).filter(|(_, because)| !because.is_empty());
        let drawn = [("drawn as", input.drawn_as.to_owned())].into_iter().chain(because);
        let notes = input.notes.iter().map(|note| ("note", note.to_string()));
        write_rows(&mut text, holds.into_iter().chain(notes).chain(drawn));
    }
    for part in &info.drawn {
        let _ = writeln!(text, "\ndrawn: {} of {}", counted(part.count as u64, part.kind), part.name);
        write_rows(&mut text, part_rows(part));
    }
    let Whole { min, max, extent, splats, host_bytes, device_bytes: [least, most], .. } = &info.scene;
    let _ = writeln!(text, "\nthe whole");
    let up = match &info.up {
        Some((up, because)) => format!("{}, because {because}", point(up)),
        None => format!("{}, as nothing says otherwise", point(&info.camera.up)),
    };
    let CameraReport { eye, target, .. } = &info.camera;
    let projection = match (info.camera.fov_deg, info.camera.orthographic) {
        (_, Some(height)) => format!("--orthographic {}", number(height)),
        (fov_deg, None) => format!("--fov {}", number(fov_deg.unwrap_or_default())),
    };
    let mut rows = vec![
        ("from", point(min)),
        ("to", point(max)),
        ("extent", extent.map(number).join(" x ")),
        ("up", up),
        ("camera", format!("--eye {} --target {} {projection}", point(eye), point(target))),
    ];
    if let Some(origin) = &info.scene.origin_shift {
        rows.push(("origin", format!("moved to {} on a device, as its numbers have 32 bits", point(origin))));
    }
    if *splats > 0 {
        rows.push(("memory", format!("{host_bytes} bytes here, {least} to {most} on a device")));
    }
    write_rows(&mut text, rows);
    text
}

fn write_rows(text: &mut String, rows: impl IntoIterator<Item = (&'static str, String)>) {
    for (name, value) in rows {
        let _ = writeln!(text, "  {name:9} {value}");
    }
}

fn model_rows(model: &ModelReport) -> Vec<(&'static str, String)> {
    let counts = match model.triangles {
        Some(triangles) => {
            format!(
                "{}, {}",
                counted(model.points as u64, "vertices"),
                counted(triangles as u64, "triangles")
            )
        }
        None => counted(model.points as u64, model.holds),
    };
    let with = [(model.normals, "normals"), (model.colors, "colors"), (model.sizes, "sizes")];
    let list = |there: bool| {
        let names: Vec<&str> = with.iter().filter(|(has, _)| *has == there).map(|(_, name)| *name).collect();
        if names.is_empty() { "nothing else".to_owned() } else { names.join(", ") }
    };
    let mut rows = vec![("format", model.format.clone()), ("holds", counts), ("with", list(true))];
    if let Some([least, most]) = &model.bounds {
        rows.push(("within", format!("{} to {}", point(least), point(most))));
    }
    rows.extend(model.metres_per_unit.map(|metres| ("unit", format!("{} m", number(metres)))));
    rows.extend(model.up.map(|up| ("up", point(&up))));
    rows
}

fn part_rows(part: &Part) -> Vec<(&'static str, String)> {
    let mut rows = vec![("surface", if part.closed { "closed" } else { "open" }.to_owned())];
    let of = if part.kind == "splats" { "to the nearest, in the mean" } else { "a side, in the mean" };
    rows.extend(part.levels.as_ref().map(|levels| {
        let Levels { nodes, pages, bytes } = levels;
        ("levels", format!("{nodes} nodes; {pages} pages, all of them sound; {bytes} bytes"))
    }));
    rows.extend(part.octree.iter().flat_map(Octree::rows));
    rows.extend(part.spacing.map(|spacing| ("spacing", format!("{} {of}", number(spacing)))));
    rows.extend(part.radii.map(|[least, median, most]| {
        let [least, median, most] = [least, median, most].map(number);
        ("radii", format!("{least} to {most}, median {median}"))
    }));
    rows
}

/// A point as options take it.
fn point(at: &[f64; 3]) -> String {
    at.map(number).join(",")
}
