//! The pixels that the ground truth hands out, and the sums that they are made from.

use glam::DVec3;

use super::edges::Edge;
use super::surface::{Surface, direction};
use crate::scene::DefectCounts;

/// The low-passed surface.
#[derive(Clone, Debug)]
pub struct GroundTruth {
    /// Width and height in pixels.
    pub size_px: [u32; 2],
    /// Row by row, the top left pixel first; `width · height` entries.
    pub pixels: Vec<TruePixel>,
    /// The splats that can't be drawn, by reason; they are not in it.
    pub defects: DefectCounts,
}

/// One pixel of the low-passed surface. All but coverage and edge are means over the samples that see a surface,
/// weighted by the filter: over a background, the image is `coverage · color + (1 − coverage) · background`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TruePixel {
    /// The share of the filter in which there is a surface, 0–1.
    pub coverage: f64,
    /// Linear; 0 where empty.
    pub albedo: [f64; 3],
    /// The mean's direction, in view space (toward the eye is z < 0); 0 where empty.
    pub normal: [f64; 3],
    /// View-space z in world units; +∞ where empty.
    pub depth: f64,
    /// Linear, the mean of shaded samples; 0 where empty.
    pub color: [f64; 3],
    /// The splats' own alpha, 0–1; 0 where empty.
    pub alpha: f64,
    /// The edge of the surface that passes through the pixel itself, before the filter.
    pub edge: Edge,
}

/// The channels of a sample that are low-passed: whether it sees a surface, then albedo, normal, color, depth and alpha.
pub(super) type Channels = [f64; 12];

/// The channels of a sample that sees `surface`.
pub(super) fn channels(surface: &Surface) -> Channels {
    let (albedo, normal, color) = (surface.albedo, surface.normal, surface.color);
    let (depth, alpha) = (surface.depth, surface.alpha);
    [1.0, albedo.x, albedo.y, albedo.z, normal.x, normal.y, normal.z, color.x, color.y, color.z, depth, alpha]
}

/// Adds `weight · value` to `sum`.
pub(super) fn add(sum: &mut Channels, weight: f64, value: &Channels) {
    sum.iter_mut().zip(value).for_each(|(sum, value)| *sum += weight * value);
}

impl TruePixel {
    /// A pixel without a surface.
    pub(super) const EMPTY: Self = Self {
        coverage: 0.0,
        albedo: [0.0; 3],
        normal: [0.0; 3],
        depth: f64::INFINITY,
        color: [0.0; 3],
        alpha: 0.0,
        edge: Edge::None,
    };

    /// The pixel of the filter's sums, without its edge.
    pub(super) fn from_sums(sums: &Channels) -> Self {
        let coverage = sums[0];
        if coverage <= 0.0 {
            return Self::EMPTY;
        }
        let three = |first: usize| DVec3::new(sums[first], sums[first + 1], sums[first + 2]);
        Self {
            // The taps' sum is 1 but for rounding.
            coverage: coverage.min(1.0),
            albedo: (three(1) / coverage).to_array(),
            normal: direction(three(4), coverage).to_array(),
            depth: sums[10] / coverage,
            color: (three(7) / coverage).to_array(),
            alpha: sums[11] / coverage,
            edge: Edge::None,
        }
    }
}
