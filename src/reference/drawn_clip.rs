//! What clip curves leave of a splat in a pixel.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, FRAC_PI_8, PI};

use glam::{DMat2, DVec2, DVec3};

use super::clip::{Curve, removes};
use super::filter::projected;
use crate::scene::{Clip, ClipCurve, ClipTest};

/// A clip in view space: where a ray meets the plane of the splat as the scene has it.
#[derive(Clone, Copy, Debug)]
pub(super) struct DrawnClip {
    clip: Clip,
    center: DVec3,
    s: DVec3,
    t: DVec3,
    ramp: Option<Ramp>,
}

/// A clipped edge that covers pixels in part.
#[derive(Clone, Copy, Debug)]
struct Ramp {
    /// The low-pass filter's radius, image plane: twice its standard deviation.
    h: f64,
    /// From where around the center a pixel sees the splat, by the pixel's place.
    through: DMat2,
}

/// What becomes of a place, whatever the rounding.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Clipped {
    Kept,
    Removed,
    Undecided,
}

/// What is left of a splat.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Kept {
    /// Of a pixel, 0 to 1.
    pub part: f64,
    /// In which quarter of the circle the curve that decides keeps, 0 to 3.
    pub toward: usize,
    /// A plane decides, not a curve.
    pub by_plane: bool,
}

impl Kept {
    /// The factor of a splat's weight in colors and normals: of what is summed together, that which has more of the pixel has next to all of
    /// it, for the mean of the normals on both sides of a ridge would be that of neither.
    pub fn priority(self) -> f64 {
        // What covers has a weight.
        self.part.powi(16).max(1e-18)
    }
}

/// How far the surface around a splat is taken to go on, in its larger radii.
const SURFACE_RADII: f64 = 2.0;

/// How near to nothing, as a part of a ramp, what is left is undecided.
const UNDECIDED: f64 = 0.01;

/// How far off a place may be that is found in f32, in radii of the filter: ten roundings of 256 pixels.
const ROUNDED: f64 = 1e-4;

/// What is left of a pixel is undecided, too, where it changes by so much over twice that: along what is seen nearly edge-on.
const UNCERTAIN_PART: f64 = 5e-4;

impl DrawnClip {
    /// `None` of what is not clipped. The tangent vectors are those that no filter has changed. `h`: the radius of the filter, where edges
    /// cover pixels in part; `filtered`: it widens this splat.
    pub fn of(
        clip: Clip,
        center: DVec3,
        (s, t): (DVec3, DVec3),
        h: Option<f64>,
        filtered: bool,
    ) -> Option<Self> {
        let ramp = |h: f64| {
            // Of two Gaussians in turn, the image of the surface around and the filter: where the first was, given their sum.
            let longer = if s.length() > t.length() { s } else { t };
            let turned = s.cross(t).normalize().cross(longer);
            let (a, b) =
                (projected(center, SURFACE_RADII * longer), projected(center, SURFACE_RADII * turned));
            let image = DMat2::from_cols(a.x * a + b.x * b, a.y * a + b.y * b);
            let sum = image + DMat2::from_diagonal(DVec2::splat(h * h));
            Ramp { h, through: if filtered { image * sum.inverse() } else { DMat2::IDENTITY } }
        };
        (clip != Clip::None).then(|| Self { clip, center, s, t, ramp: h.map(ramp) })
    }

    /// (u, v) of the place in the plane, by Cramer's rule for `u s + v t − z ray = −center`; not finite where the ray is in the plane.
    fn place(&self, ray: DVec3) -> DVec2 {
        let volume = self.s.cross(self.t).dot(ray);
        DVec2::new(self.t.cross(self.center).dot(ray), self.center.cross(self.s).dot(ray)) / volume
    }

    /// One over the depth of the place, in depths of the center: linear in the image, as are all lines of the plane by it.
    fn over_depth(&self, ray: DVec3) -> f64 {
        let normal = self.s.cross(self.t);
        normal.dot(ray) / normal.dot(self.center)
    }

    /// Whether what a pixel sees is cut off, with (u, v) moved.
    fn removes(&self, ray: DVec3, moved: DVec2) -> bool {
        let (place, over_depth) = (self.place(ray) + moved, self.over_depth(ray));
        if over_depth > 0.0 {
            return removes(&self.clip, place, ClipTest::Conic);
        }
        let removed = |curve: &ClipCurve| Curve::of(curve).kept_side(place, over_depth) < 0.0;
        let mut curves = self.clip.curves().into_iter().flatten();
        match &self.clip {
            Clip::Both(..) => curves.all(removed),
            _ => curves.any(removed),
        }
    }

    /// What a pixel sees of the splat.
    pub fn kept(&self, ray: DVec3) -> Kept {
        let Some(ramp) = &self.ramp else {
            return Kept {
                part: f64::from(u8::from(!self.removes(ray, DVec2::ZERO))),
                toward: 0,
                by_plane: false,
            };
        };
        let kept = |curve| self.kept_by(ramp, &Curve::of(curve), ray.truncate()).0;
        match &self.clip {
            Clip::None => Kept { part: 1.0, toward: 0, by_plane: false },
            Clip::One(curve) => kept(curve),
            Clip::Either(first, second) => {
                let (first, second) = (kept(first), kept(second));
                if second.part < first.part { second } else { first }
            }
            Clip::Both(first, second) => {
                let (first, second) = (kept(first), kept(second));
                if second.part > first.part { second } else { first }
            }
        }
    }

    /// By a ramp across the chord, as steep in the middle as the normal distribution of what a pixel sees; and how far its brighter end is
    /// from the curve, in half ramps.
    fn kept_by(&self, ramp: &Ramp, curve: &Curve, x: DVec2) -> (Kept, f64) {
        let image = |at: DVec2| {
            let p = self.center + at.x * self.s + at.y * self.t;
            p.truncate() / p.z
        };
        let (start, end) = (image(curve.start), image(curve.end));
        let center = image(DVec2::ZERO);
        let seen = center + ramp.through * (x - center);
        let kept_side = |x: DVec2| curve.kept_side(self.place(x.extend(1.0)), self.over_depth(x.extend(1.0)));
        let along = (end - start).normalize();
        // Toward what the chord keeps, which is on another side where the splat is seen from behind.
        let across = along.perp() * (self.s.cross(self.t).dot(self.center)).signum();
        let half = (2.0 * PI).sqrt() / 2.0 * (ramp.h / 2.0) * across.dot(ramp.through * across).sqrt();
        // Of pixels to both sides of this one, along the way on which what is seen through them crosses the chord fastest.
        let steepest = ramp.through * across;
        let step = ramp.through * steepest * (half / steepest.length_squared());
        let ends = [-step, step].map(|step| kept_side(seen + step));
        let all = ends[0].abs() + ends[1].abs();
        let part = if all > 0.0 { (ends[0].max(0.0) + ends[1].max(0.0)) / all } else { 1.0 };
        let quarters = (across.to_angle() - FRAC_PI_8) / FRAC_PI_2;
        (
            Kept { part, toward: quarters.floor().rem_euclid(4.0) as usize, by_plane: false },
            ends[0].max(ends[1]) / all,
        )
    }

    /// What becomes of a pixel, with (u, v) off by up to `margin` in any direction.
    pub fn near(&self, ray: DVec3, margin: f64) -> Clipped {
        if let Some(ramp) = &self.ramp {
            let near =
                |curve| self.kept_by(ramp, &Curve::of(curve), ray.truncate()).1.abs() < UNDECIDED + margin;
            let kept_at =
                |moved: DVec2| self.kept((ray.truncate() + ROUNDED * ramp.h * moved).extend(1.0)).part;
            let is_steep = |along: DVec2| (kept_at(along) - kept_at(-along)).abs() > UNCERTAIN_PART;
            return match self.kept(ray).part {
                _ if self.clip.curves().into_iter().flatten().any(near) => Clipped::Undecided,
                _ if is_steep(DVec2::X) || is_steep(DVec2::Y) => Clipped::Undecided,
                part if part > 0.0 => Clipped::Kept,
                _ => Clipped::Removed,
            };
        }
        let around = (0..8).map(|i| margin * DVec2::from_angle(FRAC_PI_4 * f64::from(i)));
        let removed = [DVec2::ZERO].into_iter().chain(around).map(|moved| self.removes(ray, moved));
        match removed.filter(|removed| *removed).count() {
            0 => Clipped::Kept,
            9 => Clipped::Removed,
            _ => Clipped::Undecided,
        }
    }
}
