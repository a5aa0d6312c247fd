//! Whether a mesh is the boundary of something.

use glam::DVec3;

use super::corners;
use crate::scene::Mesh;

/// How the faces hang together.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Edges {
    /// Edges of one face only.
    pub boundary: usize,
    /// Edges of more than two faces, or of two that pass them in the same direction.
    pub irregular: usize,
    /// Edges of two faces that pass them in opposite directions.
    pub regular: usize,
}

impl Edges {
    /// Counts the edges of all faces with three different corners, flat ones too: they hold their neighbors together.
    pub(super) fn of(mesh: &Mesh) -> Self {
        // One list for each direction of passing an edge, sorted by the edge.
        let (mut up, mut down) = (Vec::new(), Vec::new());
        up.reserve(mesh.triangles.len() * 3 / 2);
        down.reserve(mesh.triangles.len() * 3 / 2);
        for &[a, b, c] in mesh.triangles.iter().filter(|[a, b, c]| a != b && b != c && c != a) {
            for (from, to) in [(a, b), (b, c), (c, a)] {
                let key = u64::from(from.min(to)) << 32 | u64::from(from.max(to));
                if from < to { up.push(key) } else { down.push(key) }
            }
        }
        up.sort_unstable();
        down.sort_unstable();
        let (mut up, mut down) = (up.as_slice(), down.as_slice());
        let mut edges = Self::default();
        while let Some(&key) = [up.first(), down.first()].into_iter().flatten().min() {
            match (take_equal(&mut up, key), take_equal(&mut down, key)) {
                (1, 1) => edges.regular += 1,
                (1, 0) | (0, 1) => edges.boundary += 1,
                _ => edges.irregular += 1,
            }
        }
        edges
    }

    /// Every edge lies between two faces that pass it in opposite directions: a closed, consistently oriented surface.
    pub(super) fn closed(&self) -> bool {
        self.regular > 0 && self.boundary == 0 && self.irregular == 0
    }
}

fn take_equal(sorted: &mut &[u64], key: u64) -> usize {
    let count = sorted.iter().take_while(|&&k| k == key).count();
    *sorted = &sorted[count..];
    count
}

/// The volume inside a closed mesh, in world units cubed; negative where its faces are clockwise seen from outside.
pub(super) fn signed_volume(mesh: &Mesh) -> f64 {
    let Some(&origin) = mesh.positions.iter().find(|p| p.is_finite()) else { return 0.0 };
    let six_fold = |p: [DVec3; 3]| (p[0] - origin).dot((p[1] - origin).cross(p[2] - origin));
    mesh.triangles.iter().filter_map(|&t| corners(mesh, t)).map(six_fold).sum::<f64>() / 6.0
}
