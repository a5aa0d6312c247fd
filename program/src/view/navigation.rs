//! How the camera moves under mouse and keys: about a pivot, along the picture, toward what is under the cursor.

use glam::{DQuat, DVec3};
use surfel::scene::{AXES, Ball, Camera, View, toward_eye};

/// A camera on the move.
#[derive(Clone, Debug)]
pub struct Navigation {
    /// Where it is now.
    pub camera: Camera,
    /// Where it began.
    home: Camera,
    /// What is about as large as the scene.
    ball: Ball,
    /// The direction about which a turntable turns, unit.
    axis: DVec3,
    /// It turns freely, not on a turntable.
    pub is_free: bool,
    /// The point about which it turns; without, the one in the middle of the picture.
    pivot: Option<DVec3>,
}

/// A turntable stops short of the poles, where the picture would flip.
const MOST_ELEVATION_RAD: f64 = 1.569;

/// Distances between eye and target, in radii of the scene.
const DISTANCES: [f64; 2] = [1e-7, 1e5];

impl Navigation {
    /// From this camera, about a scene within a ball.
    pub fn new(camera: Camera, ball: Ball) -> Self {
        let axis = camera.usable_up().normalize_or(DVec3::Y);
        Self { camera, home: camera, ball, axis, is_free: false, pivot: None }
    }

    /// The scene is within another ball; the camera stays.
    pub fn set_ball(&mut self, ball: Ball) {
        self.ball = ball;
    }

    /// Turns about the pivot as the mouse is dragged: across the window's height is half a turn.
    pub fn orbit(&mut self, [dx, dy]: [f64; 2], window_px: [u32; 2]) {
        let rad_a_px = std::f64::consts::PI / f64::from(window_px[1].max(1));
        let [right, up, forward] = self.axes();
        let turn = match self.is_free {
            true => {
                let turn = DQuat::from_axis_angle(up, -dx * rad_a_px)
                    * DQuat::from_axis_angle(right, -dy * rad_a_px);
                self.camera.up = (turn * up).normalize();
                turn
            }
            false => {
                let elevation = (-forward.dot(self.axis)).clamp(-1.0, 1.0).asin();
                let raised = (elevation + dy * rad_a_px).clamp(-MOST_ELEVATION_RAD, MOST_ELEVATION_RAD);
                self.camera.up = self.axis;
                DQuat::from_axis_angle(self.axis, -dx * rad_a_px)
                    * DQuat::from_axis_angle(right, elevation - raised)
            }
        };
        let pivot = self.pivot();
        self.camera.eye = pivot + turn * (self.camera.eye - pivot);
        self.camera.target = pivot + turn * (self.camera.target - pivot);
    }

    /// Moves along the picture, so that what is at the pivot's depth follows the mouse.
    pub fn pan(&mut self, [dx, dy]: [f64; 2], window_px: [u32; 2]) {
        let [right, up, forward] = self.axes();
        let depth = (self.pivot() - self.camera.eye).dot(forward);
        let unit = self.unit_a_px(depth, window_px);
        self.shift((up * dy - right * dx) * unit);
    }

    /// Moves nearer to the surface that is under the cursor, or away from it: `factor` is the new distance over the old one. Where there is none, to what is there at the
    /// target's distance.
    pub fn zoom(
        &mut self,
        factor: f64,
        (cursor_px, surface): ([f64; 2], Option<DVec3>),
        window_px: [u32; 2],
    ) {
        let distance = self.distance();
        let [least, most] = DISTANCES.map(|radii| radii * self.ball.radius.max(f64::MIN_POSITIVE));
        let least = least.max(1e3 * f64::EPSILON * self.camera.target.abs().max_element());
        let shown = self.camera.orthographic_height.unwrap_or(distance);
        let factor = (shown * factor).clamp(least.min(shown), most.max(shown)) / shown;
        let anchor = surface.unwrap_or_else(|| self.at(cursor_px, window_px, distance));
        match &mut self.camera.orthographic_height {
            Some(height) => {
                *height *= factor;
                let moved = (anchor - self.camera.target) * (1.0 - factor);
                self.shift(moved);
            }
            None => {
                self.camera.eye = anchor + factor * (self.camera.eye - anchor);
                self.camera.target = anchor + factor * (self.camera.target - anchor);
            }
        }
    }

    /// The camera at so many times the distance from what is in the middle of the picture.
    pub fn at_distance(&self, factor: f64, window_px: [u32; 2]) -> Camera {
        let mut other = self.clone();
        let middle_px = window_px.map(|side| 0.5 * f64::from(side));
        other.zoom(factor, (middle_px, Some(self.pivot())), window_px);
        other.camera
    }

    /// Flies: to the right, up and forward, in radii of the scene.
    pub fn fly(&mut self, [right, up, forward]: [f64; 3]) {
        let axes = self.axes();
        if let Some(height) = &mut self.camera.orthographic_height {
            *height *= (-forward).exp();
            self.shift((right * axes[0] + up * axes[1]) * self.ball.radius);
            return;
        }
        self.shift((right * axes[0] + up * axes[1] + forward * axes[2]) * self.ball.radius);
    }

    /// Back to where it began.
    pub fn go_home(&mut self) {
        (self.camera, self.pivot) = (self.home, None);
        self.axis = self.camera.usable_up().normalize_or(DVec3::Y);
    }

    /// Shows all within a ball from the same side, on the left of the window up to `width_px`.
    pub fn fit(&mut self, ball: &Ball, window_px: [u32; 2], width_px: u32) {
        let [_, _, forward] = self.axes();
        self.look_from(-forward, self.camera.up, ball, window_px, width_px);
    }

    /// Shows all within a ball from a side, in the same place.
    pub fn see_from(&mut self, view: View, ball: &Ball, window_px: [u32; 2], width_px: u32) {
        let [toward, up] = toward_eye(Some(self.axis), view.angles_rad());
        self.look_from(toward, up, ball, window_px, width_px);
    }

    /// Another direction is up; the eye stays.
    pub fn set_axis(&mut self, axis: DVec3) {
        (self.axis, self.camera.up, self.is_free) = (axis, axis, false);
    }

    /// The next of the axes is up that the camera does not look along; says which.
    pub fn next_axis(&mut self) -> &'static str {
        let nearest = |axis: &usize| AXES[*axis].1.dot(self.axis);
        let now = (0..AXES.len()).max_by(|a, b| nearest(a).total_cmp(&nearest(b))).unwrap_or(0);
        let forward = self.forward();
        let others = (1..=AXES.len()).map(|by| AXES[(now + by) % AXES.len()]);
        let (name, axis) =
            others.clone().find(|(_, axis)| axis.dot(forward).abs() < 0.999).unwrap_or(AXES[now]);
        self.set_axis(axis);
        name
    }

    /// From a perspective to parallel rays and back, with what is at the target as large as before.
    pub fn toggle_projection(&mut self) {
        let [_, _, forward] = self.axes();
        let slope = 2.0 * (0.5 * self.camera.fov_y_rad).tan();
        self.camera.orthographic_height = match self.camera.orthographic_height {
            None => Some(slope * self.distance()),
            Some(height) => {
                self.camera.eye = self.camera.target - forward * (height / slope);
                None
            }
        };
    }

    /// Turns about this point from now on.
    pub fn set_pivot(&mut self, point: DVec3) {
        self.pivot = Some(point);
    }

    /// The point at a depth that is seen at a place of the window.
    pub fn at(&self, [x, y]: [f64; 2], window_px: [u32; 2], depth: f64) -> DVec3 {
        let [right, up, forward] = self.axes();
        let unit = self.unit_a_px(depth, window_px);
        let [dx, dy] = [x - 0.5 * f64::from(window_px[0]), y - 0.5 * f64::from(window_px[1])];
        self.camera.eye + forward * depth + (right * dx - up * dy) * unit
    }

    fn look_from(&mut self, toward_eye: DVec3, up: DVec3, ball: &Ball, window_px: [u32; 2], width_px: u32) {
        let seen_px = [width_px, window_px[1]];
        let fit = Camera::fit(ball, seen_px, self.camera.fov_y_rad);
        let distance = fit.eye.distance(fit.target);
        let height = self.camera.orthographic_height.map(|_| Camera::height_of(ball, seen_px));
        self.camera.orthographic_height = height;
        self.camera.target = fit.target;
        (self.camera.eye, self.camera.up) = (fit.target + toward_eye * distance, up);
        self.pivot = None;
        if width_px < window_px[0] {
            let [right, ..] = self.axes();
            let beside_px = 0.5 * f64::from(window_px[0] - width_px);
            self.shift(right * (beside_px * self.unit_a_px(distance, window_px)));
            self.pivot = Some(fit.target);
        }
    }

    fn shift(&mut self, by: DVec3) {
        self.camera.eye += by;
        self.camera.target += by;
    }

    /// The point about which it turns.
    pub fn pivot(&self) -> DVec3 {
        self.pivot.unwrap_or(self.camera.target)
    }

    /// The direction in which the camera looks, unit.
    pub fn forward(&self) -> DVec3 {
        self.axes()[2]
    }

    fn distance(&self) -> f64 {
        self.camera.eye.distance(self.camera.target)
    }

    /// To the right, up and forward, unit vectors.
    fn axes(&self) -> [DVec3; 3] {
        let rotation = self.camera.view_from_world().rotation;
        [rotation.row(0), -rotation.row(1), rotation.row(2)]
    }

    /// World units of a pixel at a depth.
    fn unit_a_px(&self, depth: f64, window_px: [u32; 2]) -> f64 {
        let focal_px = self.camera.focal_px(window_px[1].max(1));
        if self.camera.is_orthographic() { 1.0 / focal_px } else { depth.max(0.0) / focal_px }
    }
}

#[cfg(test)]
mod tests;
