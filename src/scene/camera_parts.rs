//! A camera of which some is said, and the rest comes from the scene.

use glam::DVec3;

use super::{Ball, Camera};
use crate::error::{Error, Result};

/// Parts of a camera, in world space. Each may be missing.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CameraParts {
    /// The eye; without, it is in the direction `from`.
    pub eye: Option<DVec3>,
    /// The direction from the target to an eye that is not given, from which it sees all of the scene; without, the eye looks along
    /// −z, or along ±y where up is ±z, which would be parallel to the view. Of any length above 0.
    pub from: Option<DVec3>,
    /// The point in the middle of the picture; without, the middle of the scene.
    pub target: Option<DVec3>,
    /// The direction that is up; without, +y.
    pub up: Option<DVec3>,
    /// The height of an orthographic picture; without, the camera has a field of view.
    pub orthographic: Option<PictureHeight>,
    /// The vertical field of view in radians; without, [`Camera::DEFAULT_FOV_Y_RAD`].
    pub fov_y_rad: Option<f64>,
    /// The depth of the near plane in world units; without, as [`Camera::near`] has it.
    pub near: Option<f64>,
}

/// The height of what an orthographic camera shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PictureHeight {
    /// As much as shows all of the scene.
    Fit,
    /// So many world units.
    World(f64),
}

impl CameraParts {
    /// These parts, and of `other` what is missing.
    #[must_use]
    pub fn or(self, other: Self) -> Self {
        Self {
            eye: self.eye.or(other.eye),
            from: self.from.or(other.from),
            target: self.target.or(other.target),
            up: self.up.or(other.up),
            // Either is what is said of the projection.
            orthographic: self.orthographic.or(other.orthographic.filter(|_| self.fov_y_rad.is_none())),
            fov_y_rad: self.fov_y_rad.or(other.fov_y_rad.filter(|_| self.orthographic.is_none())),
            near: self.near.or(other.near),
        }
    }

    /// The camera for a scene within a ball.
    ///
    /// # Errors
    /// As [`Camera::validate`]; for an `up` that is parallel to the view from `eye`.
    pub fn camera(&self, ball: &Ball, size_px: [u32; 2]) -> Result<Camera> {
        let fit = Camera::fit(ball, size_px, self.fov_y_rad.unwrap_or(Camera::DEFAULT_FOV_Y_RAD));
        let target = self.target.unwrap_or(fit.target);
        let distance = fit.eye.distance(fit.target);
        let eye = self.eye.unwrap_or(target + distance * self.toward_eye());
        if let Some(up) = self.up.filter(|up| are_parallel(*up, target - eye)) {
            let problem = format!(
                "{},{},{}: parallel to the view; expected another direction, or another --eye",
                up.x, up.y, up.z
            );
            return Err(Error::option("--up", problem));
        }
        let orthographic_height = self.orthographic.map(|height| match height {
            PictureHeight::Fit => Camera::height_of(ball, size_px),
            PictureHeight::World(height) => height,
        });
        let up = self.up.unwrap_or(fit.up);
        let camera = Camera { eye, target, up, near: self.near, orthographic_height, ..fit };
        camera.validate()?;
        Ok(camera)
    }

    /// These parts with a direction that was found to be up; the eye, if it is not given, sees things from above by 30°, because
    /// what lies on the ground is seen from there.
    #[must_use]
    pub fn with_found_up(self, up: DVec3) -> Self {
        let level = Self { up: Some(up), ..self };
        let Some(up) = up.try_normalize().filter(|up| up.distance(DVec3::Y) > 1e-9) else { return level };
        let (sin, cos) = RAISED_RAD.sin_cos();
        Self { from: self.from.or(Some(cos * level.toward_eye() + sin * up)), ..level }
    }

    /// The direction from the target to an eye that is not given: so turned about x that up is not along it.
    fn toward_eye(&self) -> DVec3 {
        match (self.from.and_then(DVec3::try_normalize), self.up.filter(|up| are_parallel(*up, DVec3::Z))) {
            (Some(from), _) => from,
            (None, Some(up)) => DVec3::NEG_Y * up.z.signum(),
            (None, None) => DVec3::Z,
        }
    }
}

/// 30°.
const RAISED_RAD: f64 = std::f64::consts::FRAC_PI_6;

/// Within half a degree, where the picture would turn by any angle. A vector without length or direction is parallel to none.
fn are_parallel(a: DVec3, b: DVec3) -> bool {
    const LARGEST_SINE: f64 = 0.0087;
    match (a.try_normalize(), b.try_normalize()) {
        (Some(a), Some(b)) => a.cross(b).length() < LARGEST_SINE,
        _ => false,
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
        // One that was found to be z up, from above.
        let found = none.with_found_up(DVec3::Z).camera(&ball, [8, 8]).unwrap();
        let toward = (found.eye - found.target).normalize();
        assert!(toward.distance(DVec3::new(0.0, -0.75_f64.sqrt(), 0.5)) < 1e-12, "{toward}");
        assert_eq!(none.with_found_up(DVec3::Y).camera(&ball, [8, 8]).unwrap(), fit);
        assert_eq!(only_eye.with_found_up(DVec3::Z).camera(&ball, [8, 8]).unwrap().eye, DVec3::ONE);
        let above = CameraParts { eye: Some(ball.center + DVec3::Z), up: Some(DVec3::Z), ..none };
        assert!(above.camera(&ball, [8, 8]).unwrap_err().to_string().starts_with("--up: 0,0,1: parallel"));
        let inside = CameraParts { eye: Some(ball.center), ..none };
        assert_eq!(inside.camera(&ball, [8, 8]).unwrap_err().exit_code(), 1);
        assert_eq!(inside.or(only_eye).or(narrow), CameraParts { eye: inside.eye, ..narrow });
    }
}
