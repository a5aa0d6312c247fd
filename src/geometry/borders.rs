//! Which splats lie at a border of their surface: those reach further than their rims where edges are covered in part (`glsl/inc/reach.glsl`).
//!
//! A splat is at a border where at three places in a row, of 32 around its rim, there is no other splat of the surface, nor the center of one that touches it within 60° of that way. Of the surface are
//! those whose normals are within 45° of its own, and that are no smaller than half of it. What has fewer such splats than there are along half of the outline of a square of as
//! many has gaps here and there, and no border: it has none of them. Nor has what is of more than 100 thousand splats.

use std::{
    f64::consts::TAU,
    sync::atomic::{AtomicBool, Ordering},
};

use glam::DVec3;
use rayon::prelude::*;

use super::overlaps::{
    CELLS_AT_ONCE, dual_frame,
    grids::{Grids, Search},
};
use crate::scene::Splats;

/// Places of a rim.
const PLACES: usize = 32;

/// So many of them with nothing next to each other are an end of the surface: fewer are a gap between splats.
const IN_A_ROW: u32 = 3;

/// No splat of the surface is smaller than this share of the one at whose rim it is looked for,
const LEAST_SIZE: f64 = 0.5;

/// nor has a normal with a smaller cosine to its own.
const SAME_WAY: f64 = 0.7;

/// The cosine up to which a way leads toward a neighbor: a little less than that of 60°, at which neighbors lie in regular grids.
const TOWARD: f64 = 0.49;

/// A place is on a splat up to this squared radius: more than 1, which a regular grid has at its crossings.
const ON_SPLAT: f64 = 1.0 + 1e-6;

/// Of more splats nobody looks for borders: they are about as small as pixels, whose sums tell what they cover, and it would take time and memory.
const MOST: usize = 100_000;

/// Cosine and sine of the way to each place.
type Ways = [[f64; 2]; PLACES];

/// Whether each splat is at a border; `None` where none is. A splat that can't be drawn is not.
pub(crate) fn at_border(splats: &Splats) -> Option<Vec<bool>> {
    if splats.len() > MOST {
        return None;
    }
    let grids = Grids::new(splats);
    let ways: Ways = std::array::from_fn(|place| (TAU * place as f64 / PLACES as f64).sin_cos())
        .map(|(sin, cos)| [cos, sin]);
    let found: Vec<AtomicBool> = (0..splats.len()).map(|_| AtomicBool::new(false)).collect();
    (0..grids.len().div_ceil(CELLS_AT_ONCE)).into_par_iter().for_each(|task| {
        let mut search = Search::default();
        for cell in task * CELLS_AT_ONCE..grids.len().min((task + 1) * CELLS_AT_ONCE) {
            let Some(near) = grids.that_touch(splats, cell, &mut search) else { continue };
            for &splat in grids.splats_in(cell) {
                if is_at_border(splats, splat as usize, &ways, near.clone()) {
                    found[splat as usize].store(true, Ordering::Relaxed);
                }
            }
        }
    });
    let found: Vec<bool> = found.into_iter().map(AtomicBool::into_inner).collect();
    let count = found.iter().filter(|at| **at).count() as f64;
    (count > 0.0 && count >= 2.0 * (grids.numbers().len() as f64).sqrt()).then_some(found)
}

/// `near`: all that may touch it, itself among them.
fn is_at_border(splats: &Splats, i: usize, ways: &Ways, near: impl Iterator<Item = u32> + Clone) -> bool {
    let (center, radius) = (splats.positions[i], splats.major_radius(i));
    let [to_u, to_v, normal] = dual_frame(splats, i);
    let across = across(normal);
    let along = normal.cross(across);
    let beside = near.map(|other| other as usize).filter_map(|other| {
        let to = splats.positions[other] - center;
        let its_radius = splats.major_radius(other);
        let touches =
            its_radius >= LEAST_SIZE * radius && to.length_squared() <= (radius + its_radius).powi(2);
        (other != i && touches && dual_frame(splats, other)[2].dot(normal) >= SAME_WAY)
            .then_some((other, to, its_radius))
    });
    let mut left = u32::MAX; // a bit for each place where nothing is yet
    // Ways toward neighbors are most of the places, and quickly told.
    for (_, to, _) in beside.clone() {
        let (x, y) = (across.dot(to), along.dot(to));
        let least = TOWARD * x.hypot(y);
        let toward = |(place, [cos, sin]): (usize, &[f64; 2])| u32::from(cos * x + sin * y >= least) << place;
        let toward = ways.iter().enumerate().map(toward).fold(0, |all, one| all | one);
        left &= if least > 0.0 { !toward } else { u32::MAX };
        if left == 0 {
            return false;
        }
    }
    for (other, to, its_radius) in beside {
        let [its_u, its_v, _] = dual_frame(splats, other);
        let before = left;
        for place in (0..PLACES).filter(|place| before >> place & 1 != 0) {
            let [cos, sin] = ways[place];
            let direction = cos * across + sin * along;
            let from_other = direction / to_u.dot(direction).hypot(to_v.dot(direction)) - to;
            let is_on = from_other.length_squared() <= ON_SPLAT * its_radius * its_radius
                && its_u.dot(from_other).powi(2) + its_v.dot(from_other).powi(2) <= ON_SPLAT;
            if is_on {
                left &= !(1 << place);
            }
        }
        if left == 0 {
            return false;
        }
    }
    (1..IN_A_ROW).fold(left, |in_a_row, by| in_a_row & left.rotate_left(by)) != 0
}

/// The way to the first place, whatever tangent vectors a splat has: in its plane, the way of the first axis that is not nearly its normal.
fn across(normal: DVec3) -> DVec3 {
    let axis = [DVec3::X, DVec3::Y, DVec3::Z].into_iter().find(|axis| axis.dot(normal).abs() < 0.59);
    axis.unwrap_or(DVec3::X).reject_from_normalized(normal).normalize()
}

#[cfg(test)]
mod tests;
