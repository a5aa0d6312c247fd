//! Of a surface with sharp edges, which clip curves cut: how much room ε has near each splat, how much the surface turns away there, and how wide it is.
//!
//! Such splats are as large as the faces are, and what is within their radius may be anything: a part inside of a box, the next rib. Of those
//! ε is twice the spread alone, at least a 20th of a radius, and the spread is that of neighbors toward which the surface may have turned: where
//! normals are θ apart, a center d away is d sin θ from the plane at the most.
//!
//! Such neighbors that lie behind the splat's plane, by a quarter of that at least, tell that the surface bulges there: it may end by turning away. Its *turn* is
//! the largest of a sin θ / d, with a how far the splat reaches toward where that normal leans: on a sphere about the radius of the splat over that of the sphere, and of a sliver
//! along a cylinder what it is across, not along. How far the filter reaches it is told in that reach, too: beside the turn is the minor axis over it. What is flat or hollow has none: there it is ridges alone, and what lies before it, that end what is seen
//! (`glsl/tile_project.comp.glsl`).
//!
//! Slivers beside each other are a wide surface, and what is narrow in the image because it is seen edge-on is not: so a splat knows its *width*, how far what is in its surface, by the
//! same rule or in its plane, reaches across it, in its own minor axes.

use glam::DVec3;
use rayon::prelude::*;

use super::{CELLS_AT_ONCE, CLOSE, Cell, Neighbor, SAME_WAY, Work, normal_of};
use crate::scene::{Shapes, Splats};

/// The least ε, in radii.
const LEAST_RADII: f64 = 0.05;

/// How far behind the plane what turns away is at least, of how far it may be.
const TURNED: f64 = 0.25;

/// How far off the plane, in radii, what lies in it may be by rounding.
const FLAT: f64 = 1e-3;

/// Up from this part of a step: widths and reaches in even grids are no such numbers.
const ROUNDED: f64 = 0.63;

/// What is known of each splat of a surface with sharp edges.
#[derive(Default)]
pub(in super::super) struct Sharp {
    /// The share of ε that it has room for, above 0 and at most 1; 1 of what can't be drawn.
    pub shares: Vec<f32>,
    /// Turn and width, as shaders have them.
    pub bends: Vec<u32>,
}

/// What is around a splat.
struct Room {
    share: f64,
    turn: f64,
    /// The same with the minor axis for how far the splat reaches.
    curved: f64,
    /// Half of how wide the surface is across the splat, in minor axes; at least 1.
    width: f64,
}

impl Room {
    /// The upper half of the turn as an f32; of the lower half a byte is minor axis over reach, in 255 parts, and one the width, in eighths.
    fn bend(&self) -> u32 {
        let turn = ((self.turn as f32).to_bits() + 0x8000) & !0xffff;
        let minor = if self.turn > 0.0 { self.curved / self.turn } else { 1.0 };
        let part = (255.0 * minor + ROUNDED).clamp(1.0, 255.0) as u32;
        turn | part << 8 | (8.0 * self.width + ROUNDED).min(255.0) as u32
    }
}

impl Sharp {
    /// `radii`: ε as a multiple of the radius.
    pub fn of(splats: &Splats, radii: f64) -> Self {
        let mut all = Self { shares: vec![1.0; splats.len()], bends: vec![0; splats.len()] };
        if let Some(work) = Work::of(splats, radii) {
            let parts = work.grid.cells.par_chunks(CELLS_AT_ONCE);
            let found: Vec<_> = parts.flat_map_iter(|cells| work.sharp(cells)).collect();
            for (splat, room) in found {
                all.shares[splat as usize] = room.share as f32;
                all.bends[splat as usize] = room.bend();
            }
        }
        all
    }
}

impl Work<'_> {
    /// Of the splats of some cells.
    fn sharp(&self, cells: &[Cell]) -> Vec<(u32, Room)> {
        let mut found = Vec::new();
        for cell in cells {
            let [least, most] = self.radii_in(cell);
            let around = |reach: f64| self.neighbors(&self.grid.around(cell, CLOSE * reach));
            let near = (most <= 4.0 * least).then(|| around(most));
            for place in &self.grid.places[cell.places.clone()] {
                let number = place.splat as usize;
                let room = match &near {
                    Some(near) => self.room_of(number, near),
                    // Some are a hundred times as large as others beside them: each looks for its own.
                    None => self.room_of(number, &around(self.radius(place))),
                };
                found.push((place.splat, room));
            }
        }
        found
    }

    /// The direction of the minor axis, and how long it is, of tangent vectors that are orthogonal.
    fn minor_axis(&self, i: usize, normal: DVec3) -> (DVec3, f64) {
        match &self.splats.shapes {
            Shapes::Disks { radii, .. } => (normal.any_orthonormal_vector(), radii[i].into()),
            Shapes::Ellipses { s, t } => {
                let [s, t] = [s[i].as_dvec3(), t[i].as_dvec3()];
                let longer = if s.length_squared() >= t.length_squared() { s } else { t };
                (normal.cross(longer.normalize()), s.cross(t).length() / longer.length())
            }
        }
    }

    /// How far a splat reaches in a direction of its plane, times the direction's length.
    fn reach_along(&self, i: usize, direction: DVec3) -> f64 {
        match &self.splats.shapes {
            Shapes::Disks { radii, .. } => f64::from(radii[i]) * direction.length(),
            Shapes::Ellipses { s, t } => s[i].as_dvec3().dot(direction).hypot(t[i].as_dvec3().dot(direction)),
        }
    }

    fn room_of(&self, i: usize, near: &[Neighbor]) -> Room {
        let (position, radius) = (self.splats.positions[i], self.splats.major_radius(i));
        let normal = normal_of(self.splats, i);
        let (across, minor) = self.minor_axis(i, normal);
        let (mut spread, mut turn, mut curved, mut half_width) = (0.0_f64, 0.0_f64, 0.0_f64, minor);
        for neighbor in near.iter().filter(|neighbor| neighbor.normal.dot(normal) >= SAME_WAY) {
            let to = neighbor.position - position;
            let (off, distance) = (to.dot(normal), to.length());
            let turned = neighbor.normal - neighbor.normal.dot(normal) * normal;
            let most = distance * turned.length();
            if distance <= CLOSE * radius && off.abs() <= most {
                spread = spread.max(off.abs());
                if off < -TURNED * most {
                    turn = turn.max(self.reach_along(i, turned) / distance);
                    curved = curved.max(minor * turned.length() / distance);
                }
            }
            if distance <= CLOSE * radius && off.abs() <= most.max(FLAT * radius) {
                let reach = to.dot(across).abs() + self.reach_along(neighbor.splat as usize, across);
                half_width = half_width.max(reach);
            }
        }
        let share = (f64::max(2.0 * spread, LEAST_RADII * radius) / (self.radii * radius)).min(1.0);
        Room { share, turn, curved, width: half_width / minor }
    }
}
