//! Vertex normals from faces, each weighted by its angle at the vertex, so that they don't depend on how a flat region
//! is cut into triangles (Thürmer and Wüthrich, "Computing Vertex Normals from Polygonal Facets", 1998).

use glam::DVec3;

use super::corners;
use crate::scene::Mesh;

/// The vertices' normals by their faces.
pub(super) struct VertexNormals {
    /// Unit, or zero where the faces cancel or there are none.
    pub normals: Vec<DVec3>,
    /// Whether some non-degenerate face has this vertex.
    pub used: Vec<bool>,
    /// How many faces were left out.
    pub degenerate_faces: usize,
}

pub(super) fn vertex_normals(mesh: &Mesh) -> VertexNormals {
    let mut normals = vec![DVec3::ZERO; mesh.positions.len()];
    let mut used = vec![false; mesh.positions.len()];
    let mut degenerate_faces = 0;
    for &triangle in &mesh.triangles {
        let Some(p) = corners(mesh, triangle) else {
            degenerate_faces += 1;
            continue;
        };
        let (normal, angles) = corner_angles(p);
        for (vertex, angle) in triangle.into_iter().zip(angles) {
            normals[vertex as usize] += angle * normal;
            used[vertex as usize] = true;
        }
    }
    for normal in &mut normals {
        // Weights are angles: a sum this small is what rounding leaves of faces that cancel.
        *normal = if normal.length() > 1e-12 { normal.normalize() } else { DVec3::ZERO };
    }
    VertexNormals { normals, used, degenerate_faces }
}

/// A triangle's unit normal, and its angles in radians. It has an area.
pub(super) fn corner_angles(p: [DVec3; 3]) -> (DVec3, [f64; 3]) {
    let [ab, bc, ca] = [p[1] - p[0], p[2] - p[1], p[0] - p[2]];
    let doubled_area_normal = ab.cross(-ca);
    let doubled_area = doubled_area_normal.length();
    let angle = |to_next: DVec3, to_last: DVec3| doubled_area.atan2(to_next.dot(to_last));
    (doubled_area_normal / doubled_area, [angle(ab, -ca), angle(bc, -ab), angle(ca, -bc)])
}
