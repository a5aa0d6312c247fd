//! Filters over distance: a checkerboard in perspective from far to near, against the ground truth.

mod claims;
mod plot;
mod table;

use std::collections::BTreeMap;

use serde::Serialize;

pub use claims::Claim;

use super::{
    DeviceReport,
    compare::{ErrorFigures, WeightedFilter},
};
use crate::reference::MOST_SAMPLES_PER_SIDE;

/// By how many degrees the board is tilted against the view where nothing else is said: so much that a splat can be larger
/// than the filter along one axis and smaller along the other.
pub const DEFAULT_TILT_DEG: f64 = 75.0;

/// How far the path reaches: projected spacing of the splats in the middle of the picture, in pixels.
pub const PIXELS_PER_SPLAT: [f64; 2] = [0.05, 50.0];

/// The radius of the low-pass filter in pixels, √2.
const FILTER_RADIUS_PX: f64 = std::f64::consts::SQRT_2;

/// All filters at all distances.
#[derive(Clone, Debug, Serialize)]
pub struct ZoomReport {
    /// The version of surfel.
    pub surfel: String,
    /// The device.
    pub device: DeviceReport,
    /// The settings that all have in common, by the names of the options.
    pub settings: BTreeMap<&'static str, String>,
    /// Width and height in pixels.
    pub size_px: [u32; 2],
    /// Samples along a pixel's side in the ground truth, at least; see [`ZoomStep::samples_per_side`].
    pub samples_per_side: u32,
    /// The board.
    pub board: Board,
    /// The filters that are compared.
    pub filters: Vec<WeightedFilter>,
    /// From far to near.
    pub steps: Vec<ZoomStep>,
    /// The claims about `adjust`, judged by the figures.
    pub claims: Vec<Claim>,
}

/// The checkerboard.
#[derive(Clone, Debug, Serialize)]
pub struct Board {
    /// Splats along its side.
    pub splats_per_side: usize,
    /// Splats along the side of a field.
    pub splats_per_field: usize,
    /// A splat's radius in units of the spacing.
    pub radius: f64,
    /// Degrees between its normal and the view.
    pub tilt_deg: f64,
}

/// One distance.
#[derive(Clone, Debug, Serialize)]
pub struct ZoomStep {
    /// The projected spacing of the splats across the view in the middle of the picture, in pixels.
    pub pixels_per_splat: f64,
    /// Samples along a pixel's side in the ground truth.
    pub samples_per_side: u32,
    /// One a filter, in their order; `None` where it could not be drawn.
    pub figures: Vec<Option<ZoomFigures>>,
}

/// One filter at one distance.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ZoomFigures {
    /// Fragments of the accumulation in one frame; `None` where not counted.
    pub fragments: Option<u64>,
    /// Against the ground truth.
    pub error: ErrorFigures,
}

impl ZoomStep {
    /// Whether splats in the middle of the picture are larger than the filter along one axis and smaller along the other.
    pub fn is_mixed(&self, board: &Board) -> bool {
        let major_px = self.pixels_per_splat * board.radius;
        let minor_px = major_px * board.tilt_deg.to_radians().cos();
        minor_px < FILTER_RADIUS_PX && FILTER_RADIUS_PX < major_px
    }

    /// The root mean square of a filter's error.
    fn rms(&self, filter: usize) -> Option<f64> {
        Some(self.figures.get(filter)?.as_ref()?.error.color?.rms)
    }

    fn fragments(&self, filter: usize) -> Option<f64> {
        Some(self.figures.get(filter)?.as_ref()?.fragments? as f64)
    }
}

/// How many samples along a pixel's side the ground truth needs at this distance: two between neighboring splats where the
/// tilt brings them together, or it would alias itself; from `least` to [`MOST_SAMPLES_PER_SIDE`].
pub fn samples_per_side(pixels_per_splat: f64, tilt_deg: f64, least: u32) -> u32 {
    let between_px = pixels_per_splat * tilt_deg.to_radians().cos();
    ((2.0 / between_px).ceil() as u32).min(MOST_SAMPLES_PER_SIDE).max(least)
}

/// `steps` distances in equal ratios, from far to near; in pixels a splat.
pub fn zoom_path(steps: u32) -> Vec<f64> {
    let [first, last] = PIXELS_PER_SPLAT;
    let at = |i: u32| match i + 1 == steps {
        // Without rounding.
        true => last,
        false => first * (last / first).powf(f64::from(i) / f64::from(steps - 1)),
    };
    (0..steps).map(at).collect()
}

#[cfg(test)]
mod tests;
