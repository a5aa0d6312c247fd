//! A mesh's surface at its vertices: normals, and whether it encloses something.

use std::fmt;

use glam::{DVec3, Vec3};

use super::{
    normals::{VertexNormals, vertex_normals},
    topology::{Edges, signed_volume},
};
use crate::{
    notes::{Deed, Note},
    scene::Mesh,
};

/// The facts found in a mesh on the way to splats.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct MeshReport {
    /// Vertices without a usable face: they are no part of the surface.
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

/// The vertices' normals, and what was found.
pub(super) struct Surface {
    /// The file's, where it has usable ones, else the mean of the faces weighted by angle. Unit, or zero where the faces
    /// cancel or there are none.
    pub normals: Vec<DVec3>,
    /// Whether some non-degenerate face has this vertex.
    pub used: Vec<bool>,
    /// The facts found.
    pub report: MeshReport,
}

impl Surface {
    /// The surface of a whole mesh. `step` is called after each of two steps.
    pub(super) fn of(mesh: &Mesh, mut step: impl FnMut()) -> Self {
        let VertexNormals { normals: mut face_normals, used, degenerate_faces } = vertex_normals(mesh);
        step();
        let edges = Edges::of(mesh);
        let turned = edges.closed() && signed_volume(mesh) < 0.0;
        if turned {
            face_normals.iter_mut().for_each(|n| *n = -*n);
        }
        step();
        let (normals, normals_from_file) = choose_normals(mesh, &face_normals, &used);
        let inward = |i: usize| normals[i].dot(face_normals[i]) <= 0.0;
        let closed = edges.closed() && !(0..normals.len()).any(|i| used[i] && inward(i));
        let report = MeshReport {
            vertices_without_faces: used.iter().filter(|&&used| !used).count(),
            degenerate_faces,
            boundary_edges: edges.boundary,
            irregular_edges: edges.irregular,
            closed,
            turned,
            normals_from_file,
        };
        Self { normals, used, report }
    }
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

impl MeshReport {
    /// What of the mesh is not drawn as the file says it, and what was computed; `vertices` is how many it has.
    pub fn notes(&self, vertices: usize) -> Vec<Note> {
        let normals = vertices.saturating_sub(self.vertices_without_faces + self.normals_from_file);
        let notes = [
            Note::of(Deed::Dropped, self.degenerate_faces, "triangles without area"),
            Note::of(Deed::Dropped, self.vertices_without_faces, "vertices without a face"),
            Note::of(Deed::Replaced, self.turned.into(), "surface that is inside out"),
            Note::of(Deed::Computed, normals, "normals"),
        ];
        notes.into_iter().flatten().collect()
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
            (self.boundary_edges, ["boundary edge", "boundary edges"]),
            (self.irregular_edges, ["irregular edge", "irregular edges"]),
            (self.degenerate_faces, ["degenerate face left out", "degenerate faces left out"]),
            (
                self.vertices_without_faces,
                ["vertex without a face left out", "vertices without a face left out"],
            ),
        ];
        for (count, [one, many]) in counts.into_iter().filter(|(count, _)| *count > 0) {
            write!(f, ", {count} {}", if count == 1 { one } else { many })?;
        }
        Ok(())
    }
}
