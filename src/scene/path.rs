//! Paths of cameras: where a camera is at some times, and between them.

use glam::DVec3;

use super::{Camera, option::named};
use crate::error::{Error, Result};

named! {
    /// How a camera gets from one place of a path to the next. The eye, the target and what is up go by their coordinates; the field of view by the
    /// logarithm of its half's tangent, and heights and the near plane's depth by their own, so that a zoom is even.
    Interpolation {
        /// Without a jolt: by a cubic whose speed at a place is that of the parabola through it and its neighbors in time; at the ends it stands still.
        Smooth = "smooth",
        /// Straight, at the same speed from one place to the next.
        Linear = "linear",
    }
}

/// A path.
#[derive(Clone, Debug, PartialEq)]
pub struct CameraPath {
    interpolation: Interpolation,
    keys: Vec<(f64, Camera)>,
}

/// What of a camera changes along a path: eye, target, up, then the projection and the near plane.
type Values = [f64; 11];

impl CameraPath {
    /// The path through cameras at times in seconds.
    ///
    /// # Errors
    /// [`crate::error::ErrorKind::Option`], which names the place by its number from 1 on: for no place, times that are not finite or do not grow, a
    /// camera without a picture, and cameras some of which are orthographic, or say where the near plane is, and some not.
    pub fn new(interpolation: Interpolation, keys: Vec<(f64, Camera)>) -> Result<Self> {
        let fault = |place: usize, problem: String| Error::option(format!("camera {}", place + 1), problem);
        if keys.is_empty() {
            return Err(Error::option("path", "no camera; expected one at least"));
        }
        for (i, (time, camera)) in keys.iter().enumerate() {
            camera.validate().map_err(|error| fault(i, error.to_string()))?;
            if !time.is_finite() {
                return Err(fault(i, format!("time {time}; expected a number of seconds")));
            }
            let Some((before, other)) = i.checked_sub(1).map(|before| keys[before]) else { continue };
            if before >= *time {
                return Err(fault(i, format!("time {time} after {before}; expected a later one")));
            }
            if camera.is_orthographic() != other.is_orthographic() {
                return Err(fault(
                    i,
                    "another projection than before it; expected all orthographic or none".to_owned(),
                ));
            }
            if camera.near.is_some() != other.near.is_some() {
                return Err(fault(
                    i,
                    "near is there and not before it, or not; expected it of all or none".to_owned(),
                ));
            }
        }
        Ok(Self { interpolation, keys })
    }

    /// How it goes from one place to the next.
    pub fn interpolation(&self) -> Interpolation {
        self.interpolation
    }

    /// The times, in seconds, and the cameras there.
    pub fn keys(&self) -> &[(f64, Camera)] {
        &self.keys
    }

    /// When it begins and ends.
    pub fn times(&self) -> [f64; 2] {
        [self.keys[0].0, self.keys[self.keys.len() - 1].0]
    }

    /// The camera at a time; before and after the path those at its ends.
    pub fn at(&self, time: f64) -> Camera {
        let next = self.keys.partition_point(|(at, _)| *at <= time);
        let (Some(before), Some((end, _))) = (next.checked_sub(1), self.keys.get(next)) else {
            return self.keys[next.saturating_sub(1)].1;
        };
        let (start, camera) = self.keys[before];
        let span = end - start;
        let part = (time - start) / span;
        if part <= 0.0 {
            return camera;
        }
        let [from, to] = [before, next].map(|i| values(&self.keys[i].1));
        let mixed: Values = match self.interpolation {
            Interpolation::Linear => std::array::from_fn(|i| from[i] + part * (to[i] - from[i])),
            Interpolation::Smooth => {
                let [leaving, arriving] = [before, next].map(|i| self.speed(i));
                // Cubic Hermite.
                let (square, cube) = (part * part, part * part * part);
                let weights = [
                    2.0 * cube - 3.0 * square + 1.0,
                    span * (cube - 2.0 * square + part),
                    3.0 * square - 2.0 * cube,
                    span * (cube - square),
                ];
                std::array::from_fn(|i| {
                    weights[0] * from[i]
                        + weights[1] * leaving[i]
                        + weights[2] * to[i]
                        + weights[3] * arriving[i]
                })
            }
        };
        with_values(&camera, &mixed)
    }

    /// The change of values a second at a place: of the parabola through it and its neighbors; 0 at the ends.
    fn speed(&self, place: usize) -> Values {
        let (Some(before), Some((end, after))) = (place.checked_sub(1), self.keys.get(place + 1)) else {
            return [0.0; 11];
        };
        let ((start, before), (time, own)) = (self.keys[before], self.keys[place]);
        let [before, own, after] = [&before, &own, after].map(values);
        let (left, right) = (time - start, end - time);
        std::array::from_fn(|i| {
            let [arriving, leaving] = [(own[i] - before[i]) / left, (after[i] - own[i]) / right];
            (arriving * right + leaving * left) / (left + right)
        })
    }
}

fn values(camera: &Camera) -> Values {
    let ([a, b, c], [d, e, f], [g, h, i]) =
        (camera.eye.to_array(), camera.target.to_array(), camera.usable_up().normalize().to_array());
    let shown = camera.orthographic_height.unwrap_or_else(|| (0.5 * camera.fov_y_rad).tan());
    [a, b, c, d, e, f, g, h, i, shown.ln(), camera.near.map_or(0.0, |near| near.max(f64::MIN_POSITIVE).ln())]
}

/// The camera with these values; its field of view is a number of degrees in f64.
fn with_values(camera: &Camera, [a, b, c, d, e, f, g, h, i, shown, near]: &Values) -> Camera {
    let shown = shown.exp();
    let is_orthographic = camera.is_orthographic();
    let fov_y_rad = (2.0 * shown.atan()).to_degrees().to_radians();
    Camera {
        eye: DVec3::new(*a, *b, *c),
        target: DVec3::new(*d, *e, *f),
        up: DVec3::new(*g, *h, *i),
        fov_y_rad: if is_orthographic { camera.fov_y_rad } else { fov_y_rad },
        orthographic_height: is_orthographic.then_some(shown),
        near: camera.near.map(|_| near.exp()),
        ..*camera
    }
}

impl Camera {
    /// The camera carried so far around its target, about what is up, in radians: to the right seen from the eye.
    #[must_use]
    pub fn turned(&self, angle_rad: f64) -> Self {
        if angle_rad == 0.0 {
            return *self;
        }
        let axis = self.usable_up().normalize();
        let turn = glam::DQuat::from_axis_angle(axis, angle_rad);
        Self { eye: self.target + turn * (self.eye - self.target), up: axis, ..*self }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(x: f64) -> Camera {
        Camera { eye: DVec3::new(x, 0.0, 5.0), target: DVec3::new(x, 0.0, 0.0), ..Camera::default() }
    }

    fn path(interpolation: Interpolation) -> CameraPath {
        CameraPath::new(interpolation, vec![(1.0, at(0.0)), (2.0, at(4.0)), (4.0, at(6.0))]).unwrap()
    }

    #[test]
    fn cameras_are_met_at_their_times_and_the_ends_hold() {
        for interpolation in [Interpolation::Smooth, Interpolation::Linear] {
            let path = path(interpolation);
            for (time, camera) in path.keys() {
                assert_eq!(path.at(*time), *camera);
            }
            assert_eq!((path.at(-9.0), path.at(9.0)), (at(0.0), at(6.0)));
            let middle = path.at(1.5);
            assert!((middle.eye.x - middle.target.x).abs() < 1e-15 && (1.5..2.5).contains(&middle.eye.x));
            assert!((middle.fov_y_rad - Camera::DEFAULT_FOV_Y_RAD).abs() < 1e-15);
        }
        assert_eq!(path(Interpolation::Linear).at(3.0).eye.x, 5.0);
        // The parabola through (1, 0), (2, 4), (4, 6) has the speed (4 · 2 + 1 · 1) / 3 = 3 at its middle place.
        let smooth = path(Interpolation::Smooth);
        let speed = |time: f64| (smooth.at(time + 1e-6).eye.x - smooth.at(time - 1e-6).eye.x) / 2e-6;
        assert!((speed(2.0) - 3.0).abs() < 1e-5 && speed(1.0).abs() < 1e-4 && speed(4.0).abs() < 1e-4);
    }

    #[test]
    fn zooms_are_even_in_their_logarithm() {
        let keys = |first: Camera, last: Camera| vec![(0.0, first), (2.0, last)];
        let height = |height| Camera { orthographic_height: Some(height), near: Some(1.0), ..at(0.0) };
        let path = CameraPath::new(Interpolation::Linear, keys(height(1.0), height(4.0))).unwrap();
        assert!((path.at(1.0).orthographic_height.unwrap() - 2.0).abs() < 1e-12);
        assert_eq!(path.at(1.0).near, Some(1.0));
        let path = CameraPath::new(Interpolation::Linear, keys(at(0.0), at(0.0).zoomed(4.0))).unwrap();
        assert!((path.at(1.0).focal_px(100) / at(0.0).focal_px(100) - 2.0).abs() < 1e-12);
    }

    #[test]
    fn what_is_no_path_is_refused_with_its_place() {
        let new = |keys| CameraPath::new(Interpolation::Smooth, keys).unwrap_err().to_string();
        assert_eq!(new(Vec::new()), "path: no camera; expected one at least");
        assert_eq!(
            new(vec![(1.0, at(0.0)), (1.0, at(1.0))]),
            "camera 2: time 1 after 1; expected a later one"
        );
        assert!(new(vec![(f64::NAN, at(0.0))]).starts_with("camera 1: time NaN"));
        let parallel = Camera { orthographic_height: Some(1.0), ..at(0.0) };
        assert!(new(vec![(0.0, at(0.0)), (1.0, parallel)]).starts_with("camera 2: another projection"));
        let near = Camera { near: Some(1.0), ..at(0.0) };
        assert!(new(vec![(0.0, at(0.0)), (1.0, near)]).starts_with("camera 2: near is there"));
        let inside = Camera { target: at(0.0).eye, ..at(0.0) };
        assert!(new(vec![(0.0, inside)]).starts_with("camera 1: camera: eye and target"));
    }

    #[test]
    fn a_turn_goes_to_the_right_and_keeps_the_distance() {
        let quarter = at(0.0).turned(std::f64::consts::FRAC_PI_2);
        assert!(quarter.eye.distance(DVec3::new(5.0, 0.0, 0.0)) < 1e-14 && quarter.target == DVec3::ZERO);
        assert_eq!(at(0.0).turned(0.0), at(0.0));
    }
}
