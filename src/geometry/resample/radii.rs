//! Radii of disks at points that are spread evenly over a surface.

use glam::DVec3;

use crate::{
    geometry::neighbors::{NEIGHBORS, Point, Tree},
    progress::Progress,
};

/// A disk's radius in units of the mean distance to its 6 nearest neighbors.
pub const RADIUS_PER_DISTANCE: f64 = 1.5;

/// The mean distance to the 6 nearest neighbors of independent points on a plane, in units of the square root of a
/// point's share of the area: the mean over k of Γ(k + ½)/(Γ(k) √π), k from 1 to 6.
const MEAN_DISTANCE_PER_SPACING: f64 = 0.977_539_062_5;

/// The mean distance is taken as at most so many times the expected. At a straight edge of a surface it is √2 times, at
/// a right-angled corner 2 times as large as inside; beyond that a point is alone on a small part, and its neighbors
/// are elsewhere: a disk that reaches them would be far larger than what it stands for.
const MOST_PER_EXPECTED: f64 = 3.0;

/// For points that have `area_per_point` each, in world units squared.
pub(in crate::geometry) fn radii(
    positions: &[DVec3],
    area_per_point: f64,
    progress: &dyn Progress,
) -> Vec<f32> {
    const TASK: &str = "distances of neighbors";
    let expected = MEAN_DISTANCE_PER_SPACING * area_per_point.sqrt();
    let mut radii = vec![(RADIUS_PER_DISTANCE * expected) as f32; positions.len()];
    // Too few to tell: the expected distance it is.
    if positions.len() <= NEIGHBORS {
        return radii;
    }
    progress.step(TASK, 0, positions.len() as u64);
    let mut points = Vec::with_capacity(positions.len());
    points.extend((0_u32..).zip(positions).map(|(number, &position)| Point { position, number }));
    let tree = Tree::new(points);
    tree.distances(
        |number, distances| {
            let mean = distances.iter().sum::<f64>() / NEIGHBORS as f64;
            // Zero where f64 has no digits left for the triangle: the points are one.
            let mean = if mean > 0.0 { mean.min(MOST_PER_EXPECTED * expected) } else { expected };
            radii[number as usize] = (RADIUS_PER_DISTANCE * mean) as f32;
        },
        |done| progress.step(TASK, done as u64, positions.len() as u64),
    );
    radii
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_expected_distance_is_that_of_its_formula() {
        // Γ(k + ½)/Γ(k) by recurrence from Γ(3/2)/Γ(1) = √π/2.
        let mut ratio = 0.5;
        let mut sum = 0.0;
        for k in 1..=NEIGHBORS {
            sum += ratio;
            ratio *= (k as f64 + 0.5) / k as f64;
        }
        assert!((sum / NEIGHBORS as f64 - MEAN_DISTANCE_PER_SPACING).abs() < 1e-12, "{}", sum / 6.0);
    }
}
