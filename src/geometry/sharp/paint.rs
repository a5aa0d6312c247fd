//! The colors of a mesh's triangles at their corners, as the file has them, and triangles split where one color is not enough.

use std::{
    cmp::Ordering,
    collections::{BinaryHeap, HashMap},
};

use glam::{DVec3, Vec4};
use rayon::prelude::*;

use super::tint::Tint;
use crate::scene::{Colors, Mesh};

/// As many triangles are made by splitting at the most.
const MOST: usize = 4 << 20;

/// Of each triangle, at its corners.
pub(super) struct Paint(Vec<[Vec4; 3]>);

impl Paint {
    /// Of a mesh that was repaired, some of whose vertices stand for several of the file, which may have colors of their own. `None` where the file has none.
    /// `first`: of the vertices of the file, the one that each has become.
    pub fn of(file: &Mesh, mesh: &Mesh, first: &[u32]) -> Option<Self> {
        let Colors::Each(colors) = &file.colors else { return None };
        let color = |vertex: u32| colors.get(vertex as usize).copied().map_or(Vec4::NAN, Vec4::from);
        let merged = |vertex: &u32| first.get(*vertex as usize).copied().unwrap_or(*vertex);
        let differs = |vertex: &u32| color(*vertex) != color(merged(vertex));
        // The triangles of the file one of whose corners has another color than the vertex which it has become.
        let key = |mut corners: [u32; 3]| {
            corners.sort_unstable();
            corners
        };
        let others = file.triangles.iter().rev().filter(|corners| corners.iter().any(differs));
        let others: HashMap<[u32; 3], [u32; 3]> =
            others.map(|corners| (key(corners.map(|vertex| merged(&vertex))), *corners)).collect();
        let of_triangle = |corners: &[u32; 3]| {
            let own = others.get(&key(*corners));
            corners.map(|vertex| {
                let found = own.and_then(|own| own.iter().find(|other| merged(other) == vertex));
                color(found.copied().unwrap_or(vertex))
            })
        };
        Some(Self(mesh.triangles.par_iter().map(of_triangle).collect()))
    }

    /// The color of a triangle with its corners.
    pub fn tint(&self, triangle: usize, [p, q, r]: [DVec3; 3]) -> Tint {
        Tint::of_triangle(self.0[triangle], 0.5 * (q - p).cross(r - p).length())
    }

    /// Splits triangles, those first whose color is off by most, until each is off by `most` at the most, a length, or there are `count`. At each step
    /// all at one edge: so no vertex comes to lie on a side. Whether any was.
    pub fn split(&mut self, mesh: &mut Mesh, count: usize, most: f64) -> bool {
        let count = count.min(MOST);
        let off = |paint: &Self, mesh: &Mesh, i: usize| {
            let tint = paint.tint(i, mesh.triangles[i].map(|vertex| mesh.positions[vertex as usize]));
            (!tint.is_within(most)).then(|| Worst { off: tint.off(), triangle: i })
        };
        if mesh.triangles.len() >= count {
            return false;
        }
        let mut worst: BinaryHeap<Worst> =
            (0..mesh.triangles.len()).filter_map(|i| off(self, mesh, i)).collect();
        if worst.is_empty() {
            return false;
        }
        let key = |a: u32, b: u32| (a.min(b), a.max(b));
        let mut at_edge: HashMap<(u32, u32), Vec<usize>> = HashMap::new();
        for (i, [a, b, c]) in mesh.triangles.iter().enumerate() {
            for (from, to) in [(a, b), (b, c), (c, a)] {
                at_edge.entry(key(*from, *to)).or_default().push(i);
            }
        }
        while let Some(Worst { off: was, triangle }) = worst.pop() {
            if mesh.triangles.len() >= count {
                break;
            }
            // Split since.
            if off(self, mesh, triangle).is_none_or(|now| now.off < was) {
                continue;
            }
            let (a, b) = self.edge(mesh, triangle);
            let middle = mesh.positions.len() as u32;
            mesh.positions.push(0.5 * (mesh.positions[a as usize] + mesh.positions[b as usize]));
            for i in at_edge.remove(&key(a, b)).unwrap_or_default() {
                let new = mesh.triangles.len();
                let (corners, colors) = (mesh.triangles[i], self.0[i]);
                let at = |vertex: u32| corners.iter().position(|corner| *corner == vertex).unwrap_or(0);
                let (at_a, at_b) = (at(a), at(b));
                let third = corners[3 - at_a - at_b];
                let (mut own, mut other) = ((corners, colors), (corners, colors));
                let between = 0.5 * (colors[at_a] + colors[at_b]);
                (own.0[at_b], own.1[at_b]) = (middle, between);
                (other.0[at_a], other.1[at_a]) = (middle, between);
                (mesh.triangles[i], self.0[i]) = own;
                mesh.triangles.push(other.0);
                self.0.push(other.1);
                at_edge.entry(key(a, middle)).or_default().push(i);
                at_edge.entry(key(middle, b)).or_default().push(new);
                at_edge.entry(key(middle, third)).or_default().extend([i, new]);
                let beyond = at_edge.entry(key(b, third)).or_default();
                beyond.iter_mut().filter(|old| **old == i).for_each(|old| *old = new);
                worst.extend([i, new].into_iter().filter_map(|i| off(self, mesh, i)));
            }
        }
        true
    }

    /// Where a triangle is split: at the longest of the edges along which its color changes by most, or by more than half of that.
    fn edge(&self, mesh: &Mesh, triangle: usize) -> (u32, u32) {
        let (corners, colors) = (mesh.triangles[triangle], self.0[triangle]);
        let changes = |i: usize| colors[i].distance(colors[(i + 1) % 3]);
        let length = |i: usize| {
            let [a, b] = [corners[i], corners[(i + 1) % 3]].map(|vertex| mesh.positions[vertex as usize]);
            a.distance(b)
        };
        let most = (0..3).map(changes).fold(0.0, f32::max);
        let by_length = |a: &usize, b: &usize| length(*a).total_cmp(&length(*b));
        let longest = (0..3).filter(|i| changes(*i) >= 0.5 * most).max_by(by_length).unwrap_or(0);
        (corners[longest], corners[(longest + 1) % 3])
    }
}

/// A triangle whose color is off.
struct Worst {
    off: f64,
    triangle: usize,
}

impl Ord for Worst {
    fn cmp(&self, other: &Self) -> Ordering {
        self.off.total_cmp(&other.off).then(other.triangle.cmp(&self.triangle))
    }
}

impl PartialOrd for Worst {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Worst {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Worst {}
