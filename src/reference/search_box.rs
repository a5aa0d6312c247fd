//! The pixels in which a splat is looked for: far more than it covers, never fewer.

use std::ops::Range;

use super::intersect::r2_margin;
use super::splat::DrawnSplat;
use super::view::View;

/// Columns and rows, possibly empty.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct SearchBox {
    pub columns: Range<u32>,
    pub rows: Range<u32>,
}

impl SearchBox {
    /// Holds every pixel whose `r²` is at most `limit_r2` plus the margin of [`DrawnSplat::r2_margin`].
    ///
    /// The enlarged disk lies in a ball, the ball in a cube; the cube is projected corner by corner. Where it
    /// reaches the near plane the box is the whole image.
    pub fn of(splat: &DrawnSplat, limit_r2: f64, view: &View) -> Self {
        let [width, height] = view.size_px;
        let whole = Self { columns: 0..width, rows: 0..height };
        let Some(minor_px) = splat.minor_px else { return whole };
        let [middle_x, middle_y] = view.middle_px();
        let margin = r2_margin(middle_x.hypot(middle_y), minor_px);
        // |u s + v t|² ≤ (u² + v²)(|s|² + |t|²).
        let radius = ((limit_r2 + margin) * (splat.s.length_squared() + splat.t.length_squared())).sqrt();
        let center = splat.center;
        if center.z + radius < view.near {
            return Self { columns: 0..0, rows: 0..0 };
        }
        // Written so that NaN and infinity take the whole image.
        let reaches_near = !(center.z - radius >= view.near && radius.is_finite());
        if reaches_near {
            return whole;
        }
        let range = |coordinate: f64, middle_px: f64, pixels: u32| {
            let ends = [center.z - radius, center.z + radius]
                .map(|z| [(coordinate - radius) / z, (coordinate + radius) / z]);
            let low = ends[0][0].min(ends[1][0]) * view.focal_px + middle_px;
            let high = ends[0][1].max(ends[1][1]) * view.focal_px + middle_px;
            // One pixel more on each side than the pixel centers need.
            let limit = f64::from(pixels);
            let first = (low - 1.5).floor().clamp(0.0, limit);
            let end = (high + 1.5).ceil().clamp(0.0, limit);
            first as u32..end as u32
        };
        Self { columns: range(center.x, middle_x, width), rows: range(center.y, middle_y, height) }
    }

    /// The part of it within `rows`.
    pub fn clipped(&self, rows: &Range<u32>) -> Range<u32> {
        self.rows.start.max(rows.start)..self.rows.end.min(rows.end)
    }
}
