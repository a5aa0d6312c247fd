//! A camera of which some is said, and the rest comes from the scene.

use std::f64::consts::FRAC_PI_2;

use glam::DVec3;

use super::{
    Ball, Camera,
    camera_view::{are_parallel, front, toward_eye},
};
use crate::error::Result;

/// Parts of a camera, in world space. Each may be missing.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CameraParts {
    /// The eye; without, it is in the direction of the angles, so far that it sees all of what is looked at.
    pub eye: Option<DVec3>,
    /// The turn of an eye that is not given about what is up, in radians: 0 in front, positive to the right, see
    /// [`toward_eye`](super::toward_eye); without, 0.
    pub azimuth_rad: Option<f64>,
    /// The height of an eye that is not given above the horizon, in radians from −π/2 to π/2; without, 0.
    pub elevation_rad: Option<f64>,
    /// The point in the middle of the picture; without, the middle of what is looked at.
    pub target: Option<DVec3>,
    /// A ball around the part of the scene that is looked at and shown all of; without, the whole scene.
    pub subject: Option<Ball>,
    /// The direction that is up; without, +y.
    pub up: Option<DVec3>,
    /// The height of an orthographic picture; without, the camera has a field of view.
    pub orthographic: Option<PictureHeight>,
    /// The vertical field of view in radians; without, [`Camera::DEFAULT_FOV_Y_RAD`].
    pub fov_y_rad: Option<f64>,
    /// How many times as large as without it things are in the middle of the picture, above 0: the picture shows so much less, from the
    /// same eye.
    pub zoom: Option<f64>,
    /// The depth of the near plane in world units; without, as [`Camera::near`] has it.
    pub near: Option<f64>,
}

/// The height of what an orthographic camera shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PictureHeight {
    /// As much as shows all of what is looked at.
    Fit,
    /// So many world units.
    World(f64),
}

impl CameraParts {
    /// These parts, and of `other` what is missing and goes with them: an eye is given or found by angles, a target is a point or a part of
    /// the scene, and what is said of the projection is said of all of it but the zoom.
    #[must_use]
    pub fn or(self, other: Self) -> Self {
        let has_angles = self.azimuth_rad.is_some() || self.elevation_rad.is_some();
        let projects = self.fov_y_rad.is_some() || self.orthographic.is_some();
        let other = Self {
            eye: other.eye.filter(|_| !has_angles),
            azimuth_rad: other.azimuth_rad.filter(|_| self.eye.is_none()),
            elevation_rad: other.elevation_rad.filter(|_| self.eye.is_none()),
            target: other.target.filter(|_| self.subject.is_none()),
            subject: other.subject.filter(|_| self.target.is_none()),
            orthographic: other.orthographic.filter(|_| !projects),
            fov_y_rad: other.fov_y_rad.filter(|_| !projects),
            zoom: other.zoom.filter(|_| !projects),
            ..other
        };
        Self {
            eye: self.eye.or(other.eye),
            azimuth_rad: self.azimuth_rad.or(other.azimuth_rad),
            elevation_rad: self.elevation_rad.or(other.elevation_rad),
            target: self.target.or(other.target),
            subject: self.subject.or(other.subject),
            up: self.up.or(other.up),
            orthographic: self.orthographic.or(other.orthographic),
            fov_y_rad: self.fov_y_rad.or(other.fov_y_rad),
            zoom: self.zoom.or(other.zoom),
            near: self.near.or(other.near),
        }
    }

    /// The camera for a scene within a ball. Where its eye looks along `up`, what is up in the picture is as for an eye right above or below
    /// the target.
    ///
    /// # Errors
    /// As [`Camera::validate`].
    pub fn camera(&self, ball: &Ball, size_px: [u32; 2]) -> Result<Camera> {
        let ball = self.subject.as_ref().unwrap_or(ball);
        let fit = Camera::fit(ball, size_px, self.fov_y_rad.unwrap_or(Camera::DEFAULT_FOV_Y_RAD));
        let target = self.target.unwrap_or(fit.target);
        let (toward, up) = self.direction();
        let eye = self.eye.unwrap_or_else(|| target + fit.eye.distance(fit.target) * toward);
        let up = up.unwrap_or(fit.up);
        // Right above or below, as by angles.
        let up = match are_parallel(up, target - eye) {
            true => toward_eye(Some(up), [0.0, FRAC_PI_2.copysign(up.dot(eye - target))])[1],
            false => up,
        };
        let orthographic_height = self.orthographic.map(|height| match height {
            PictureHeight::Fit => Camera::height_of(ball, size_px),
            PictureHeight::World(height) => height,
        });
        let camera = Camera { eye, target, up, near: self.near, orthographic_height, ..fit };
        let camera = self.zoom.map_or(camera, |zoom| camera.zoomed(zoom));
        camera.validate()?;
        Ok(camera)
    }

    /// These parts with an eye, if nothing is said of its height, that sees from above what lies on the ground of a scene of an extent along x,
    /// y and z: by 38° what is at most a quarter as high as wide, as terrain is, and by 30° what is half as high. What stands, as high as wide or
    /// higher, it sees from the front, and what is between by an angle in between.
    #[must_use]
    pub fn from_above(self, extent: DVec3) -> Self {
        let up = self.up.and_then(DVec3::try_normalize).unwrap_or(DVec3::Y).abs();
        let height = extent.dot(up);
        let width = (extent - height * up).max_element();
        let lies = (2.0 * (1.0 - height / width)).clamp(0.0, 1.0);
        let is_flat = (4.0 * (0.5 - height / width)).clamp(0.0, 1.0);
        let raised_rad = (lies > 0.0).then_some(lies * RAISED_RAD + is_flat * FLAT_RAD);
        Self { elevation_rad: self.elevation_rad.or(raised_rad), ..self }
    }

    /// The unit direction from the target to the eye, if nothing is said of it: from the front, level.
    pub fn front(&self) -> Option<DVec3> {
        let is_said = self.eye.is_some() || self.azimuth_rad.is_some() || self.elevation_rad.is_some();
        (!is_said).then(|| front(self.up))
    }

    /// These parts with an eye at a corner: from the front, and 30° to the right and 20° above it.
    #[must_use]
    pub fn from_corner(self) -> Self {
        self.from_angles(CORNER_RAD)
    }

    /// These parts with an eye at an azimuth and an elevation in radians.
    #[must_use]
    pub fn from_angles(self, [azimuth, elevation]: [f64; 2]) -> Self {
        Self { azimuth_rad: Some(azimuth), elevation_rad: Some(elevation), ..self }
    }

    /// The direction from the target to an eye that is not given, and what is up in the picture.
    fn direction(&self) -> (DVec3, Option<DVec3>) {
        if self.eye.is_some() || (self.azimuth_rad, self.elevation_rad) == (None, None) {
            return (front(self.up), self.up);
        }
        let angles_rad = [self.azimuth_rad, self.elevation_rad].map(Option::unwrap_or_default);
        let [toward_eye, up] = toward_eye(self.up, angles_rad);
        let own = self.up.unwrap_or(DVec3::Y);
        // Seen from above there is nothing but the picture's own.
        (toward_eye, Some(if are_parallel(own, toward_eye) { up } else { own }))
    }
}

/// 30°.
const RAISED_RAD: f64 = std::f64::consts::FRAC_PI_6;

/// 8°: the less there is to hide what is behind it, the more of the ground is seen.
const FLAT_RAD: f64 = 2.0 * std::f64::consts::PI / 45.0;

/// 30° and 20°: two sides and the top are seen, and the front most.
const CORNER_RAD: [f64; 2] = [std::f64::consts::FRAC_PI_6, std::f64::consts::PI / 9.0];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::View;

    #[test]
    fn parts_that_are_missing_come_from_the_scene() {
        let ball = Ball { center: DVec3::new(5.0, 0.0, 0.0), radius: 1.0 };
        let fit = Camera::fit(&ball, [8, 8], Camera::DEFAULT_FOV_Y_RAD);
        let none = CameraParts::default();
        assert_eq!(none.camera(&ball, [8, 8]).unwrap(), fit);
        let only_eye = CameraParts { eye: Some(DVec3::ONE), ..none };
        assert_eq!(only_eye.camera(&ball, [8, 8]).unwrap().target, ball.center);
        let narrow = CameraParts { fov_y_rad: Some(0.1), near: Some(0.5), ..none };
        let camera = narrow.camera(&ball, [8, 8]).unwrap();
        // The same scene fits a narrow view from further away.
        assert!(camera.eye.z > 5.0 * fit.eye.z && camera.fov_y_rad == 0.1 && camera.near() == 0.5);
        // A scan with z up is seen from the front, with its top up.
        for (up, toward) in [(DVec3::Z, DVec3::NEG_Y), (2.0 * DVec3::NEG_Z, DVec3::Y)] {
            let camera = CameraParts { up: Some(up), ..none }.camera(&ball, [8, 8]).unwrap();
            assert!((camera.eye - camera.target).normalize().distance(toward) < 1e-12, "{up}");
            assert!((camera.eye.distance(camera.target) / fit.eye.distance(fit.target) - 1.0).abs() < 1e-12);
        }
        // Parallel rays: a height that is given, or one that shows all; what is said last of the projection holds.
        let fitted = CameraParts { orthographic: Some(PictureHeight::Fit), ..none };
        let camera = fitted.camera(&ball, [16, 8]).unwrap();
        assert!((camera.orthographic_height.unwrap() - 2.1).abs() < 1e-12 && camera.eye == fit.eye);
        assert!((fitted.camera(&ball, [8, 16]).unwrap().orthographic_height.unwrap() - 4.2).abs() < 1e-12);
        assert_eq!((fitted.or(narrow).fov_y_rad, narrow.or(fitted).orthographic), (None, None));
        let flat = CameraParts { orthographic: Some(PictureHeight::World(0.0)), ..none };
        assert!(
            flat.camera(&ball, [8, 8]).unwrap_err().to_string().starts_with("--orthographic: 0: expected")
        );
        let rolled =
            CameraParts { up: Some(DVec3::new(1.0, 1.0, 0.0)), ..none }.camera(&ball, [8, 8]).unwrap();
        assert_eq!(rolled.eye, fit.eye);
        // What lies on the ground, from above.
        for (height, degrees) in [
            (0.0, 38.0),
            (1.0, 38.0),
            (1.5, 34.0),
            (2.0, 30.0),
            (3.0, 15.0),
            (4.0, 0.0),
            (9.0, 0.0),
            (f64::NAN, 0.0),
        ] {
            let parts = CameraParts { up: Some(DVec3::Z), ..none }.from_above(DVec3::new(4.0, 2.0, height));
            let found = parts.camera(&ball, [8, 8]).unwrap();
            let toward = (found.eye - found.target).normalize();
            let (sin, cos) = f64::to_radians(degrees).sin_cos();
            assert!(toward.distance(DVec3::new(0.0, -cos, sin)) < 1e-12, "{toward}");
        }
        let lies = DVec3::new(4.0, 1.0, 1.0);
        assert_eq!(
            (none.from_above(lies).elevation_rad, none.from_above(DVec3::ONE)),
            (Some(RAISED_RAD + FLAT_RAD), none)
        );
        assert_eq!(only_eye.from_above(lies).camera(&ball, [8, 8]).unwrap().eye, DVec3::ONE);
        // From a corner, if nothing is said of it.
        assert_eq!(
            (none.front(), only_eye.front(), none.from_corner().front()),
            (Some(DVec3::Z), None, None)
        );
        let corner = none.from_corner().camera(&ball, [8, 8]).unwrap();
        let [azimuth, elevation] = [30.0_f64, 20.0].map(f64::to_radians);
        let expected =
            DVec3::new(azimuth.sin() * elevation.cos(), elevation.sin(), azimuth.cos() * elevation.cos());
        let toward = (corner.eye - corner.target).normalize();
        assert!(toward.distance(expected) < 1e-12, "{toward}");
        // By angles; from above, too.
        let [right, top] = [View::Right, View::Top].map(|view| {
            let [azimuth, elevation] = view.angles_rad();
            CameraParts { azimuth_rad: Some(azimuth), elevation_rad: Some(elevation), ..none }
        });
        let camera = CameraParts { up: Some(DVec3::Z), ..right }.camera(&ball, [8, 8]).unwrap();
        assert_eq!((camera.eye - camera.target).normalize().round(), DVec3::X);
        let camera = CameraParts { up: Some(DVec3::Z), ..top }.camera(&ball, [8, 8]).unwrap();
        assert_eq!(((camera.eye - camera.target).normalize().round(), camera.up), (DVec3::Z, DVec3::Y));
        assert_eq!(right.from_above(lies).elevation_rad, Some(0.0));
        assert_eq!((right.or(only_eye).eye, only_eye.or(right).azimuth_rad), (None, None));
        // What is looked at is a part of the scene.
        let part = Ball { center: DVec3::X, radius: 0.25 };
        let part = CameraParts { subject: Some(part), ..none };
        let camera = part.camera(&ball, [8, 8]).unwrap();
        let nearer = camera.eye.distance(camera.target) / fit.eye.distance(fit.target);
        assert!(camera.target == DVec3::X && (nearer - 0.25).abs() < 1e-12);
        let point = CameraParts { target: Some(DVec3::Y), ..none };
        assert_eq!((point.or(part).subject, part.or(point).target), (None, None));
        // Twice as large, from the same eye.
        let zoomed = CameraParts { zoom: Some(2.0), ..none };
        let camera = zoomed.camera(&ball, [8, 8]).unwrap();
        assert_eq!(camera.eye, fit.eye);
        assert!((camera.focal_px(8) / fit.focal_px(8) - 2.0).abs() < 1e-12);
        assert!(
            (zoomed.or(fitted).camera(&ball, [8, 8]).unwrap().orthographic_height.unwrap() - 1.05).abs()
                < 1e-12
        );
        assert_eq!((narrow.or(zoomed).zoom, zoomed.or(narrow).fov_y_rad), (None, Some(0.1)));
        let above = CameraParts { eye: Some(ball.center + DVec3::Z), up: Some(DVec3::Z), ..none };
        // As by angles.
        let camera = above.camera(&ball, [8, 8]).unwrap();
        assert_eq!((camera.eye, camera.up), (ball.center + DVec3::Z, DVec3::Y));
        let below = CameraParts { eye: Some(ball.center - DVec3::Z), ..above };
        assert_eq!(below.camera(&ball, [8, 8]).unwrap().up, DVec3::NEG_Y);
        let inside = CameraParts { eye: Some(ball.center), ..none };
        assert_eq!(inside.camera(&ball, [8, 8]).unwrap_err().exit_code(), 1);
        assert_eq!(inside.or(only_eye).or(narrow), CameraParts { eye: inside.eye, ..narrow });
    }
}
