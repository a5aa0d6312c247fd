//! A mesh cut into cells, each of which is drawn as polygons or as splats: the leaves of a tree whose nodes have up to eight children.
//!
//! Three times a part is cut in two at the median of its triangles' middles along its longest side, by what it has of the samples. So each
//! cell has about as many samples, wherever triangles are small or large, and half of [`MOST_SAMPLES`] unless triangles are so large that
//! there is no such cut.

use std::ops::Range;

use glam::DVec3;

use crate::{
    geometry::hierarchy::Child,
    scene::{Bounds, Mesh},
};

/// A part with more samples is cut, if both halves are left with so many.
const MOST_SAMPLES: f64 = 256.0;
const LEAST_SAMPLES: f64 = 48.0;

/// How a mesh is cut.
pub(super) struct Cells {
    /// The numbers of its triangles, cell by cell.
    pub order: Vec<u32>,
    /// Places of `order`.
    pub cells: Vec<Range<usize>>,
    /// The children of the nodes above, the first of which is the root; none of a single cell.
    pub nodes: Vec<Vec<Child>>,
}

/// A triangle, while it finds its place.
#[derive(Clone, Copy)]
struct Piece {
    middle: DVec3,
    samples: f64,
    number: u32,
}

impl Cells {
    /// Those of a mesh without degenerate triangles, of which each unit of area has so many samples.
    pub fn of(mesh: &Mesh, samples_per_area: f64) -> Self {
        let piece = |(number, triangle): (u32, &[u32; 3])| {
            let [a, b, c] = triangle.map(|vertex| mesh.positions[vertex as usize]);
            let samples = 0.5 * (b - a).cross(c - a).length() * samples_per_area;
            Piece { middle: (a + b + c) / 3.0, samples, number }
        };
        let mut pieces: Vec<Piece> = (0..).zip(&mesh.triangles).map(piece).collect();
        let mut cells = Self { order: Vec::new(), cells: Vec::new(), nodes: Vec::new() };
        let mut open = std::collections::VecDeque::new();
        if let Some(parts) = parts(&mut pieces, 0..mesh.triangles.len()) {
            cells.nodes.push(Vec::new());
            open.push_back((0, parts));
        } else {
            cells.cells.push(0..mesh.triangles.len());
        }
        while let Some((node, ranges)) = open.pop_front() {
            for range in ranges {
                let child = match parts(&mut pieces, range.clone()) {
                    Some(parts) => {
                        cells.nodes.push(Vec::new());
                        open.push_back((cells.nodes.len() - 1, parts));
                        Child::Node(cells.nodes.len() - 1)
                    }
                    None => {
                        cells.cells.push(range);
                        Child::Part(cells.cells.len() - 1)
                    }
                };
                cells.nodes[node].push(child);
            }
        }
        cells.order = pieces.iter().map(|piece| piece.number).collect();
        cells
    }
}

/// Up to eight parts of a run of pieces; `None` where it is a cell.
fn parts(pieces: &mut [Piece], run: Range<usize>) -> Option<Vec<Range<usize>>> {
    let mut parts = vec![run];
    for _ in 0..3 {
        let cut = |part: Range<usize>| match cut_in_two(&mut pieces[part.clone()]) {
            Some(first) => vec![part.start..part.start + first, part.start + first..part.end],
            None => vec![part],
        };
        parts = parts.into_iter().flat_map(cut).collect();
    }
    (parts.len() > 1).then_some(parts)
}

/// Sorts pieces so that the first half of the samples comes first, and tells how many pieces these are.
fn cut_in_two(pieces: &mut [Piece]) -> Option<usize> {
    let all: f64 = pieces.iter().map(|piece| piece.samples).sum();
    if all <= MOST_SAMPLES {
        return None;
    }
    let bounds = pieces.iter().map(|piece| Bounds::of_ball(piece.middle, 0.0)).reduce(Bounds::union)?;
    let axis = (bounds.max - bounds.min).max_position();
    pieces.sort_unstable_by(|a, b| a.middle[axis].total_cmp(&b.middle[axis]).then(a.number.cmp(&b.number)));
    let mut before = 0.0;
    let sums = pieces.iter().map(|piece| {
        before += piece.samples;
        before
    });
    // The place with the larger least half.
    let least = |before: f64| before.min(all - before);
    let (first, half) = sums
        .enumerate()
        .map(|(place, before)| (place + 1, least(before)))
        .max_by(|a, b| a.1.total_cmp(&b.1))?;
    (half >= LEAST_SAMPLES).then_some(first)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::load::builtin::sphere_mesh;

    /// Each triangle once; each cell once below the root; as many samples as a cell is to have.
    #[test]
    fn every_triangle_is_in_one_cell_of_about_as_many_samples() {
        let mesh = sphere_mesh(20_000);
        let Cells { order, cells, nodes } = Cells::of(&mesh, 10_000.0 / (4.0 * std::f64::consts::PI));
        let mut sorted = order.clone();
        sorted.sort_unstable();
        assert!(sorted.into_iter().eq(0..mesh.triangles.len() as u32));
        assert!(cells.iter().map(|cell| cell.len()).sum::<usize>() == order.len());
        let mut seen = vec![0; cells.len()];
        let mut reached = vec![0; nodes.len()];
        for child in nodes.iter().flatten() {
            match *child {
                Child::Part(cell) => seen[cell] += 1,
                Child::Node(node) => reached[node] += 1,
            }
        }
        assert!(seen.iter().all(|times| *times == 1), "{seen:?}");
        assert!(reached[0] == 0 && reached[1..].iter().all(|times| *times == 1), "{reached:?}");
        assert!(nodes.iter().all(|children| (2..=8).contains(&children.len())));
        let samples = cells.iter().map(|cell| cell.len() as f64 * 10_000.0 / mesh.triangles.len() as f64);
        assert!(samples.clone().all(|samples| (100.0..=260.0).contains(&samples)));
        assert!(cells.len() > 40, "{}", cells.len());
    }

    /// A triangle alone may have all samples; nothing may be cut off it with next to none.
    #[test]
    fn large_triangles_stay_whole() {
        let mut mesh = sphere_mesh(20);
        mesh.positions.extend([DVec3::ZERO, 1e3 * DVec3::X, 1e3 * DVec3::Y]);
        let last = mesh.positions.len() as u32;
        mesh.triangles.push([last - 3, last - 2, last - 1]);
        let Cells { cells, nodes, .. } = Cells::of(&mesh, 1.0);
        assert!(cells.len() == 1 && nodes.is_empty(), "{cells:?}");
    }
}
