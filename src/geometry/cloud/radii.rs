//! The radii of disks: the file's, or those that [`reach`](super::reach) finds, without those that are far too large.

use std::ops::RangeInclusive;

use glam::DVec3;
use rayon::prelude::*;

use super::{
    BATCH, Cloud, CloudReport, DEFAULT_OVERLAP, Steps, outliers,
    plane::{MOST_NEIGHBORS, NEIGHBORS},
    reach::Cells,
};
use crate::scene::Points;

/// The radius of a point that is alone: there is nothing to measure it by.
const ALONE: f64 = 1.0;

/// Sizes that are radii, in those that were found: such disks close the surface, and are not as large as those that are limited.
const CLOSE: RangeInclusive<f32> = (1.0 / DEFAULT_OVERLAP) as f32..=4.0;

/// Cosine of the angle between normals from which on a neighbor is of another face: its disk is half as wide then as seen from
/// here, and its share of the surface beside an edge is not covered by it alone.
const OTHER_FACE: f64 = 0.5;

/// The radius of a disk.
#[derive(Clone, Copy, Debug)]
pub(super) struct Radius {
    pub whole: f32,
    /// At a rim, what of it closes the surface.
    pub of_rim: Option<f32>,
}

impl Cloud {
    /// The radii of disks: the file's, or those that close the surface. Those of isolated points, which are left out, are not told of.
    pub(super) fn radii(
        &self,
        points: &Points,
        isolated: &[bool],
        steps: &Steps<'_>,
        report: &mut CloudReport,
    ) -> Vec<f32> {
        let count = self.tree.points().len();
        let of_file = |place: usize| -> Option<f32> {
            let number = self.tree.points()[place].number as usize;
            points.radii.as_ref().map(|radii| radii[number]).filter(|r| *r > 0.0 && r.is_finite())
        };
        let own = |place: usize| of_file(place).filter(|_| !points.radii_in_doubt);
        let one = |scratch: &mut (Vec<DVec3>, Cells), place: usize| match own(place) {
            Some(radius) => Radius { whole: radius, of_rim: None },
            None => self.radius(place, scratch),
        };
        let mut radii = Vec::with_capacity(count);
        for first in (0..count).step_by(BATCH) {
            steps.done(1, first, count);
            let batch = (first..count.min(first + BATCH)).into_par_iter();
            radii.par_extend(batch.map_init(Default::default, one));
        }
        steps.done(1, count, count);
        let mut radii = match points.radii.is_some() && !points.radii_in_doubt {
            // A file's own tell nothing of those that it lacks.
            true => radii.iter().map(|radius| radius.whole).collect(),
            false => outliers::limit_rims(&self.neighbors, &radii),
        };
        let from_file = (0..count).filter(|&place| of_file(place).is_some()).count();
        if points.radii_in_doubt && from_file > 0 {
            let close =
                |&place: &usize| of_file(place).is_some_and(|size| CLOSE.contains(&(size / radii[place])));
            if 2 * (0..count).filter(close).count() < from_file {
                report.sizes_ignored = from_file;
            } else {
                radii.iter_mut().enumerate().for_each(|(place, radius)| {
                    *radius = of_file(place).unwrap_or(*radius);
                });
            }
        }
        report.radii_from_file = from_file - report.sizes_ignored;
        if report.radii_from_file > 0 {
            return radii;
        }
        let limited = outliers::limit_radii(&self.neighbors, &radii);
        let changed =
            limited.iter().zip(&radii).zip(isolated).filter(|((new, old), out)| new != old && !**out);
        report.limited = changed.count();
        limited
    }

    /// The radius of the disk at a place.
    fn radius(&self, place: usize, (offsets, cells): &mut (Vec<DVec3>, Cells)) -> Radius {
        let normal = self.normals[place];
        let mut of = |near: &[u32]| {
            cells.uncut();
            let same_face = |j: usize| {
                let other = self.normals[j];
                let is_same = normal.dot(other) > OTHER_FACE;
                if !is_same {
                    cells.cut(normal, other, self.place(j) - self.place(place));
                }
                is_same
            };
            let offsets = self.offsets(place, near, same_face, offsets);
            cells.reach(normal, offsets)
        };
        let mut found = of(&self.neighbors[place]);
        // Most that 12 leave open are closed by twice as many, which take half as long to find as 48.
        if found.is_at_rim() {
            found = of(&self.near::<{ 2 * NEIGHBORS }>(place));
        }
        if found.is_at_rim() {
            found = of(&self.near::<MOST_NEIGHBORS>(place));
        }
        let radius = |reach: f64| (DEFAULT_OVERLAP * reach) as f32;
        match found.distance > 0.0 {
            true => Radius {
                whole: radius(found.distance),
                of_rim: found.is_at_rim().then(|| radius(found.within)),
            },
            false => Radius { whole: radius(ALONE), of_rim: None },
        }
    }
}
