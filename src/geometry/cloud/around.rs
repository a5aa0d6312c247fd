//! Whether scanners stood among what they saw, as in a room or a street: from outside it is seen from behind, and hides what is in it.

use glam::DVec3;

use crate::scene::{Points, Viewpoint};

/// Parts of the full circle about an axis.
const SECTORS: usize = 8;

/// A part has something that has one point in so many.
const FEW: usize = 200;

/// Tangent of the angle from an axis's plane up to which something is beside the scanner: what is farther along is seen before it, as a wall is.
const MOST_ALONG: f64 = 0.5;

/// So many points of a scan are looked at.
const SAMPLES: usize = 10_000;

/// Whether most points were seen from places that are surrounded: about one of the axes there is something on every side.
pub(super) fn surround_scanners(points: &Points) -> bool {
    let mut first = 0;
    let mut surrounding = 0;
    for Viewpoint { end, place } in &points.viewpoints {
        let seen = points.positions.get(first..*end).unwrap_or_default();
        if surround(seen, *place) {
            surrounding += seen.len();
        }
        first = *end;
    }
    2 * surrounding > points.positions.len()
}

fn surround(points: &[DVec3], place: DVec3) -> bool {
    let step = points.len() / SAMPLES + 1;
    let mut counts = [[0; SECTORS]; 3];
    for point in points.iter().step_by(step) {
        let away = *point - place;
        let about = [[away.x, away.y, away.z], [away.y, away.z, away.x], [away.z, away.x, away.y]];
        for (counts, [along, x, y]) in counts.iter_mut().zip(about) {
            if along.abs() > MOST_ALONG * x.hypot(y) {
                continue;
            }
            let part = (y.atan2(x) / std::f64::consts::TAU + 0.5) * SECTORS as f64;
            counts[(part as usize).min(SECTORS - 1)] += 1;
        }
    }
    let least = (points.len() / step / FEW).max(1);
    counts.iter().any(|sectors| sectors.iter().all(|count| *count >= least))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::SplitMix;

    /// Walls of a room of 6 by 4, one of them left out or none, and what a place before and a place within it is.
    #[test]
    fn a_scanner_is_surrounded_within_a_room_and_not_before_a_wall() {
        let mut random = SplitMix(3);
        let mut wall = |from: DVec3, along: DVec3| -> Vec<DVec3> {
            (0..500).map(|_| from + along * random.unit() + DVec3::Z * 3.0 * random.unit()).collect()
        };
        let (x, y) = (6.0 * DVec3::X, 4.0 * DVec3::Y);
        let walls = [wall(DVec3::ZERO, x), wall(DVec3::ZERO, y), wall(y, x), wall(x, y)];
        let within = DVec3::new(2.0, 1.5, 1.4);
        let of = |walls: &[Vec<DVec3>], places: &[DVec3]| {
            let positions = walls.concat();
            let count = positions.len() / places.len();
            let views = (1..).zip(places).map(|(i, place)| Viewpoint { end: i * count, place: *place });
            surround_scanners(&Points { viewpoints: views.collect(), positions, ..Points::default() })
        };
        assert!(of(&walls, &[within]));
        assert!(!of(&walls, &[DVec3::new(3.0, -5.0, 1.4)]), "from outside");
        assert!(!of(&walls[..2], &[within]), "an open corner");
        assert!(!surround_scanners(&Points { positions: walls.concat(), ..Points::default() }), "not told");
        assert!(!of(&[walls.concat(), walls.concat()], &[within, DVec3::new(9.0, 9.0, 1.0)]), "half of them");
    }
}
