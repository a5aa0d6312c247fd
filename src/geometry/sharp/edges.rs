//! The edges of a mesh, and what of a mesh can't be turned into splats with curves: repaired, cut apart, or refused by name.
//!
//! **Cut apart** is an edge at which no two triangles belong together: that of more than two, and that of two which pass it in the same
//! direction. It is a border of each of its triangles (Guéziec, Taubin, Lazarus, Horn, "Cutting and stitching", 2001), but its vertices stay
//! one: so it is one ridge, whose curve cuts the splats of all its triangles, and collapses along it move all sheets at once.

use std::collections::HashMap;

use glam::DVec3;
use rayon::prelude::*;

use crate::{
    error::{Error, Result},
    geometry::{
        repeated::{REPEATED, drop_repeated},
        sharp::{orientation, slivers},
        topology::signed_volume,
    },
    notes::{Deed, Note},
    scene::Mesh,
};

/// The number of no triangle.
pub(super) const NONE: u32 = u32::MAX;

/// An edge between vertices `a < b`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Edge {
    pub a: u32,
    pub b: u32,
    /// The triangle that passes it from `a` to `b`, or [`NONE`]; as of one that is cut apart.
    pub left: u32,
    /// The triangle that passes it from `b` to `a`, or [`NONE`]; as of one that is cut apart.
    pub right: u32,
}

/// The edges of a mesh, and what kinds of them there are.
pub(super) struct Edges {
    /// By their vertices.
    pub all: Vec<Edge>,
    /// Those of more than two triangles.
    pub crowded: usize,
    /// Those that two triangles pass in the same direction.
    pub one_way: usize,
    /// Each is passed as often in one direction as in the other: the border of something, as far as that goes.
    pub closed: bool,
}

/// What was repaired.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Repairs {
    /// Vertices that lie where another does, and became that one.
    pub welded: usize,
    /// Triangles without area.
    pub degenerate: usize,
    /// Triangles of the same three vertices as another.
    pub repeated: usize,
    /// Triangles that were turned around, so that neighbors agree.
    pub flipped: usize,
    /// Edges of more than two triangles, which were cut apart.
    pub crowded: usize,
    /// Edges that two triangles pass in the same direction whatever is turned, as of a strip of one side: cut apart.
    pub one_way: usize,
    /// The closed surface was inside out.
    pub turned: bool,
}

impl Repairs {
    /// In words.
    pub fn notes(&self) -> Vec<Note> {
        let notes = [
            Note::of(Deed::Merged, self.welded, "vertices at the place of another"),
            Note::of(Deed::Dropped, self.degenerate, "triangles without area"),
            Note::of(Deed::Dropped, self.repeated, REPEATED),
            Note::of(Deed::Replaced, self.flipped, "triangles whose direction is not their neighbors'"),
            Note::of(Deed::Replaced, self.turned.into(), "surface that is inside out"),
            Note::of(Deed::Separated, self.crowded, "edges of more than two triangles"),
            Note::of(Deed::Separated, self.one_way, "edges at which a surface of one side meets its back"),
        ];
        notes.into_iter().flatten().collect()
    }
}

/// A mesh whose edges each have one triangle, two that pass them in opposite directions, or are cut apart; its vertices are those of the input.
pub(super) struct Sound {
    pub mesh: Mesh,
    pub edges: Vec<Edge>,
    pub repairs: Repairs,
    /// See [`Edges::closed`].
    pub closed: bool,
    /// What each vertex of the input has become.
    pub first: Vec<u32>,
}

impl Sound {
    /// Vertices at equal places are made one, triangles without area and repeated ones left out, and those turned around that pass an edge as
    /// their neighbor does.
    ///
    /// # Errors
    /// [`crate::error::ErrorKind::Input`] for a mesh without any triangle.
    pub fn of(mesh: &Mesh) -> Result<Self> {
        let (mut mesh, mut repairs) = (mesh.clone(), Repairs::default());
        let first;
        (repairs.welded, first) = weld(&mut mesh);
        repairs.degenerate = slivers::leave_out(&mut mesh);
        repairs.repeated = drop_repeated(&mut mesh.triangles);
        if mesh.triangles.is_empty() {
            return Err(Error::input("mesh", "", "no triangle with an area; expected one"));
        }
        let mut edges = edges(&mesh.triangles);
        if edges.one_way > 0 {
            repairs.flipped = orientation::agree(&mut mesh.triangles);
            edges = self::edges(&mesh.triangles);
        }
        (repairs.crowded, repairs.one_way) = (edges.crowded, edges.one_way);
        let Edges { mut all, closed, .. } = edges;
        if closed && signed_volume(&mesh) < 0.0 {
            repairs.turned = true;
            mesh.triangles.iter_mut().for_each(|triangle| triangle.swap(1, 2));
            all.iter_mut().for_each(|edge| (edge.left, edge.right) = (edge.right, edge.left));
        }
        Ok(Self { mesh, edges: all, repairs, closed, first })
    }
}

/// Makes triangles name the first of the vertices at a place; how many others there were that any named, and which that is of each.
fn weld(mesh: &mut Mesh) -> (usize, Vec<u32>) {
    let bits = |p: DVec3| p.to_array().map(|x| (x + 0.0).to_bits());
    let mut by_place: Vec<([u64; 3], u32)> =
        mesh.positions.par_iter().enumerate().map(|(i, p)| (bits(*p), i as u32)).collect();
    by_place.par_sort_unstable();
    let mut first: Vec<u32> = (0..mesh.positions.len() as u32).collect();
    for pair in by_place.chunk_by(|a, b| a.0 == b.0) {
        pair.iter().for_each(|(_, i)| first[*i as usize] = pair[0].1);
    }
    let mut used = vec![false; mesh.positions.len()];
    for vertex in mesh.triangles.iter_mut().flatten() {
        if let Some(to) = first.get(*vertex as usize).filter(|to| **to != *vertex) {
            used[*vertex as usize] = true;
            *vertex = *to;
        }
    }
    (used.iter().filter(|used| **used).count(), first)
}

/// The edges of triangles.
pub(super) fn edges(triangles: &[[u32; 3]]) -> Edges {
    let mut sides: Vec<(u32, u32, u32, bool)> = triangles
        .par_iter()
        .enumerate()
        .flat_map_iter(|(i, &[a, b, c])| {
            [(a, b), (b, c), (c, a)].map(|(from, to)| (from.min(to), from.max(to), i as u32, from > to))
        })
        .collect();
    sides.par_sort_unstable();
    let all = Vec::with_capacity(sides.len() / 2 + 1);
    let mut edges = Edges { all, crowded: 0, one_way: 0, closed: true };
    for sides in sides.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)) {
        let (a, b, ..) = sides[0];
        let (left, right) = match sides {
            [one] if one.3 => (NONE, one.2),
            [one] => (one.2, NONE),
            [first, second] if !first.3 && second.3 => (first.2, second.2),
            [first, second] if first.3 && !second.3 => (second.2, first.2),
            _ => (NONE, NONE),
        };
        edges.all.push(Edge { a, b, left, right });
        edges.crowded += usize::from(sides.len() > 2);
        edges.one_way += usize::from(sides.len() == 2 && left == NONE);
        let backward = sides.iter().filter(|side| side.3).count();
        edges.closed &= 2 * backward == sides.len();
    }
    edges
}

/// The edges of a mesh, to be looked up by their vertices.
pub(super) struct EdgeIndex(HashMap<(u32, u32), Edge>);

impl EdgeIndex {
    pub fn of(edges: &Edges) -> Self {
        Self(edges.all.iter().map(|edge| ((edge.a, edge.b), *edge)).collect())
    }

    /// The triangle beyond the side from `from` to `to` of a triangle; none at a border, and where it is cut apart.
    pub fn beyond(&self, from: u32, to: u32) -> Option<usize> {
        let edge = self.0.get(&(from.min(to), from.max(to)))?;
        let triangle = if from < to { edge.right } else { edge.left };
        (triangle != NONE).then_some(triangle as usize)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mesh(positions: &[[f64; 3]], triangles: &[[u32; 3]]) -> Mesh {
        Mesh {
            positions: positions.iter().map(|p| DVec3::from(*p)).collect(),
            triangles: triangles.to_vec(),
            ..Mesh::default()
        }
    }

    const SQUARE: [[f64; 3]; 5] =
        [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0], [0.5, 0.5, 1.0]];

    #[test]
    fn faults_are_repaired_and_counted_or_refused_by_name() {
        let good = Sound::of(&mesh(&SQUARE, &[[0, 1, 2], [0, 2, 3]])).unwrap();
        assert_eq!((good.edges.len(), good.repairs), (5, Repairs::default()));
        assert!(good.edges.contains(&Edge { a: 0, b: 2, left: 1, right: 0 }));
        // The diagonal has other vertices on either side, -0 is 0; one triangle is there twice, one has no area.
        let mut apart = SQUARE.to_vec();
        apart.extend([[-0.0, 0.0, 0.0], [1.0, 1.0, 0.0]]);
        let faulty = mesh(&apart, &[[0, 1, 2], [5, 6, 3], [2, 0, 1], [0, 2, 6]]);
        let repaired = Sound::of(&faulty).unwrap();
        assert_eq!(repaired.mesh.triangles, good.mesh.triangles);
        assert_eq!(repaired.repairs, Repairs { welded: 2, degenerate: 1, repeated: 1, ..Repairs::default() });
        let refusal =
            |triangles: &[[u32; 3]]| Sound::of(&mesh(&SQUARE, triangles)).err().unwrap().to_string();
        assert_eq!(refusal(&[[0, 0, 9]]), "mesh: no triangle with an area; expected one");
    }

    #[test]
    fn edges_at_which_no_two_triangles_belong_together_are_cut_apart() {
        // Three sheets at one edge; a strip of one side; both.
        let sheets = [[0, 1, 2], [0, 2, 3], [0, 2, 4]];
        let strip = [[0, 1, 2], [1, 3, 2], [2, 3, 4], [3, 0, 4], [4, 0, 1]];
        for (triangles, crowded, one_way, cut) in [(&sheets[..], 1, 0, [0, 2]), (&strip[..], 0, 1, [0, 1])] {
            let made = Sound::of(&mesh(&SQUARE, triangles)).unwrap();
            assert_eq!(made.repairs, Repairs { crowded, one_way, ..Repairs::default() });
            assert_eq!(made.mesh.triangles, triangles);
            let found: Vec<[u32; 2]> = made
                .edges
                .iter()
                .filter(|edge| (edge.left, edge.right) == (NONE, NONE))
                .map(|edge| [edge.a, edge.b])
                .collect();
            assert!(found == [cut] && !made.closed, "{found:?}");
            let notes = made.repairs.notes();
            assert!(notes.len() == 1 && notes[0].to_string().ends_with(" cut apart"), "{}", notes[0]);
        }
        // Two tetrahedra at one edge enclose what each does.
        let both = [[0, 2, 1], [0, 1, 4], [1, 2, 4], [2, 0, 4], [0, 1, 3], [0, 5, 1], [1, 5, 3], [3, 5, 0]];
        let below = [&SQUARE[..], &[[0.5, -0.5, -1.0]]].concat();
        let made = Sound::of(&mesh(&below, &both)).unwrap();
        assert_eq!((made.closed, made.repairs), (true, Repairs { crowded: 1, ..Repairs::default() }));
    }

    #[test]
    fn a_triangle_that_is_turned_against_its_neighbors_is_turned_back() {
        let good = Sound::of(&mesh(&SQUARE, &[[0, 1, 2], [0, 2, 3]])).unwrap();
        let repaired = Sound::of(&mesh(&SQUARE, &[[0, 1, 2], [0, 3, 2]])).unwrap();
        assert_eq!((repaired.mesh.triangles, repaired.edges), (good.mesh.triangles, good.edges));
        assert_eq!(repaired.repairs, Repairs { flipped: 1, ..Repairs::default() });
        let told = repaired.repairs.notes().iter().map(ToString::to_string).collect::<Vec<_>>();
        assert_eq!(told, ["1 triangle whose direction is not their neighbors' replaced"]);
    }

    #[test]
    fn what_is_inside_out_is_turned() {
        let outward = [[0, 2, 1], [0, 1, 4], [1, 2, 4], [2, 0, 4]];
        let inward = outward.map(|[a, b, c]| [a, c, b]);
        let [out, turned] = [outward, inward].map(|triangles| Sound::of(&mesh(&SQUARE, &triangles)).unwrap());
        assert!(!out.repairs.turned && turned.repairs.turned);
        assert_eq!((out.mesh.triangles, out.edges), (turned.mesh.triangles, turned.edges));
    }
}
