//! The elliptical weighted average (Zwicker, Pfister, van Baar, Gross 2001): the splat's Gaussian under an affine
//! map, convolved with the Gaussian of the low-pass filter. Covariances add: `V = σ² (a aᵀ + b bᵀ + h² I)`. In the
//! principal axes `l` of the splat's ellipse that is an ellipse of the same directions and the axes `√(l² + h²)`.

use glam::{DVec2, DVec3};

use super::affine::ImageEllipse;
use super::filter::orthogonalized;
use super::intersect::Hit;

/// A plane through the eye, but for 32-bit rounding: where `|(s×t)·p|` is at most this share of `|s×t| |p|`, a
/// splat is seen from its edge and its contour has no width to be stretched.
const EDGE_ON: f64 = 2.4e-7;

/// A splat's ellipse with the low-pass filter added.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stretched {
    pub ellipse: ImageEllipse,
    /// The factor of its weight: the ratio of the areas, `√(det(V − σ²h²I) / det V)`, at least
    /// what 16-bit sums ask for.
    pub share: f64,
    /// 1/z is `inverse_depth + per_uv · (u, v)`: that of the splat's plane at the point that has been stretched to
    /// here, so that it stays within the depths of the splat itself.
    inverse_depth: f64,
    per_uv: DVec2,
}

impl Stretched {
    /// With the map that is exact at the center. `h` is the filter's radius in the image plane.
    pub fn at_center(center: DVec3, s: DVec3, t: DVec3, h: f64, least_share: f64) -> Self {
        let (s, t) = orthogonalized(center, s, t);
        // Along a in the image the point moves along s: 1/z changes by −s_z/z² at the center, and everywhere, because
        // it is linear in the image. This needs no plane, which an edge-on splat does not show.
        Self::new(
            ImageEllipse::exact_at_center(center, s, t),
            (h, least_share),
            center.z.recip(),
            DVec2::new(s.z, t.z) / -(center.z * center.z),
        )
    }

    /// With the ellipse of the contour. Where that has no width, as [`Self::at_center`].
    pub fn of_contour(center: DVec3, s: DVec3, t: DVec3, h: f64, least_share: f64) -> Self {
        let normal = s.cross(t);
        let volume = normal.dot(center);
        if volume.abs() <= EDGE_ON * normal.length() * center.length() {
            return Self::at_center(center, s, t, h, least_share);
        }
        let ellipse = ImageEllipse::exact_contour(center, s, t);
        // The plane n·q = n·p is 1/z = n·(x, y, 1) / n·p.
        let inverse_depth = normal.dot(ellipse.center.extend(1.0)) / volume;
        let per = |i: usize| normal.truncate().dot(ellipse.directions[i]) * ellipse.lengths[i] / volume;
        Self::new(ellipse, (h, least_share), inverse_depth, DVec2::new(per(0), per(1)))
    }

    fn new(own: ImageEllipse, (h, least_share): (f64, f64), inverse_depth: f64, per_uv: DVec2) -> Self {
        let lengths = own.lengths.map(|length| length.hypot(h));
        let share = (own.lengths[0] * own.lengths[1] / (lengths[0] * lengths[1])).max(least_share);
        Self { ellipse: ImageEllipse { lengths, ..own }, share, inverse_depth, per_uv }
    }

    /// `r²` and depth at the image-plane point `x`; `None` where the depth is before the near plane.
    pub fn hit(&self, x: DVec2, near: f64) -> Option<Hit> {
        let uv = self.ellipse.uv(x);
        let z = (self.inverse_depth + self.per_uv.dot(uv)).recip();
        (z >= near && z.is_finite()).then_some(Hit { z, uv })
    }
}
