//! How far a point's disk must reach so that the surface closes.
//!
//! **The gap rule.** Give every point of the surface to the sample nearest to it, as with meshes (`radii.rs`): a sample's disk must
//! reach the farthest of its points. In the sample's tangent plane these are its Voronoi cell: the x with x·d ≤ |d|²/2 for the
//! offset d in space of each neighbor. The disk's radius is the distance of the cell's farthest corner. Every point of the plane
//! is then in the disk of the sample that is nearest to it, and no smaller radii do that for all.
//!
//! A cell that no neighbor closes is at the border of the surface, or of a hole in the sampling. It is cut where corners would be
//! farther than [`WIDEST_GAP`] distances of the 6th neighbor: in between, two mean distances or so, gaps are closed, and wider
//! ones are the surface's own. A far corner behind which there is no neighbor is outside of the surface, too. At such a rim a disk reaches as far as its other corners or its third neighbor, and no farther for the latter than
//! those of its neighbors that are at no rim ([`limit_rims`](super::outliers::limit_rims)).
//!
//! Scan lines have neighbors on the line only: there the gap to the next line counts, if it is not beyond [`WIDEST_BETWEEN_LINES`].
//!
//! Neighbors of other faces are no neighbors: the other side of a plate, and what lies behind an edge. A disk there is seen from
//! its edge, and covers nothing of this face, so that its point must not take a part of this cell. But the cell ends where the planes of the
//! two faces meet, or at the neighbor, if that is farther: there is the edge ([`Cells::cut`]).

use std::f32::consts::FRAC_1_SQRT_2;

use glam::{DVec3, Vec2, Vec4};

/// How far corners of a cell may be, in distances of the 6th neighbor.
const WIDEST_GAP: f64 = 1.5;

/// How far the next scan line may be, in distances of the 6th neighbor, which is 3 points away along a line: 42 times as far as the next point.
const WIDEST_BETWEEN_LINES: f64 = 14.0;

/// So many nearest neighbors are a line.
const LINE: usize = 8;

/// Sine of the angle to the first one up to which neighbors are on its line, and from which on they are beside it.
const LINE_WIDTH: f64 = 0.1;
const BESIDE_LINE: f64 = 0.7;

/// The sides of the polygon about a circle of that radius.
const SIDES: usize = 8;

/// A disk's least radius.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Reach {
    pub distance: f64,
    /// What of it closes the surface toward neighbors; less than all at some rims.
    pub within: f64,
    /// No neighbor closes the cell on some side.
    pub open: bool,
    /// A corner of it is outside of the surface, as far as these neighbors tell.
    pub outside: bool,
}

impl Reach {
    /// The disk is at a rim.
    pub fn is_at_rim(&self) -> bool {
        self.open || self.outside
    }
}

/// Half of the squared distance from which on a neighbor's line is beyond the corners of the octagon, in its radii.
const BEYOND: f64 = 2.5;

/// How far a corner is that may be outside of the surface, in radii of the circle: farther than most inside.
const FAR: f32 = 0.7;

/// How far those are along its direction, at most, that close a gap with it, in distances of the corner.
const FARTHEST: f32 = 2.5;

/// Edges of a cell are one four of lines.
const MOST_CUTS: usize = 4;

/// Sine of the angle between faces from which on their edge is where their planes meet: 60°.
const LEAST_SINE: f64 = 0.866;

/// Cosine of the angle between directions to edges up to which they are one edge.
const SAME_DIRECTION: f64 = 0.8;

/// How near an edge may be, in radii of the circle: at 0 a cell would have no inside.
const NEAREST_CUT: f64 = 1e-3;

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
    /// Directions of unit length, and how far away the edges are.
    cuts: Vec<(DVec3, f64)>,
    /// Where neighbors of other faces are, and where in the plane, in radii of the circle.
    across: Vec<DVec3>,
    across_in_plane: Vec<Vec2>,
    /// How many of the lines are no neighbors'.
    others: usize,
    /// How long the way is up to each.
    lengths: Vec<Vec4>,
}

impl Cells {
    /// The reach of a point's cell in its tangent plane, from its neighbors' offsets, nearest first, 48 at most. Zero without any.
    pub(super) fn reach(&mut self, normal: DVec3, offsets: &[DVec3]) -> Reach {
        let radius = widest_gap(offsets);
        if radius == 0.0 {
            return Reach { distance: 0.0, within: 0.0, open: true, outside: false };
        }
        self.lines.clear();
        self.lines.extend(OCTAGON);
        let (u, v) = normal.any_orthonormal_pair();
        if !self.cuts.is_empty() {
            let [mut x, mut y, mut limits] = [Vec4::ZERO, Vec4::ZERO, Vec4::MAX];
            for (i, (along, distance)) in self.cuts.iter().enumerate() {
                let limit = (distance / radius).max(NEAREST_CUT);
                (x[i], y[i], limits[i]) = (along.dot(u) as f32, along.dot(v) as f32, limit as f32);
            }
            self.lines.push([x, y, limits]);
        }
        self.others = 4 * self.lines.len();
        let (u, v) = (u / radius, v / radius);
        let in_plane = |offset: &DVec3| Vec2::new(offset.dot(u) as f32, offset.dot(v) as f32);
        self.across_in_plane.clear();
        self.across_in_plane.extend(self.across.iter().map(in_plane));
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
        let (mut farthest, mut closed, mut open, mut outside) = (0.0_f32, 0.0_f32, false, false);
        let (mut corner, first) = self.next(Vec2::ZERO, Vec2::X);
        let mut line = first;
        // Of lines that are equal but for rounding the first may not be met again.
        for _ in 0..SIDES + MOST_CUTS + offsets.len() {
            let (next, met) = self.next(corner, self.along(line).perp());
            let squared = next.length_squared();
            farthest = farthest.max(squared);
            match line.min(met) < SIDES {
                true => open = true,
                false if line.min(met) >= self.others && self.is_outside(next, [line, met]) => outside = true,
                false => closed = closed.max(squared),
            }
            (corner, line) = (next, met);
            if met == first {
                break;
            }
        }
        let [farthest, closed] = [farthest, closed].map(|squared| radius * f64::from(squared).sqrt());
        let distance = match open || outside {
            false => farthest,
            true => {
                let third = offsets.get(2).or(offsets.last()).map_or(0.0, |offset| offset.length());
                closed.max(third.min(farthest))
            }
        };
        Reach { distance, within: closed, open, outside }
    }

    /// Adds the edge to the face of a neighbor at an offset, of which there are [`MOST_CUTS`]; to faces in one direction the farther.
    pub(super) fn cut(&mut self, normal: DVec3, other: DVec3, offset: DVec3) {
        self.across.push(offset);
        let along = other - normal * normal.dot(other);
        let sine = along.length();
        if sine < LEAST_SINE {
            return;
        }
        let along = if offset.dot(along) < 0.0 { -along / sine } else { along / sine };
        let distance = (other.dot(offset).abs() / sine).max(offset.dot(along));
        if let Some((_, own)) = self.cuts.iter_mut().find(|(own, _)| own.dot(along) > SAME_DIRECTION) {
            *own = own.max(distance);
        } else if self.cuts.len() < MOST_CUTS {
            self.cuts.push((along, distance));
        }
    }

    /// Forgets the edges of the point before.
    pub(super) fn uncut(&mut self) {
        self.cuts.clear();
        self.across.clear();
    }

    /// Whether a corner between two neighbors is outside of the surface: far away, not within the triangle with them, and no other neighbor, of
    /// whatever face, is beyond it, within 45° of its direction.
    fn is_outside(&self, corner: Vec2, between: [usize; 2]) -> bool {
        let squared = corner.length_squared();
        if squared < FAR * FAR {
            return false;
        }
        let [a, b] = between.map(|line| self.along(line));
        let dot = a.dot(b);
        if dot > 0.0 && a.length_squared() > dot && b.length_squared() > dot {
            return false;
        }
        let beyond = |(i, [x, y, _]): (usize, &Four)| {
            let toward = corner.x * x + corner.y * y;
            let aside = corner.x * y - corner.y * x;
            let is_beyond = toward.cmpgt(Vec4::splat(squared))
                & aside.abs().cmplt(toward)
                & toward.cmplt(Vec4::splat(FARTHEST * squared));
            u64::from(is_beyond.bitmask()) << (4 * i)
        };
        let is_beyond = |at: &Vec2| {
            let (toward, aside) = (corner.dot(*at), corner.perp_dot(*at));
            toward > squared && aside.abs() < toward && toward < FARTHEST * squared
        };
        let all =
            self.lines[self.others / 4..].iter().enumerate().map(beyond).fold(0, |all, four| all | four);
        let of_both = between.iter().fold(0, |both, line| both | 1 << (line - self.others));
        all & !of_both == 0 && !self.across_in_plane.iter().any(is_beyond)
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

/// How far the corners of a cell may be, from its neighbors' offsets, nearest first; 0 without any.
fn widest_gap(offsets: &[DVec3]) -> f64 {
    let Some(sixth) = offsets.get(5).or(offsets.last()).map(|offset| offset.length()) else { return 0.0 };
    let first = offsets.first().copied().unwrap_or_default();
    let off_line = |offset: &DVec3, part: f64| {
        offset.cross(first).length_squared()
            > (part * part) * offset.length_squared() * first.length_squared()
    };
    let is_line = offsets.len() > LINE && !offsets[..LINE].iter().any(|offset| off_line(offset, LINE_WIDTH));
    let beside =
        || offsets[LINE..].iter().find(|offset| off_line(offset, BESIDE_LINE)).map(|offset| offset.length());
    match is_line.then(beside).flatten() {
        Some(beside) if beside < WIDEST_BETWEEN_LINES * sixth => beside.max(WIDEST_GAP * sixth),
        _ => WIDEST_GAP * sixth,
    }
}

#[cfg(test)]
mod tests;
