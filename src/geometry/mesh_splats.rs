//! A mesh becomes disks at its vertices.

use std::fmt;

use glam::{DVec3, Vec3};

use super::{
    normals::{VertexNormals, vertex_normals},
    radii::hole_free_radii,
    topology::{Edges, signed_volume},
};
use crate::{
    math::srgb::linear_from_srgb,
    progress::Progress,
    scene::{Colors, Mesh, MeshColors, Shapes, Splats},
};

/// How much larger than the smallest hole-free radius disks are made: so that their kernels blend.
///
/// On a sphere of 1 026 vertices with the Gaussian kernel (σ = ½), the blended normals are off by 2.06° at factor 1, 0.88°
/// at 1.25, 0.33° at 1.5, 0.53° at 1.75 and 0.37° at 2, and a point is in 1.4, 2.2, 3.2, 4.4 and 5.7 disks: more than 1.5
/// costs fragments and gains nothing. The test `more_overlap_gives_smoother_normals` prints these figures.
pub const DEFAULT_OVERLAP: f64 = 1.5;

/// The albedo of meshes without colors, as an sRGB value.
const DEFAULT_SRGB: f32 = 204.0 / 255.0;

/// What was found in a mesh on the way to splats.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct MeshReport {
    /// Vertices without a usable face: no splat was made of them.
    pub vertices_without_faces: usize,
    /// Faces left out: a corner repeated, out of range or not finite, or no area.
    pub degenerate_faces: usize,
    /// Edges of one face only.
    pub boundary_edges: usize,
    /// Edges of more than two faces, or of two that pass them in the same direction.
    pub irregular_edges: usize,
    /// The mesh is closed and consistently oriented and its splats' normals point outward: those that face away can't
    /// be seen.
    pub closed: bool,
    /// The mesh is closed, but its faces were clockwise seen from outside: computed normals were turned around.
    pub turned: bool,
    /// Vertices whose normal was taken from the file.
    pub normals_from_file: usize,
}

/// Makes a disk of every vertex that has a face.
///
/// Normals are the file's, where it has usable ones, else the mean of the faces weighted by angle. Radii are `overlap`
/// times the smallest that leave no hole seen along the faces' normals; 1 is already free of holes, [`DEFAULT_OVERLAP`]
/// is a good value. Order and colors are those of the vertices.
///
/// A vertex whose faces cancel has normal zero: [`Splats::drop_defective`] removes it.
pub fn splats_from_mesh(mesh: &Mesh, overlap: f64, progress: &dyn Progress) -> (Splats, MeshReport) {
    const TASK: &str = "splats from the mesh";
    let VertexNormals { normals: mut face_normals, used, degenerate_faces } = vertex_normals(mesh);
    progress.step(TASK, 1, 4);
    let edges = Edges::of(mesh);
    let turned = edges.closed() && signed_volume(mesh) < 0.0;
    if turned {
        face_normals.iter_mut().for_each(|n| *n = -*n);
    }
    progress.step(TASK, 2, 4);
    let (normals, from_file) = choose_normals(mesh, &face_normals, &used);
    let inward = |i: usize| normals[i].dot(face_normals[i]) <= 0.0;
    let closed = edges.closed() && !(0..normals.len()).any(|i| used[i] && inward(i));
    let radii = hole_free_radii(mesh, &normals);
    progress.step(TASK, 3, 4);
    let splats = collect(mesh, &used, &normals, &radii, overlap);
    progress.step(TASK, 4, 4);
    let report = MeshReport {
        vertices_without_faces: used.iter().filter(|&&used| !used).count(),
        degenerate_faces,
        boundary_edges: edges.boundary,
        irregular_edges: edges.irregular,
        closed,
        turned,
        normals_from_file: from_file,
    };
    (splats, report)
}

/// The file's normals, where they can be used, and how many.
fn choose_normals(mesh: &Mesh, face_normals: &[DVec3], used: &[bool]) -> (Vec<DVec3>, usize) {
    let Some(of_file) = mesh.normals.as_ref().filter(|n| n.len() == face_normals.len()) else {
        return (face_normals.to_vec(), 0);
    };
    let mut count = 0;
    let choose = |((&of_file, &of_faces), &used): ((&Vec3, &DVec3), &bool)| {
        let unit = of_file.as_dvec3().try_normalize();
        count += usize::from(used && unit.is_some());
        unit.unwrap_or(of_faces)
    };
    let normals = of_file.iter().zip(face_normals).zip(used).map(choose).collect();
    (normals, count)
}

#[expect(clippy::cast_possible_truncation, reason = "splats keep radii as f32")]
fn collect(mesh: &Mesh, used: &[bool], normals: &[DVec3], radii: &[f64], overlap: f64) -> Splats {
    let kept = || used.iter().enumerate().filter(|(_, used)| **used).map(|(i, _)| i);
    let gray = linear_from_srgb(DEFAULT_SRGB);
    let colors = match &mesh.colors {
        MeshColors::PerVertex(colors) if colors.len() == used.len() => {
            Colors::PerSplat(kept().map(|i| colors[i]).collect())
        }
        MeshColors::PerVertex(_) | MeshColors::None => Colors::Uniform([gray, gray, gray, 1.0]),
    };
    Splats {
        positions: kept().map(|i| mesh.positions[i]).collect(),
        shapes: Shapes::Disks {
            normals: kept().map(|i| normals[i].as_vec3()).collect(),
            radii: kept().map(|i| (overlap * radii[i]) as f32).collect(),
        },
        colors,
    }
}

impl fmt::Display for MeshReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match (self.closed, self.turned) {
            (true, false) => "closed",
            (true, true) => "closed, inside out: turned around",
            (false, _) if self.boundary_edges + self.irregular_edges == 0 => {
                "closed, but some normals of the file point inward: taken as open"
            }
            (false, _) => "open",
        })?;
        let counts = [
            (self.boundary_edges, "boundary edges"),
            (self.irregular_edges, "irregular edges"),
            (self.degenerate_faces, "degenerate faces left out"),
            (self.vertices_without_faces, "vertices without a face left out"),
        ];
        for (count, what) in counts.into_iter().filter(|(count, _)| *count > 0) {
            write!(f, ", {count} {what}")?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests;
