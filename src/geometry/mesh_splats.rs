//! A mesh becomes splats at its vertices.

use super::{
    fitness::Fitness,
    flat_splats::{FlatSplat, flat_splats, shapes},
    radii::hole_free_radii,
    surface::{MeshReport, Surface},
};
use crate::{
    progress::Progress,
    scene::{Colors, Mesh, Splats},
};

/// How much larger than the smallest hole-free radius disks are made: so that their kernels blend.
///
/// On a sphere of 1 026 vertices with the Gaussian kernel (σ = ½), the blended normals are off by 2.06° at factor 1, 0.88°
/// at 1.25, 0.33° at 1.5, 0.53° at 1.75 and 0.37° at 2, and a point is in 1.4, 2.2, 3.2, 4.4 and 5.7 disks: more than 1.5
/// costs fragments and gains nothing. The test `more_overlap_gives_smoother_normals` prints these figures.
pub const DEFAULT_OVERLAP: f64 = 1.5;

/// Makes a splat of every vertex that has a face, and several where its faces don't lie flat.
///
/// Normals are the file's, where it has usable ones, else the mean of the faces weighted by angle. A splat is a round disk
/// with a radius of `overlap` times the smallest that leaves no hole seen along the faces' normals; 1 is already free of
/// holes, [`DEFAULT_OVERLAP`] is a good value. Where the surface turns or ends below that disk, a splat is an ellipse
/// for each flat part around the vertex, and ends there (`flat_splats.rs`). Where no vertex has one, all splats are
/// [`Shapes::Disks`](crate::scene::Shapes::Disks). Order and colors are those of the vertices.
///
/// A vertex whose faces cancel has normal zero: [`Splats::drop_defective`] removes it.
pub fn splats_from_mesh(mesh: &Mesh, overlap: f64, progress: &dyn Progress) -> (Splats, MeshReport) {
    let (surface, _, splats) = made(mesh, overlap, progress);
    (splats, surface.report)
}

/// As [`splats_from_mesh`], and how well round disks at the vertices would show the mesh.
pub fn fitting_splats(mesh: &Mesh, overlap: f64, progress: &dyn Progress) -> (Splats, MeshReport, Fitness) {
    let (surface, radii, splats) = made(mesh, overlap, progress);
    let fitness = Fitness::of(mesh, &surface.normals, &radii, surface.report.boundary_edges > 0);
    (splats, surface.report, fitness)
}

/// The surface at the vertices, the radii of round disks there, and the splats.
fn made(mesh: &Mesh, overlap: f64, progress: &dyn Progress) -> (Surface, Vec<f64>, Splats) {
    const TASK: &str = "splats from the mesh";
    let mut done = 0;
    let mut step = || {
        done += 1;
        progress.step(TASK, done, 4);
    };
    let surface = Surface::of(mesh, &mut step);
    let mut radii = hole_free_radii(mesh, &surface.normals);
    radii.iter_mut().for_each(|radius| *radius *= overlap);
    step();
    let splats = collect(mesh, &flat_splats(mesh, &surface, &radii, overlap));
    step();
    (surface, radii, splats)
}

fn collect(mesh: &Mesh, splats: &[FlatSplat]) -> Splats {
    let colors = match &mesh.colors {
        Colors::Each(colors) if colors.len() == mesh.positions.len() => {
            Colors::Each(splats.iter().map(|splat| colors[splat.vertex]).collect())
        }
        _ => one_color(mesh),
    };
    Splats::new(splats.iter().map(|splat| splat.position).collect(), shapes(splats), colors)
}

/// The color of all splats of a mesh that has none at its vertices.
pub(super) fn one_color(mesh: &Mesh) -> Colors {
    match mesh.colors {
        Colors::Uniform(color) => Colors::Uniform(color),
        Colors::Each(_) => Colors::unknown(),
    }
}

#[cfg(test)]
mod tests;
