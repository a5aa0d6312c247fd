//! The splats of a model: those of its file, at its vertices, spread over it, or few that are cut at its edges.

use std::path::Path;

use glam::DVec3;
use surfel::{
    Error, ErrorKind, Progress as _, Result,
    compose::{make, sharpened},
    geometry::{Fitness, REPEATED, Suited, drop_repeated, sharp::SharpOptions, up_of_shape},
    load::{Model, ObjectDescription, Representation, file_name, load},
    notes::{Deed, Note},
    report::InputReport,
    scene::{Mesh, Object, Scene},
};

use super::{ConvertArguments, is_hierarchy};
use crate::{
    console::Bars,
    scene::{not_a_mesh, refuse_losses, resample_mesh},
};

/// Splats, and what was done.
pub struct Made {
    pub object: Object,
    pub report: InputReport,
    /// The direction that is up, where the file tells it, or else its shape.
    pub up: Option<DVec3>,
    /// What shows the model better, where these splats show it badly; goes on from what was written.
    pub hint: String,
}

/// The splats that the arguments ask for.
///
/// # Errors
/// Of the file; a mesh that has none of these splats; with `--strict`, what is not in them as the file says it.
pub fn made(arguments: &ConvertArguments, bars: &Bars) -> Result<Made> {
    let made = match arguments.resample {
        Some(count) => resampled(arguments, count, bars),
        None if arguments.splats.is_some() || arguments.max_error.is_some() => sharp(arguments, bars),
        None => usual(arguments, bars),
    }?;
    if arguments.reading.strict {
        refuse_losses(&made.report)?;
    }
    Ok(with_up(made))
}

fn with_up(made: Made) -> Made {
    let Made { object, report, up, hint } = made;
    let mut scene = Scene::from(object);
    let up = up.or_else(|| up_of_shape(&scene).map(|found| found.direction));
    let object = scene.objects.swap_remove(0);
    Made { object, report, up, hint }
}

/// Those of the file, of points, or at the vertices of a mesh; without those that can't be drawn.
fn usual(arguments: &ConvertArguments, bars: &Bars) -> Result<Made> {
    let path = &arguments.input;
    let representation = Representation::Splats;
    let object = ObjectDescription { representation, ..ObjectDescription::of_file(path) };
    let built = make(&object, &arguments.reading.options(), bars);
    bars.clear();
    let built = built?;
    let object = built.splats.ok_or_else(|| Error::input(path, "", "has no splat"))?;
    let triangles = built.report.triangles.unwrap_or(0);
    let hint = built.fitness.map(|fitness| hint(&fitness, triangles, &arguments.output)).unwrap_or_default();
    Ok(Made { object, report: built.report, up: built.up, hint })
}

/// What shows a mesh of so many triangles better than splats at its vertices, in a file of this name.
fn hint(fitness: &Fitness, triangles: usize, output: &Path) -> String {
    match fitness.suited() {
        Suited::VertexDisks => String::new(),
        Suited::SpreadDisks(count) => {
            format!("; too uneven for one at each vertex ({fitness}): --resample {count} spreads them evenly")
        }
        // Levels of detail have no clip curves.
        Suited::Triangles if is_hierarchy(output) => {
            let count = fitness.spread_disks();
            format!("; they stick out at its edges ({fitness}): --resample {count} makes small ones")
        }
        Suited::Triangles => {
            format!("; they stick out at its edges ({fitness}): --splats {triangles} makes sharp ones")
        }
    }
}

/// Spread evenly over the mesh in the file.
fn resampled(arguments: &ConvertArguments, count: u64, bars: &Bars) -> Result<Made> {
    let path = &arguments.input;
    let Opened { mut mesh, mut notes, up } = open(arguments, bars)?;
    let repeated = Note::of(Deed::Dropped, drop_repeated(&mut mesh.triangles), REPEATED);
    tell(path, repeated.iter(), bars);
    notes.extend(repeated);
    let (object, mut report) = resample_mesh(&mesh, path, count, arguments.seed, bars)?;
    report.notes = [notes, report.notes].concat();
    Ok(Made { object, report, up, hint: String::new() })
}

/// Of the mesh in the file, simplified, clipped at its ridges.
fn sharp(arguments: &ConvertArguments, bars: &Bars) -> Result<Made> {
    let path = &arguments.input;
    let Opened { mesh, notes, up } = open(arguments, bars)?;
    let options =
        SharpOptions { splats: arguments.splats, max_error: arguments.max_error, ..SharpOptions::default() };
    let made = sharpened(&mesh, file_name(path), &options, bars);
    let (object, mut report) = made.map_err(|error| match error.kind() {
        // The library knows no file.
        ErrorKind::Input { place, problem, .. } => Error::input(path, place, problem),
        _ => error,
    })?;
    report.notes = [notes, report.notes].concat();
    Ok(Made { object, report, up, hint: String::new() })
}

struct Opened {
    mesh: Mesh,
    notes: Vec<Note>,
    up: Option<DVec3>,
}

/// The mesh in the file; what was done with it is told.
fn open(arguments: &ConvertArguments, bars: &Bars) -> Result<Opened> {
    let path = &arguments.input;
    let loaded = load(path, &arguments.reading.options(), bars)?;
    tell(path, loaded.notes.iter(), bars);
    match loaded.model {
        Model::Mesh(mesh) => Ok(Opened { mesh, notes: loaded.notes, up: loaded.up }),
        other => {
            let purpose = match arguments.resample {
                Some(_) => "to take samples of its triangles",
                None => "to simplify its triangles",
            };
            Err(not_a_mesh(path, &other, purpose))
        }
    }
}

fn tell<'n>(path: &Path, notes: impl Iterator<Item = &'n Note>, bars: &Bars) {
    notes.for_each(|note| bars.note(&format!("{}: {note}", path.display())));
}
