//! From a pixel to a splat: the depth and the splat's own radius there.

use glam::{DVec2, DVec3};

use super::affine::ImageEllipse;
use super::ewa::Stretched;
use super::filter::{minor_axis, orthogonalized, projected};
use super::splat::DrawnSplat;
use super::view::View;
use crate::scene::{Filter, Rasterizer, Settings};

/// How the image is mapped onto a splat.
#[derive(Clone, Copy, Debug)]
pub(super) enum Map {
    /// The ray of the pixel meets the plane: exact.
    Projective,
    /// An ellipse in the image; the depth is that of the plane.
    Affine(ImageEllipse),
    /// An affine map with the low-pass filter added, and depths of its own.
    Stretched(Stretched),
}

impl Map {
    /// That of a regular splat with the tangent vectors that are drawn. All rasterizers but the affine ones draw the same picture.
    pub fn of(center: DVec3, s: DVec3, t: DVec3, h: f64, settings: &Settings) -> Self {
        let least = settings.floors().share;
        match (settings.filter, settings.rasterizer) {
            (Filter::Ewa, Rasterizer::AffineContour) => {
                Self::Stretched(Stretched::of_contour(center, s, t, h, least))
            }
            // The filter brings its own map.
            (Filter::Ewa, _) => Self::Stretched(Stretched::at_center(center, s, t, h, least)),
            (_, Rasterizer::AffineContour) => Self::Affine(ImageEllipse::exact_contour(center, s, t)),
            (_, Rasterizer::AffineCenter) => {
                let (s, t) = orthogonalized(center, s, t);
                Self::Affine(ImageEllipse::exact_at_center(center, s, t))
            }
            _ => Self::Projective,
        }
    }

    /// How large the ellipse in the image plane is: the root of the sum of the squares of both axes. `axes`: the images of the tangent vectors.
    pub fn size(&self, [s, t]: [DVec2; 2]) -> f64 {
        let [a, b] = match self {
            Self::Projective => [s.length(), t.length()],
            Self::Affine(ellipse) => ellipse.lengths,
            Self::Stretched(stretched) => stretched.ellipse.lengths,
        };
        a.hypot(b)
    }
}

/// Where a pixel lies on a splat, inside the disk or not.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Hit {
    /// View-space depth, at or beyond the near plane.
    pub z: f64,
    /// u and v.
    pub uv: DVec2,
}

impl Hit {
    /// `u² + v²`.
    pub fn r2(&self) -> f64 {
        self.uv.length_squared()
    }
}

impl DrawnSplat {
    /// `None` where the depth is before the near plane, behind the eye, or nowhere.
    pub fn hit(&self, ray: DVec3, near: f64) -> Option<Hit> {
        match &self.map {
            Map::Projective => self.plane_hit(ray, near),
            Map::Affine(ellipse) => {
                let uv = ellipse.uv(ray.truncate());
                // An ellipse without width is not even near a pixel.
                let hit = Hit { z: self.plane_depth(ray, near)?, uv };
                hit.r2().is_finite().then_some(hit)
            }
            Map::Stretched(stretched) => stretched.hit(ray.truncate(), near),
        }
    }

    /// `u² + v²` of what the filter makes of it: that of a hit, unless it reaches further.
    pub fn filtered_r2(&self, hit: &Hit) -> f64 {
        self.filtered(hit.uv).length_squared()
    }

    fn filtered(&self, uv: DVec2) -> DVec2 {
        self.reach.map_or(uv, |reach| reach.over_filtered * uv)
    }

    /// How that changes a pixel along x and y, by the map from the image to the splat as it is at its center; 0 where that can't be seen.
    pub fn change_of_filtered_r2(&self, ray: DVec3, view: &View) -> DVec2 {
        // Small enough for what curves, and large enough for the digits.
        let step_px = 1.0 / 64.0;
        let step = |x: DVec2| (step_px / view.focal_px * x).extend(0.0);
        let along = |x: DVec2| match &self.map {
            Map::Projective => {
                let at_center = self.center / self.center.z;
                let seen = |ray: DVec3| Some(self.plane_depth(ray, view.near)? * ray);
                let (here, after, before) =
                    (seen(ray)?, seen(at_center + step(x))?, seen(at_center - step(x))?);
                let change = (self.uv(after) - self.uv(before)) / (2.0 * step_px);
                Some(2.0 * self.filtered(self.uv(here)).dot(self.filtered(change)) * here.z / self.center.z)
            }
            _ => {
                let r2 = |ray: DVec3| Some(self.hit(ray, view.near)?.r2());
                Some((r2(ray + step(x))? - r2(ray - step(x))?) / (2.0 * step_px))
            }
        };
        DVec2::new(along(DVec2::X).unwrap_or(0.0), along(DVec2::Y).unwrap_or(0.0))
    }

    /// Solves `[s t p] (u, v, 1)ᵀ = z (x, y, 1)ᵀ` (Guennebaud et al. 2006, eq. 3): the plane first, then u and v in
    /// it.
    fn plane_hit(&self, ray: DVec3, near: f64) -> Option<Hit> {
        let z = self.plane_depth(ray, near)?;
        Some(Hit { z, uv: self.uv(z * ray) })
    }

    /// u and v of a point of its plane.
    pub(super) fn uv(&self, point: DVec3) -> DVec2 {
        let q = point - self.center;
        DVec2::new(self.u_axis.dot(q), self.v_axis.dot(q))
    }

    /// The depth at which the ray meets the plane.
    pub(super) fn plane_depth(&self, ray: DVec3, near: f64) -> Option<f64> {
        let z = self.plane_normal.dot(self.center) / self.plane_normal.dot(ray);
        // 0/0 of a plane that holds the ray is NaN and must not pass.
        (z >= near && z.is_finite()).then_some(z)
    }

    /// How far `r²` may be off in an evaluation with 24 bits, at `distance_px` from the middle of the image:
    /// `max(1e-3, 16·2⁻²⁴ · distance / b)`. b is the semi-minor axis of the projection, at the center; for a splat
    /// that reaches the near plane, whose projection is no ellipse, that of the affine map at the hit itself.
    pub fn r2_margin(&self, ray: DVec3, z: f64, distance_px: f64, view: &View) -> f64 {
        let minor_px = self.minor_px.unwrap_or_else(|| {
            let at = z * ray;
            view.focal_px * minor_axis(projected(at, self.s), projected(at, self.t))
        });
        r2_margin(distance_px, minor_px)
    }
}

/// `max(1e-3, 16·2⁻²⁴ · distance / minor)`; infinite for an ellipse without width.
pub(super) fn r2_margin(distance_px: f64, minor_px: f64) -> f64 {
    (16.0 * 0.5_f64.powi(24) * distance_px / minor_px).max(1e-3)
}
