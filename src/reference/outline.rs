//! Where a splat of a sharp surface ends, as no filter has widened it: what it covers of pixels there.
//!
//! The ellipses of a mesh's triangles pass through the corners, so that together they hold all of the surface, and what they cover sums to a whole wherever it
//! goes on. Weights do not: they fall toward corners, and at a ridge nothing lies beyond.

use glam::{DVec2, DVec3};

use super::covering::smooth_step;
use super::intersect::Map;
use super::splat::DrawnSplat;
use super::view::View;

/// An axis is no less of the widened one than the root of this.
const LEAST_OWN2: f64 = 1e-3;

impl DrawnSplat {
    /// The part of a pixel that it covers as no filter has widened it, if the surface goes on around it and it is not narrow there; 0 if not.
    pub fn outlined(&self, ray: DVec3, view: &View) -> f64 {
        let Some(covering) = self.covering.as_ref().filter(|covering| covering.goes_on > 0.0) else {
            return 0.0;
        };
        let Some((place, per_px)) = self.place_and_change(ray, view) else { return 0.0 };
        // Across an edge of the surface the normal distribution of what a pixel sees, of standard deviation h / 2, as a ramp.
        let ramp_px = (2.0 * std::f64::consts::PI).sqrt() * covering.h_px / 2.0;
        let own2 = per_px.map(|change| (1.0 - (covering.h_px * change.length()).powi(2)).max(LEAST_OWN2));
        let axes_px = [0, 1].map(|i| own2[i].sqrt() / per_px[i].length());
        let is_wide = smooth_step((axes_px[0].min(axes_px[1]) / covering.h_px - 0.25) / 0.5);
        // In radii of the ellipse that no filter has widened, and half of how the square of that changes a pixel.
        let radius = (place.x * place.x / own2[0] + place.y * place.y / own2[1]).sqrt();
        let slope = place.x / own2[0] * per_px[0] + place.y / own2[1] * per_px[1];
        let inside_px = match slope.length() {
            0.0 => f64::INFINITY,
            steepness => radius * (1.0 - radius) * self.nearness(ray, view) / steepness,
        };
        // No more than the strip that it is.
        let strip = axes_px.map(|axis_px| (2.0 * axis_px / ramp_px).min(1.0));
        covering.goes_on * is_wide * (0.5 + inside_px / ramp_px).min(strip[0] * strip[1]).clamp(0.0, 1.0)
    }

    /// u and v of what a pixel sees, and how each changes a pixel: by the map as it is at the center, in its depth there.
    fn place_and_change(&self, ray: DVec3, view: &View) -> Option<(DVec2, [DVec2; 2])> {
        let step_px = 1.0 / 64.0;
        let step = |x: DVec2| (step_px / view.focal_px * x).extend(0.0);
        let (place, changes) = match &self.map {
            Map::Projective => {
                let at_center = self.center / self.center.z;
                let seen = |ray: DVec3| Some(self.plane_depth(ray, view.near)? * ray);
                let here = seen(ray)?;
                let along = |x: DVec2| {
                    let [after, before] = [seen(at_center + step(x))?, seen(at_center - step(x))?];
                    Some((self.uv(after) - self.uv(before)) / (2.0 * step_px))
                };
                (self.uv(here), [along(DVec2::X)?, along(DVec2::Y)?])
            }
            Map::Affine(ellipse) | Map::Stretched(super::ewa::Stretched { ellipse, .. }) => {
                let at = |x: DVec3| ellipse.uv(x.truncate());
                let along = |x: DVec2| (at(ray + step(x)) - at(ray - step(x))) / (2.0 * step_px);
                (at(ray), [along(DVec2::X), along(DVec2::Y)])
            }
        };
        let [x, y] = changes;
        Some((place, [DVec2::new(x.x, y.x), DVec2::new(x.y, y.y)]))
    }

    /// The depth of the center over that of what a pixel sees.
    fn nearness(&self, ray: DVec3, view: &View) -> f64 {
        match &self.map {
            Map::Projective => self.plane_depth(ray, view.near).map_or(1.0, |z| self.center.z / z),
            _ => 1.0,
        }
    }
}
