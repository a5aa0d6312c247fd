//! The camera, and the one that is chosen where none is given.

use glam::{DMat3, DVec3};

use super::{Ball, Window};
use crate::error::{Error, Result};

/// A camera in world space: a pinhole, or one whose rays are parallel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// The eye.
    pub eye: DVec3,
    /// The point in the middle of the image.
    pub target: DVec3,
    /// The direction that is up in the image; need not be orthogonal to the view. Where it is parallel to the view, the nearest
    /// other axis takes its place.
    pub up: DVec3,
    /// The vertical field of view in radians, between 1e-12 and π.
    pub fov_y_rad: f64,
    /// The height of the whole picture in world units, above 0: the camera is then orthographic, its rays are parallel, and the field of
    /// view means nothing. `None`: they meet in the eye.
    pub orthographic_height: Option<f64>,
    /// The depth of the near plane in world units, in front of which nothing is drawn; `None` is 1e-6 of the distance from eye to target,
    /// and of an orthographic camera 0: where the eye is.
    pub near: Option<f64>,
    /// Where the drawn image lies in the picture that this field of view has.
    pub window: Window,
}

/// The rigid motion from world to view space: `view = rotation · (world − eye)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ViewFromWorld {
    /// Its rows are the view axes x (right), y (down), z (forward) in world space.
    pub rotation: DMat3,
    /// The eye in world space.
    pub eye: DVec3,
}

/// Below that an image-plane unit has more pixels than f32 can tell apart.
const SMALLEST_FOV_RAD: f64 = 1e-12;

/// The width of the fitted view over that of the bounding sphere.
const FIT_MARGIN: f64 = 1.05;

impl Camera {
    /// The vertical field of view where none is given: 45°, in radians.
    pub const DEFAULT_FOV_Y_RAD: f64 = std::f64::consts::FRAC_PI_4;

    /// The camera that shows all of a ball, looking along −z with +y up: it fits the smaller of the two angles with 5%
    /// margin. `fov_y_rad` is the vertical one, between 0 and π. A ball without extent (in f64, at its
    /// place) is taken as a unit ball.
    pub fn fit(ball: &Ball, size_px: [u32; 2], fov_y_rad: f64) -> Self {
        let aspect = f64::from(size_px[0].max(1)) / f64::from(size_px[1].max(1));
        let half_y = 0.5 * fov_y_rad;
        let half = half_y.min((half_y.tan() * aspect).atan());
        let eye = ball.center + DVec3::Z * (FIT_MARGIN * seen_radius(ball) / half.sin());
        Self { eye, target: ball.center, fov_y_rad, ..Self::default() }
    }

    /// Whether rays are parallel.
    pub fn is_orthographic(&self) -> bool {
        self.orthographic_height.is_some()
    }

    /// The depth of the near plane in world units.
    pub fn near(&self) -> f64 {
        let where_none_is_given =
            || if self.is_orthographic() { 0.0 } else { 1e-6 * self.eye.distance(self.target) };
        self.near.unwrap_or_else(where_none_is_given)
    }

    /// The focal length in pixels for a drawn image of this height: an image-plane coordinate times this is a pixel
    /// distance from [`Self::middle_px`]. Of an orthographic camera, whose image plane is that of view-space x and y: pixels of a world
    /// unit.
    pub fn focal_px(&self, height_px: u32) -> f64 {
        let whole_px = f64::from(self.window.whole_px.map_or(height_px, |[_, height_px]| height_px));
        self.orthographic_height
            .map_or_else(|| 0.5 * whole_px / (0.5 * self.fov_y_rad).tan(), |height| whole_px / height)
    }

    /// The direction in which it looks: a unit vector in world space.
    pub fn forward(&self) -> DVec3 {
        (self.target - self.eye).normalize()
    }

    /// The height of an orthographic picture of this size that shows all of a ball, with 5% margin.
    pub fn height_of(ball: &Ball, size_px: [u32; 2]) -> f64 {
        let aspect = f64::from(size_px[0].max(1)) / f64::from(size_px[1].max(1));
        2.0 * FIT_MARGIN * seen_radius(ball) / aspect.min(1.0)
    }

    /// With things in the middle of the picture so many times as large, seen from the same eye: of the picture's height, so much less is
    /// shown. The field of view is one that is a number of degrees in f64.
    #[must_use]
    pub fn zoomed(&self, zoom: f64) -> Self {
        let fov_y_rad = 2.0 * ((0.5 * self.fov_y_rad).tan() / zoom).atan();
        let orthographic_height = self.orthographic_height.map(|height| height / zoom);
        Self { fov_y_rad: fov_y_rad.to_degrees().to_radians(), orthographic_height, ..*self }
    }

    /// Where the view's axis meets a drawn image of this size, in pixels from its top left corner: its middle, unless the
    /// camera is off-center.
    pub fn middle_px(&self, size_px: [u32; 2]) -> [f64; 2] {
        let (whole_px, corner_px) = (self.window.whole_px.unwrap_or(size_px), self.window.corner_px);
        [0, 1].map(|i| 0.5 * f64::from(whole_px[i]) - corner_px[i])
    }

    /// Where the drawn image's corner lies in the whole picture, in whole pixels.
    pub(crate) fn corner_px(&self) -> [u32; 2] {
        match self.window.whole_px {
            Some(_) => self.window.corner_px.map(|at| at.clamp(0.0, 65_535.0) as u32),
            None => [0; 2],
        }
    }

    /// As a sample of a picture is seen, with pixels sampled so far to the right and down of their centers; see [`super::Samples`].
    #[must_use]
    pub fn sample(&self, offset_px: [f64; 2]) -> Self {
        Self { window: self.window.shifted(offset_px), ..*self }
    }

    /// `up`, or where it is zero or parallel to the view the coordinate axis that takes its place.
    pub fn usable_up(&self) -> DVec3 {
        usable_up(self.up, self.forward())
    }

    /// The motion from world to view space.
    pub fn view_from_world(&self) -> ViewFromWorld {
        let forward = self.forward();
        let up = usable_up(self.up, forward);
        let right = forward.cross(up).normalize();
        let down = forward.cross(right);
        ViewFromWorld { rotation: DMat3::from_cols(right, down, forward).transpose(), eye: self.eye }
    }

    /// Refuses a camera that has no picture.
    ///
    /// # Errors
    /// [`crate::error::ErrorKind::Option`] for values that are not finite, an eye at the target, an angle outside (0°,
    /// 180°), a height or a near plane not above zero (of an orthographic camera it may be 0); as [`Window::validate`].
    pub fn validate(&self) -> Result<()> {
        let finite = self.eye.is_finite() && self.target.is_finite() && self.up.is_finite();
        if !finite {
            return Err(Error::option("camera", "eye, target and up must be finite numbers"));
        }
        let distance = self.eye.distance(self.target);
        if !(distance > 0.0 && distance.is_finite()) {
            return Err(Error::option("camera", "eye and target must be two different points"));
        }
        if let Some(height) = self.orthographic_height
            && !(height > 0.0 && height.is_finite())
        {
            return Err(Error::option(
                "--orthographic",
                format!("{height}: expected a height above 0, in the scene's unit"),
            ));
        }
        let has_angle = self.fov_y_rad >= SMALLEST_FOV_RAD && self.fov_y_rad < std::f64::consts::PI;
        if !(has_angle || self.is_orthographic()) {
            let degrees = self.fov_y_rad.to_degrees();
            return Err(Error::option(
                "--fov",
                format!("{degrees}: expected degrees above 1e-10 and below 180"),
            ));
        }
        let is_near_enough = if self.is_orthographic() { self.near() >= 0.0 } else { self.near() > 0.0 };
        if !(is_near_enough && self.near().is_finite()) {
            return Err(Error::option("camera", "near must be above zero"));
        }
        self.window.validate()
    }
}

impl Default for Camera {
    /// Looks from (0, 0, 1) along −z, with +y up.
    fn default() -> Self {
        Self {
            eye: DVec3::Z,
            target: DVec3::ZERO,
            up: DVec3::Y,
            fov_y_rad: Self::DEFAULT_FOV_Y_RAD,
            orthographic_height: None,
            near: None,
            window: Window::default(),
        }
    }
}

impl ViewFromWorld {
    /// A world point in view space.
    pub fn point(&self, world: DVec3) -> DVec3 {
        self.rotation * (world - self.eye)
    }
}

/// The radius of a ball, or 1 of one without extent: below a few steps of f64 at its place it can't be told from its center, nor the eye
/// from the target.
fn seen_radius(ball: &Ball) -> f64 {
    let smallest = 16.0 * f64::EPSILON * ball.center.abs().max_element();
    if ball.radius > smallest { ball.radius } else { 1.0 }
}

/// `up`, or where it is zero or parallel to the view the coordinate axis nearest to it that is not.
fn usable_up(up: DVec3, forward: DVec3) -> DVec3 {
    let parallel = |v: DVec3| forward.cross(v).length() <= 1e-9 * v.length();
    if !parallel(up) {
        return up;
    }
    let mut axes = [DVec3::Y, DVec3::Z, DVec3::X];
    axes.sort_by(|a, b| b.dot(up).abs().total_cmp(&a.dot(up).abs()));
    axes.into_iter().find(|&axis| forward.cross(axis).length() > 1e-3).unwrap_or(DVec3::Y)
}

#[cfg(test)]
mod tests {
    use super::*;

    const FOV: f64 = Camera::DEFAULT_FOV_Y_RAD;

    #[test]
    fn view_axes_are_right_down_forward() {
        let camera = Camera {
            eye: DVec3::new(0.0, 0.0, 5.0),
            target: DVec3::ZERO,
            ..Camera::fit(&unit(), [1, 1], FOV)
        };
        let view = camera.view_from_world();
        assert!(view.point(DVec3::X).distance(DVec3::new(1.0, 0.0, 5.0)) < 1e-15);
        assert!(view.point(DVec3::Y).distance(DVec3::new(0.0, -1.0, 5.0)) < 1e-15);
        assert!(view.point(DVec3::Z).distance(DVec3::new(0.0, 0.0, 4.0)) < 1e-15);
    }

    #[test]
    fn up_parallel_to_the_view_still_gives_a_rotation() {
        for up in [DVec3::Y, DVec3::NEG_Y, DVec3::ZERO] {
            let camera = Camera { eye: DVec3::Y, up, fov_y_rad: 1.0, ..Camera::default() };
            assert!((camera.view_from_world().rotation.determinant() - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn a_fit_shows_the_bounding_sphere_in_both_directions_and_survives_a_point() {
        for size in [[200, 100], [100, 200], [1, 1]] {
            let camera = Camera::fit(&unit(), size, FOV);
            let distance = camera.eye.z;
            let half_y = (0.5 * camera.fov_y_rad).tan();
            let half_x = half_y * f64::from(size[0]) / f64::from(size[1]);
            let seen = (unit().radius / distance).asin().tan();
            assert!(seen <= half_x.min(half_y), "{size:?}");
            assert!(seen >= 0.9 * half_x.min(half_y), "{size:?}");
        }
        let point = Ball { center: DVec3::new(5e5, 4.6e6, 300.0), radius: 0.0 };
        Camera::fit(&point, [64, 64], FOV).validate().unwrap();
    }

    fn unit() -> Ball {
        Ball { center: DVec3::ZERO, radius: 1.0 }
    }
}
