//! Scan lines so far apart that all 48 neighbors of a point are on its own: what is beside it is looked for.

use glam::DVec3;

use super::{Cloud, fit::Plane, plane::NEIGHBORS};

/// How far the next line is looked for, in distances of the 6th neighbor, which is 3 points away: 120 times as far as the next point.
const FARTHEST: f64 = 40.0;

/// Sine of the angle to the line from which on points are beside it.
const BESIDE: f64 = 0.7;

/// So many of a point's nearest neighbors are those on its line; the others are those beside it.
const ON_LINE: usize = 8;

impl Cloud {
    /// The normal at a place, whose neighbors all lie on a line along a direction, by the lines on both sides of it, in which case `near` has points of
    /// them; `None` where there are none.
    pub(super) fn between_lines(
        &self,
        place: usize,
        along: DVec3,
        near: &mut [u32; NEIGHBORS],
    ) -> Option<DVec3> {
        let here = self.place(place);
        let along = along.try_normalize()?;
        let sixth = self.place(*near.get(5).filter(|at| **at != u32::MAX)? as usize).distance(here);
        let off_line = |at: DVec3| {
            let offset = at - here;
            offset - along * along.dot(offset)
        };
        let is_beside = |at: DVec3| off_line(at).length() > BESIDE * at.distance(here);
        let reach = FARTHEST * sixth;
        let first = self.tree.nearest_place_of(here, reach, &is_beside)?;
        let toward = off_line(self.place(first));
        let is_opposite = |at: DVec3| is_beside(at) && off_line(at).dot(toward) < 0.0;
        let second = self.tree.nearest_place_of(here, reach, &is_opposite);
        let on_line = near.iter().filter(|at| **at != u32::MAX);
        let mut offsets: Vec<DVec3> = on_line.map(|at| self.place(*at as usize) - here).collect();
        let mut beside = [u32::MAX; NEIGHBORS - ON_LINE];
        for (own, line) in beside.chunks_mut(2).zip([Some(first), second]) {
            let Some(line) = line else { continue };
            let of_line: [u32; 4] = self.near(line);
            own[0] = line as u32;
            own[1] = of_line[0];
            let all = of_line.iter().filter(|at| **at != u32::MAX).map(|at| *at as usize).chain([line]);
            offsets.extend(all.map(|at| self.place(at) - here));
        }
        let plane = Plane::fit(&offsets, |_| true);
        near[ON_LINE..].copy_from_slice(&beside);
        (plane.width > 0.0).then_some(plane.normal)
    }
}
