//! Where parts of a mesh meet: that which stays polygons and that which becomes splats, or cells of which either may be drawn.
//!
//! An edge is a **transition edge** if triangles of two parts have it. Triangles have it in common if they name the same
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
#[derive(Clone, Debug)]
pub(super) struct Edge {
    /// Numbers of joints, the lower one first.
    pub ends: [usize; 2],
    /// The unit normal of a triangle of the first part, for where the joints' normals cancel.
    pub face: DVec3,
    /// The parts whose triangles have it, rising.
    pub parts: Vec<u32>,
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
    /// The borders in a mesh without degenerate triangles that has normals; `part[i]`: that of triangle i.
    pub(super) fn of(mesh: &Mesh, part: &[u32]) -> Self {
        let first = first_at_place(&mesh.positions);
        let mut sides = sides(mesh, part, &first);
        let mut border = Vec::new();
        sides.sort_unstable_by_key(|side| (side.vertices, side.triangle));
        let mut alone = Vec::new();
        for group in sides.chunk_by(|a, b| a.vertices == b.vertices) {
            match group {
                [side] => alone.push(*side),
                _ if is_transition(group, part) => border.extend_from_slice(group),
                _ => {}
            }
        }
        alone.sort_unstable_by_key(|side| (side.places, side.triangle));
        let groups = alone.chunk_by(|a, b| a.places == b.places);
        border.extend(groups.filter(|group| is_transition(group, part)).flatten());
        border.sort_unstable_by_key(|side| (side.places, side.triangle));
        Self::from_sides(mesh, part, &first, &border)
    }

    /// `sides` are sorted by places.
    fn from_sides(mesh: &Mesh, part: &[u32], first: &[u32], sides: &[Side]) -> Self {
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
            let of_first = group.iter().min_by_key(|side| part[side.triangle]).unwrap_or(&group[0]);
            let [a, b, c] = mesh.triangles[of_first.triangle].map(|v| mesh.positions[v as usize]);
            let face = (b - a).cross(c - a).normalize_or_zero();
            Edge { ends: group[0].places.map(number), face, parts: parts_of(group, part) }
        });
        Self { edges: edges.collect(), joints }
    }
}

fn is_transition(group: &[Side], part: &[u32]) -> bool {
    group.iter().any(|side| part[side.triangle] != part[group[0].triangle])
}

fn parts_of(group: &[Side], part: &[u32]) -> Vec<u32> {
    let mut parts: Vec<u32> = group.iter().map(|side| part[side.triangle]).collect();
    parts.sort_unstable();
    parts.dedup();
    parts
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

/// The sides of all edges that may be in transition: both ends are in several parts. The others are most of a mesh.
fn sides(mesh: &Mesh, part: &[u32], first: &[u32]) -> Vec<Side> {
    let mut of_place: Vec<Option<u32>> = vec![None; first.len()];
    let mut in_several = vec![false; first.len()];
    for (triangle, &part) in mesh.triangles.iter().zip(part) {
        for place in triangle.map(|vertex| first[vertex as usize] as usize) {
            in_several[place] |= *of_place[place].get_or_insert(part) != part;
        }
    }
    let mut sides = Vec::new();
    for (triangle, &[a, b, c]) in mesh.triangles.iter().enumerate() {
        for (from, to) in [(a, b), (b, c), (c, a)] {
            let places = sorted(first[from as usize], first[to as usize]);
            if places.iter().all(|&place| in_several[place as usize]) {
                sides.push(Side { vertices: sorted(from, to), places, triangle });
            }
        }
    }
    sides
}

fn sorted(a: u32, b: u32) -> [u32; 2] {
    [a.min(b), a.max(b)]
}
