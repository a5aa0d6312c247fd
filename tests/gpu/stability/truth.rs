//! One splat in f64, from the equations: where it is seen, and the box of its image. Shares no formula with shaders.

use std::f64::consts::{PI, TAU};

use glam::{DVec2, DVec3};
use surfel::scene::{Camera, Scene, Settings, Shapes};

use crate::common::builder::Random;

/// A splat in view space, world unit, and the camera's numbers.
#[derive(Clone, Debug)]
pub struct Truth {
    pub p: DVec3,
    pub s: DVec3,
    pub t: DVec3,
    pub near: f64,
    pub focal_px: f64,
    pub size_px: DVec2,
    /// The semi-minor axis of the projection at the center; `None` where the splat reaches the near plane.
    minor_px: Option<f64>,
}

/// A few steps of f32 in depth, relative.
const NEAR_STEPS: f64 = 1e-6;

/// Where a ray meets the splat's plane.
#[derive(Clone, Copy, Debug)]
pub struct Hit {
    pub u: f64,
    pub v: f64,
    pub z: f64,
}

impl Hit {
    pub fn r2(&self) -> f64 {
        self.u * self.u + self.v * self.v
    }
}

/// Whether a pixel's center is covered, as far as f32 may tell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Coverage {
    Inside,
    Outside,
    /// Within the margin of the rim or of the near plane.
    Rim,
}

impl Truth {
    /// The first splat of a scene.
    pub fn of(scene: &Scene, camera: &Camera, settings: &Settings) -> Self {
        let view = camera.view_from_world();
        let splats = &scene.objects[0].splats;
        let p = view.point(splats.positions[0]);
        let (s, t) = match &splats.shapes {
            Shapes::Disks { normals, radii } => {
                let n = normals[0].as_dvec3().normalize();
                let s = n.any_orthonormal_vector();
                (s * f64::from(radii[0]), n.cross(s) * f64::from(radii[0]))
            }
            Shapes::Ellipses { s, t } => (s[0].as_dvec3(), t[0].as_dvec3()),
        };
        let (s, t) = (view.rotation * s, view.rotation * t);
        let focal_px = camera.focal_px(settings.size_px[1]);
        let [width, height] = settings.size_px.map(f64::from);
        let mut truth = Self {
            p,
            s,
            t,
            near: camera.near(),
            focal_px,
            size_px: DVec2::new(width, height),
            minor_px: None,
        };
        if p.z - s.z.hypot(t.z) >= truth.near {
            truth.minor_px = Some(truth.minor_px_at(p));
        }
        truth
    }

    /// Solves `p + u s + v t = z (x, y, 1)`: the plane first, then u and v in it. `at_px` from the image's middle.
    pub fn hit(&self, at_px: DVec2) -> Option<Hit> {
        let ray = (at_px / self.focal_px).extend(1.0);
        let normal = self.s.cross(self.t);
        let z = normal.dot(self.p) / normal.dot(ray);
        let q = z * ray - self.p;
        let (s, t) = (self.s, self.t);
        let (ss, st, tt) = (s.dot(s), s.dot(t), t.dot(t));
        let determinant = ss * tt - st * st;
        let u = (q.dot(s) * tt - q.dot(t) * st) / determinant;
        let v = (q.dot(t) * ss - q.dot(s) * st) / determinant;
        (z > 0.0 && u.is_finite() && v.is_finite()).then_some(Hit { u, v, z })
    }

    /// Whether a pixel's center is covered. Not decided is what lies within `max(1e-3, 16·2⁻²⁴·|x|/b)` of `r² = 1`, and
    /// at the near plane what a step of that size within the disk brings across it (half the margin of r² is one of r),
    /// or a few steps of f32 in depth.
    pub fn coverage(&self, at_px: DVec2) -> Coverage {
        let Some(hit) = self.hit(at_px) else { return Coverage::Outside };
        let margin = self.r2_margin(at_px, &hit);
        let near_margin = 0.5 * margin * self.s.z.hypot(self.t.z) + NEAR_STEPS * self.near;
        let (r2, beyond_near) = (hit.r2(), hit.z - self.near);
        if r2 > 1.0 + margin || beyond_near < -near_margin {
            Coverage::Outside
        } else if r2 < 1.0 - margin && beyond_near > near_margin {
            Coverage::Inside
        } else {
            Coverage::Rim
        }
    }

    /// How far r² may be off at a place: `max(1e-3, 16·2⁻²⁴·|x|/b)`, with b the semi-minor axis of the projection; for a
    /// splat that reaches the near plane, whose projection is no ellipse, that of the affine map at the hit itself.
    pub fn r2_margin(&self, at_px: DVec2, hit: &Hit) -> f64 {
        let ray = (at_px / self.focal_px).extend(1.0);
        let minor_px = self.minor_px.unwrap_or_else(|| self.minor_px_at(hit.z * ray));
        (16.0 * 0.5_f64.powi(24) * at_px.length() / minor_px).max(1e-3)
    }

    /// How far r may be off at a place: half of what r² may be, and 32 steps of f32 in rotation, tangent vectors
    /// and their products, which a splat that is seen edge-on magnifies by its aspect on the screen.
    pub fn r_margin(&self, at_px: DVec2, hit: &Hit) -> f64 {
        let at = hit.z * (at_px / self.focal_px).extend(1.0);
        let cosine = (self.s.cross(self.t).dot(at) / (self.s.cross(self.t).length() * at.length())).abs();
        0.5 * self.r2_margin(at_px, hit) + 32.0 * 0.5_f64.powi(24) / cosine
    }

    /// Whether it is seen exactly there.
    pub fn covers(&self, at_px: DVec2) -> bool {
        self.hit(at_px).is_some_and(|hit| hit.r2() <= 1.0 && hit.z >= self.near)
    }

    /// The semi-minor axis of the affine map at a point of the plane.
    fn minor_px_at(&self, at: DVec3) -> f64 {
        let projected = |v: DVec3| (v.truncate() - at.truncate() / at.z * v.z) / at.z;
        let (a, b) = (projected(self.s), projected(self.t));
        let (aa, bb) = (a.length_squared(), b.length_squared());
        let major = (0.5 * (aa + bb + (aa - bb).hypot(2.0 * a.dot(b)))).sqrt();
        self.focal_px * a.perp_dot(b).abs() / major
    }

    fn rim(&self, angle: f64) -> DVec3 {
        self.p + self.s * angle.cos() + self.t * angle.sin()
    }

    /// The box of all that is seen, in pixels from the image's middle, cut by the image; `None` where nothing is.
    ///
    /// x = X/Z is stationary on the rim where X′Z = XZ′: A cos θ + B sin θ = C. The other extremes are where the rim
    /// passes the near plane.
    pub fn box_px(&self) -> Option<[DVec2; 2]> {
        self.box_beyond_px(self.near)
    }

    /// The boxes of what lies beyond the near plane, be that a few steps of f32 farther or nearer than it is.
    pub fn least_and_largest_box_px(&self) -> [Option<[DVec2; 2]>; 2] {
        [1.0 + NEAR_STEPS, 1.0 - NEAR_STEPS].map(|factor| self.box_beyond_px(factor * self.near))
    }

    fn box_beyond_px(&self, near: f64) -> Option<[DVec2; 2]> {
        let (p, s, t) = (self.p, self.s, self.t);
        let mut angles = Vec::new();
        let mut solve = |a: f64, b: f64, c: f64| {
            let ratio = c / a.hypot(b);
            if ratio.abs() <= 1.0 {
                angles.extend([b.atan2(a) + ratio.acos(), b.atan2(a) - ratio.acos()]);
            }
        };
        for axis in 0..2 {
            solve(
                t[axis] * p.z - p[axis] * t.z,
                p[axis] * s.z - s[axis] * p.z,
                s[axis] * t.z - t[axis] * s.z,
            );
        }
        let stationary = angles.len();
        let depth_radius = s.z.hypot(t.z);
        let chord = (near - p.z) / depth_radius;
        if chord.abs() <= 1.0 {
            let middle = t.z.atan2(s.z);
            angles.extend([middle + chord.acos(), middle - chord.acos()]);
        }
        let points = angles.iter().enumerate().map(|(i, angle)| {
            let q = self.rim(*angle);
            // The chord's ends lie on the near plane, whatever rounding says.
            (q, if i < stationary { q.z } else { near })
        });
        bounds_px(points.filter(|(_, z)| *z >= near).map(|(q, z)| q.truncate() / z * self.focal_px))
            .and_then(|found| self.cut(found))
    }

    /// The part of a box within the image.
    pub fn cut(&self, [lo, hi]: [DVec2; 2]) -> Option<[DVec2; 2]> {
        let half = 0.5 * self.size_px;
        let (lo, hi) = (lo.max(-half), hi.min(half));
        lo.cmple(hi).all().then_some([lo, hi])
    }

    /// Up to `count` places in the image where the splat is seen, in pixels from the image's top left corner, as f32 has
    /// them.
    pub fn places_px(&self, count: usize, random: &mut Random) -> Vec<DVec2> {
        let Some([lo, hi]) = self.box_px() else { return Vec::new() };
        let half = 0.5 * self.size_px;
        let mut found = Vec::new();
        for _ in 0..4000 {
            if found.len() == count {
                break;
            }
            let at = DVec2::new(random.between(lo.x, hi.x), random.between(lo.y, hi.y)) + half;
            let at = at.as_vec2().as_dvec2();
            if self.covers(at - half) {
                found.push(at);
            }
        }
        found
    }
}

fn bounds_px(points: impl Iterator<Item = DVec2>) -> Option<[DVec2; 2]> {
    points.map(|x| [x, x]).reduce(|[lo, hi], [x, _]| [lo.min(x), hi.max(x)])
}

/// The box in closed form against 100 000 points of the rim, on disks of every kind.
#[test]
fn the_box_in_closed_form_is_that_of_the_rim() {
    let mut random = Random(9);
    let mut cut_by_near = 0;
    for case in 0..300 {
        let s = random.direction();
        let truth = Truth {
            p: DVec3::new(random.between(-2.0, 2.0), random.between(-2.0, 2.0), random.between(-0.9, 3.0)),
            s,
            t: s.cross(random.direction()) * random.between(0.1, 1.0),
            near: 0.3,
            focal_px: 100.0,
            size_px: DVec2::splat(1e9),
            minor_px: None,
        };
        let steps = 100_000;
        let rim = (0..steps).map(|i| truth.rim(f64::from(i) * TAU / f64::from(steps)));
        let sampled =
            bounds_px(rim.filter(|q| q.z >= truth.near).map(|q| q.truncate() / q.z * truth.focal_px));
        let reaches_near = truth.p.z - truth.s.z.hypot(truth.t.z) < truth.near;
        match (truth.box_px(), sampled) {
            (Some(found), Some(sampled)) => {
                cut_by_near += usize::from(reaches_near);
                // A step of the rim is 2π/1e5, an image-plane unit at the near plane 333 px.
                let tolerance_px = PI * 2e-5 * 1500.0;
                let (lo, hi) = (sampled[0] - found[0], found[1] - sampled[1]);
                assert!(lo.min(hi).min_element() > -1e-6, "case {case}: too small by {lo} {hi}");
                assert!(lo.max(hi).max_element() < tolerance_px, "case {case}: too large by {lo} {hi}");
            }
            (None, None) => {}
            (found, sampled) => panic!("case {case}: {found:?}, sampled {sampled:?}"),
        }
    }
    assert!(cut_by_near > 50, "{cut_by_near}");
}
