//! Triangle meshes as they come from files.

use glam::DVec3;

use super::{Bounds, Colors};

/// Triangles over shared vertices, in world space.
#[derive(Clone, Debug, Default)]
pub struct Mesh {
    /// Vertex positions.
    pub positions: Vec<DVec3>,
    /// The file's vertex normals, of any length; `None` where it has none.
    pub normals: Option<Vec<glam::Vec3>>,
    /// Colors of the vertices; [`Colors::unknown`] where the file has none.
    pub colors: Colors,
    /// Vertex indices, counterclockwise seen from outside; each is below `positions.len()`.
    pub triangles: Vec<[u32; 3]>,
}

impl Mesh {
    /// The corner positions of triangle `i`; `None` where it can't be drawn: a corner out of range or not finite.
    pub fn corners(&self, i: usize) -> Option<[DVec3; 3]> {
        let position = |vertex: u32| self.positions.get(vertex as usize).copied().filter(|p| p.is_finite());
        let [a, b, c] = self.triangles[i];
        Some([position(a)?, position(b)?, position(c)?])
    }

    /// The box around all triangles that can be drawn; `None` where there is none.
    pub fn bounds(&self) -> Option<Bounds> {
        let corners = (0..self.triangles.len()).filter_map(|i| self.corners(i)).flatten();
        corners.map(|corner| Bounds::of_ball(corner, 0.0)).reduce(Bounds::union)
    }
}
