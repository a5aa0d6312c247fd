//! A mesh becomes splats, triangles, or both.

use super::{
    hybrid,
    object::{Parts, Work},
    words::{finish, finish_triangles, mesh_head, normals_computed, radii_computed},
};
use crate::{
    error::Result,
    geometry::{self, DEFAULT_OVERLAP, shaded_mesh, splats_from_mesh},
    load::{ObjectDescription, Representation, Samples, Source},
    progress::Progress,
    report::InputReport,
    scene::{Mesh, MeshObject, Object},
};

/// What is drawn of a mesh, given in its own coordinates. Errors know no file.
pub(super) fn parts(
    own: Mesh,
    name: String,
    object: &ObjectDescription,
    work: &mut Work<'_>,
) -> Result<Parts> {
    let placed = |own: Mesh| {
        let mut mesh = own.transformed(&object.world_from_object);
        mesh.colors.tint(object.color, object.alpha);
        mesh
    };
    match (object.representation, object.samples) {
        (Representation::Splats, None) => {
            Ok(splats(work.time(format!("normals and radii of {name}"), |progress| {
                splats_at_vertices(&placed(own), name, progress)
            })))
        }
        (Representation::Splats, Some(samples)) => work
            .time(format!("resample {name}"), |progress| resampled(&placed(own), name, samples, progress))
            .map(splats),
        (Representation::Mesh, _) => {
            Ok(work.time(format!("normals of {name}"), |_| triangles(placed(own), name)))
        }
        (Representation::Hybrid(polygons), samples) => {
            let samples = samples.unwrap_or_else(|| built_in_samples(&object.source));
            let stay = hybrid::stay_polygons(&own, polygons);
            work.time(format!("split {name}"), |progress| both(&placed(own), name, &stay, samples, progress))
        }
    }
}

fn splats((object, report): (Object, InputReport)) -> Parts {
    Parts { splats: Some(object), triangles: None, report }
}

/// As many as the built-in model would have without triangles.
fn built_in_samples(source: &Source) -> Samples {
    let count = match source {
        Source::BuiltIn { splats, .. } => *splats,
        Source::File(_) => 0, // which is refused
    };
    Samples { count, seed: 0 }
}

fn splats_at_vertices(mesh: &Mesh, name: String, progress: &dyn Progress) -> (Object, InputReport) {
    let (splats, report) = splats_from_mesh(mesh, DEFAULT_OVERLAP, progress);
    let head = format!("{}; {}", mesh_head(counts(mesh), &report), radii_computed(&report, splats.len()));
    finish(Object { name, splats, closed: report.closed }, head, Some(counts(mesh)))
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
    Ok(finish(Object { name, splats, closed: report.closed }, head, Some(counts(mesh))))
}

fn triangles(mesh: Mesh, name: String) -> Parts {
    let counts = counts(&mesh);
    let (mesh, report) = shaded_mesh(mesh);
    let head = format!("{}; {}", mesh_head(counts, &report), normals_computed(&report, counts[0]));
    let object = MeshObject { name, mesh, closed: report.closed };
    let report = finish_triangles(&object, &head, counts);
    Parts { splats: None, triangles: Some(object), report }
}

fn both(
    mesh: &Mesh,
    name: String,
    stay: &[bool],
    samples: Samples,
    progress: &dyn Progress,
) -> Result<Parts> {
    let hybrid::Split { splats, polygons, report } = hybrid::split(mesh, stay, samples, progress)?;
    let (disks, triangles) = (splats.len(), polygons.triangles.len());
    let head = format!("{}; {disks} splats and {triangles} triangles", mesh_head(counts(mesh), &report));
    let closed = report.closed;
    let (object, report) = finish(Object { name: name.clone(), splats, closed }, head, Some(counts(mesh)));
    Ok(Parts { splats: Some(object), triangles: Some(MeshObject { name, mesh: polygons, closed }), report })
}

/// Vertices and triangles.
fn counts(mesh: &Mesh) -> [usize; 2] {
    [mesh.positions.len(), mesh.triangles.len()]
}
