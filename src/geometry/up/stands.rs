//! Whether a thing stands: on a base, its legs or its open lower edge, as it would on a table.
//!
//! Only places count, so that it does not matter whether a scan has the side below, nor what its normals are. What touches the table is the *contact*, the
//! places in the lowest 3% of the height; the convex hull of the contact is what the thing stands on, and its *footprint* is the convex hull of
//! all of it, seen from above. A thing stands where its center is well above the contact's hull, and that is a good part of the footprint. That is not enough:
//! a box stands on any side. So nothing may stand on its top nearly as well, nor on any side.
//!
//! What was seen from one side alone, as by a depth camera, has a level rim all around its back, and what hangs on a wall a flat back: neither is as deep as
//! it is wide, so that what stands has to be high, or to have legs, with nothing but these below it.

use glam::{DVec2, DVec3};

use super::{CELLS, Piece};
use crate::scene::Bounds;

/// The share of the height that touches the table.
const CONTACT: f64 = 0.03;

/// One of so many places may be below the table, or above all else: strays.
const STRAY: usize = 500;

/// So many places are looked at.
const SAMPLES: usize = 40_000;

/// How well a thing stands on an end of an axis.
#[derive(Clone, Copy, Default)]
struct Footing {
    /// The area of the contact's hull as a share of the footprint's.
    hull: f64,
    /// How far within the contact's hull the center is, in sides of a square like the footprint.
    inside: f64,
    /// Cells of a grid with contact, as a share of those with anything.
    cells: f64,
}

impl Footing {
    fn is_firm(&self) -> bool {
        self.hull >= 0.25 && self.inside >= 0.12
    }

    /// Another side of which this is true makes any other doubtful.
    fn is_possible(&self) -> bool {
        self.hull >= 0.2 && self.inside >= 0.03
    }
}

/// Whether pieces stand on what is lowest along z.
pub(super) fn stands(pieces: &[Piece]) -> bool {
    let step = pieces.len().div_ceil(SAMPLES).max(1);
    let thing: Vec<&Piece> = pieces.iter().step_by(step).collect();
    let Some(bounds) = bounds_but_for_strays(&thing) else { return false };
    let [bottom, top] = footings(&thing, &bounds, 2);
    let may_stand_on = |axis: usize| footings(&thing, &bounds, axis).iter().any(Footing::is_possible);
    if !bottom.is_firm() || top.hull > 0.6 * bottom.hull || may_stand_on(0) || may_stand_on(1) {
        return false;
    }
    let extent = bounds.max - bounds.min;
    let wide = extent.x.max(extent.y);
    let is_high = (0.6 * wide..=2.5 * wide).contains(&extent.z);
    let is_deep = deep_cells(&thing, &bounds) >= 0.5;
    let has_legs = bottom.hull >= 0.5 && bottom.cells <= 0.15 && is_deep;
    has_legs || is_high && (bottom.cells >= 0.3 || extent.z >= wide || is_deep)
}

/// `None` of what has no extent along some axis.
fn bounds_but_for_strays(thing: &[&Piece]) -> Option<Bounds> {
    let ends = |axis: usize| {
        let mut along: Vec<f64> = thing.iter().map(|piece| piece.place[axis]).collect();
        along.sort_unstable_by(f64::total_cmp);
        let strays = along.len() / STRAY;
        Some([*along.get(strays)?, *along.iter().nth_back(strays)?])
    };
    let [x, y, z] = [ends(0)?, ends(1)?, ends(2)?];
    let [min, max] = [0, 1].map(|end| DVec3::new(x[end], y[end], z[end]));
    min.cmplt(max).all().then_some(Bounds { min, max })
}

/// A place seen along an axis, where the bounds are from 0 to 1; and how far along that axis it is.
fn seen_along(axis: usize, bounds: &Bounds, place: DVec3) -> (DVec2, f64) {
    let at = (place - bounds.min) / (bounds.max - bounds.min);
    (DVec2::new(at[(axis + 1) % 3], at[(axis + 2) % 3]), at[axis])
}

/// The cell of a grid that a place is in.
fn cell(at: DVec2) -> usize {
    let [column, row] = (at * CELLS as f64).to_array().map(|at| (at.max(0.0) as usize).min(CELLS - 1));
    row * CELLS + column
}

/// How a thing would stand on its lower end along an axis, and on its upper one.
fn footings(thing: &[&Piece], bounds: &Bounds, axis: usize) -> [Footing; 2] {
    let seen: Vec<(DVec2, f64)> = thing.iter().map(|piece| seen_along(axis, bounds, piece.place)).collect();
    let area: f64 = thing.iter().map(|piece| piece.area).sum();
    let moment: DVec2 = seen.iter().zip(thing).map(|((at, _), piece)| *at * piece.area).sum();
    let footprint = area_of(&hull(seen.iter().map(|(at, _)| *at).collect()));
    let cells_of = |part: &dyn Fn(f64) -> bool| {
        let mut cells = [false; CELLS * CELLS];
        seen.iter().filter(|(_, height)| part(*height)).for_each(|(at, _)| cells[cell(*at)] = true);
        cells.iter().filter(|is_there| **is_there).count() as f64
    };
    let all = cells_of(&|_| true);
    [0, 1].map(|end| {
        let touches = |height: f64| if end == 0 { height <= CONTACT } else { height >= 1.0 - CONTACT };
        let contact = hull(seen.iter().filter(|(_, height)| touches(*height)).map(|(at, _)| *at).collect());
        Footing {
            hull: area_of(&contact) / footprint,
            inside: depth_in(&contact, moment / area) / footprint.sqrt(),
            cells: cells_of(&touches) / all,
        }
    })
}

/// The share of cells, seen along z, whose surfaces are more than a fifth of the height apart.
fn deep_cells(thing: &[&Piece], bounds: &Bounds) -> f64 {
    let mut heights = [[f64::INFINITY, f64::NEG_INFINITY]; CELLS * CELLS];
    for piece in thing {
        let (at, height) = seen_along(2, bounds, piece.place);
        let [low, high] = &mut heights[cell(at)];
        (*low, *high) = (low.min(height), high.max(height));
    }
    let there = heights.iter().filter(|[low, high]| low <= high);
    let deep = there.clone().filter(|[low, high]| high - low > 0.2).count();
    deep as f64 / there.count() as f64
}

/// The corners of the convex hull, counterclockwise.
fn hull(mut places: Vec<DVec2>) -> Vec<DVec2> {
    places.sort_unstable_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    let half = |places: &mut dyn Iterator<Item = DVec2>| {
        let mut corners: Vec<DVec2> = Vec::new();
        for place in places {
            while let [.., a, b] = corners[..]
                && (b - a).perp_dot(place - b) <= 0.0
            {
                corners.pop();
            }
            corners.push(place);
        }
        corners.pop();
        corners
    };
    let mut corners = half(&mut places.iter().copied());
    corners.extend(half(&mut places.iter().rev().copied()));
    corners
}

fn sides(corners: &[DVec2]) -> impl Iterator<Item = (DVec2, DVec2)> {
    corners.iter().copied().zip(corners.iter().copied().cycle().skip(1))
}

fn area_of(corners: &[DVec2]) -> f64 {
    0.5 * sides(corners).map(|(a, b)| a.perp_dot(b)).sum::<f64>()
}

/// How far a place is from the nearest side within; below 0 outside.
fn depth_in(corners: &[DVec2], place: DVec2) -> f64 {
    let depths = sides(corners).map(|(a, b)| (b - a).normalize_or_zero().perp_dot(place - a));
    if corners.len() < 3 { f64::NEG_INFINITY } else { depths.fold(f64::INFINITY, f64::min) }
}

#[cfg(test)]
mod tests;
