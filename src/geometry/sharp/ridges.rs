//! Ridges of a mesh: edges over which its surface bends, those at its border, and those that are cut apart (`edges`), in chains (Kobbelt, Botsch, Schwanecke, Seidel, "Feature
//! sensitive surface extraction from volume data", 2001; Ivo et al. 2012, section 5).
//!
//! A chain goes from one *corner* to another: a vertex at which one ridge ends, more than two meet, or one turns by more than
//! [`COS_CORNER`] says. One without a corner begins and ends at its vertex of the least number, which then is one.
//!
//! **Noise.** Edges bend by two thirds of the threshold at least; a chain counts where one of its edges reaches the threshold. One with
//! a free end that is shorter than [`SHORTEST`] mean edges is left out, and so is what is left of its neighbors then; but none at which no two triangles
//! belong together.

use glam::DVec3;

use super::edges::{Edge, NONE};
use crate::scene::Mesh;

/// Cosine of 40°, the turn at which a ridge has a corner.
const COS_CORNER: f64 = 0.766;

/// The part of the threshold that an edge of a ridge reaches.
const WEAK: f64 = 2.0 / 3.0;

/// The shortest ridge with a free end, in mean edges of the ridges.
const SHORTEST: f64 = 3.0;

/// What a vertex is to the ridges.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// On none.
    Smooth,
    /// Within a chain, at that place of it.
    Ridge { chain: u32, place: u32 },
    /// At the ends of chains.
    Corner,
}

/// The ridges.
pub(super) struct Ridges {
    /// Vertices from corner to corner.
    pub chains: Vec<Vec<u32>>,
    /// One a vertex.
    pub kinds: Vec<Kind>,
}

/// An edge of a ridge.
#[derive(Clone, Copy)]
struct Crease {
    ends: [u32; 2],
    strong: bool,
    /// It has no triangle on one side, or is cut apart: never noise.
    open: bool,
}

impl Ridges {
    /// The ridges where the surface bends by `crease_rad` or more. `normals` are the triangles'.
    pub fn of(mesh: &Mesh, edges: &[Edge], normals: &[DVec3], crease_rad: f64) -> Self {
        let [weak, strong] = [WEAK * crease_rad, crease_rad].map(f64::cos);
        let crease = |edge: &Edge| {
            let ends = [edge.a, edge.b];
            if edge.left == NONE || edge.right == NONE {
                return Some(Crease { ends, strong: true, open: true });
            }
            let cos = normals[edge.left as usize].dot(normals[edge.right as usize]);
            (cos <= weak).then_some(Crease { ends, strong: cos <= strong, open: false })
        };
        let mut creases: Vec<Crease> = edges.iter().filter_map(crease).collect();
        let length =
            |ends: [u32; 2]| mesh.positions[ends[0] as usize].distance(mesh.positions[ends[1] as usize]);
        // What one round takes away may leave free ends.
        for _ in 0..4 {
            let mean =
                creases.iter().map(|crease| length(crease.ends)).sum::<f64>() / creases.len().max(1) as f64;
            let incident = Incident::of(mesh.positions.len(), &creases);
            let mut keep = vec![true; creases.len()];
            for chain in walk(mesh, &creases, &incident) {
                let is_free = |vertex: u32| incident.of_vertex(vertex).len() == 1;
                let ends = [chain.vertices[0], chain.vertices[chain.vertices.len() - 1]];
                let long: f64 = chain.vertices.windows(2).map(|pair| length([pair[0], pair[1]])).sum();
                let weak = !chain.creases.iter().any(|i| creases[*i].strong);
                let open = chain.creases.iter().any(|i| creases[*i].open);
                if weak || ends.into_iter().any(is_free) && long < SHORTEST * mean && !open {
                    chain.creases.iter().for_each(|i| keep[*i] = false);
                }
            }
            if keep.iter().all(|keep| *keep) {
                break;
            }
            let mut keep = keep.iter();
            creases.retain(|_| *keep.next().unwrap_or(&true));
        }
        let incident = Incident::of(mesh.positions.len(), &creases);
        let chains: Vec<_> =
            walk(mesh, &creases, &incident).into_iter().map(|chain| chain.vertices).collect();
        let mut kinds = vec![Kind::Smooth; mesh.positions.len()];
        for (number, chain) in chains.iter().enumerate() {
            for (place, &vertex) in chain.iter().enumerate() {
                let is_end = place == 0 || place == chain.len() - 1;
                let within = Kind::Ridge { chain: number as u32, place: place as u32 };
                kinds[vertex as usize] = if is_end { Kind::Corner } else { within };
            }
        }
        Self { chains, kinds }
    }
}

struct Chain {
    vertices: Vec<u32>,
    creases: Vec<usize>,
}

/// All chains: first those that begin at a corner, by its number, then the loops.
fn walk(mesh: &Mesh, creases: &[Crease], incident: &Incident) -> Vec<Chain> {
    let is_corner = |vertex: u32| match incident.of_vertex(vertex) {
        [first, second] => {
            let way = |i: &u32| {
                let [a, b] = creases[*i as usize].ends;
                let other = if a == vertex { b } else { a };
                (mesh.positions[other as usize] - mesh.positions[vertex as usize]).normalize()
            };
            -way(first).dot(way(second)) < COS_CORNER
        }
        _ => true,
    };
    let mut order: Vec<(bool, u32, usize)> = Vec::with_capacity(2 * creases.len());
    for (i, crease) in creases.iter().enumerate() {
        order.extend(crease.ends.map(|end| (!is_corner(end), end, i)));
    }
    order.sort_unstable();
    let mut walked = vec![false; creases.len()];
    let mut chains = Vec::new();
    for (_, start, first) in order {
        let mut chain = Chain { vertices: vec![start], creases: Vec::new() };
        let (mut at, mut next) = (start, Some(first).filter(|first| !walked[*first]));
        while let Some(crease) = next {
            walked[crease] = true;
            let [a, b] = creases[crease].ends;
            at = if a == at { b } else { a };
            chain.vertices.push(at);
            chain.creases.push(crease);
            let onward = incident.of_vertex(at).iter().map(|i| *i as usize).find(|i| !walked[*i]);
            next = if at == start || is_corner(at) { None } else { onward };
        }
        if !chain.creases.is_empty() {
            chains.push(chain);
        }
    }
    chains
}

/// The creases of each vertex.
struct Incident {
    /// Where those of each vertex begin, and the end.
    starts: Vec<u32>,
    creases: Vec<u32>,
}

impl Incident {
    fn of(vertices: usize, creases: &[Crease]) -> Self {
        let mut starts = vec![0; vertices + 1];
        creases.iter().flat_map(|crease| crease.ends).for_each(|end| starts[end as usize + 1] += 1);
        for vertex in 0..vertices {
            starts[vertex + 1] += starts[vertex];
        }
        let (mut free, mut of_vertices) = (starts.clone(), vec![0; 2 * creases.len()]);
        for (i, crease) in creases.iter().enumerate() {
            for end in crease.ends {
                of_vertices[free[end as usize] as usize] = i as u32;
                free[end as usize] += 1;
            }
        }
        Self { starts, creases: of_vertices }
    }

    fn of_vertex(&self, vertex: u32) -> &[u32] {
        let vertex = vertex as usize;
        &self.creases[self.starts[vertex] as usize..self.starts[vertex + 1] as usize]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::sharp::{edges::Sound, normals_of};

    /// A wedge of two strips of `count` quads each along x, whose sides are bent by `bend_rad`, and open at all other sides.
    fn wedge(count: u32, bend_rad: f64) -> Mesh {
        let (mut positions, mut triangles) = (Vec::new(), Vec::new());
        for i in 0..=count {
            let x = f64::from(i);
            let (sin, cos) = bend_rad.sin_cos();
            positions.extend([DVec3::new(x, -1.0, 0.0), DVec3::new(x, 0.0, 0.0), DVec3::new(x, cos, -sin)]);
            if i > 0 {
                let (old, new) = (3 * (i - 1), 3 * i);
                for row in 0..2 {
                    triangles.push([old + row, new + row, new + row + 1]);
                    triangles.push([old + row, new + row + 1, old + row + 1]);
                }
            }
        }
        Mesh { positions, triangles, ..Mesh::default() }
    }

    fn ridges(mesh: &Mesh, crease_deg: f64) -> Ridges {
        let sound = Sound::of(mesh).unwrap();
        let normals = normals_of(&sound.mesh);
        Ridges::of(&sound.mesh, &sound.edges, &normals, crease_deg.to_radians())
    }

    #[test]
    fn a_wedge_has_its_ridge_and_its_border_between_four_corners_and_two_ends() {
        let found = ridges(&wedge(6, 0.7), 30.0);
        let mut lengths: Vec<usize> = found.chains.iter().map(Vec::len).collect();
        lengths.sort_unstable();
        // The ridge, two sides along it, and four halves of the ends.
        assert_eq!(lengths, [2, 2, 2, 2, 7, 7, 7]);
        let corners = found.kinds.iter().filter(|kind| **kind == Kind::Corner).count();
        assert_eq!(corners, 6);
        // Below the threshold the border alone is left: four sides.
        assert_eq!(ridges(&wedge(6, 0.5), 30.0).chains.len(), 4);
    }

    #[test]
    fn a_loop_without_a_corner_begins_at_its_first_vertex() {
        let count = 40;
        let mut positions = vec![DVec3::ZERO];
        positions.extend((0..count).map(|i| {
            let (sin, cos) = (std::f64::consts::TAU * f64::from(i) / f64::from(count)).sin_cos();
            DVec3::new(cos, sin, 0.0)
        }));
        let triangles = (0..count).map(|i| [0, 1 + i, 1 + (i + 1) % count]).collect();
        let found = ridges(&Mesh { positions, triangles, ..Mesh::default() }, 30.0);
        assert_eq!(found.chains.len(), 1);
        assert_eq!((found.chains[0].len(), found.chains[0][0], found.chains[0][40]), (41, 1, 1));
        assert_eq!(found.kinds[1], Kind::Corner);
        assert_eq!(found.kinds[2], Kind::Ridge { chain: 0, place: 1 });
    }

    /// A bump in a plain, one of whose edges bends by enough: too short to be a ridge.
    #[test]
    fn noise_is_no_ridge() {
        let (mut positions, mut triangles) = (Vec::new(), Vec::new());
        let side = 12;
        for y in 0..side {
            for x in 0..side {
                let z = if (x, y) == (5, 5) { 0.45 } else { 0.0 };
                positions.push(DVec3::new(f64::from(x), f64::from(y), z));
                if x > 0 && y > 0 {
                    let [a, b] = [(y - 1) * side + x - 1, (y - 1) * side + x];
                    let [c, d] = [y * side + x - 1, y * side + x];
                    triangles.extend([[a, b, d], [a, d, c]].map(|t| t.map(|i| i as u32)));
                }
            }
        }
        let found = ridges(&Mesh { positions, triangles, ..Mesh::default() }, 30.0);
        assert!(found.chains.iter().flatten().all(|vertex| *vertex != 5 * 12 + 5), "{:?}", found.chains);
        assert_eq!(found.chains.len(), 4);
    }
}
