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
//! Splats of a surface with sharp edges, which clip curves cut, are as large as its faces are, and what is within their radius may be anything:
//! a part inside of a box, the next rib. Of those ε is twice the spread alone, at least a 20th of a radius, and the spread is that of
//! neighbors toward which the surface may have turned: where normals are θ apart, a center d away is d sin θ from the plane at the most.
//!
//! The splats lie in a grid whose cells are as large as the neighborhood of the median radius, each with a cone around its normals. Cells
//! near which no two normals can be 120° apart, most of any scan, are done with a look at the cones.

use std::{iter, ops::Range};

use glam::{DVec3, Vec3};
use rayon::prelude::*;

use crate::scene::{Shapes, Splats};

/// The cosine of the angle up to which normals face the same way, and, negative, from which on the other.
const SAME_WAY: f64 = 0.5;

/// How far close centers are, in radii.
const CLOSE: f64 = 1.5;

/// The least gap, in spreads.
const LEAST_SPREADS: f64 = 3.0;

/// The least gap, in radii.
const LEAST_RADII: f64 = 0.05;

/// The least ε of surfaces with sharp edges, in radii.
const LEAST_OF_SHARP: f64 = 0.05;

/// So many cells are a task.
const CELLS_AT_ONCE: usize = 256;

/// A splat that reaches farther than this many cells is one among much smaller ones; it is taken to reach so far.
const MOST_CELLS: f64 = 64.0;

/// More candidates than this near a cell are a heap in which nothing is told apart.
const MOST_CANDIDATES: usize = 1 << 13;

/// The share of ε that each splat has room for, above 0 and at most 1, where ε is that many radii; `None` where all have all of it. A
/// splat that can't be drawn has 1.
pub(super) fn shares(splats: &Splats, radii: f64) -> Option<Vec<f32>> {
    let drawn = (0..splats.len()).filter(|&i| splats.defect(i).is_none());
    let numbers: Vec<u32> = drawn.map_while(|i| u32::try_from(i).ok()).collect();
    let cell = 2.0 * radii * median_radius(splats, &numbers)?;
    let grid = Grid::new(splats, numbers, cell);
    let work = Work { splats, radii, grid: &grid, is_sharp: !splats.clips.is_empty() };
    let parts = grid.cells.par_chunks(CELLS_AT_ONCE);
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

/// A splat in its cell.
#[derive(Clone, Copy)]
struct Place {
    cell: [i32; 3],
    splat: u32,
}

/// A cell that is not empty.
struct Cell {
    places: Range<usize>,
    /// A cone around its normals: unit axis, angle.
    axis: DVec3,
    angle_rad: f64,
}

/// The splats by cells, which are sorted.
struct Grid {
    cell: f64,
    places: Vec<Place>,
    cells: Vec<Cell>,
}

impl Grid {
    fn new(splats: &Splats, numbers: Vec<u32>, cell: f64) -> Self {
        let place = |splat: u32| Place { cell: cell_of(splats.positions[splat as usize], cell), splat };
        let mut places: Vec<Place> = numbers.into_par_iter().map(place).collect();
        places.par_sort_unstable_by_key(|place| (place.cell, place.splat));
        let mut ranges: Vec<Range<usize>> = Vec::new();
        for (i, place) in places.iter().enumerate() {
            match ranges.last_mut() {
                Some(last) if places[last.start].cell == place.cell => last.end = i + 1,
                _ => ranges.push(i..i + 1),
            }
        }
        let cone = |range: Range<usize>| {
            let normal = |place: &Place| normal_of(splats, place.splat as usize);
            let axis = normal(&places[range.start]);
            let least = places[range.clone()].iter().map(|place| normal(place).dot(axis)).fold(1.0, f64::min);
            Cell { places: range, axis, angle_rad: least.clamp(-1.0, 1.0).acos() }
        };
        let cells = ranges.into_par_iter().map(cone).collect();
        Self { cell, places, cells }
    }

    fn at(&self, cell: &Cell) -> [i32; 3] {
        self.places[cell.places.start].cell
    }

    /// The cells of a box, in order. What is between them is leapt over, so that a box of many rows costs no more than the cells that are there.
    fn within(&self, [lo, hi]: [[i32; 3]; 2]) -> impl Iterator<Item = &Cell> {
        let mut next = self.from(0, lo);
        iter::from_fn(move || {
            loop {
                let cell = self.cells.get(next)?;
                let [x, y, z] = self.at(cell);
                let leap = if x > hi[0] {
                    return None;
                } else if y < lo[1] {
                    [x, lo[1], lo[2]]
                } else if y > hi[1] {
                    [x + 1, lo[1], lo[2]]
                } else if z < lo[2] {
                    [x, y, lo[2]]
                } else if z > hi[2] {
                    [x, y + 1, lo[2]]
                } else {
                    next += 1;
                    return Some(cell);
                };
                next = self.from(next, leap);
            }
        })
    }

    /// The first cell, from one on, that is not before a place.
    fn from(&self, first: usize, place: [i32; 3]) -> usize {
        first + self.cells[first..].partition_point(|cell| self.at(cell) < place)
    }
}

/// Far cells are one.
fn cell_of(position: DVec3, cell: f64) -> [i32; 3] {
    let most = f64::from(i32::MAX / 2);
    (position / cell).floor().to_array().map(|x| x.clamp(-most, most) as i32)
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
    grid: &'a Grid,
    /// Clip curves cut some of them.
    is_sharp: bool,
}

impl Work<'_> {
    /// The splats of some cells that have less than all of ε, and their shares.
    fn less_than_all(&self, cells: &[Cell]) -> Vec<(u32, f32)> {
        let mut found = Vec::new();
        for cell in cells {
            let own = &self.grid.places[cell.places.clone()];
            let radius = |place: &Place| self.splats.major_radius(place.splat as usize);
            let [least, most] =
                own.iter().map(radius).fold([f64::INFINITY, 0.0], |[a, b], r| [r.min(a), r.max(b)]);
            let alike = most <= 4.0 * least;
            let near = match self.is_sharp {
                true if alike => self.neighbors(&self.around(cell, CLOSE * most)),
                true => Vec::new(),
                false => self.near(cell, most),
            };
            for place in own.iter().filter(|_| self.is_sharp || !near.is_empty()) {
                let number = place.splat as usize;
                let share = match (self.is_sharp, alike) {
                    (false, _) => self.share(number, &near),
                    (true, true) => self.share_of_sharp(number, &near),
                    // Some are a hundred times as large as others beside them: each looks for its own.
                    (true, false) => {
                        let own = self.neighbors(&self.around(cell, CLOSE * radius(place)));
                        self.share_of_sharp(number, &own)
                    }
                };
                if share < 1.0 {
                    found.push((place.splat, share as f32));
                }
            }
        }
        found
    }

    /// All that is near the splats of a cell, which have such a radius at most; nothing where none of it can face the other way.
    fn near(&self, cell: &Cell, most: f64) -> Vec<Neighbor> {
        let near = self.around(cell, 2.0 * self.radii * most);
        let other_way = (-SAME_WAY).acos();
        let may_face_the_other_way = |other: &&Cell| {
            let between = other.axis.dot(cell.axis).clamp(-1.0, 1.0).acos();
            // With room for rounding.
            between + cell.angle_rad + other.angle_rad > other_way - 1e-6
        };
        if near.iter().any(may_face_the_other_way) { self.neighbors(&near) } else { Vec::new() }
    }

    /// The cells within a length of the splats of one.
    fn around(&self, cell: &Cell, reach: f64) -> Vec<&Cell> {
        let cells = (reach / self.grid.cell).ceil().clamp(1.0, MOST_CELLS) as i32;
        let middle = self.grid.at(cell);
        self.grid.within([-cells, cells].map(|by| middle.map(|x| x + by))).collect()
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

    fn share_of_sharp(&self, i: usize, near: &[Neighbor]) -> f64 {
        let (position, radius) = (self.splats.positions[i], self.splats.major_radius(i));
        let normal = normal_of(self.splats, i);
        let mut spread = 0.0_f64;
        for neighbor in near.iter().filter(|neighbor| neighbor.normal.dot(normal) >= SAME_WAY) {
            let to = neighbor.position - position;
            let (off, squared) = (to.dot(normal).abs(), to.length_squared());
            let is_close = squared <= CLOSE * CLOSE * radius * radius;
            if is_close && off * off <= squared * neighbor.normal.cross(normal).length_squared() {
                spread = spread.max(off);
            }
        }
        (f64::max(2.0 * spread, LEAST_OF_SHARP * radius) / (self.radii * radius)).min(1.0)
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
