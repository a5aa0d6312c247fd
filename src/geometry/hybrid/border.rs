//! Where the part of a mesh that stays polygons meets the part that becomes splats.
//!
//! An edge is a **transition edge** if a triangle of each part has it. Triangles have it in common if they name the same
//! two vertices. Many files repeat vertices, for instance where normals or colors jump; there every edge is one of one
//! triangle only. Such edges, and no others, are also compared by the positions of their ends, bit by bit (−0 is 0). So
//! two sheets that touch along an edge that is inside both stay apart.
//!
//! Edges that coincide without having the same ends (T-junctions) are not found.

use glam::DVec3;

use crate::{
    geometry::{resample::vertex_colors, turns::first_at_place},
    scene::Mesh,
};

/// The transition edges, and the places that they join.
pub(super) struct Border {
    /// In the order of their first vertices.
    pub joints: Vec<Joint>,
    /// Each pair of joints once, sorted.
    pub edges: Vec<Edge>,
}

/// An end of transition edges: one place, however many vertices are there.
#[derive(Clone, Copy, Debug)]
pub(super) struct Joint {
    pub position: DVec3,
    /// The mean over the vertices here that transition edges have, on both sides of them; not of unit length.
    pub normal: DVec3,
    /// The mean as well; 0 where the mesh has no colors at vertices.
    pub color: [f64; 4],
}

/// A transition edge.
#[derive(Clone, Copy, Debug)]
pub(super) struct Edge {
    /// Numbers of joints, the lower one first.
    pub ends: [usize; 2],
    /// The unit normal of a triangle of the splat part, for where the joints' normals cancel.
    pub face: DVec3,
}

/// An edge as one triangle has it.
#[derive(Clone, Copy)]
struct Side {
    /// Its vertices, sorted.
    vertices: [u32; 2],
    /// The first vertices at the same places, sorted.
    places: [u32; 2],
    triangle: usize,
}

impl Border {
    /// The border of a mesh without degenerate triangles that has normals; `polygon[i]`: triangle i stays one.
    pub(super) fn of(mesh: &Mesh, polygon: &[bool]) -> Self {
        let first = first_at_place(&mesh.positions);
        let mut sides = sides(mesh, polygon, &first);
        let mut border = Vec::new();
        sides.sort_unstable_by_key(|side| (side.vertices, side.triangle));
        let mut alone = Vec::new();
        for group in sides.chunk_by(|a, b| a.vertices == b.vertices) {
            match group {
                [side] => alone.push(*side),
                _ if is_transition(group, polygon) => border.extend_from_slice(group),
                _ => {}
            }
        }
        alone.sort_unstable_by_key(|side| (side.places, side.triangle));
        let groups = alone.chunk_by(|a, b| a.places == b.places);
        border.extend(groups.filter(|group| is_transition(group, polygon)).flatten());
        border.sort_unstable_by_key(|side| (side.places, side.triangle));
        Self::from_sides(mesh, polygon, &first, &border)
    }

    /// `sides` are sorted by places.
    fn from_sides(mesh: &Mesh, polygon: &[bool], first: &[u32], sides: &[Side]) -> Self {
        let mut vertices: Vec<[u32; 2]> = sides
            .iter()
            .flat_map(|side| side.vertices)
            .map(|vertex| [first[vertex as usize], vertex])
            .collect();
        vertices.sort_unstable();
        vertices.dedup();
        let groups = vertices.chunk_by(|a, b| a[0] == b[0]);
        let places: Vec<u32> = groups.clone().map(|group| group[0][0]).collect();
        let joints = groups.map(|group| joint(mesh, group)).collect();
        let number = |place: u32| places.partition_point(|&p| p < place);
        let edges = sides.chunk_by(|a, b| a.places == b.places).map(|group| {
            let of_splats = group.iter().find(|side| !polygon[side.triangle]).unwrap_or(&group[0]);
            let [a, b, c] = mesh.triangles[of_splats.triangle].map(|v| mesh.positions[v as usize]);
            Edge { ends: group[0].places.map(number), face: (b - a).cross(c - a).normalize_or_zero() }
        });
        Self { edges: edges.collect(), joints }
    }
}

fn is_transition(group: &[Side], polygon: &[bool]) -> bool {
    let polygons = group.iter().filter(|side| polygon[side.triangle]).count();
    (1..group.len()).contains(&polygons)
}

fn joint(mesh: &Mesh, vertices: &[[u32; 2]]) -> Joint {
    let share = 1.0 / vertices.len() as f64;
    let mut joint =
        Joint { position: mesh.positions[vertices[0][0] as usize], normal: DVec3::ZERO, color: [0.0; 4] };
    for &[_, vertex] in vertices {
        let vertex = vertex as usize;
        joint.normal +=
            mesh.normals.as_ref().map_or(DVec3::ZERO, |normals| share * normals[vertex].as_dvec3());
        if let Some(colors) = vertex_colors(mesh) {
            let each = joint.color.iter_mut().zip(colors[vertex]);
            each.for_each(|(mean, channel)| *mean += share * f64::from(channel));
        }
    }
    joint
}

/// The sides of all edges that may be in transition: both ends are in both parts. The others are most of a mesh.
fn sides(mesh: &Mesh, polygon: &[bool], first: &[u32]) -> Vec<Side> {
    let mut parts = vec![0_u8; first.len()];
    for (triangle, &polygon) in mesh.triangles.iter().zip(polygon) {
        triangle.iter().for_each(|&vertex| parts[first[vertex as usize] as usize] |= 1 << u8::from(polygon));
    }
    let mut sides = Vec::new();
    for (triangle, &[a, b, c]) in mesh.triangles.iter().enumerate() {
        for (from, to) in [(a, b), (b, c), (c, a)] {
            let places = sorted(first[from as usize], first[to as usize]);
            if places.iter().all(|&place| parts[place as usize] == 0b11) {
                sides.push(Side { vertices: sorted(from, to), places, triangle });
            }
        }
    }
    sides
}

fn sorted(a: u32, b: u32) -> [u32; 2] {
    [a.min(b), a.max(b)]
}
