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

use std::mem;

use glam::{DVec2, DVec3};

/// How far corners of a cell may be, in distances of the 6th neighbor.
const WIDEST_GAP: f64 = 1.5;

/// A disk's least radius.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Reach {
    pub distance: f64,
    /// No neighbor closes the cell on some side.
    pub open: bool,
}

/// A corner, and whether the edge to the next one is a neighbor's.
type Corner = (DVec2, bool);

/// Convex polygons around 0: a cell, and what is cut of it. One point after another uses their memory.
#[derive(Default)]
pub(super) struct Cells {
    cell: Vec<Corner>,
    rest: Vec<Corner>,
}

impl Cells {
    /// The reach of a point's cell in its tangent plane, from its neighbors' offsets, nearest first. Zero without any.
    pub(super) fn reach(&mut self, normal: DVec3, offsets: &[DVec3]) -> Reach {
        let Some(sixth) = offsets.get(5).or(offsets.last()) else {
            return Reach { distance: 0.0, open: true };
        };
        let (u, v) = normal.any_orthonormal_pair();
        self.begin(WIDEST_GAP * sixth.length());
        let mut farthest_squared = farthest(&self.cell, |_| true);
        for offset in offsets {
            let squared = offset.length_squared();
            // From here on no neighbor is near enough.
            if squared > 4.0 * farthest_squared {
                break;
            }
            let along = DVec2::new(offset.dot(u), offset.dot(v));
            if along.length_squared() * farthest_squared > 0.25 * squared * squared {
                self.cut(along, 0.5 * squared);
                farthest_squared = farthest(&self.cell, |_| true);
            }
        }
        let corners = &self.cell;
        let closed = |i: usize| corners[i].1 && corners[(i + corners.len() - 1) % corners.len()].1;
        let open = !(0..corners.len()).all(closed);
        let distance = match open {
            false => farthest_squared.sqrt(),
            true => {
                let third = offsets.get(2).or(offsets.last()).map_or(0.0, |offset| offset.length());
                farthest(corners, closed).sqrt().max(third.min(farthest_squared.sqrt()))
            }
        };
        Reach { distance, open }
    }

    /// With a regular octagon around a circle of that radius.
    fn begin(&mut self, radius: f64) {
        self.cell.clear();
        // tan(π/8): the half of an edge.
        let half = radius * (2.0_f64.sqrt() - 1.0);
        let ways = [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)];
        for (i, (x, y)) in ways.into_iter().enumerate() {
            let pair = [DVec2::new(x * radius, y * half), DVec2::new(x * half, y * radius)];
            let [first, second] = if i % 2 == 0 { pair } else { [pair[1], pair[0]] };
            self.cell.extend([(first, false), (second, false)]);
        }
    }

    /// Of the cell only the x with x·along ≤ limit stay.
    fn cut(&mut self, along: DVec2, limit: f64) {
        let beyond = |corner: &Corner| corner.0.dot(along) - limit;
        let Self { cell, rest } = self;
        rest.clear();
        let Some(mut from) = cell.last() else { return };
        let mut before = beyond(from);
        for corner in cell.iter() {
            let here = beyond(corner);
            if (before <= 0.0) != (here <= 0.0) {
                let crossing = from.0.lerp(corner.0, before / (before - here));
                // Outward through this edge the new one begins; inward the rest of this one does.
                rest.push((crossing, before <= 0.0 || from.1));
            }
            if here <= 0.0 {
                rest.push(*corner);
            }
            (from, before) = (corner, here);
        }
        mem::swap(cell, rest);
    }
}

fn farthest(corners: &[Corner], part: impl Fn(usize) -> bool) -> f64 {
    let squared = |(i, corner): (usize, &Corner)| part(i).then_some(corner.0.length_squared());
    corners.iter().enumerate().filter_map(squared).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

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
        assert!(!found.open && (found.distance - 0.5_f64.sqrt()).abs() < 1e-12, "{found:?}");
        let oblong = reach(-DVec3::Z, &grid(DVec2::new(1.0, 2.0), |_| true));
        assert!(!oblong.open && (oblong.distance - 1.25_f64.sqrt()).abs() < 1e-12, "{oblong:?}");
    }

    #[test]
    fn at_a_border_it_reaches_no_farther_than_its_neighbors() {
        let found = reach(DVec3::Z, &grid(DVec2::ONE, |o| o.x <= 0.0));
        assert!(found.open && (found.distance - 1.0).abs() < 1e-12, "{found:?}");
        assert_eq!(reach(DVec3::Z, &[]), Reach { distance: 0.0, open: true });
        let one = reach(DVec3::Z, &[DVec3::new(0.0, 2.0, 0.0)]);
        assert!(one.open && one.distance == 2.0, "{one:?}");
    }

    #[test]
    fn a_point_right_below_cuts_nothing() {
        let mut offsets = grid(DVec2::ONE, |_| true);
        offsets.insert(0, DVec3::new(0.0, 0.0, -0.1));
        assert!((reach(DVec3::Z, &offsets).distance - 0.5_f64.sqrt()).abs() < 1e-12);
    }
}
