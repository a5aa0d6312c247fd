//! How many of a chunk's splats may face an eye, known from where the eye is alone: a frame asks once, however many splats there are.
//!
//! A splat at p with a normal n, both from the local origin, faces an eye at e = D u where n · (e − p) > 0, that is n · u > (n · p) / D. Splats are counted by cells of their normals, each with
//! the least n · p, q; all normals of a cell are within σ of a direction a. Of eyes in a cell of directions all are within δ of a direction c, and of those from one distance to another one, by R over D from i₀ to i₁, where all p
//! are within R, n · p / D is m = min(q i₀, q i₁) / R at least. So none of a cell's splats faces any of these eyes where the angle between a and c exceeds arccos m + σ + δ. All others are counted.
//!
//! That takes some microseconds, and is kept: eyes that move stay within a cell for long, and what is found for a cell is the same whenever it is found.

use std::{
    f64::consts::PI,
    sync::atomic::{AtomicU64, Ordering::Relaxed},
};

use glam::{DVec3, Vec3};

use super::{blocks::Block, quad::Quad};

/// Cells along a side of a cube's, for normals: within 5.1° of their middles.
const NORMALS_SIDE: usize = 16;

/// The same for eyes: within 1.3°.
const EYES_SIDE: usize = 64;

/// Distances are told apart by R / D, in so many steps up to the nearest.
const STEPS: usize = 16;

/// An eye is no nearer to the local origin than so many R.
const NEAREST: f64 = 4.0;

/// What a device finds of a normal and a ray may be off by, as an angle (`passes/plan/blocks/balls.rs`), where a splat is a quarter farther than D at most; and what is rounded here.
const RESERVE_RAD: f64 = 2e-3;

/// Counts that are kept: a scene may be in many places at once.
const KEPT_BITS: u32 = 10;

/// A direction, and how far others of its cell are from it, of a cube with so many cells along a side.
fn cell(side: usize, number: usize) -> (DVec3, f64) {
    let (face, x, y) = (number / (side * side), number % side, number / side % side);
    let at = |x: usize, y: usize| {
        let [x, y] = [x, y].map(|along| along as f64 / side as f64 - 1.0);
        let mut all = [0.0; 3];
        all[face / 2] = if face % 2 == 0 { 1.0 } else { -1.0 };
        (all[(face / 2 + 1) % 3], all[(face / 2 + 2) % 3]) = (x, y);
        DVec3::from(all).normalize()
    };
    let middle = at(2 * x + 1, 2 * y + 1);
    // A cell is between planes through the cube's middle: the farthest of it is a corner.
    let corners = [(0, 0), (0, 2), (2, 0), (2, 2)].map(|(right, down)| at(2 * x + right, 2 * y + down));
    let away = corners.iter().map(|corner| middle.angle_between(*corner)).fold(0.0, f64::max);
    (middle, away)
}

/// The cell of a direction of any length but 0.
fn cell_of(side: usize, direction: DVec3) -> usize {
    let (all, away) = (direction.to_array(), direction.abs());
    let axis = if away.x >= away.y && away.x >= away.z { 0 } else { 1 + usize::from(away.z > away.y) };
    let along = |other: usize| {
        let share = all[(axis + other) % 3] / all[axis].abs();
        (((share + 1.0) * (0.5 * side as f64)) as usize).min(side - 1)
    };
    (2 * axis + usize::from(all[axis] < 0.0)) * side * side + along(2) * side + along(1)
}

/// Splats by their normals, while a chunk is packed.
pub(super) struct Normals {
    /// Of each cell how many, and the least of n · p.
    cells: Vec<(u32, f64)>,
    farthest: f64,
}

impl Normals {
    /// None.
    pub fn new() -> Self {
        Self { cells: vec![(0, f64::INFINITY); 6 * NORMALS_SIDE * NORMALS_SIDE], farthest: 0.0 }
    }

    /// Takes in a splat.
    pub fn add(&mut self, normal: DVec3, center: DVec3) {
        let (count, least) = &mut self.cells[cell_of(NORMALS_SIDE, normal)];
        *count += 1;
        *least = least.min(normal.dot(center));
        self.farthest = self.farthest.max(center.length());
    }
}

/// The splats of a cell of normals.
struct Counted {
    /// a.
    direction: Vec3,
    /// q / R.
    least: f32,
    count: u32,
}

/// How many splats may face an eye.
pub struct Facing {
    normals: Vec<Counted>,
    /// R, local unit.
    farthest: f64,
    /// All of them, in a ball around the local origin.
    pub whole: Quad,
    /// What was found: one more than the number of a cell and a step, and in the lower half how many.
    kept: Box<[AtomicU64]>,
}

impl Facing {
    /// Of all of these.
    pub(super) fn new(normals: &Normals, largest_radius: f64) -> Self {
        let farthest = normals.farthest.max(f64::MIN_POSITIVE);
        let of = |(number, &(count, least)): (usize, &(u32, f64))| Counted {
            direction: cell(NORMALS_SIDE, number).0.as_vec3(),
            least: (least / farthest).clamp(-1.0, 1.0) as f32,
            count,
        };
        let all = Block {
            count: normals.cells.iter().map(|cell| cell.0).sum(),
            radius: farthest,
            spread_rad: PI,
            spread_sin_cos: PI.sin_cos().into(),
            largest_radius,
            ..Block::EMPTY
        };
        Self {
            normals: normals.cells.iter().enumerate().filter(|(_, cell)| cell.0 > 0).map(of).collect(),
            farthest,
            whole: Quad::of(&[all]),
            kept: (0..1 << KEPT_BITS).map(|_| AtomicU64::new(0)).collect(),
        }
    }

    /// No more of them face an eye that is there from the local origin, local unit; or, if it `is_far`, in that direction. `None` where it is too near for that.
    pub fn most(&self, eye: DVec3, is_far: bool) -> Option<u32> {
        let near = if is_far { 0.0 } else { self.farthest / eye.length() };
        self.most_toward(eye, near)
    }

    /// How far the farthest is from the local origin.
    pub fn farthest(&self) -> f64 {
        self.farthest
    }

    /// The same by a direction of any length, and that as a part of the eye's distance.
    pub fn most_toward(&self, eye: DVec3, near: f64) -> Option<u32> {
        // NaN is too near.
        let is_known = near * (NEAREST * (1.0 + 1e-9)) < 1.0;
        let step = ((near * (NEAREST * STEPS as f64)) as usize).min(STEPS - 1);
        is_known.then(|| self.kept_of(cell_of(EYES_SIDE, eye) * STEPS + step))
    }

    /// By the number of a cell and a step.
    fn kept_of(&self, number: usize) -> u32 {
        let key = number as u32 + 1;
        let place = (key.wrapping_mul(0x9e37_79b1) >> (u32::BITS - KEPT_BITS)) as usize;
        let places = [&self.kept[place], &self.kept[place ^ 1]];
        let found = places.map(|place| place.load(Relaxed));
        if let Some(found) = found.iter().find(|found| *found >> u32::BITS == u64::from(key)) {
            return *found as u32;
        }
        let count = self.count(number);
        let place = if found[0] == 0 { places[0] } else { places[1] };
        place.store(u64::from(key) << u32::BITS | u64::from(count), Relaxed);
        count
    }

    /// Looks at all cells of normals.
    fn count(&self, number: usize) -> u32 {
        let (direction, away) = cell(EYES_SIDE, number / STEPS);
        let direction = direction.as_vec3();
        let [from, to] = [0, 1].map(|i| (number % STEPS + i) as f32 / (STEPS as f64 * NEAREST) as f32);
        let widest = cell(NORMALS_SIDE, (NORMALS_SIDE / 2) * (NORMALS_SIDE + 1)).1;
        let (sin, cos) = (widest + away + RESERVE_RAD).sin_cos();
        let (sin, cos) = (sin as f32, cos as f32);
        let of = |of: &Counted| {
            let inward = (of.least * from).min(of.least * to);
            // The cosine of the sum, which is less than 180°.
            let limit = inward * cos - (1.0 - inward * inward).sqrt() * sin;
            // NaN is counted.
            if of.direction.dot(direction) < limit { 0 } else { of.count }
        };
        self.normals.iter().map(of).sum()
    }
}

#[cfg(test)]
mod tests;
