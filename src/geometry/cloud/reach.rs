//! How far a point's disk must reach so that the surface closes.
//!
//! **The gap rule.** Give every point of the surface to the sample nearest to it, as with meshes (`radii.rs`): a sample's disk must
//! reach the farthest of its points. In the sample's tangent plane these are its Voronoi cell: the x with x·d ≤ |d|²/2 for the
//! offset d in space of each neighbor. The disk's radius is the distance of the cell's farthest corner. Every point of the plane
//! is then in the disk of the sample that is nearest to it, and no smaller radii do that for all.
//!
//! A cell that no neighbor closes is at the border of the surface, or of a hole in the sampling. It is cut where corners would be
//! farther than [`WIDEST_GAP`] distances of the 6th neighbor: in between, two mean distances or so, gaps are closed, and wider
//! ones are the surface's own. At such a cut a disk reaches as far as its closed corners or its third neighbor.
//!
//! Neighbors of other faces are no neighbors: the other side of a plate, and what lies behind an edge. A disk there is seen from
//! its edge, and covers nothing of this face, so that its point must not take a part of this cell.

use std::f32::consts::FRAC_1_SQRT_2;

use glam::{DVec3, Vec2, Vec4};

/// How far corners of a cell may be, in distances of the 6th neighbor.
const WIDEST_GAP: f64 = 1.5;

/// The sides of the polygon about a circle of that radius.
const SIDES: usize = 8;

/// A disk's least radius.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Reach {
    pub distance: f64,
    /// No neighbor closes the cell on some side.
    pub open: bool,
}

/// Half of the squared distance from which on a neighbor's line is beyond the corners of the octagon, in its radii.
const BEYOND: f64 = 2.5;

/// Of four lines the x and y of their directions, and the limits: on the cell's side x·along ≤ limit.
type Four = [Vec4; 3];

/// A regular octagon about a circle of radius 1.
const OCTAGON: [Four; SIDES / 4] = {
    const H: f32 = FRAC_1_SQRT_2;
    [
        [Vec4::new(1.0, H, 0.0, -H), Vec4::new(0.0, H, 1.0, H), Vec4::ONE],
        [Vec4::new(-1.0, -H, 0.0, H), Vec4::new(0.0, -H, -1.0, -H), Vec4::ONE],
    ]
};

/// Lines around 0: the octagon's, then the neighbors', in radii of its circle. One point after another uses their memory.
///
/// The cell between them is walked around: from a corner along a line to the one that is met first. All lines are looked at each time, four at once and
/// without a branch. However near lines lie to each other, the way never leaves the cell by more than rounding does, 1e-6 of the radius.
#[derive(Default)]
pub(super) struct Cells {
    lines: Vec<Four>,
    /// How long the way is up to each.
    lengths: Vec<Vec4>,
}

impl Cells {
    /// The reach of a point's cell in its tangent plane, from its neighbors' offsets, nearest first, 56 at most. Zero without any.
    pub(super) fn reach(&mut self, normal: DVec3, offsets: &[DVec3]) -> Reach {
        let Some(sixth) = offsets.get(5).or(offsets.last()) else {
            return Reach { distance: 0.0, open: true };
        };
        let radius = WIDEST_GAP * sixth.length();
        self.lines.clear();
        self.lines.extend(OCTAGON);
        let (u, v) = normal.any_orthonormal_pair();
        let (u, v) = (u / radius, v / radius);
        for offsets in offsets.chunks(4) {
            let [mut x, mut y, mut limits] = [Vec4::ZERO, Vec4::ZERO, Vec4::MAX];
            for (i, offset) in offsets.iter().enumerate() {
                let limit = 0.5 * offset.length_squared() / (radius * radius);
                if limit > 0.0 && limit < BEYOND {
                    (x[i], y[i], limits[i]) = (offset.dot(u) as f32, offset.dot(v) as f32, limit as f32);
                }
            }
            self.lines.push([x, y, limits]);
        }
        let (mut farthest, mut closed, mut open) = (0.0_f32, 0.0_f32, false);
        let (mut corner, first) = self.next(Vec2::ZERO, Vec2::X);
        let mut line = first;
        // Of lines that are equal but for rounding the first may not be met again.
        for _ in 0..SIDES + offsets.len() {
            let (next, met) = self.next(corner, self.along(line).perp());
            let squared = next.length_squared();
            farthest = farthest.max(squared);
            match line.min(met) < SIDES {
                true => open = true,
                false => closed = closed.max(squared),
            }
            (corner, line) = (next, met);
            if met == first {
                break;
            }
        }
        let [farthest, closed] = [farthest, closed].map(|squared| radius * f64::from(squared).sqrt());
        let distance = match open {
            false => farthest,
            true => {
                let third = offsets.get(2).or(offsets.last()).map_or(0.0, |offset| offset.length());
                closed.max(third.min(farthest))
            }
        };
        Reach { distance, open }
    }

    fn along(&self, number: usize) -> Vec2 {
        let [x, y, _] = &self.lines[number / 4];
        Vec2::new(x[number % 4], y[number % 4])
    }

    /// Where the way from a place inside first meets a line, and that line's number. No line of the octagon is met inside its circle.
    fn next(&mut self, from: Vec2, way: Vec2) -> (Vec2, usize) {
        let of_neighbors = self.next_from(OCTAGON.len(), from, way);
        match of_neighbors.0.length_squared() <= 1.0 {
            true => of_neighbors,
            false => self.next_from(0, from, way),
        }
    }

    /// Of the lines from a four on.
    fn next_from(&mut self, first: usize, from: Vec2, way: Vec2) -> (Vec2, usize) {
        let mut nearest = Vec4::MAX;
        self.lengths.clear();
        self.lengths.extend(self.lines[first..].iter().map(|[x, y, limit]| {
            let toward = way.x * x + way.y * y;
            let left = limit - (from.x * x + from.y * y);
            let length = Vec4::select(toward.cmpgt(Vec4::ZERO), left.max(Vec4::ZERO) / toward, Vec4::MAX);
            nearest = nearest.min(length);
            length
        }));
        let nearest = nearest.min_element();
        let is_nearest =
            |(i, four): (usize, &Vec4)| u64::from(four.cmple(Vec4::splat(nearest)).bitmask()) << (4 * i);
        let lines = self.lengths.iter().enumerate().map(is_nearest).fold(0, |all, four| all | four);
        (from + way * nearest, 4 * first + lines.trailing_zeros() as usize)
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use glam::DVec2;

    use super::*;
    use crate::{geometry::cloud::plane::MOST_NEIGHBORS, math::random::SplitMix};

    fn reach(normal: DVec3, offsets: &[DVec3]) -> Reach {
        Cells::default().reach(normal, offsets)
    }

    fn grid(spacing: DVec2, part: impl Fn(DVec3) -> bool) -> Vec<DVec3> {
        let one = |i: i32| spacing * DVec2::new(f64::from(i % 7 - 3), f64::from(i / 7 - 3));
        let mut all: Vec<DVec3> =
            (0..49).map(|i| one(i).extend(0.0)).filter(|o| o.length() > 0.0 && part(*o)).collect();
        all.sort_by(|a, b| a.length().total_cmp(&b.length()));
        all
    }

    #[test]
    fn on_a_grid_a_disk_reaches_the_middle_of_its_squares() {
        let found = reach(DVec3::Z, &grid(DVec2::ONE, |_| true));
        assert!(!found.open && (found.distance - 0.5_f64.sqrt()).abs() < 1e-6, "{found:?}");
        let oblong = reach(-DVec3::Z, &grid(DVec2::new(1.0, 2.0), |_| true));
        assert!(!oblong.open && (oblong.distance - 1.25_f64.sqrt()).abs() < 1e-6, "{oblong:?}");
    }

    #[test]
    fn at_a_border_it_reaches_no_farther_than_its_neighbors() {
        let found = reach(DVec3::Z, &grid(DVec2::ONE, |o| o.x <= 0.0));
        assert!(found.open && (found.distance - 1.0).abs() < 1e-6, "{found:?}");
        assert_eq!(reach(DVec3::Z, &[]), Reach { distance: 0.0, open: true });
        let one = reach(DVec3::Z, &[DVec3::new(0.0, 2.0, 0.0)]);
        assert!(one.open && one.distance == 2.0, "{one:?}");
    }

    #[test]
    fn a_point_right_below_cuts_nothing() {
        let mut offsets = grid(DVec2::ONE, |_| true);
        offsets.insert(0, DVec3::new(0.0, 0.0, -0.1));
        assert!((reach(DVec3::Z, &offsets).distance - 0.5_f64.sqrt()).abs() < 1e-6);
    }
    /// Of all crossings of two lines those that no line cuts off, and whether one is the octagon's.
    fn corners(lines: &[(DVec2, f64)]) -> (f64, bool) {
        let (mut farthest, mut open) = (0.0_f64, false);
        for (i, (a, at_a)) in lines.iter().enumerate() {
            for (j, (b, at_b)) in lines.iter().enumerate().take(i) {
                let across = a.perp_dot(*b);
                if across.abs() < 1e-9 * a.length() * b.length() {
                    continue;
                }
                let corner = DVec2::new(at_a * b.y - at_b * a.y, at_b * a.x - at_a * b.x) / across;
                if lines.iter().all(|(line, limit)| corner.dot(*line) <= limit + 1e-9 * limit.max(1.0)) {
                    farthest = farthest.max(corner.length());
                    open |= j.min(i) < SIDES;
                }
            }
        }
        (farthest, open)
    }

    #[test]
    fn the_way_around_finds_the_corners_that_all_pairs_of_lines_have() {
        let mut random = SplitMix(12);
        let (mut open, mut closed) = (0, 0);
        for case in 0..3000 {
            let scale = 10.0_f64.powi(case % 201 - 100);
            let mut unit = || 2.0 * random.unit() - 1.0;
            let mut offsets: Vec<DVec3> = (0..[2, 6, 12, 24, 48][case as usize % 5])
                .map(|_| scale * DVec3::new(unit(), unit(), 0.2 * unit()))
                .collect();
            match case % 7 {
                0 => offsets.extend_from_within(..2),
                1 => offsets.iter_mut().for_each(|offset| *offset = (*offset / scale * 2.0).round() * scale),
                2 => offsets.push(DVec3::splat(1e60 * scale)),
                3 => (0..offsets.len()).for_each(|i| {
                    let beside = scale * DVec3::new(unit(), unit(), unit());
                    offsets.push(offsets[i] + 10.0_f64.powi(-3 - case % 5) * beside);
                }),
                _ => {}
            }
            offsets.retain(|offset| offset.length() > 1e-3 * scale);
            offsets.sort_by(|a, b| a.length_squared().total_cmp(&b.length_squared()));
            offsets.truncate(MOST_NEIGHBORS);
            let Some(sixth) = offsets.get(5).or(offsets.last()) else { continue };
            let radius = WIDEST_GAP * sixth.length();
            let octagon = (0..SIDES).map(|i| (DVec2::from_angle(i as f64 * PI / 4.0), 1.0));
            let (u, v) = DVec3::Z.any_orthonormal_pair();
            let line = |offset: &DVec3| {
                let offset = *offset / radius;
                (DVec2::new(offset.dot(u), offset.dot(v)), 0.5 * offset.length_squared())
            };
            let near = offsets.iter().filter(|offset| offset.length() < 3.0 * radius);
            let (farthest, is_open) = corners(&octagon.chain(near.map(line)).collect::<Vec<_>>());
            let found = reach(DVec3::Z, &offsets);
            let third = offsets.get(2).or(offsets.last()).unwrap().length();
            // Where it is open, closed corners decide, or the third neighbor.
            if !is_open && !found.open {
                closed += 1;
                assert!((found.distance / radius - farthest).abs() < 1e-5, "{case}: {found:?} {farthest}");
            } else if is_open && found.open {
                open += 1;
                let least = third.min(farthest * radius);
                assert!((0.99999 * least..=1.00001 * farthest * radius).contains(&found.distance));
            } else {
                // A corner of the octagon that rounding cuts off.
                assert!((farthest - 1.0).abs() < 0.09, "{case}: {found:?} {farthest} {is_open}");
            }
        }
        assert!(open > 500 && closed > 500, "{open} {closed}");
    }
}
