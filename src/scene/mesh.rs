//! Triangle meshes as they come from files.

use glam::DVec3;

/// Triangles over shared vertices, in world space.
#[derive(Clone, Debug, Default)]
pub struct Mesh {
    /// Vertex positions.
    pub positions: Vec<DVec3>,
    /// The file's vertex normals, of any length; `None` where it has none.
    pub normals: Option<Vec<glam::Vec3>>,
    /// Vertex colors.
    pub colors: MeshColors,
    /// Vertex indices, counterclockwise seen from outside; each is below `positions.len()`.
    pub triangles: Vec<[u32; 3]>,
}

/// The colors of a mesh: linear albedo and straight alpha, each 0–1.
#[derive(Clone, Debug, Default)]
pub enum MeshColors {
    /// None in the file.
    #[default]
    None,
    /// One per vertex.
    PerVertex(Vec<[f32; 4]>),
}
