//! The low-pass filter beside the splat (Botsch, Hornung, Zwicker, Kobbelt 2005): a disk in the image of the filter's
//! radius, around the projected center and at the center's depth. A pixel takes the larger one of both weights.

use glam::{DVec2, DVec3};

/// The filter's part of a splat.
#[derive(Clone, Copy, Debug)]
pub(super) struct LowPass {
    /// The projected center.
    pub center: DVec2,
    /// √2 pixels, in the image plane.
    pub radius: f64,
    /// The depth of the splat's center.
    pub z: f64,
    /// The larger one of the filter's radius and the splat's own semi-minor axis, in pixels.
    pub minor_px: f64,
}

impl LowPass {
    /// `|x − c|² / h²`.
    pub fn r2(&self, x: DVec2) -> f64 {
        self.center.distance_squared(x) / (self.radius * self.radius)
    }
}

/// A square in the image: what the paper's point size leaves of a splat.
///
/// The paper takes the radius as seen at the depth of the center. Off the axis a tilted splat's projection reaches
/// farther than that, and is cut off.
#[derive(Clone, Copy, Debug)]
pub(super) struct Square {
    /// The projected center.
    center: DVec2,
    /// In the image plane.
    half_side: f64,
}

impl Square {
    /// The square of a splat with these drawn tangent vectors, or of its low-pass filter, where that is larger.
    pub fn around(center: DVec3, s: DVec3, t: DVec3, low_pass: Option<&LowPass>) -> Self {
        // The larger singular value of the two: the ellipse's own, whatever vectors it is told by.
        let (sum, difference) =
            (s.length_squared() + t.length_squared(), s.length_squared() - t.length_squared());
        let half_side = (0.5 * (sum + difference.hypot(2.0 * s.dot(t)))).sqrt() / center.z;
        Self {
            center: center.truncate() / center.z,
            half_side: half_side.max(low_pass.map_or(0.0, |low_pass| low_pass.radius)),
        }
    }

    /// How far `x` is inside the nearest side; negative outside.
    pub fn depth_inside(&self, x: DVec2) -> f64 {
        self.half_side - (x - self.center).abs().max_element()
    }
}
