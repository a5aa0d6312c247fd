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

    /// Leaves out vertices that no triangle has, and tells how many there were. Corners that are out of range stay so.
    pub fn drop_unused_vertices(&mut self) -> usize {
        let mut used = vec![false; self.positions.len()];
        for &vertex in self.triangles.iter().flatten() {
            if let Some(used) = used.get_mut(vertex as usize) {
                *used = true;
            }
        }
        let unused = used.iter().filter(|used| !**used).count();
        if unused == 0 {
            return 0;
        }
        let mut next = 0;
        let number = |&used: &bool| {
            let number = next;
            next += u32::from(used);
            number
        };
        let numbers: Vec<u32> = used.iter().map(number).collect();
        for vertex in self.triangles.iter_mut().flatten() {
            *vertex = numbers.get(*vertex as usize).map_or(*vertex, |number| *number);
        }
        if let Colors::Each(colors) = &mut self.colors {
            keep(colors, &used);
        }
        if let Some(normals) = &mut self.normals {
            keep(normals, &used);
        }
        keep(&mut self.positions, &used);
        unused
    }
}

fn keep<T>(values: &mut Vec<T>, used: &[bool]) {
    let mut used = used.iter();
    values.retain(|_| *used.next().unwrap_or(&true));
    values.shrink_to_fit();
}
