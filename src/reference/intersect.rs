//! The ray of a pixel against the plane of a splat.

use glam::DVec3;

use super::filter::{minor_axis, projected};
use super::splat::DrawnSplat;
use super::view::View;

/// Where a ray meets a splat's plane, inside the disk or not.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Hit {
    /// View-space depth, at or beyond the near plane.
    pub z: f64,
    /// `u² + v²`.
    pub r2: f64,
}

impl DrawnSplat {
    /// Solves `[s t p] (u, v, 1)ᵀ = z (x, y, 1)ᵀ` (Guennebaud et al. 2006, eq. 3): the plane first, then u and v in
    /// it. `None` where the plane is met before the near plane, behind the eye, or nowhere.
    pub fn hit(&self, ray: DVec3, near: f64) -> Option<Hit> {
        let z = self.plane_normal.dot(self.center) / self.plane_normal.dot(ray);
        // 0/0 of a plane that holds the ray is NaN and must not pass.
        if !(z >= near && z.is_finite()) {
            return None;
        }
        let q = z * ray - self.center;
        let (u, v) = (self.u_axis.dot(q), self.v_axis.dot(q));
        Some(Hit { z, r2: u * u + v * v })
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
