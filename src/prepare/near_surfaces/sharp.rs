//! Of a surface with sharp edges, which clip curves cut: how much room ε has near each splat, and how much the surface turns away there.
//!
//! Such splats are as large as the faces are, and what is within their radius may be anything: a part inside of a box, the next rib. Of those
//! ε is twice the spread alone, at least a 20th of a radius, and the spread is that of neighbors toward which the surface may have turned: where
//! normals are θ apart, a center d away is d sin θ from the plane at the most.
//!
//! Such neighbors that lie behind the splat's plane, by a quarter of that at least, tell that the surface bulges there: it may end by turning away. Its *turn* is
//! the largest of r sin θ / d, which on a sphere is about the radius r of the splat over that of the sphere. What is flat or hollow has none: there it is ridges alone,
//! and what lies before it, that end what is seen (`glsl/tile_project.comp.glsl`).

use rayon::prelude::*;

use super::{CELLS_AT_ONCE, CLOSE, Cell, Neighbor, SAME_WAY, Work, normal_of};
use crate::scene::Splats;

/// The least ε, in radii.
const LEAST_RADII: f64 = 0.05;

/// How far behind the plane what turns away is at least, of how far it may be.
const TURNED: f64 = 0.25;

/// What is known of each splat of a surface with sharp edges.
#[derive(Default)]
pub(in super::super) struct Sharp {
    /// The share of ε that it has room for, above 0 and at most 1; 1 of what can't be drawn.
    pub shares: Vec<f32>,
    /// By how much the surface turns away over a radius: a sine, or more where neighbors are nearer; 0 or more.
    pub turns: Vec<f32>,
}

impl Sharp {
    /// `radii`: ε as a multiple of the radius.
    pub fn of(splats: &Splats, radii: f64) -> Self {
        let mut all = Self { shares: vec![1.0; splats.len()], turns: vec![0.0; splats.len()] };
        if let Some(work) = Work::of(splats, radii) {
            let parts = work.grid.cells.par_chunks(CELLS_AT_ONCE);
            let found: Vec<_> = parts.flat_map_iter(|cells| work.sharp(cells)).collect();
            for (splat, share, turn) in found {
                (all.shares[splat as usize], all.turns[splat as usize]) = (share as f32, turn as f32);
            }
        }
        all
    }
}

impl Work<'_> {
    /// Of the splats of some cells, share and turn.
    fn sharp(&self, cells: &[Cell]) -> Vec<(u32, f64, f64)> {
        let mut found = Vec::new();
        for cell in cells {
            let [least, most] = self.radii_in(cell);
            let around = |reach: f64| self.neighbors(&self.grid.around(cell, CLOSE * reach));
            let near = (most <= 4.0 * least).then(|| around(most));
            for place in &self.grid.places[cell.places.clone()] {
                let number = place.splat as usize;
                let (share, turn) = match &near {
                    Some(near) => self.share_and_turn(number, near),
                    // Some are a hundred times as large as others beside them: each looks for its own.
                    None => self.share_and_turn(number, &around(self.radius(place))),
                };
                found.push((place.splat, share, turn));
            }
        }
        found
    }

    fn share_and_turn(&self, i: usize, near: &[Neighbor]) -> (f64, f64) {
        let (position, radius) = (self.splats.positions[i], self.splats.major_radius(i));
        let normal = normal_of(self.splats, i);
        let (mut spread, mut turn) = (0.0_f64, 0.0_f64);
        for neighbor in near.iter().filter(|neighbor| neighbor.normal.dot(normal) >= SAME_WAY) {
            let to = neighbor.position - position;
            let (off, distance) = (to.dot(normal), to.length());
            let sine = neighbor.normal.cross(normal).length();
            if distance <= CLOSE * radius && off.abs() <= distance * sine {
                spread = spread.max(off.abs());
                if off < -TURNED * distance * sine {
                    turn = turn.max(radius * sine / distance);
                }
            }
        }
        let share = (f64::max(2.0 * spread, LEAST_RADII * radius) / (self.radii * radius)).min(1.0);
        (share, turn)
    }
}
