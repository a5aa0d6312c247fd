//! How far apart splats, points and vertices are.

use glam::DVec3;

use super::neighbors::{Point, Tree};
use crate::scene::Mesh;

/// So many points are asked for their neighbors, spread over all.
const ASKED: usize = 10_000;

/// The mean distance from a point to the nearest other; `None` where there are fewer than two that are finite.
pub fn mean_spacing(positions: &[DVec3]) -> Option<f64> {
    let finite = positions.iter().filter(|position| position.is_finite());
    let origin = *finite.clone().next()?;
    let moved = |(number, position): (u32, &DVec3)| Point { position: *position - origin, number };
    let tree = Tree::new((0..).zip(finite).map(moved).collect());
    let count = tree.points().len();
    let distances = (0..count).step_by(count.div_ceil(ASKED).max(1)).map(|place| -> Option<f64> {
        let [nearest] = tree.nearest_places(place);
        let nearest = tree.points().get(nearest as usize)?;
        Some(tree.points()[place].position.distance(nearest.position))
    });
    mean(distances.flatten())
}

/// The mean length of the triangles' sides; `None` where there is none.
pub fn mean_edge(mesh: &Mesh) -> Option<f64> {
    let corners = (0..mesh.triangles.len()).filter_map(|i| mesh.corners(i));
    mean(corners.flat_map(|[a, b, c]| [a.distance(b), b.distance(c), c.distance(a)]))
}

fn mean(values: impl Iterator<Item = f64>) -> Option<f64> {
    let (count, sum) = values.fold((0_u64, 0.0), |(count, sum), value| (count + 1, sum + value));
    (count > 0).then(|| sum / count as f64)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distances_are_those_to_the_nearest() {
        let line = |count: u32| (0..count).map(|i| DVec3::new(1e6 + 0.5 * f64::from(i), 7.0, 0.0));
        let places: Vec<DVec3> = line(30_000).chain([DVec3::NAN]).collect();
        assert_eq!(mean_spacing(&places), Some(0.5));
        assert_eq!(mean_spacing(&line(1).collect::<Vec<_>>()), None);
        assert_eq!(mean_spacing(&[DVec3::NAN]), None);
        let mesh = Mesh {
            positions: vec![DVec3::ZERO, 3.0 * DVec3::X, 4.0 * DVec3::Y, DVec3::NAN],
            triangles: vec![[0, 1, 2], [0, 1, 3]],
            ..Mesh::default()
        };
        assert_eq!(mean_edge(&mesh), Some(4.0));
        assert_eq!(mean_edge(&Mesh::default()), None);
    }
}
