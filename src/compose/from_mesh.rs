//! A mesh becomes splats, triangles, or both.

use super::{
    hybrid::{self, usual_samples},
    parts::{Parts, StepTimer},
    words::{finish, finish_triangles, mesh_head, normals_computed, radii_computed, split_into},
};
use crate::{
    error::Result,
    geometry::{self, DEFAULT_OVERLAP, Hybrid, HybridOptions, shaded_mesh, splats_from_mesh},
    load::{ObjectDescription, Representation, Samples},
    progress::Progress,
    report::InputReport,
    scene::{Mesh, MeshObject, Object},
};

/// The parts of a mesh that are drawn; it is given in its own coordinates. Errors know no file.
pub(super) fn parts(
    own: Mesh,
    name: String,
    object: &ObjectDescription,
    work: &mut StepTimer<'_>,
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
        (Representation::Hybrid { polygons, sample_edges }, samples) => {
            let stay = hybrid::stay_polygons(&own, polygons);
            work.time(format!("split {name}"), |progress| {
                let mesh = placed(own);
                let usual = || Samples { count: usual_samples(&mesh, &stay, &object.source), seed: 0 };
                let Samples { count, seed } = samples.unwrap_or_else(usual);
                let options = HybridOptions { samples: count, seed, sample_edges };
                both(&mesh, name, &stay, &options, progress)
            })
        }
    }
}

fn splats((object, report): (Object, InputReport)) -> Parts {
    Parts { splats: Some(object), triangles: None, report }
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
    options: &HybridOptions,
    progress: &dyn Progress,
) -> Result<Parts> {
    let stays_polygon = |triangle: usize| stay.get(triangle).is_some_and(|stays| *stays);
    let Hybrid { splats, polygons, closed, report } =
        geometry::hybrid(mesh, &stays_polygon, options, progress)?;
    let head = format!("{}; {}", mesh_head(counts(mesh), &report.mesh), split_into(&report, splats.len()));
    let (object, report) = finish(Object { name: name.clone(), splats, closed }, head, Some(counts(mesh)));
    let triangles = MeshObject { name, mesh: polygons, closed };
    // A part may have everything.
    Ok(Parts {
        splats: (!object.splats.is_empty()).then_some(object),
        triangles: (!triangles.mesh.triangles.is_empty()).then_some(triangles),
        report,
    })
}

/// Vertices and triangles.
fn counts(mesh: &Mesh) -> [usize; 2] {
    [mesh.positions.len(), mesh.triangles.len()]
}
