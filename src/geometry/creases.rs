//! Creases: where faces meet at an angle, each side has a normal of its own, or a cube is shaded as a ball.
//!
//! **The rule.** Two faces of a vertex are of one surface there where they share an edge at it over which the surface bends by
//! less than [`COS_CREASE`] says, or where others between them are. A vertex of several surfaces becomes one for each; their
//! normals are the means of their own faces, weighted by angle as in [`super::normals`]. So a fillet of many small bends stays
//! smooth, and so does the end of a crease that fades out. A vertex whose normal the file has stays as it is: the file has
//! decided.

use glam::{DVec3, Vec3};

use super::{corners, normals::corner_angles};
use crate::scene::{Colors, Mesh};

/// Cosine of the smallest bend of a crease, 40°: a ball of 80 triangles and a tube of 10 sides are smooth, a tube of 8 is not.
/// Modelers' defaults are 20° to 60°.
pub(super) const COS_CREASE: f64 = 0.766;

/// Each face at an edge is compared with so many next ones: where hundreds share an edge there is no surface to tell.
const MOST_AT_AN_EDGE: usize = 8;

/// A triangle's corner at some vertex.
#[derive(Clone, Copy)]
pub(super) struct Corner {
    pub triangle: u32,
    pub place: u8,
}

/// Cuts a mesh apart at its creases. `normals` of the mesh are of its vertices and `fixed` are those that stay; its
/// triangles have an area and the same orientation.
pub(super) fn split(mesh: &mut Mesh, fixed: &[bool]) {
    let faces: Vec<Option<Face>> = mesh.triangles.iter().map(|&triangle| Face::of(mesh, triangle)).collect();
    let (starts, of_vertices) = corners_of_vertices(mesh);
    let mut surfaces = Surfaces::default();
    for vertex in (0..fixed.len()).filter(|&vertex| !fixed[vertex]) {
        let around = &of_vertices[starts[vertex]..starts[vertex + 1]];
        let Some(count) =
            surfaces.find(mesh, &faces, around, COS_CREASE).checked_sub(1).filter(|more| *more > 0)
        else {
            continue;
        };
        // Vertices have 32-bit numbers.
        let first = mesh.positions.len();
        if u32::try_from(first + count).is_err() {
            return;
        }
        let mut sums = vec![DVec3::ZERO; count + 1];
        for (&corner, &surface) in around.iter().zip(&surfaces.of_corners) {
            if let Some(face) = &faces[corner.triangle as usize] {
                sums[surface] += face.angles[usize::from(corner.place)] * face.normal;
            }
            if surface > 0 {
                mesh.triangles[corner.triangle as usize][usize::from(corner.place)] =
                    (first + surface - 1) as u32;
            }
        }
        let mut normals = sums.iter().map(|sum| sum.try_normalize().unwrap_or_default().as_vec3());
        add_copies(mesh, vertex, &mut normals);
    }
}

/// The vertex takes the first of the normals, and a copy of it each of the others.
fn add_copies(mesh: &mut Mesh, vertex: usize, normals: &mut dyn Iterator<Item = Vec3>) {
    let Some(of_mesh) = &mut mesh.normals else { return };
    of_mesh[vertex] = normals.next().unwrap_or_default();
    for normal in normals {
        of_mesh.push(normal);
        mesh.positions.extend_from_within(vertex..=vertex);
        if let Colors::Each(colors) = &mut mesh.colors {
            colors.extend_from_within(vertex..=vertex);
        }
    }
}

/// A triangle's unit normal, and its angles.
pub(super) struct Face {
    pub normal: DVec3,
    pub angles: [f64; 3],
}

impl Face {
    pub(super) fn of(mesh: &Mesh, triangle: [u32; 3]) -> Option<Self> {
        let (normal, angles) = corner_angles(corners(mesh, triangle)?);
        Some(Self { normal, angles })
    }
}

/// Where each vertex's corners begin in the list, and the list. Vertices that the mesh does not have have none.
pub(super) fn corners_of_vertices(mesh: &Mesh) -> (Vec<usize>, Vec<Corner>) {
    let mut starts = vec![0; mesh.positions.len() + 1];
    let has = |vertex: u32| (vertex as usize) < mesh.positions.len();
    for &vertex in mesh.triangles.iter().flatten().filter(|vertex| has(**vertex)) {
        starts[vertex as usize + 1] += 1;
    }
    for vertex in 1..starts.len() {
        starts[vertex] += starts[vertex - 1];
    }
    let mut next = starts.clone();
    let mut list = vec![Corner { triangle: 0, place: 0 }; mesh.triangles.len() * 3];
    for (triangle, vertices) in mesh.triangles.iter().enumerate() {
        for (place, &vertex) in vertices.iter().enumerate().filter(|(_, vertex)| has(**vertex)) {
            let to = &mut next[vertex as usize];
            list[*to] = Corner { triangle: triangle as u32, place: place as u8 };
            *to += 1;
        }
    }
    (starts, list)
}

/// The surfaces that meet at one vertex.
#[derive(Default)]
pub(super) struct Surfaces {
    /// The surface of each corner, numbered from 0 in the order of their first corners.
    pub of_corners: Vec<usize>,
    /// The other end of each edge, and the corner that has it.
    edges: Vec<(u32, usize)>,
    /// A corner of the same surface; itself at last.
    parents: Vec<usize>,
}

impl Surfaces {
    /// Tells the surfaces apart, where a bend with a cosine of at most `cos_crease` is a crease; how many there are.
    pub(super) fn find(
        &mut self,
        mesh: &Mesh,
        faces: &[Option<Face>],
        around: &[Corner],
        cos_crease: f64,
    ) -> usize {
        self.edges.clear();
        for (i, corner) in around.iter().enumerate() {
            let (triangle, place) = (mesh.triangles[corner.triangle as usize], usize::from(corner.place));
            self.edges.extend([(triangle[(place + 1) % 3], i), (triangle[(place + 2) % 3], i)]);
        }
        self.edges.sort_unstable();
        self.parents.clear();
        self.parents.extend(0..around.len());
        let normal = |corner: usize| faces[around[corner].triangle as usize].as_ref().map(|face| face.normal);
        for first in 0..self.edges.len() {
            let last = self.edges.len().min(first + 1 + MOST_AT_AN_EDGE);
            for second in first + 1..last {
                let [(end, a), (other_end, b)] = [self.edges[first], self.edges[second]];
                let smooth = || normal(a).zip(normal(b)).is_some_and(|(a, b)| a.dot(b) > cos_crease);
                if end == other_end && smooth() {
                    let (a, b) = (self.root(a), self.root(b));
                    self.parents[a.max(b)] = a.min(b);
                }
            }
        }
        self.number(around.len())
    }

    fn number(&mut self, corners: usize) -> usize {
        self.of_corners.clear();
        let mut count = 0;
        for corner in 0..corners {
            let root = self.root(corner);
            // A root is the first corner of its surface.
            let surface = if root == corner { count } else { self.of_corners[root] };
            count += usize::from(root == corner);
            self.of_corners.push(surface);
        }
        count
    }

    fn root(&mut self, mut corner: usize) -> usize {
        while self.parents[corner] != corner {
            self.parents[corner] = self.parents[self.parents[corner]];
            corner = self.parents[corner];
        }
        corner
    }
}

#[cfg(test)]
mod tests;
