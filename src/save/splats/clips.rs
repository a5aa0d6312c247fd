//! The columns of clip curves in a file.

use crate::scene::{Clip, ClipCurve, Clips};

/// Which of them there are.
pub(super) struct ClipColumns {
    /// The most curves of a splat.
    curves: usize,
    /// Both of two must remove somewhere.
    mode: bool,
}

const CURVES: [[&str; 5]; 2] = [
    ["clip_a1", "clip_a3", "clip_u", "clip_v", "clip_w"],
    ["clip2_a1", "clip2_a3", "clip2_u", "clip2_v", "clip2_w"],
];

impl ClipColumns {
    pub fn of(clips: &Clips) -> Self {
        let count = |clip: &Clip| clip.curves().into_iter().flatten().count();
        Self {
            curves: clips.iter().map(count).max().unwrap_or(0),
            mode: clips.iter().any(|clip| matches!(clip, Clip::Both(..))),
        }
    }

    /// Types and names.
    pub fn properties(&self) -> impl Iterator<Item = [&'static str; 2]> {
        let curves = CURVES.into_iter().take(self.curves).flatten().map(|name| ["float", name]);
        curves.chain(self.mode.then_some(["uchar", "clip_mode"]))
    }

    /// NaN where a splat has no such curve.
    pub fn push(&self, row: &mut Vec<u8>, clip: Clip) {
        for curve in clip.curves().into_iter().take(self.curves) {
            let values = curve.map_or([f32::NAN; 5], |curve| {
                let ClipCurve { start_rad, end_rad, middle, weight } = *curve;
                [start_rad, end_rad, middle.x, middle.y, weight]
            });
            values.iter().for_each(|value| row.extend(value.to_le_bytes()));
        }
        if self.mode {
            row.push(matches!(clip, Clip::Both(..)).into());
        }
    }
}
