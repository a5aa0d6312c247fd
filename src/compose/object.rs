//! One object: its model loaded or made, placed, colored, and turned into what is drawn.

use glam::DVec3;

use super::{
    beyond, facts, from_mesh, from_points,
    parts::{Parts, StepTimer},
    words::finish_splats,
};
use crate::{
    error::{Error, ErrorKind, Result},
    geometry::Fitness,
    load::{
        BuiltIn, LoadOptions, Loaded, Model, ObjectDescription, Representation, Source,
        builtin::{checkerboard, relief, sphere, sphere_mesh},
        file_name, load,
    },
    notes::Note,
    progress::Progress,
    report::{InputReport, ModelReport, Step},
    scene::{HybridLevels, MeshObject, Object},
};

/// The parts that an object became; at least one of the two has something to draw.
#[derive(Clone, Debug)]
pub struct BuiltObject {
    /// Its splats; each can be drawn.
    pub splats: Option<Object>,
    /// Its triangles.
    pub triangles: Option<MeshObject>,
    /// Levels of detail of these.
    pub levels: Option<HybridLevels>,
    /// The direction that is up in the world, where its file or the file's format tells one; unit.
    pub up: Option<DVec3>,
    /// How well disks at the vertices of a mesh show it, where it has those.
    pub fitness: Option<Fitness>,
    /// All parts in numbers and words.
    pub report: InputReport,
    /// How long each step took.
    pub steps: Vec<Step>,
}

/// Loads or makes a model and makes of it what its description says.
///
/// # Errors
/// As [`load`] and [`crate::geometry::resample`]; [`ErrorKind::Input`] for splats that should be resampled or drawn as
/// triangles, and for a model of which nothing can be drawn.
pub fn make(
    object: &ObjectDescription,
    options: &LoadOptions,
    progress: &dyn Progress,
) -> Result<BuiltObject> {
    let mut work = StepTimer { progress, steps: Vec::new() };
    let opened = open(object, options, &mut work)?;
    make_opened(opened, object, work)
}

/// As [`make`], of an object of whose file this was read.
///
/// # Errors
/// As [`make`], but for those of the file.
pub fn make_loaded(
    loaded: Loaded,
    object: &ObjectDescription,
    progress: &dyn Progress,
) -> Result<BuiltObject> {
    let opened = Opened::of(loaded, name_of(object));
    make_opened(opened, object, StepTimer { progress, steps: Vec::new() })
}

/// As [`make`], of a model that is in memory already. Messages call it as they would call the description's file.
///
/// # Errors
/// As [`make`], but for those of a file.
pub fn make_model(model: Model, object: &ObjectDescription, progress: &dyn Progress) -> Result<BuiltObject> {
    let opened = Opened { model, name: name_of(object), notes: Vec::new(), file: None };
    make_opened(opened, object, StepTimer { progress, steps: Vec::new() })
}

fn make_opened(opened: Opened, object: &ObjectDescription, mut work: StepTimer<'_>) -> Result<BuiltObject> {
    let Opened { mut model, name, mut notes, file } = opened;
    let beyond = beyond::lose(&mut model);
    beyond.iter().for_each(|note| work.progress.note(&format!("{name}: {note}")));
    notes.extend(beyond);
    let up = file.as_ref().and_then(|file| file.up).map(DVec3::from_array);
    let parts = match model {
        Model::Splats { splats, closed } => place_splats(Object { name, splats, closed }, object),
        Model::Points(points) => refuse_triangles(object, "points")
            .and_then(|()| from_points::parts(points, name, object, &mut work)),
        Model::Mesh(mesh) => from_mesh::parts(mesh, name, object, &mut work),
    };
    let Parts { splats, triangles, levels, fitness, mut report } =
        parts.map_err(|error| of_object(error, object))?;
    let nothing =
        report.splats == 0 && triangles.as_ref().is_none_or(|object| object.mesh.triangles.is_empty());
    if nothing {
        let what = if triangles.is_none() { "splat" } else { "triangle" };
        let problem = format!("no {what} can be drawn ({})", report.summary);
        return Err(of_object(Error::input("", "", problem), object));
    }
    report.notes = [notes, report.notes].concat();
    if report.because.is_empty() && file.is_some() {
        report.because = "its file holds splats".to_owned();
    }
    report.model = file;
    let up = up.and_then(|up| object.world_from_object.transform_vector3(up).try_normalize());
    Ok(BuiltObject { splats, triangles, levels, up, fitness, report, steps: work.steps })
}

/// A model as it is before it is placed.
struct Opened {
    model: Model,
    name: String,
    /// What was done with its file.
    notes: Vec<Note>,
    /// What its file holds, where it has one.
    file: Option<ModelReport>,
}

impl Opened {
    fn of(loaded: Loaded, name: String) -> Self {
        let file = Some(facts::of(&loaded));
        Self { model: loaded.model, name, notes: loaded.notes, file }
    }
}

pub(super) fn name_of(object: &ObjectDescription) -> String {
    let own = || match &object.source {
        Source::File(path) => file_name(path),
        Source::BuiltIn { model, .. } => format!("built-in {}", model.name()),
    };
    object.name.clone().unwrap_or_else(own)
}

fn open(object: &ObjectDescription, options: &LoadOptions, work: &mut StepTimer<'_>) -> Result<Opened> {
    let name = name_of(object);
    let model = match &object.source {
        Source::File(path) => {
            let loaded = work.time(format!("read {name}"), |progress| load(path, options, progress))?;
            loaded.notes.iter().for_each(|note| work.progress.note(&format!("{}: {note}", path.display())));
            return Ok(Opened::of(loaded, name));
        }
        Source::BuiltIn { model, splats, triangles } => {
            work.time(format!("make the {name}"), |_| match object.representation {
                Representation::Splats | Representation::Auto => splats_of(*model, *splats),
                // Other models have none, and no scene file asks them for any.
                Representation::Mesh | Representation::Hybrid { .. } => Model::Mesh(sphere_mesh(*triangles)),
            })
        }
    };
    Ok(Opened { model, name, notes: Vec::new(), file: None })
}

fn splats_of(model: BuiltIn, splats: u64) -> Model {
    let count = usize::try_from(splats).unwrap_or(usize::MAX);
    let Object { splats, closed, .. } = match model {
        BuiltIn::Relief => relief(count),
        BuiltIn::Sphere => sphere(count),
        BuiltIn::Checkerboard => checkerboard(count.isqrt().max(1)),
    };
    Model::Splats { splats, closed }
}

/// Refuses what needs triangles for a file of `what`.
///
/// # Errors
/// [`ErrorKind::Input`] for an object that should be drawn as triangles or sampled anew.
pub fn refuse_triangles(object: &ObjectDescription, what: &str) -> Result<()> {
    let purpose = match (object.representation, object.samples) {
        (Representation::Splats | Representation::Auto, None) => "",
        (Representation::Splats | Representation::Auto, Some(_)) => "to take samples of its triangles",
        _ => "to draw its triangles",
    };
    match purpose {
        "" => Ok(()),
        _ => {
            let problem = format!("the file holds {what}; expected a mesh, {purpose}");
            Err(of_object(Error::input("", "", problem), object))
        }
    }
}

fn place_splats(mut splats: Object, object: &ObjectDescription) -> Result<Parts> {
    refuse_triangles(object, "splats")?;
    // Told by what they are in the file, before they become something else.
    let defects = splats.splats.drop_defective();
    splats.splats = splats.splats.transformed(&object.world_from_object);
    splats.splats.colors.tint(object.color, object.alpha);
    let (splats, report) = finish_splats(splats, String::new(), None, defects);
    Ok(Parts::of_splats(splats, report))
}

/// An error of an object's model, in the name of its file: what makes splats of it knows none.
fn of_object(error: Error, object: &ObjectDescription) -> Error {
    let ErrorKind::Input { problem, .. } = error.kind() else { return error };
    match &object.source {
        Source::File(path) => Error::input(path, "", problem),
        Source::BuiltIn { model, .. } => Error::input(format!("built-in {}", model.name()), "", problem),
    }
}
