//! A mesh becomes disks at its vertices.

use glam::DVec3;

use super::{
    fitness::Fitness,
    radii::hole_free_radii,
    surface::{MeshReport, Surface},
};
use crate::{
    progress::Progress,
    scene::{Colors, Mesh, Shapes, Splats},
};

/// How much larger than the smallest hole-free radius disks are made: so that their kernels blend.
///
/// On a sphere of 1 026 vertices with the Gaussian kernel (σ = ½), the blended normals are off by 2.06° at factor 1, 0.88°
/// at 1.25, 0.33° at 1.5, 0.53° at 1.75 and 0.37° at 2, and a point is in 1.4, 2.2, 3.2, 4.4 and 5.7 disks: more than 1.5
/// costs fragments and gains nothing. The test `more_overlap_gives_smoother_normals` prints these figures.
pub const DEFAULT_OVERLAP: f64 = 1.5;

/// Makes a disk of every vertex that has a face.
///
/// Normals are the file's, where it has usable ones, else the mean of the faces weighted by angle. Radii are `overlap`
/// times the smallest that leave no hole seen along the faces' normals; 1 is already free of holes, [`DEFAULT_OVERLAP`]
/// is a good value. Order and colors are those of the vertices.
///
/// A vertex whose faces cancel has normal zero: [`Splats::drop_defective`] removes it.
pub fn splats_from_mesh(mesh: &Mesh, overlap: f64, progress: &dyn Progress) -> (Splats, MeshReport) {
    let (surface, radii) = disks(mesh, overlap, progress);
    (collect(mesh, &surface.used, &surface.normals, &radii), surface.report)
}

/// As [`splats_from_mesh`], and how well these splats show the mesh.
pub fn fitting_splats(mesh: &Mesh, overlap: f64, progress: &dyn Progress) -> (Splats, MeshReport, Fitness) {
    let (surface, radii) = disks(mesh, overlap, progress);
    let fitness = Fitness::of(mesh, &surface.normals, &radii, surface.report.boundary_edges > 0);
    (collect(mesh, &surface.used, &surface.normals, &radii), surface.report, fitness)
}

/// The surface at the vertices, and the radii of disks there.
fn disks(mesh: &Mesh, overlap: f64, progress: &dyn Progress) -> (Surface, Vec<f64>) {
    const TASK: &str = "splats from the mesh";
    let mut done = 0;
    let mut step = || {
        done += 1;
        progress.step(TASK, done, 3);
    };
    let surface = Surface::of(mesh, &mut step);
    let mut radii = hole_free_radii(mesh, &surface.normals);
    radii.iter_mut().for_each(|radius| *radius *= overlap);
    step();
    (surface, radii)
}

fn collect(mesh: &Mesh, used: &[bool], normals: &[DVec3], radii: &[f64]) -> Splats {
    let kept = || used.iter().enumerate().filter(|(_, used)| **used).map(|(i, _)| i);
    let colors = match &mesh.colors {
        Colors::Each(colors) if colors.len() == used.len() => {
            Colors::Each(kept().map(|i| colors[i]).collect())
        }
        _ => one_color(mesh),
    };
    Splats {
        positions: kept().map(|i| mesh.positions[i]).collect(),
        shapes: Shapes::Disks {
            normals: kept().map(|i| normals[i].as_vec3()).collect(),
            radii: kept().map(|i| radii[i] as f32).collect(),
        },
        colors,
    }
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
