//! Clip curves: `clip_a1 clip_a3 clip_u clip_v clip_w`, the same with `clip2_`, and `clip_mode`.
//!
//! The first two are angles in radians, the next the middle control point in (u, v), the last its weight: a [`ClipCurve`] on the tangent
//! vectors of the file. A vertex whose five values are NaN has no such curve. `clip_mode` is 0 where either of two curves
//! removes, 1 where both must; without it, it is 0.

use glam::Vec2;

use super::body::Table;
use crate::scene::{Clip, ClipCurve};

/// The properties of each curve.
pub(super) const CURVES: [[&str; 5]; 2] = [
    ["clip_a1", "clip_a3", "clip_u", "clip_v", "clip_w"],
    ["clip2_a1", "clip2_a3", "clip2_u", "clip2_v", "clip2_w"],
];

/// How two curves act together.
pub(super) const MODE: &str = "clip_mode";

/// The numbers of their columns; one curve at least.
#[derive(Clone, Copy, Debug)]
pub(super) struct ClipColumns {
    pub curves: [Option<[usize; 5]>; 2],
    pub mode: Option<usize>,
}

/// What was read of them.
#[derive(Debug, Default)]
pub(super) struct FileClips {
    /// One a vertex.
    pub each: Vec<Clip>,
    /// The first vertex with another mode than 0 and 1.
    pub unknown_mode: Option<(usize, f64)>,
}

impl FileClips {
    /// Adds those of a table.
    pub(super) fn extend(&mut self, columns: &ClipColumns, table: &Table, rows: usize) {
        for row in 0..rows {
            let value = |column: usize| table.column(column).get(row).copied().unwrap_or(f64::NAN);
            let mode = columns.mode.map_or(0.0, value);
            if mode != 0.0 && mode != 1.0 {
                self.unknown_mode.get_or_insert((self.each.len(), mode));
            }
            let curves = columns.curves.map(|curve| curve.and_then(|columns| curve_of(columns.map(value))));
            self.each.push(Clip::of(curves, mode == 1.0));
        }
    }
}

/// None of five NaN.
fn curve_of(values: [f64; 5]) -> Option<ClipCurve> {
    let [start_rad, end_rad, u, v, weight] = values.map(|value| value as f32);
    let curve = ClipCurve { start_rad, end_rad, middle: Vec2::new(u, v), weight };
    (!values.iter().all(|value| value.is_nan())).then_some(curve)
}
