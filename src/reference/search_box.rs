//! The pixels in which a splat is looked for: far more than it covers, never fewer.

use std::ops::Range;

use glam::{DVec2, DVec3};

use super::affine::ImageEllipse;
use super::intersect::{Map, r2_margin};
use super::splat::DrawnSplat;
use super::view::View;

/// Columns and rows, possibly empty.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct SearchBox {
    pub columns: Range<u32>,
    pub rows: Range<u32>,
}

impl SearchBox {
    /// Holds every pixel whose `r²` is at most `limit_r2` plus the margin of [`DrawnSplat::r2_margin`], of the
    /// splat or of the low-pass filter beside it.
    pub fn of(splat: &DrawnSplat, limit_r2: f64, view: &View) -> Self {
        let [middle_x, middle_y] = view.middle_px;
        let farthest_px = middle_x.hypot(middle_y);
        match &splat.map {
            Map::Projective => {
                // A splat that reaches the near plane has another margin in every pixel.
                let Some(minor_px) = splat.minor_px else { return Self::whole(view) };
                Self::of_disk(splat, limit_r2 + r2_margin(farthest_px, minor_px), view)
            }
            Map::Affine(ellipse) => Self::of_ellipse(splat, ellipse, limit_r2, farthest_px, view),
            Map::Stretched(stretched) => {
                Self::of_ellipse(splat, &stretched.ellipse, limit_r2, farthest_px, view)
            }
        }
    }

    /// Holds every pixel whose `r²` is at most `largest_r2`, under the projective map. The disk of that size lies
    /// in a ball, the ball in a cube; the cube is projected corner by corner. Where it reaches the near plane the
    /// box is the whole image.
    pub fn of_disk(splat: &DrawnSplat, largest_r2: f64, view: &View) -> Self {
        // |u s + v t|² ≤ (u² + v²)(|s|² + |t|²).
        let radius = (largest_r2 * (splat.s.length_squared() + splat.t.length_squared())).sqrt();
        let center = splat.center;
        if center.z + radius < view.near {
            return Self { columns: 0..0, rows: 0..0 };
        }
        // Written so that NaN and infinity take the whole image.
        let reaches_near = !(center.z - radius >= view.near && radius.is_finite());
        if reaches_near {
            return Self::whole(view);
        }
        let ends = |coordinate: f64| {
            let ends = [center.z - radius, center.z + radius]
                .map(|z| [(coordinate - radius) / z, (coordinate + radius) / z]);
            [ends[0][0].min(ends[1][0]), ends[0][1].max(ends[1][1])]
        };
        let ([left, right], [top, bottom]) = (ends(center.x), ends(center.y));
        Self::between(DVec2::new(left, top), DVec2::new(right, bottom), view)
    }

    /// Holds every pixel whose center is in the triangle or less than a pixel beside it. A triangle that reaches the near
    /// plane takes the whole image.
    pub fn of_triangle(corners: &[DVec3; 3], view: &View) -> Self {
        if corners.iter().all(|corner| corner.z < view.near) {
            return Self { columns: 0..0, rows: 0..0 };
        }
        if corners.iter().any(|corner| corner.z < view.near) {
            return Self::whole(view);
        }
        let [a, b, c] = corners.map(|corner| corner.truncate() / corner.z);
        if !(a.is_finite() && b.is_finite() && c.is_finite()) {
            return Self::whole(view);
        }
        Self::between(a.min(b).min(c), a.max(b).max(c), view)
    }

    /// The enlarged ellipse lies in the circle of its long axis.
    fn of_ellipse(
        splat: &DrawnSplat,
        ellipse: &ImageEllipse,
        limit_r2: f64,
        farthest_px: f64,
        view: &View,
    ) -> Self {
        let margin = splat.minor_px.map_or(f64::INFINITY, |minor_px| r2_margin(farthest_px, minor_px));
        Self::of_circle(ellipse.center, (limit_r2 + margin).sqrt() * ellipse.lengths[0], view)
    }

    fn of_circle(center: DVec2, radius: f64, view: &View) -> Self {
        if center.is_finite() && radius.is_finite() {
            Self::between(center - radius, center + radius, view)
        } else {
            Self::whole(view)
        }
    }

    /// Between two points of the image plane.
    fn between(low: DVec2, high: DVec2, view: &View) -> Self {
        let range = |low: f64, high: f64, middle_px: f64, pixels: u32| {
            // A pixel more on each side than the pixel centers need. The low-pass filter beside a splat reaches √2
            // pixels around the projected center, and is within that.
            let limit = f64::from(pixels);
            let first = (low * view.focal_px + middle_px - 1.5).floor().clamp(0.0, limit);
            let end = (high * view.focal_px + middle_px + 1.5).ceil().clamp(0.0, limit);
            first as u32..end as u32
        };
        let ([width, height], [middle_x, middle_y]) = (view.size_px, view.middle_px);
        Self { columns: range(low.x, high.x, middle_x, width), rows: range(low.y, high.y, middle_y, height) }
    }

    fn whole(view: &View) -> Self {
        let [width, height] = view.size_px;
        Self { columns: 0..width, rows: 0..height }
    }

    /// The part of it within `rows`.
    pub fn clipped(&self, rows: &Range<u32>) -> Range<u32> {
        self.rows.start.max(rows.start)..self.rows.end.min(rows.end)
    }
}
