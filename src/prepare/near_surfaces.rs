//! How much room there is for ε near each splat: another surface that faces the other way, as the other side of a plate, a rib or a leaf
//! does, must not be taken for the splat's own.
//!
//! Of the splats whose centers are within 1.5 radii and that face about the same way (normals within 60°), the largest distance of a
//! center from the splat's plane is the *spread* of its own surface, by curvature, spacing and noise. Of those within twice ε that face
//! the other way (beyond 120°) the smallest such distance is the *gap*. ε is half the gap, but at least twice the spread, and at most what
//! it is without another surface: where the gap is that, half of it is ε, so that nothing jumps.
//! A gap of less than three spreads, of its own surface or of what faces the other way within 1.5 radii, or of less than a 20th of the
//! radius, is none: normals of one surface that look to both sides, as those of a cloud nobody oriented, are not a plate.
//!
//! The splats lie in a grid whose cells are as large as the neighborhood of the median radius, each with a cone around its normals. Cells
//! near which no two normals can be 120° apart, most of any scan, are done with a look at the cones.

mod grid;
pub(super) mod sharp;

use glam::{DVec3, Vec3};
use rayon::prelude::*;

use self::grid::{Cell, Grid, Place};
use crate::scene::{Shapes, Splats};

/// The cosine of the angle up to which normals face the same way, and, negative, from which on the other.
const SAME_WAY: f64 = 0.5;

/// How far close centers are, in radii.
const CLOSE: f64 = 1.5;

/// The least gap, in spreads.
const LEAST_SPREADS: f64 = 3.0;

/// The least gap, in radii.
const LEAST_RADII: f64 = 0.05;

/// So many cells are a task.
const CELLS_AT_ONCE: usize = 256;

/// More candidates than this near a cell are a heap in which nothing is told apart.
const MOST_CANDIDATES: usize = 1 << 13;

/// The share of ε that each splat has room for, above 0 and at most 1, where ε is that many radii; `None` where all have all of it. A
/// splat that can't be drawn has 1.
pub(super) fn shares(splats: &Splats, radii: f64) -> Option<Vec<f32>> {
    let work = Work::of(splats, radii)?;
    let parts = work.grid.cells.par_chunks(CELLS_AT_ONCE);
    let found: Vec<(u32, f32)> = parts.flat_map_iter(|cells| work.less_than_all(cells)).collect();
    if found.is_empty() {
        return None;
    }
    let mut shares = vec![1.0; splats.len()];
    found.iter().for_each(|(splat, share)| shares[*splat as usize] = *share);
    Some(shares)
}

/// `None` where there is no splat.
fn median_radius(splats: &Splats, numbers: &[u32]) -> Option<f64> {
    // A thousand of them are enough for the size of cells.
    let some = numbers.iter().step_by(numbers.len().div_ceil(1024).max(1));
    let mut radii: Vec<f64> = some.map(|&i| splats.major_radius(i as usize)).collect();
    radii.sort_by(f64::total_cmp);
    radii.get(radii.len() / 2).copied()
}

fn normal_of(splats: &Splats, i: usize) -> DVec3 {
    match &splats.shapes {
        Shapes::Disks { normals, .. } => normals[i].as_dvec3().normalize(),
        Shapes::Ellipses { s, t } => {
            let unit = |v: Vec3| v.as_dvec3().normalize();
            unit(s[i]).cross(unit(t[i])).normalize()
        }
    }
}

/// A splat as its neighbors see it.
struct Neighbor {
    position: DVec3,
    normal: DVec3,
    splat: u32,
}

/// What all threads read.
struct Work<'a> {
    splats: &'a Splats,
    radii: f64,
    grid: Grid,
}

impl<'a> Work<'a> {
    /// `None` where there is nothing to draw.
    fn of(splats: &'a Splats, radii: f64) -> Option<Self> {
        let drawn = (0..splats.len()).filter(|&i| splats.defect(i).is_none());
        let numbers: Vec<u32> = drawn.map_while(|i| u32::try_from(i).ok()).collect();
        let cell = 2.0 * radii * median_radius(splats, &numbers)?;
        Some(Self { splats, radii, grid: Grid::new(splats, numbers, cell) })
    }

    fn radius(&self, place: &Place) -> f64 {
        self.splats.major_radius(place.splat as usize)
    }

    /// The least and the largest radius in a cell.
    fn radii_in(&self, cell: &Cell) -> [f64; 2] {
        let own = self.grid.places[cell.places.clone()].iter().map(|place| self.radius(place));
        own.fold([f64::INFINITY, 0.0], |[a, b], r| [r.min(a), r.max(b)])
    }

    /// The splats of some cells that have less than all of ε, and their shares.
    fn less_than_all(&self, cells: &[Cell]) -> Vec<(u32, f32)> {
        let mut found = Vec::new();
        for cell in cells {
            let near = self.near(cell, self.radii_in(cell)[1]);
            for place in self.grid.places[cell.places.clone()].iter().filter(|_| !near.is_empty()) {
                let share = self.share(place.splat as usize, &near);
                if share < 1.0 {
                    found.push((place.splat, share as f32));
                }
            }
        }
        found
    }

    /// All that is near the splats of a cell, which have such a radius at most; nothing where none of it can face the other way.
    fn near(&self, cell: &Cell, most: f64) -> Vec<Neighbor> {
        let near = self.grid.around(cell, 2.0 * self.radii * most);
        let other_way = (-SAME_WAY).acos();
        let may_face_the_other_way = |other: &&Cell| {
            let between = other.axis.dot(cell.axis).clamp(-1.0, 1.0).acos();
            // With room for rounding.
            between + cell.angle_rad + other.angle_rad > other_way - 1e-6
        };
        if near.iter().any(may_face_the_other_way) { self.neighbors(&near) } else { Vec::new() }
    }

    /// The splats of some cells; none of more than can be told apart.
    fn neighbors(&self, cells: &[&Cell]) -> Vec<Neighbor> {
        let count: usize = cells.iter().map(|other| other.places.len()).sum();
        if count > MOST_CANDIDATES {
            return Vec::new();
        }
        let neighbor = |&Place { splat, .. }: &Place| {
            let i = splat as usize;
            Neighbor { position: self.splats.positions[i], normal: normal_of(self.splats, i), splat }
        };
        cells.iter().flat_map(|other| self.grid.places[other.places.clone()].iter().map(neighbor)).collect()
    }

    fn share(&self, i: usize, near: &[Neighbor]) -> f64 {
        let (position, radius) = (self.splats.positions[i], self.splats.major_radius(i));
        let normal = normal_of(self.splats, i);
        let whole = self.radii * radius;
        let (mut spread, mut gap) = (0.0_f64, f64::INFINITY);
        let (mut lowest, mut highest) = (f64::INFINITY, f64::NEG_INFINITY);
        for neighbor in near {
            let to = neighbor.position - position;
            if to.length_squared() > 4.0 * whole * whole || neighbor.splat as usize == i {
                continue;
            }
            let (facing, off) = (neighbor.normal.dot(normal), to.dot(normal));
            let is_close = to.length_squared() <= CLOSE * CLOSE * radius * radius;
            if facing >= SAME_WAY && is_close {
                spread = spread.max(off.abs());
            } else if facing <= -SAME_WAY {
                gap = gap.min(off.abs());
                if is_close {
                    (lowest, highest) = (lowest.min(off), highest.max(off));
                }
            }
        }
        let range = highest - lowest; // -∞ of none
        if gap < LEAST_SPREADS * spread.max(range) || gap < LEAST_RADII * radius {
            return 1.0;
        }
        (f64::max(0.5 * gap, 2.0 * spread) / whole).min(1.0)
    }
}

#[cfg(test)]
mod tests;
