//! Points become splats: normals and radii that the file does not have, from the points nearby.
//!
//! The steps, each a file: points at one place, or in [`clumps`] about one, [`merge`]; each finds its neighbors and their [`plane`], or the one of their [`sheets`] that it lies on, or that between scan [`lines`],
//! or of coarser [`patches`] where there is [`noise`]; normals are turned to one side ([`orient`]); isolated points are left out ([`outliers`], [`strays`]); disks [`reach`] as far as
//! closes the surface ([`radii`]). All of it is the same whatever the number of threads.
//!
//! Splats are round: ellipses take half as much memory again (48 bytes on the device instead of 32), and gain only where points lie much denser along one direction than across.

mod around;
mod clumps;
mod fit;
mod lines;
mod merge;
mod noise;
mod orient;
mod outliers;
mod patches;
mod plane;
mod radii;
mod reach;
mod report;
mod sheets;
mod strays;
#[cfg(test)]
mod tests;

use glam::{DVec3, Vec3};
use rayon::prelude::*;

use super::{
    mesh_splats::DEFAULT_OVERLAP,
    neighbors::{Point, Tree},
};
use crate::{
    progress::Progress,
    scene::{Points, Shapes, Splats},
};
use merge::{Merged, merge};
use plane::{MOST_NEIGHBORS, NEIGHBORS};

pub use report::{CloudReport, Sides};

/// So many points are done between two progress messages.
const BATCH: usize = 1 << 16;

/// Makes a round disk of each point.
///
/// Normals are the file's where it has usable ones, else those of the plane through the 12 nearest neighbors, turned toward the
/// viewpoint, or else to one side along a spanning tree. Radii are the file's, or 1.5 times what the gap rule of `reach.rs`
/// gives: 1 is free of holes already, the rest makes kernels blend as those of meshes ([`DEFAULT_OVERLAP`]). Order and colors
/// are those of the points.
pub fn splats_from_points(points: Points, progress: &dyn Progress) -> (Splats, CloudReport) {
    let mut report = CloudReport { points: points.positions.len(), ..CloudReport::default() };
    let Merged { points, duplicates, not_finite } = merge(points);
    (report.duplicates, report.not_finite) = (duplicates, not_finite);
    let mut cloud = Cloud::new(&points);
    let points = match clumps::first_of_clumps(&cloud.tree) {
        None => points,
        Some(first) => {
            let merged = merge(at_places_of(points, &first));
            report.duplicates += merged.duplicates;
            cloud = Cloud::new(&merged.points);
            merged.points
        }
    };
    let steps = Steps { progress, passes: 2 };
    cloud.find_planes(&points, &steps, &mut report);
    report.around_scanner = report.sides == Sides::TowardScanner && around::surround_scanners(&points);
    report.coarse_step = merge::coarse_step(&points.positions, &cloud.spreads, duplicates);
    let isolated = outliers::isolated(&cloud.tree, &cloud.neighbors, &cloud.spreads);
    let radii = cloud.radii(&points, &isolated, &steps, &mut report);
    // Back into the order of the file.
    let count = points.positions.len();
    let mut normals = vec![Vec3::ZERO; count];
    let mut radii_of_points = vec![0.0; count];
    let mut keep = vec![true; count];
    for (place, point) in cloud.tree.points().iter().enumerate() {
        let i = point.number as usize;
        normals[i] = cloud.normals[place].as_vec3();
        radii_of_points[i] = radii[place];
        keep[i] = !isolated[place];
    }
    report.isolated = keep.iter().filter(|keep| !**keep).count();
    let Points { positions, colors, .. } = points;
    let shapes = Shapes::Disks { normals, radii: radii_of_points };
    let mut splats = Splats::new(positions, shapes, colors);
    if report.isolated > 0 {
        splats.keep(&keep);
    }
    (splats, report)
}

/// Each point at the place of another.
fn at_places_of(mut points: Points, others: &[u32]) -> Points {
    points.positions = others.iter().map(|other| points.positions[*other as usize]).collect();
    points
}

/// Tells of two passes over all points as one task.
struct Steps<'a> {
    progress: &'a dyn Progress,
    passes: usize,
}

impl Steps<'_> {
    fn done(&self, pass: usize, done: usize, total: usize) {
        const TASK: &str = "normals and radii of points";
        self.progress.step(TASK, (pass * total + done) as u64, (self.passes * total) as u64);
    }
}

/// Points in the order of their tree; all arrays by place in it.
struct Cloud {
    tree: Tree,
    /// Nearest first, `u32::MAX` for none. Where more were looked at, a part of those.
    neighbors: Vec<[u32; NEIGHBORS]>,
    /// Mean distances of 6 neighbors; 0 without any.
    spreads: Vec<f64>,
    /// Unit.
    normals: Vec<DVec3>,
}

impl Cloud {
    fn new(points: &Points) -> Self {
        // Differences of coordinates far from the origin are exact, their squares would not be.
        let origin = points.positions.first().copied().unwrap_or_default();
        let moved = |(number, position): (u32, &DVec3)| Point { position: *position - origin, number };
        let tree = Tree::new((0..).zip(&points.positions).map(moved).collect());
        Self { tree, neighbors: Vec::new(), spreads: Vec::new(), normals: Vec::new() }
    }

    fn place(&self, place: usize) -> DVec3 {
        self.tree.points()[place].position
    }

    /// Up to `K` neighbors.
    fn near<const K: usize>(&self, place: usize) -> [u32; K] {
        self.tree.nearest_places(place)
    }

    /// The offsets of those neighbors that `part` takes, in the same memory for one point after another.
    fn offsets<'a>(
        &self,
        place: usize,
        near: &[u32],
        mut part: impl FnMut(usize) -> bool,
        into: &'a mut Vec<DVec3>,
    ) -> &'a [DVec3] {
        let here = self.place(place);
        let near = near.iter().filter(|j| **j != u32::MAX).map(|j| *j as usize);
        into.clear();
        into.extend(near.filter(|j| part(*j)).map(|j| self.place(j) - here));
        into
    }

    /// Neighbors, spreads and normals.
    fn find_planes(&mut self, points: &Points, steps: &Steps<'_>, report: &mut CloudReport) {
        let count = self.tree.points().len();
        let of_file = |place: usize| -> Option<DVec3> {
            let number = self.tree.points()[place].number as usize;
            let normal = points.normals.as_ref()?[number].as_dvec3();
            normal.is_finite().then(|| normal.try_normalize()).flatten()
        };
        let given: Vec<bool> = (0..count).map(|place| of_file(place).is_some()).collect();
        let coarse = if given.iter().all(|given| *given) { None } else { noise::normals(&self.tree) };
        let one = |[first, more]: &mut [Vec<DVec3>; 2], place: usize| {
            let mut near = self.near::<NEIGHBORS>(place);
            let offsets = self.offsets(place, &near, |_| true, first);
            let six = &offsets[..offsets.len().min(6)];
            let spread = six.iter().map(|o| o.length()).sum::<f64>() / six.len().max(1) as f64;
            let normal = of_file(place).unwrap_or_else(|| {
                if let Some(coarse) = &coarse {
                    return coarse[place];
                }
                let mut wider = [u32::MAX; MOST_NEIGHBORS];
                let plane = plane::plane(offsets, || {
                    wider = self.near(place);
                    self.offsets(place, &wider, |_| true, more)
                });
                if plane.is_line() {
                    let along = wider.iter().rfind(|at| **at != u32::MAX).map(|at| self.place(*at as usize));
                    let along = along.map(|at| at - self.place(place)).unwrap_or_default();
                    if let Some(normal) = self.between_lines(place, along, &mut near) {
                        return normal;
                    }
                } else if plane.along_line {
                    // Joins scan lines.
                    let every = MOST_NEIGHBORS / NEIGHBORS;
                    near[NEIGHBORS / 2..]
                        .iter_mut()
                        .zip(wider[MOST_NEIGHBORS / 2..].iter().step_by(every))
                        .for_each(|(near, wider)| *near = *wider);
                }
                plane.normal
            });
            (near, spread, normal)
        };
        let mut neighbors = vec![[u32::MAX; NEIGHBORS]; count];
        let (mut spreads, mut normals) = (vec![0.0; count], vec![DVec3::ZERO; count]);
        for first in (0..count).step_by(BATCH) {
            steps.done(0, first, count);
            let batch = first..count.min(first + BATCH);
            let into = neighbors[batch.clone()].par_iter_mut().zip(&mut spreads[batch.clone()]);
            into.zip(&mut normals[batch]).enumerate().for_each_init(
                Default::default,
                |offsets, (i, ((near, spread), normal))| {
                    (*near, *spread, *normal) = one(offsets, first + i);
                },
            );
        }
        report.noisy = coarse.is_some();
        report.normals_from_file = given.iter().filter(|given| **given).count();
        (self.neighbors, self.spreads, self.normals) = (neighbors, spreads, normals);
        report.sides = self.choose_sides(points, &given, report);
    }

    /// The sides of normals that are not the file's.
    fn choose_sides(&mut self, points: &Points, given: &[bool], report: &CloudReport) -> Sides {
        if !points.viewpoints.is_empty() {
            let origin = points.positions.first().copied().unwrap_or_default();
            let views = &points.viewpoints;
            for (place, point) in self.tree.points().iter().enumerate() {
                let view =
                    views.partition_point(|view| view.end <= point.number as usize).min(views.len() - 1);
                let toward = views[view].place - origin - point.position;
                if !given[place] && self.normals[place].dot(toward) < 0.0 {
                    self.normals[place] = -self.normals[place];
                }
            }
            Sides::TowardScanner
        } else if report.normals_from_file == 0 {
            if !report.noisy {
                // Patches have turned theirs.
                let areas: Vec<f64> = self.spreads.iter().map(|spread| spread * spread).collect();
                orient::orient(&self.tree.positions(), &self.neighbors, &areas, &mut self.normals);
            }
            Sides::One
        } else {
            // A few lack theirs: as most of their neighbors.
            for place in (0..given.len()).filter(|&place| !given[place]) {
                let near = self.neighbors[place].iter().filter(|j| **j != u32::MAX && given[**j as usize]);
                let most: DVec3 = near.map(|&j| self.normals[j as usize]).sum();
                if self.normals[place].dot(most) < 0.0 {
                    self.normals[place] = -self.normals[place];
                }
            }
            Sides::AsNeighbors
        }
    }
}
