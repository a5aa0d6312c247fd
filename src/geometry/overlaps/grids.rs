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

/// A cell of an octave's grid, and a splat in it.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Place {
    octave: i32,
    cell: [i32; 3],
    splat: u32,
}

/// All splats that can be drawn, by cells, which are sorted.
pub(super) struct Grids {
    places: Vec<Place>,
    /// Cells that are not empty.
    pub cells: Vec<Range<usize>>,
    /// Octaves that are there, and their cells.
    octaves: Vec<(i32, Range<usize>)>,
}

/// A splat as its neighbors see it.
struct Neighbor {
    position: DVec3,
    /// What gives u and v of a place, counted from its center.
    to_uv: [DVec3; 2],
    normal: DVec3,
    radius: f64,
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
            Place { octave, cell: cell_of(splats.positions[i], octave), splat }
        };
        let mut places: Vec<Place> = numbers.into_par_iter().map(place).collect();
        places.par_sort_unstable();
        let cells = runs(places.len(), |a, b| {
            (places[a].octave, places[a].cell) == (places[b].octave, places[b].cell)
        });
        let octave = |cell: usize| places[cells[cell].start].octave;
        let octaves = runs(cells.len(), |a, b| octave(a) == octave(b));
        let octaves = octaves.into_iter().map(|range| (octave(range.start), range)).collect();
        Self { places, cells, octaves }
    }

    /// What a place on a splat has in sum of weights, each times its factor.
    pub fn sum_on(&self, splats: &Splats, i: usize, place: DVec3, factor: &dyn Fn(u32) -> f64) -> f64 {
        let octave = octave_of(splats.major_radius(i));
        sum_at(&self.near(splats, octave, cell_of(place, octave)), splats, i, place, factor)
    }

    /// The splats of a cell, with their crowds.
    pub fn crowds_in(&self, splats: &Splats, cell: &Range<usize>) -> Vec<(u32, f64)> {
        let own = &self.places[cell.clone()];
        let near = self.near(splats, own[0].octave, own[0].cell);
        let crowd = |place: &Place| {
            let i = place.splat as usize;
            let sum = sum_at(&near, splats, i, splats.positions[i], &|_| 1.0);
            (place.splat, sum.max(1.0))
        };
        own.iter().map(crowd).collect()
    }

    /// The numbers of the splats, in order.
    pub fn numbers(&self) -> Vec<u32> {
        let mut numbers: Vec<u32> = self.places.iter().map(|place| place.splat).collect();
        numbers.sort_unstable();
        numbers
    }

    /// All that may reach a place in a cell of an octave, of this octave, the one below and those above.
    fn near(&self, splats: &Splats, octave: i32, cell: [i32; 3]) -> Vec<Neighbor> {
        let mut near = Vec::new();
        let first = self.octaves.partition_point(|(of, _)| *of < octave - 1);
        for (of, cells) in &self.octaves[first..] {
            let up = (of - octave).clamp(-1, 31);
            let corners = match up {
                -1 => [cell.map(|x| 2 * x - 1), cell.map(|x| 2 * x + 2)],
                _ => [cell.map(|x| (x >> up) - 1), cell.map(|x| (x >> up) + 1)],
            };
            self.gather(splats, &self.cells[cells.clone()], corners, &mut near);
        }
        near
    }

    /// What lies in a box of some cells.
    fn gather(
        &self,
        splats: &Splats,
        cells: &[Range<usize>],
        [lo, hi]: [[i32; 3]; 2],
        near: &mut Vec<Neighbor>,
    ) {
        let at = |cell: &Range<usize>| self.places[cell.start].cell;
        let mut found: Vec<Range<usize>> = Vec::new();
        for (x, y) in (lo[0]..=hi[0]).flat_map(|x| (lo[1]..=hi[1]).map(move |y| (x, y))) {
            let first = cells.partition_point(|cell| at(cell) < [x, y, lo[2]]);
            found.extend(cells[first..].iter().take_while(|cell| at(cell) <= [x, y, hi[2]]).cloned());
        }
        let count: usize = found.iter().map(Range::len).sum();
        let step = count.div_ceil(MOST_CANDIDATES).max(1);
        let neighbor = |place: &Place| {
            let i = place.splat as usize;
            let [to_u, to_v, normal] = dual_frame(splats, i);
            Neighbor {
                position: splats.positions[i],
                to_uv: [to_u, to_v],
                normal,
                radius: splats.major_radius(i),
                splat: place.splat,
                count: step as f64,
            }
        };
        near.extend(found.into_iter().flatten().step_by(step).map(|at| neighbor(&self.places[at])));
    }
}

/// The sum at a place on splat `of` of the weights of what is near, each times its factor.
fn sum_at(near: &[Neighbor], splats: &Splats, of: usize, place: DVec3, factor: &dyn Fn(u32) -> f64) -> f64 {
    let normal = dual_frame(splats, of)[2];
    let least = LEAST_SIZE * splats.major_radius(of);
    let mut sum = 0.0;
    for neighbor in near {
        let from_center = place - neighbor.position;
        let [u, v] = neighbor.to_uv.map(|axis| axis.dot(from_center));
        let r2 = u * u + v * v;
        let is_there = r2 <= 1.0 && from_center.length_squared() <= neighbor.radius * neighbor.radius;
        let is_there = is_there && !removes(&splats.clips.get(neighbor.splat as usize), DVec2::new(u, v));
        if is_there && neighbor.radius >= least && neighbor.normal.dot(normal) > 0.0 {
            sum += neighbor.count * factor(neighbor.splat) * (-2.0 * r2).exp();
        }
    }
    sum
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

/// Where things in a row are the same as the first of them.
fn runs(count: usize, same: impl Fn(usize, usize) -> bool) -> Vec<Range<usize>> {
    let mut runs: Vec<Range<usize>> = Vec::new();
    for i in 0..count {
        match runs.last_mut() {
            Some(last) if same(last.start, i) => last.end = i + 1,
            _ => runs.push(i..i + 1),
        }
    }
    runs
}
