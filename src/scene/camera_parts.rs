//! A camera of which some is said, and the rest comes from the scene.

use glam::DVec3;

use super::{Ball, Camera};
use crate::error::Result;

/// Parts of a camera, in world space. Each may be missing.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CameraParts {
    /// The eye; without, it looks along −z at the target from so far that the scene fits.
    pub eye: Option<DVec3>,
    /// The point in the middle of the picture; without, the middle of the scene.
    pub target: Option<DVec3>,
    /// The direction that is up; without, +y.
    pub up: Option<DVec3>,
    /// The vertical field of view in radians; without, [`Camera::DEFAULT_FOV_Y_RAD`].
    pub fov_y_rad: Option<f64>,
    /// The depth of the near plane in world units; without, as [`Camera::near`] has it.
    pub near: Option<f64>,
}

impl CameraParts {
    /// These parts, and of `other` what is missing.
    #[must_use]
    pub fn or(self, other: Self) -> Self {
        Self {
            eye: self.eye.or(other.eye),
            target: self.target.or(other.target),
            up: self.up.or(other.up),
            fov_y_rad: self.fov_y_rad.or(other.fov_y_rad),
            near: self.near.or(other.near),
        }
    }

    /// The camera for a scene within a ball.
    ///
    /// # Errors
    /// As [`Camera::validate`].
    pub fn camera(&self, ball: &Ball, size_px: [u32; 2]) -> Result<Camera> {
        let fit = Camera::fit(ball, size_px, self.fov_y_rad.unwrap_or(Camera::DEFAULT_FOV_Y_RAD));
        let target = self.target.unwrap_or(fit.target);
        let eye = self.eye.unwrap_or(target + (fit.eye - fit.target));
        let camera = Camera { eye, target, up: self.up.unwrap_or(fit.up), near: self.near, ..fit };
        camera.validate()?;
        Ok(camera)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
        let inside = CameraParts { eye: Some(ball.center), ..none };
        assert_eq!(inside.camera(&ball, [8, 8]).unwrap_err().exit_code(), 1);
        assert_eq!(inside.or(only_eye).or(narrow), CameraParts { eye: inside.eye, ..narrow });
    }
}
