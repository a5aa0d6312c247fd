//! Planes that cut what is seen: a place is there if it is on their one side.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_8, PI};

use glam::{BVec3, DVec2, DVec3, DVec4};

use super::drawn_clip::{Clipped, Kept};
use super::splat::DrawnSplat;
use super::view::View;
use crate::scene::{Bounds, MOST_PLANES, Scene, Settings};

/// Planes in view space: unit normals toward what is left, and by how much the eye is on that side.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Planes {
    all: [DVec4; MOST_PLANES],
    count: usize,
}

impl Planes {
    pub fn is_empty(&self) -> bool {
        self.count == 0
    }
}

/// How near to a plane, in pixels, rounding leaves it open whether a place is cut off; and how near to nothing, as a part of a ramp, a part is so.
const UNDECIDED: f64 = 0.01;

impl View {
    /// The same view of what planes leave of a scene. Where all corners of the box around it are on the inner side of all of them, it is as if there were none: nothing is cut
    /// open then, nor is what a filter has widened beyond the box.
    pub fn cut_by(self, scene: &Scene, settings: &Settings) -> Self {
        let mut planes = Planes::default();
        let corners = |Bounds { min, max }: Bounds| {
            (0..8).map(move |i| DVec3::select(BVec3::new(i & 1 > 0, i & 2 > 0, i & 4 > 0), max, min))
        };
        let is_left = |at: DVec3| settings.clip().iter().all(|plane| plane.dot(at.extend(1.0)) >= 0.0);
        if scene.bounds().is_some_and(|bounds| corners(bounds).all(is_left)) {
            return Self { planes, ..self };
        }
        for (own, plane) in planes.all.iter_mut().zip(settings.clip()) {
            let normal = plane.truncate();
            let of_eye = normal.dot(self.from_world.eye) + plane.w;
            *own = (self.from_world.rotation * normal).extend(of_eye);
            planes.count += 1;
        }
        Self { planes, ..self }
    }

    /// How far inside of the nearest plane a place is, in pixels as a length there is seen; +∞ where there is none.
    pub fn inside_px(&self, ray: DVec3, z: f64) -> f64 {
        let planes = &self.planes.all[..self.planes.count];
        planes.iter().map(|plane| self.focal_px * inside(*plane, ray, z)).fold(f64::INFINITY, f64::min)
    }

    /// What becomes of a place, whatever the rounding.
    pub fn cuts(&self, ray: DVec3, z: f64) -> Clipped {
        match self.inside_px(ray, z) {
            px if px.abs() <= UNDECIDED => Clipped::Undecided,
            px if px > 0.0 => Clipped::Kept,
            _ => Clipped::Removed,
        }
    }
}

/// How far inside a place of a ray is, over its depth.
fn inside(plane: DVec4, ray: DVec3, z: f64) -> f64 {
    plane.truncate().dot(z * ray) / z + plane.w / z
}

impl DrawnSplat {
    /// What planes leave of it in a pixel that it covers at that depth; `None` where there are none.
    pub fn left_by_planes(&self, ray: DVec3, z: f64, view: &View) -> Option<Kept> {
        let parts = self.ramps(ray, z, view).map(|(part, toward)| Kept {
            part: part.clamp(0.0, 1.0),
            toward,
            by_plane: true,
        });
        parts.reduce(|least, kept| if kept.part < least.part { kept } else { least })
    }

    /// What becomes of it there, whatever the rounding.
    pub fn near_planes(&self, ray: DVec3, z: f64, view: &View) -> Clipped {
        if self.covering.is_none() {
            return view.cuts(ray, z);
        }
        let least = self.ramps(ray, z, view).map(|(part, _)| part).fold(f64::INFINITY, f64::min);
        match least {
            part if part.abs() <= UNDECIDED => Clipped::Undecided,
            part if part > 0.0 => Clipped::Kept,
            _ => Clipped::Removed,
        }
    }

    /// Of each plane the part that it leaves of a pixel, not yet within 0 and 1, and the quarter of the circle toward which it keeps. Where edges cover pixels in
    /// part, the cut is the edge of a surface that goes on beyond the splat: low-passed by a Gaussian of half of h, which a ramp as steep stands for.
    fn ramps(&self, ray: DVec3, z: f64, view: &View) -> impl Iterator<Item = (f64, usize)> {
        let planes = view.planes.all.into_iter().take(view.planes.count);
        // By finite differences, for what is linear in the image.
        let step = 0.25 / view.focal_px;
        let depth = |dx: f64, dy: f64| self.hit(ray + DVec3::new(dx, dy, 0.0), 0.0).map(|hit| hit.z);
        let around = [depth(step, 0.0), depth(-step, 0.0), depth(0.0, step), depth(0.0, -step)];
        let in_part = self.covering.is_some();
        let width = (2.0 * PI).sqrt() * view.filter_radius() / 2.0;
        planes.map(move |plane| {
            let own = inside(plane, ray, z);
            let hard = (if own < 0.0 { f64::NEG_INFINITY } else { f64::INFINITY }, 0);
            let [Some(right), Some(left), Some(down), Some(up)] = around else { return hard };
            let at = |dx: f64, dy: f64, z: f64| inside(plane, ray + DVec3::new(dx, dy, 0.0), z);
            let gradient = DVec2::new(
                at(step, 0.0, right) - at(-step, 0.0, left),
                at(0.0, step, down) - at(0.0, -step, up),
            ) / (2.0 * step);
            if !in_part || gradient.length() == 0.0 {
                return hard;
            }
            let quarters = (gradient.to_angle() - FRAC_PI_8) / FRAC_PI_2;
            (0.5 + own / (gradient.length() * width), quarters.floor().rem_euclid(4.0) as usize)
        })
    }
}
