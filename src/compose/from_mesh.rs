//! A mesh becomes splats, triangles, or both.

use super::{
    hybrid::{self, usual_samples},
    parts::{Parts, StepTimer},
    words::{
        ASKED_FOR, counted, dense_enough, finish, finish_triangles, in_cells, mesh_head, normals_computed,
        radii_computed, split_into, too_coarse, too_uneven,
    },
};
use crate::{
    error::{Error, Result},
    geometry::{
        self, DEFAULT_OVERLAP, Hybrid, HybridOptions, MeshReport, Multiresolution, REPEATED, Suited,
        creased_mesh, drop_repeated, fitting_splats,
    },
    load::{ObjectDescription, Representation, Samples},
    notes::{Deed, Note},
    progress::Progress,
    report::InputReport,
    scene::{Mesh, MeshObject, Object, Opacity, Splats},
};

/// The parts of a mesh that are drawn; it is given in its own coordinates. Errors know no file.
pub(super) fn parts(
    mut own: Mesh,
    name: String,
    object: &ObjectDescription,
    work: &mut StepTimer<'_>,
) -> Result<Parts> {
    let repeated = Note::of(Deed::Dropped, drop_repeated(&mut own.triangles), REPEATED);
    repeated.iter().for_each(|note| work.progress.note(&format!("{name}: {note}")));
    let placed = |own: Mesh| {
        let mut mesh = own.transformed(&object.world_from_object);
        mesh.colors.tint(object.color, object.alpha);
        mesh
    };
    let chosen = object.representation == Representation::Auto && object.samples.is_none();
    let parts = match (object.representation, object.samples) {
        (Representation::Splats, None) => Ok(work.time(format!("normals and radii of {name}"), |progress| {
            splats_at_vertices(&placed(own), name, progress)
        })),
        (Representation::Auto, None) => best(placed(own), name, work),
        (Representation::Splats | Representation::Auto, Some(samples)) => work
            .time(format!("resample {name}"), |progress| resampled(&placed(own), name, samples, progress))
            .map(splats),
        (Representation::Mesh, _) => {
            Ok(work.time(format!("normals of {name}"), |_| triangles(placed(own), name, "")))
        }
        (Representation::Hybrid { polygons: None, .. }, samples) => {
            let none_stays = vec![false; own.triangles.len()];
            let usual = || Samples { count: usual_samples(&own, &none_stays, &object.source), seed: 0 };
            let Samples { count, seed } = samples.unwrap_or_else(usual);
            let options = HybridOptions { samples: count, seed, sample_edges: true };
            work.time(format!("cells and splats of {name}"), |progress| {
                in_levels(placed(own), name, &options, progress)
            })
        }
        (Representation::Hybrid { polygons: Some(polygons), sample_edges }, samples) => {
            let stay = hybrid::stay_polygons(&own, polygons);
            work.time(format!("split {name}"), |progress| {
                let mesh = placed(own);
                let usual = || Samples { count: usual_samples(&mesh, &stay, &object.source), seed: 0 };
                let Samples { count, seed } = samples.unwrap_or_else(usual);
                let options = HybridOptions { samples: count, seed, sample_edges };
                both(&mesh, name, &stay, &options, progress)
            })
        }
    };
    let mut parts = parts?;
    parts.report.notes.splice(0..0, repeated);
    Ok(if chosen { parts } else { because(parts, ASKED_FOR.to_owned()) })
}

fn because(mut parts: Parts, because: String) -> Parts {
    parts.report.because = because;
    parts
}

fn splats((object, report): (Object, InputReport)) -> Parts {
    Parts::of_splats(object, report)
}

/// What shows it best.
fn best(mesh: Mesh, name: String, work: &mut StepTimer<'_>) -> Result<Parts> {
    let (made, report, fitness) = work.time(format!("normals and radii of {name}"), |progress| {
        fitting_splats(&mesh, DEFAULT_OVERLAP, progress)
    });
    match fitness.suited() {
        Suited::VertexDisks => {
            let parts = splats(at_vertices(&mesh, name, (made, report)));
            Ok(because(parts, dense_enough(&fitness)))
        }
        Suited::SpreadDisks(count) => {
            drop(made);
            let samples = Samples { count, seed: 0 };
            let (object, mut report) =
                work.time(format!("resample {name}"), |progress| resampled(&mesh, name, samples, progress))?;
            let disks = counted(object.splats.len(), "disk", "disks");
            let why = too_uneven(&fitness);
            report.summary += &format!("; drawn as {disks}: {why}");
            Ok(because(splats((object, report)), why))
        }
        Suited::Triangles => {
            drop(made);
            let why = too_coarse(&fitness);
            let parts =
                work.time(format!("normals of {name}"), |_| triangles(mesh, name, &format!(": {why}")));
            Ok(because(parts, why))
        }
    }
}

fn splats_at_vertices(mesh: &Mesh, name: String, progress: &dyn Progress) -> Parts {
    let (made, report, fitness) = fitting_splats(mesh, DEFAULT_OVERLAP, progress);
    Parts { fitness: Some(fitness), ..splats(at_vertices(mesh, name, (made, report))) }
}

fn at_vertices(mesh: &Mesh, name: String, (splats, report): (Splats, MeshReport)) -> (Object, InputReport) {
    let head = format!("{}; {}", mesh_head(counts(mesh), &report), radii_computed(&report, splats.len()));
    let (object, told) = finish(Object { name, splats, closed: report.closed }, head, Some(counts(mesh)));
    (object, with_notes(told, mesh.positions.len(), &report))
}

/// With what was done with the mesh before its splats were looked at.
fn with_notes(mut told: InputReport, vertices: usize, report: &MeshReport) -> InputReport {
    let mut notes = report.notes(vertices);
    notes.append(&mut told.notes);
    InputReport { notes, ..told }
}

/// Splats spread evenly over a mesh, and what was done.
///
/// # Errors
/// As [`geometry::resample`].
pub fn resampled(
    mesh: &Mesh,
    name: String,
    samples: Samples,
    progress: &dyn Progress,
) -> Result<(Object, InputReport)> {
    let (splats, report) = geometry::resample(mesh, samples.count, samples.seed, progress)?;
    let head = format!("{}; resampled with seed {}", mesh_head(counts(mesh), &report), samples.seed);
    let (object, told) = finish(Object { name, splats, closed: report.closed }, head, Some(counts(mesh)));
    Ok((object, with_notes(told, mesh.positions.len(), &report)))
}

/// `why` goes on from what it is drawn as.
fn triangles(mesh: Mesh, name: String, why: &str) -> Parts {
    let counts = counts(&mesh);
    let (mesh, report) = creased_mesh(mesh);
    let head = format!("{}; {}", mesh_head(counts, &report), normals_computed(&report, counts[0]));
    let object = MeshObject { name, mesh, closed: report.closed };
    let report = with_notes(finish_triangles(&object, &head, counts, why), counts[0], &report);
    Parts { splats: None, triangles: Some(object), levels: None, fitness: None, report }
}

fn both(
    mesh: &Mesh,
    name: String,
    stay: &[bool],
    options: &HybridOptions,
    progress: &dyn Progress,
) -> Result<Parts> {
    let stays_polygon = |triangle: usize| stay.get(triangle).is_some_and(|stays| *stays);
    let Hybrid { splats, polygons, closed, report } =
        geometry::hybrid(mesh, &stays_polygon, options, progress)?;
    let head = format!("{}; {}", mesh_head(counts(mesh), &report.mesh), split_into(&report, splats.len()));
    let (object, told) = finish(Object { name: name.clone(), splats, closed }, head, Some(counts(mesh)));
    let mut report = with_notes(told, mesh.positions.len(), &report.mesh);
    report.drawn_as = "splats and triangles";
    let triangles = MeshObject { name, mesh: polygons, closed };
    // A part may have everything.
    Ok(Parts {
        splats: (!object.splats.is_empty()).then_some(object),
        triangles: (!triangles.mesh.triangles.is_empty()).then_some(triangles),
        levels: None,
        fitness: None,
        report,
    })
}

/// Polygons where splats would be large, splats elsewhere.
fn in_levels(mesh: Mesh, name: String, options: &HybridOptions, progress: &dyn Progress) -> Result<Parts> {
    if mesh.colors.opacity() != Opacity::Opaque {
        let problem = "transparent; expected an opaque mesh, for polygons and splats in turn";
        return Err(Error::input("", "", problem));
    }
    let counts = counts(&mesh);
    let Multiresolution { mesh, closed, levels, report } =
        geometry::multiresolution(mesh, name.clone(), options, progress)?;
    let object = MeshObject { name, mesh, closed };
    let splats = levels.splats.leaves.len();
    let head =
        format!("{}; {}", mesh_head(counts, &report.mesh), in_cells(&report, levels.cells.len(), splats));
    let told =
        InputReport { splats, ..finish_triangles(&object, &head, counts, " or splats, as the view has it") };
    let mut report = with_notes(told, counts[0], &report.mesh);
    report.drawn_as = "splats and triangles";
    Ok(Parts { splats: None, triangles: Some(object), levels: Some(levels), fitness: None, report })
}

/// Vertices and triangles.
fn counts(mesh: &Mesh) -> [usize; 2] {
    [mesh.positions.len(), mesh.triangles.len()]
}
