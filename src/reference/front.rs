//! The opaque things of a pixel that hide others: the nearest splats, and a polygon that they do not hide.

use super::decision::Decision;
use super::surface::Nearest;
use crate::scene::Transition;

/// The visible opaque polygon of a pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct VisiblePolygon {
    pub z: f64,
    pub triangle: usize,
}

/// The things in front.
#[derive(Clone, Copy)]
pub(super) struct Front {
    pub splats: Nearest,
    pub polygon: Option<VisiblePolygon>,
    /// The nearest polygon, even behind splats.
    pub nearest_polygon: Option<VisiblePolygon>,
    /// Splats are shifted toward the eye wherever they are, not only before polygons: [`Transition::Paper`], where the
    /// scene has opaque polygons.
    pub shifts_all: bool,
}

impl Front {
    /// The polygon is seen unless it is behind the nearest shifted depth of splats. The second value is the margin of
    /// that.
    pub fn new(
        splats: Nearest,
        polygon: Option<VisiblePolygon>,
        transition: Transition,
        has_opaque_polygons: bool,
    ) -> (Self, f64) {
        let visible = match polygon {
            Some(polygon) => Decision::at_most(polygon.z, splats.z_shifted),
            None => Decision::CERTAIN,
        };
        let nearest_polygon = polygon;
        let polygon = polygon.filter(|_| visible.holds);
        let shifts_all = has_opaque_polygons && transition == Transition::Paper;
        (Self { splats, polygon, nearest_polygon, shifts_all }, visible.margin)
    }

    fn polygon_z(&self) -> f64 {
        self.polygon.map_or(f64::INFINITY, |polygon| polygon.z)
    }

    /// Beyond that depth transparent things are hidden.
    pub fn hides_beyond(&self) -> f64 {
        self.splats.z_shifted.min(self.polygon_z())
    }

    /// Transparent things are hidden beyond this depth, not at the nearest splat's.
    pub fn hide_beyond(&mut self, z: f64) {
        self.splats.z_shifted = z;
        self.polygon = None;
    }

    /// Whether an opaque splat's fragment belongs to the surface that is seen.
    pub fn counts(&self, splat: usize, z: f64, shift: f64) -> Decision {
        let is_owner = splat == self.splats.splat;
        let polygon_z = self.polygon_z();
        if self.shifts_all {
            let threshold = self.splats.z_shifted.min(polygon_z);
            return match is_owner && threshold < polygon_z {
                true => Decision::CERTAIN,
                false => Decision::at_most(z / shift, threshold),
            };
        }
        let within_splats = match is_owner {
            true => Decision::CERTAIN,
            false => Decision::at_most(z, self.splats.z_shifted),
        };
        match self.polygon {
            // What is left out where there is no polygon is a division that changes nothing.
            None => within_splats,
            Some(_) => within_splats.and(Decision::at_most(z / shift, polygon_z)),
        }
    }

    /// Whether an opaque splat at this depth would change something, if depths may be off by `margin`, relative.
    pub fn may_count(&self, z: f64, shift: f64, margin: f64) -> bool {
        let tolerance = 1.0 + margin;
        if self.shifts_all {
            return z / shift <= self.hides_beyond() * tolerance;
        }
        z <= self.splats.z_shifted * tolerance && z / shift <= self.polygon_z() * tolerance
    }

    /// Whether a transparent fragment is not hidden.
    pub fn shows(&self, z: f64) -> Decision {
        Decision::at_most(z, self.hides_beyond())
    }

    /// Whether a transparent thing or a polygon would change something, as [`Self::may_count`].
    pub fn may_be_seen(&self, z: f64, margin: f64) -> bool {
        z <= self.hides_beyond() * (1.0 + margin)
    }
}
