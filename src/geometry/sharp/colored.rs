//! What of the file's colors each triangle stands for while edges collapse.
//!
//! A splat has one color, so that a triangle over which the surface's color varies is wrong by that variation: the integral of the squared
//! difference to the mean (`tint`), the square of a length as the quadrics' distances are. By how much a collapse adds to it, over the triangles
//! around the vertex, is added to its rank. To know it, each triangle of the input is one sample, at its middle, which belongs to the triangle that is
//! now there: when a vertex goes, those of its triangles are given to the new ones, on their side of a ridge.

use glam::DVec3;
use rayon::prelude::*;

use super::{around::Around, paint::Paint, tint::Tint};

/// The mean squared difference of colors that are the same.
const SAME: f64 = 1e-9;

/// A triangle of the input.
struct Sample {
    place: DVec3,
    tint: Tint,
    /// That stands for it now.
    triangle: u32,
}

/// A mesh of colors on its way.
pub(super) struct Colored {
    samples: Vec<Sample>,
    /// Where those of each triangle begin in `order`, and the end.
    starts: Vec<u32>,
    order: Vec<u32>,
    /// Of the triangles.
    pub tints: Vec<Tint>,
}

/// The triangles around a vertex.
pub(super) struct Fan {
    from: u32,
    /// Their numbers, their corners, and on which side of the vertex's ridge they are.
    triangles: Vec<(u32, [u32; 3], usize)>,
}

impl Fan {
    /// `ends`: those of the piece of a ridge within which the vertex lies.
    pub fn of(from: u32, around: &[u32], triangles: &[[u32; 3]], ends: Option<[u32; 2]>) -> Self {
        let mut fan: Vec<_> = around.iter().map(|i| (*i, triangles[*i as usize], 0)).collect();
        let Some(ends) = ends else { return Self { from, triangles: fan } };
        (0..fan.len()).for_each(|i| fan[i].2 = i);
        // Those that share an edge that is no ridge are on one side.
        for i in 0..fan.len() {
            for j in 0..i {
                let (a, b) = (fan[i], fan[j]);
                let is_shared =
                    |vertex: &u32| *vertex != from && !ends.contains(vertex) && b.1.contains(vertex);
                if a.2 != b.2 && a.1.iter().any(is_shared) {
                    fan.iter_mut().filter(|one| one.2 == a.2).for_each(|one| one.2 = b.2);
                }
            }
        }
        Self { from, triangles: fan }
    }

    /// What is left of them once the vertex lies at another.
    fn homes(&self, positions: &[DVec3], to: u32) -> Vec<Home> {
        let left = self.triangles.iter().filter(|(_, corners, _)| !corners.contains(&to));
        let home = |&(triangle, corners, side): &(u32, [u32; 3], usize)| {
            let at = corners.iter().position(|vertex| *vertex == self.from).unwrap_or(0);
            let corner = positions[to as usize];
            let [a, b] = [1, 2].map(|i| positions[corners[(at + i) % 3] as usize] - corner);
            let normal = a.cross(b);
            let shares = [b.cross(normal), normal.cross(a)].map(|share| share / normal.length_squared());
            Home { triangle, side, corner, shares, tint: Tint::default() }
        };
        left.map(home).collect()
    }
}

/// A triangle once the vertex is gone.
struct Home {
    triangle: u32,
    side: usize,
    corner: DVec3,
    /// From a place to its shares of the other corners.
    shares: [DVec3; 2],
    tint: Tint,
}

impl Home {
    /// How far a place is within, in shares of corners; below 0 outside.
    fn within(&self, place: DVec3) -> f64 {
        let [a, b] = self.shares.map(|share| share.dot(place - self.corner));
        a.min(b).min(1.0 - a - b)
    }
}

impl Colored {
    /// Each triangle stands for itself.
    pub fn new(positions: &[DVec3], triangles: &[[u32; 3]], paint: &Paint) -> Self {
        let sample = |(i, corners): (usize, &[u32; 3])| {
            let [p, q, r] = corners.map(|vertex| positions[vertex as usize]);
            let place = (p + q + r) / 3.0;
            Sample { place, tint: paint.tint(i, [p, q, r]), triangle: i as u32 }
        };
        let samples = triangles.par_iter().enumerate().map(sample).collect();
        let mut made = Self { samples, starts: Vec::new(), order: Vec::new(), tints: Vec::new() };
        made.sort(triangles.len());
        made
    }

    /// Finds the samples of each triangle.
    pub fn sort(&mut self, triangles: usize) {
        self.starts = vec![0; triangles + 1];
        self.tints = vec![Tint::default(); triangles];
        self.order = vec![0; self.samples.len()];
        for sample in &self.samples {
            self.starts[sample.triangle as usize + 1] += 1;
            self.tints[sample.triangle as usize].add(&sample.tint);
        }
        (0..triangles).for_each(|i| self.starts[i + 1] += self.starts[i]);
        let mut free = self.starts.clone();
        for (i, sample) in self.samples.iter().enumerate() {
            let free = &mut free[sample.triangle as usize];
            self.order[*free as usize] = i as u32;
            *free += 1;
        }
    }

    /// Tells that only these triangles are left.
    pub fn keep(&mut self, is_left: &[bool]) {
        let mut next = 0;
        let number = |left: &bool| {
            let number = next;
            next += u32::from(*left);
            number
        };
        let numbers: Vec<u32> = is_left.iter().map(number).collect();
        self.samples.retain(|sample| is_left[sample.triangle as usize]);
        self.samples.iter_mut().for_each(|sample| sample.triangle = numbers[sample.triangle as usize]);
        self.sort(next as usize);
    }

    fn of_triangle(&self, triangle: u32) -> &[u32] {
        let triangle = triangle as usize;
        &self.order[self.starts[triangle] as usize..self.starts[triangle + 1] as usize]
    }

    /// The colors for which so many splats of a triangle stand: each place of the surface is that of the splat from which it is least `away`.
    pub fn of_splats(&self, triangle: usize, splats: usize, away: impl Fn(usize, DVec3) -> f64) -> Vec<Tint> {
        if splats == 1 {
            return vec![self.tints[triangle]];
        }
        let mut tints = vec![Tint::default(); splats];
        for sample in self.of_triangle(triangle as u32).iter().map(|i| &self.samples[*i as usize]) {
            let order = |a: &usize, b: &usize| away(*a, sample.place).total_cmp(&away(*b, sample.place));
            (0..splats).min_by(order).into_iter().for_each(|i| tints[i].add(&sample.tint));
        }
        tints
    }

    /// Triangles that stand for the middle of none of the input have the color of those around them.
    pub fn fill(&mut self, vertices: usize, triangles: &[[u32; 3]]) {
        let empty: Vec<usize> = (0..triangles.len()).filter(|i| self.tints[*i].mean().is_none()).collect();
        if empty.is_empty() {
            return;
        }
        let around = Around::of(vertices, triangles);
        let beside = |i: &usize| {
            let mut tint = Tint::default();
            let all = triangles[*i].iter().flat_map(|vertex| around.of_vertex(*vertex));
            all.for_each(|other| tint.add(&self.tints[*other as usize]));
            tint
        };
        let filled: Vec<Tint> = empty.iter().map(beside).collect();
        empty.into_iter().zip(filled).for_each(|(i, tint)| self.tints[i] = tint.even());
    }

    /// By how much more colors are off once the vertex of a fan lies at another; `None` where that comes to be more than `most`, a length, in a
    /// triangle, and was not before.
    pub fn price(&self, positions: &[DVec3], fan: &Fan, to: u32, most: f64) -> Option<f64> {
        let (mut whole, mut before, mut worst) = (Tint::default(), 0.0, 0.0_f64);
        for (triangle, ..) in &fan.triangles {
            let tint = &self.tints[*triangle as usize];
            whole.add(tint);
            before += tint.off();
            worst = worst.max(tint.off());
        }
        // No parts are off by more than the whole.
        if whole.off() <= SAME * whole.area {
            return Some(0.0);
        }
        let mut homes = fan.homes(positions, to);
        self.each_move(fan, &mut homes, |home, sample| home.tint.add(&self.samples[sample as usize].tint));
        let after: f64 = homes.iter().map(|home| home.tint.off()).sum();
        let is_within = |home: &Home| home.tint.is_within(most) || home.tint.off() <= worst;
        homes.iter().all(is_within).then_some(after - before)
    }

    /// Gives the samples of a fan to the triangles that are left of it.
    pub fn collapse(&mut self, positions: &[DVec3], fan: &Fan, to: u32) {
        let mut moves: Vec<(u32, u32)> = Vec::new();
        self.each_move(fan, &mut fan.homes(positions, to), |home, sample| {
            moves.push((sample, home.triangle))
        });
        moves.into_iter().for_each(|(sample, triangle)| self.samples[sample as usize].triangle = triangle);
    }

    /// Each sample of a fan, with its new triangle: that within which it is, or from which it is the least way.
    fn each_move(&self, fan: &Fan, homes: &mut [Home], mut then: impl FnMut(&mut Home, u32)) {
        for &(triangle, _, side) in &fan.triangles {
            let any = homes.iter().all(|home| home.side != side);
            for &sample in self.of_triangle(triangle) {
                let place = self.samples[sample as usize].place;
                let mut best = (f64::NEG_INFINITY, None);
                for home in homes.iter_mut().filter(|home| any || home.side == side) {
                    let within = home.within(place);
                    if within > best.0 {
                        best = (within, Some(home));
                    }
                }
                if let Some(home) = best.1 {
                    then(home, sample);
                }
            }
        }
    }
}
