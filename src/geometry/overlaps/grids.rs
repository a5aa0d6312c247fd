//! Splats in grids, one for each octave of radii, whose cells are as large as its largest radius: what reaches a place is near it in all of
//! them.

use std::ops::Range;

use glam::{DVec2, DVec3};
use rayon::prelude::*;

use super::dual_frame;
use crate::{geometry::clip::removes, scene::Splats};

/// No splat counts that is smaller than this share of the one at whose center it is looked for.
const LEAST_SIZE: f64 = 0.5;

/// Of more candidates than this, in one octave near one cell, every second, third … stands for all.
const MOST_CANDIDATES: usize = 512;

/// All splats that can be drawn, by cells. Octaves are sorted, and so are the cells of each.
pub(in crate::geometry) struct Grids {
    /// The splats, cell by cell.
    splats: Vec<u32>,
    /// Where the cells are that are not empty.
    cells: Vec<[i32; 3]>,
    /// Where the splats of each begin; one more, where the last ones end.
    starts: Vec<u32>,
    /// Octaves that are there, and their cells.
    octaves: Vec<(i32, Range<usize>)>,
}

/// What was found near a cell, and room for finding it.
#[derive(Default)]
pub(in crate::geometry) struct Search {
    near: Vec<Neighbor>,
    /// Those of one octave, by cell.
    found: Vec<Range<u32>>,
    /// Where each row of cells was found last: those near the next cell are not far from there.
    rows: Vec<usize>,
}

/// A splat as its neighbors see it: what most of them see is that it is too far away.
struct Neighbor {
    position: DVec3,
    radius: f32,
    splat: u32,
    /// How many it stands for.
    count: f64,
}

impl Grids {
    pub fn new(splats: &Splats) -> Self {
        let drawn = (0..splats.len()).filter(|&i| splats.defect(i).is_none());
        let numbers: Vec<u32> = drawn.map_while(|i| u32::try_from(i).ok()).collect();
        let place = |splat: u32| {
            let i = splat as usize;
            let octave = octave_of(splats.major_radius(i));
            (octave, cell_of(splats.positions[i], octave), splat)
        };
        let mut places: Vec<(i32, [i32; 3], u32)> = numbers.into_par_iter().map(place).collect();
        places.par_sort_unstable();
        let mut grids =
            Self { splats: Vec::new(), cells: Vec::new(), starts: Vec::new(), octaves: Vec::new() };
        for (i, (octave, cell, _)) in places.iter().enumerate() {
            let number = grids.cells.len();
            match grids.octaves.last_mut() {
                Some((last, cells)) if last == octave && grids.cells[number - 1] == *cell => {
                    debug_assert_eq!(cells.end, number);
                    continue;
                }
                Some((last, cells)) if last == octave => cells.end += 1,
                _ => grids.octaves.push((*octave, number..number + 1)),
            }
            grids.cells.push(*cell);
            grids.starts.push(i as u32);
        }
        grids.starts.push(places.len() as u32);
        grids.splats = places.into_iter().map(|(.., splat)| splat).collect();
        grids
    }

    /// So many cells have splats.
    pub fn len(&self) -> usize {
        self.cells.len()
    }

    /// What a place on a splat has in sum of weights, each times its factor; and of these times the height of the place over the disk's plane, and times its square.
    pub fn sums_on(&self, splats: &Splats, i: usize, place: DVec3, factor: impl Fn(u32) -> f64) -> [f64; 3] {
        let octave = octave_of(splats.major_radius(i));
        let mut search = Search::default();
        self.find(splats, (octave, cell_of(place, octave)), 0, &mut search);
        sums_at(&search.near, splats, i, place, factor)
    }

    /// Tells the crowds of the splats of a cell.
    pub fn crowds_in(
        &self,
        splats: &Splats,
        cell: usize,
        search: &mut Search,
        mut tell: impl FnMut(u32, f64),
    ) {
        let octave = self.octaves.partition_point(|(_, cells)| cells.end <= cell);
        self.find(splats, (self.octaves[octave].0, self.cells[cell]), 0, search);
        for &splat in self.splats_in(cell) {
            let i = splat as usize;
            let [crowd, ..] = sums_at(&search.near, splats, i, splats.positions[i], |_| 1.0);
            tell(splat, crowd.max(1.0));
        }
    }

    /// The splats of a cell.
    pub fn splats_in(&self, cell: usize) -> &[u32] {
        &self.splats[self.starts[cell] as usize..self.starts[cell + 1] as usize]
    }

    /// Finds all that may touch one of the splats of a cell, and is no smaller than half of it; `None` of more than can be told apart.
    pub fn that_touch<'s>(
        &self,
        splats: &Splats,
        cell: usize,
        search: &'s mut Search,
    ) -> Option<impl Iterator<Item = u32> + Clone + use<'s>> {
        let octave = self.octaves.partition_point(|(_, cells)| cells.end <= cell);
        let all = self.find(splats, (self.octaves[octave].0, self.cells[cell]), 1, search);
        all.then(|| search.near.iter().map(|neighbor| neighbor.splat))
    }

    /// The numbers of the splats, in order.
    pub fn numbers(&self) -> Vec<u32> {
        let mut numbers = self.splats.clone();
        numbers.sort_unstable();
        numbers
    }

    /// Finds all that may reach a place in a cell of an octave, of this octave, the one below and those above; or a place so many times as far beyond the cell as it is wide. False
    /// where some were left out, for which others stand.
    fn find(
        &self,
        splats: &Splats,
        (octave, cell): (i32, [i32; 3]),
        beyond: i32,
        search: &mut Search,
    ) -> bool {
        search.near.clear();
        let mut all_found = true;
        let first = self.octaves.partition_point(|(of, _)| *of < octave - 1);
        let mut row = 0;
        for (of, cells) in &self.octaves[first..] {
            let up = (of - octave).clamp(-1, 31);
            let [lo, hi] = match up {
                -1 => [cell.map(|x| 2 * (x - beyond) - 1), cell.map(|x| 2 * (x + beyond) + 2)],
                _ => [cell.map(|x| ((x - beyond) >> up) - 1), cell.map(|x| ((x + beyond) >> up) + 1)],
            };
            search.found.clear();
            let mut count = 0;
            for (x, y) in (lo[0]..=hi[0]).flat_map(|x| (lo[1]..=hi[1]).map(move |y| (x, y))) {
                let first = search.seek(&self.cells[..cells.end], cells.start, row, [x, y, lo[2]]);
                let found = self.cells[first..cells.end].iter().take_while(|cell| **cell <= [x, y, hi[2]]);
                // Cells of a row follow each other, and so do their splats.
                let found = self.starts[first]..self.starts[first + found.count()];
                count += found.len();
                search.found.push(found);
                row += 1;
            }
            let step = count.div_ceil(MOST_CANDIDATES).max(1);
            all_found &= step == 1;
            let mut skip = 0;
            for range in &search.found {
                let range = range.start as usize..range.end as usize;
                let all = self.splats[range.clone()].iter().skip(skip).step_by(step);
                search.near.extend(all.map(|&splat| {
                    let i = splat as usize;
                    let (position, radius) = (splats.positions[i], splats.major_radius(i) as f32);
                    Neighbor { position, radius, splat, count: step as f64 }
                }));
                skip = (skip + range.len() * (step - 1)) % step;
            }
        }
        all_found
    }
}

impl Search {
    /// The first of some cells, from number `start` on, that is not before a place, for a row of those that are looked for.
    fn seek(&mut self, cells: &[[i32; 3]], start: usize, row: usize, place: [i32; 3]) -> usize {
        if self.rows.len() <= row {
            self.rows.resize(row + 1, start);
        }
        let from = self.rows[row].clamp(start, cells.len());
        // Steps of 1, 2, 4 … to where it must be, and then by halves.
        let (mut low, mut high, mut step) = (from, from, 1);
        while high < cells.len() && cells[high] < place {
            (low, high, step) = (high + 1, (high + step).min(cells.len()), 2 * step);
        }
        while low > start && cells[low - 1] >= place {
            (high, low, step) = (low - 1, low.saturating_sub(step).max(start), 2 * step);
        }
        let found = low + cells[low..high].partition_point(|cell| *cell < place);
        self.rows[row] = found;
        found
    }
}

/// [`Grids::sums_on`] splat `of`, of what is near.
fn sums_at(
    near: &[Neighbor],
    splats: &Splats,
    of: usize,
    place: DVec3,
    factor: impl Fn(u32) -> f64,
) -> [f64; 3] {
    let normal = dual_frame(splats, of)[2];
    let least = (LEAST_SIZE * splats.major_radius(of)) as f32;
    let mut sums = [0.0; 3];
    for neighbor in near {
        let from_center = place - neighbor.position;
        let radius = f64::from(neighbor.radius);
        if from_center.length_squared() > radius * radius || neighbor.radius < least {
            continue;
        }
        let i = neighbor.splat as usize;
        let [to_u, to_v, its_normal] = dual_frame(splats, i);
        let uv = DVec2::new(to_u.dot(from_center), to_v.dot(from_center));
        let is_there = uv.length_squared() <= 1.0 && !removes(&splats.clips.get(i), uv);
        if is_there && its_normal.dot(normal) > 0.0 {
            let weight = neighbor.count * factor(neighbor.splat) * (-2.0 * uv.length_squared()).exp();
            let height = its_normal.dot(from_center);
            sums = [sums[0] + weight, sums[1] + weight * height, sums[2] + weight * height * height];
        }
    }
    sums
}

/// The octave of a radius: that of the least power of two that is not smaller.
fn octave_of(radius: f64) -> i32 {
    radius.log2().ceil() as i32
}

/// Far cells are one.
fn cell_of(position: DVec3, octave: i32) -> [i32; 3] {
    let most = f64::from(i32::MAX / 4);
    (position * f64::from(-octave).exp2()).floor().to_array().map(|x| x.clamp(-most, most) as i32)
}
