//! Splats by cells as large as what is looked at around each.

use std::{iter, ops::Range};

use glam::DVec3;
use rayon::prelude::*;

use super::normal_of;
use crate::scene::Splats;

/// A splat that reaches farther than this many cells is one among much smaller ones; it is taken to reach so far.
const MOST_CELLS: f64 = 64.0;

/// A splat in its cell.
#[derive(Clone, Copy)]
pub(super) struct Place {
    cell: [i32; 3],
    pub splat: u32,
}

/// A cell that is not empty.
pub(super) struct Cell {
    pub places: Range<usize>,
    /// A cone around its normals: unit axis, angle.
    pub axis: DVec3,
    pub angle_rad: f64,
}

/// The splats by cells, which are sorted.
pub(super) struct Grid {
    cell: f64,
    pub places: Vec<Place>,
    pub cells: Vec<Cell>,
}

impl Grid {
    pub fn new(splats: &Splats, numbers: Vec<u32>, cell: f64) -> Self {
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

    /// The cells within a length of the splats of one.
    pub fn around(&self, cell: &Cell, reach: f64) -> Vec<&Cell> {
        let cells = (reach / self.cell).ceil().clamp(1.0, MOST_CELLS) as i32;
        let middle = self.at(cell);
        self.within([-cells, cells].map(|by| middle.map(|x| x + by))).collect()
    }

    pub fn at(&self, cell: &Cell) -> [i32; 3] {
        self.places[cell.places.start].cell
    }

    /// The cells of a box, in order. What is between them is leapt over, so that a box of many rows costs no more than the cells that are there.
    pub fn within(&self, [lo, hi]: [[i32; 3]; 2]) -> impl Iterator<Item = &Cell> {
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
