//! Triangles cut into pieces that are small near transition edges and as they were elsewhere.
//!
//! A piece is cut at the middle of its longest edge until it is as small as wanted where it is (Rivara, "Algorithms for refining
//! triangular grids suitable for adaptive and multigrid techniques", 1984). Pieces of two neighbors need not meet at their corners:
//! only the places of their points matter.

use glam::DVec3;

use crate::{
    geometry::resample::vertex_colors,
    scene::{Colors, Mesh},
};

/// Pieces of some of a mesh's triangles.
pub(super) struct Pieces {
    /// Its positions, triangles and colors; the mesh's own vertices first.
    pub mesh: Mesh,
    /// At its vertices: interpolated, not of unit length.
    pub normals: Vec<DVec3>,
    /// Of each piece the number of the triangle that it is of.
    pub triangles: Vec<usize>,
}

impl Pieces {
    /// The pieces of those triangles that are `wanted`, in their order; the others are left out. `longest` is how long the
    /// sides of a piece may be, given its middle and how far its corners are from it at most.
    pub(super) fn of(
        mesh: &Mesh,
        wanted: &dyn Fn(usize) -> bool,
        longest: &dyn Fn(DVec3, f64) -> f64,
    ) -> Self {
        let colors =
            vertex_colors(mesh).map_or(Colors::Uniform([0.0; 4]), |colors| Colors::Each(colors.to_vec()));
        let positions = mesh.positions.clone();
        let normals = mesh.normals.iter().flatten().map(|normal| normal.as_dvec3()).collect();
        let mesh_of_pieces = Mesh { positions, colors, ..Mesh::default() };
        let mut pieces = Self { mesh: mesh_of_pieces, normals, triangles: Vec::new() };
        for (number, triangle) in mesh.triangles.iter().enumerate().filter(|(number, _)| wanted(*number)) {
            pieces.cut(*triangle, longest);
            pieces.triangles.resize(pieces.mesh.triangles.len(), number);
        }
        pieces
    }

    fn cut(&mut self, triangle: [u32; 3], longest: &dyn Fn(DVec3, f64) -> f64) {
        let mut left = vec![triangle];
        while let Some([a, b, c]) = left.pop() {
            let at = |vertex: u32| self.mesh.positions[vertex as usize];
            let sides = [(a, b, c), (b, c, a), (c, a, b)];
            let length = |(from, to, _): &(u32, u32, u32)| at(*from).distance(at(*to));
            let side = sides.into_iter().max_by(|a, b| length(a).total_cmp(&length(b)));
            let middle = (at(a) + at(b) + at(c)) / 3.0;
            let reach = [a, b, c].map(|vertex| at(vertex).distance(middle)).into_iter().fold(0.0, f64::max);
            match side.filter(|side| length(side) > longest(middle, reach)) {
                Some((from, to, other)) => {
                    let half = self.halfway(from, to);
                    left.extend([[half, to, other], [from, half, other]]);
                }
                None => self.mesh.triangles.push([a, b, c]),
            }
        }
    }

    /// The middle of a piece.
    pub(super) fn middle(&self, piece: usize) -> DVec3 {
        let corners = self.mesh.triangles[piece].map(|vertex| self.mesh.positions[vertex as usize]);
        corners.into_iter().sum::<DVec3>() / 3.0
    }

    fn halfway(&mut self, from: u32, to: u32) -> u32 {
        let (from, to) = (from as usize, to as usize);
        self.mesh.positions.push(0.5 * (self.mesh.positions[from] + self.mesh.positions[to]));
        self.normals.push(0.5 * (self.normals[from] + self.normals[to]));
        if let Colors::Each(colors) = &mut self.mesh.colors {
            let mean = std::array::from_fn(|channel| 0.5 * (colors[from][channel] + colors[to][channel]));
            colors.push(mean);
        }
        (self.mesh.positions.len() - 1) as u32
    }
}
