//! How the camera moves under mouse and keys: about a pivot, along the picture, toward what is under the cursor.

use glam::{DQuat, DVec3};
use surfel::scene::{Ball, Camera, View, toward_eye};

/// A camera on the move.
#[derive(Clone, Debug)]
pub struct Navigation {
    /// Where it is now.
    pub camera: Camera,
    /// Where it began.
    home: Camera,
    /// What `fit` shows.
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

    /// Moves nearer to what is under the cursor, or away from it: `factor` is the new distance over the old one.
    pub fn zoom(&mut self, factor: f64, cursor_px: [f64; 2], window_px: [u32; 2]) {
        let distance = self.distance();
        let [least, most] = DISTANCES.map(|radii| radii * self.ball.radius.max(f64::MIN_POSITIVE));
        let least = least.max(1e3 * f64::EPSILON * self.camera.target.abs().max_element());
        let shown = self.camera.orthographic_height.unwrap_or(distance);
        let factor = (shown * factor).clamp(least.min(shown), most.max(shown)) / shown;
        let anchor = self.at(cursor_px, window_px, distance);
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

    /// Shows all of the scene from the same side.
    pub fn fit(&mut self, window_px: [u32; 2]) {
        let [_, _, forward] = self.axes();
        self.look_from(-forward, self.camera.up, window_px);
    }

    /// Shows all of the scene from a side.
    pub fn see_from(&mut self, view: View, window_px: [u32; 2]) {
        let [toward, up] = toward_eye(Some(self.axis), view.angles_rad());
        self.look_from(toward, up, window_px);
    }

    /// Another direction is up; the eye stays.
    pub fn set_axis(&mut self, axis: DVec3) {
        (self.axis, self.camera.up, self.is_free) = (axis, axis, false);
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

    fn look_from(&mut self, toward_eye: DVec3, up: DVec3, window_px: [u32; 2]) {
        let fit = Camera::fit(&self.ball, window_px, self.camera.fov_y_rad);
        let distance = fit.eye.distance(fit.target);
        let height = self.camera.orthographic_height.map(|_| Camera::height_of(&self.ball, window_px));
        self.camera.orthographic_height = height;
        self.camera.target = fit.target;
        (self.camera.eye, self.camera.up) = (fit.target + toward_eye * distance, up);
        self.pivot = None;
    }

    fn shift(&mut self, by: DVec3) {
        self.camera.eye += by;
        self.camera.target += by;
    }

    fn pivot(&self) -> DVec3 {
        self.pivot.unwrap_or(self.camera.target)
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
mod tests {
    use super::*;

    const WINDOW_PX: [u32; 2] = [400, 300];

    fn start() -> Navigation {
        let ball = Ball { center: DVec3::new(2.0, 1.0, -3.0), radius: 1.5 };
        Navigation::new(Camera::fit(&ball, WINDOW_PX, Camera::DEFAULT_FOV_Y_RAD), ball)
    }

    /// Where the window shows a point.
    fn place_px(navigation: &Navigation, point: DVec3) -> [f64; 2] {
        let camera = &navigation.camera;
        let view = camera.view_from_world().point(point);
        let depth = if camera.is_orthographic() { 1.0 } else { view.z };
        let focal_px = camera.focal_px(WINDOW_PX[1]);
        [0.5 * 400.0 + focal_px * view.x / depth, 0.5 * 300.0 + focal_px * view.y / depth]
    }

    fn assert_near([x, y]: [f64; 2], expected: [f64; 2]) {
        assert!((x - expected[0]).hypot(y - expected[1]) < 1e-6, "{x}, {y}, not {expected:?}");
    }

    #[test]
    fn what_is_under_the_cursor_stays_there_while_zooming_and_follows_while_panning() {
        for parallel in [false, true] {
            let mut navigation = start();
            if parallel {
                navigation.toggle_projection();
            }
            navigation.orbit([31.0, 17.0], WINDOW_PX);
            let distance = navigation.distance();
            let point = navigation.at([77.0, 210.0], WINDOW_PX, distance);
            assert_near(place_px(&navigation, point), [77.0, 210.0]);
            navigation.zoom(0.4, [77.0, 210.0], WINDOW_PX);
            assert_near(place_px(&navigation, point), [77.0, 210.0]);
            navigation.set_pivot(point);
            navigation.pan([10.0, -5.0], WINDOW_PX);
            assert_near(place_px(&navigation, point), [87.0, 205.0]);
        }
    }

    #[test]
    fn orbits_keep_the_pivot_in_its_place_and_the_distance_to_it() {
        for free in [false, true] {
            let mut navigation = Navigation { is_free: free, ..start() };
            let pivot = navigation.camera.target + DVec3::new(0.3, 0.2, 0.1);
            navigation.set_pivot(pivot);
            let before = (place_px(&navigation, pivot), navigation.camera.eye.distance(pivot));
            for step in [[40.0, 0.0], [0.0, 60.0], [-90.0, 1e4], [13.0, -2e4]] {
                navigation.orbit(step, WINDOW_PX);
                navigation.camera.validate().unwrap();
                assert!((navigation.camera.eye.distance(pivot) - before.1).abs() < 1e-9);
                if free {
                    assert_near(place_px(&navigation, pivot), before.0);
                }
            }
        }
    }

    #[test]
    fn a_turntable_keeps_its_axis_upright_and_stops_at_the_poles() {
        let mut navigation = start();
        navigation.orbit([0.0, 1e5], WINDOW_PX);
        assert!(navigation.axes()[2].dot(DVec3::Y) < -0.999_99);
        navigation.orbit([123.0, -40.0], WINDOW_PX);
        let [right, up, _] = navigation.axes();
        assert!(right.dot(DVec3::Y).abs() < 1e-12 && up.dot(DVec3::Y) > 0.0);
        // Mouse down: seen from above.
        let mut navigation = start();
        navigation.orbit([0.0, 10.0], WINDOW_PX);
        assert!(navigation.camera.eye.y > navigation.camera.target.y);
        // Mouse to the right: the scene turns with it, so the eye goes to the left.
        let mut navigation = start();
        navigation.orbit([10.0, 0.0], WINDOW_PX);
        assert!(navigation.camera.eye.x < navigation.camera.target.x);
    }

    #[test]
    fn presets_are_sides_of_the_scene_whatever_is_up() {
        let mut navigation = start();
        let direction = |n: &Navigation| (n.camera.eye - n.camera.target).normalize();
        navigation.see_from(View::Right, WINDOW_PX);
        assert!(direction(&navigation).distance(DVec3::X) < 1e-12);
        navigation.set_axis(DVec3::Z);
        navigation.see_from(View::Top, WINDOW_PX);
        assert!(direction(&navigation).distance(DVec3::Z) < 1e-12);
        // From the pole, too, a turntable goes on.
        let right = navigation.axes()[0];
        navigation.orbit([0.0, -30.0], WINDOW_PX);
        assert!(navigation.axes()[0].distance(right) < 1e-6);
        navigation.go_home();
        assert_eq!(navigation.camera, start().camera);
        assert_eq!(navigation.axis, DVec3::Y);
    }

    #[test]
    fn projections_show_the_target_alike_and_come_back() {
        let mut navigation = start();
        let point = navigation.camera.target + DVec3::new(0.4, 0.3, 0.0);
        let before = place_px(&navigation, point);
        navigation.toggle_projection();
        assert_near(place_px(&navigation, point), before);
        navigation.toggle_projection();
        assert_near(place_px(&navigation, point), before);
        assert!(navigation.camera.orthographic_height.is_none());
    }

    #[test]
    fn no_zoom_and_no_flight_ends_in_a_camera_without_a_picture() {
        for parallel in [false, true] {
            let mut navigation = start();
            if parallel {
                navigation.toggle_projection();
            }
            for factor in [0.5, 2.0] {
                for _ in 0..200 {
                    navigation.zoom(factor, [3.0, 299.0], WINDOW_PX);
                    navigation.fly([0.1, -0.1, 0.3]);
                    navigation.camera.validate().unwrap();
                }
            }
            navigation.fit(WINDOW_PX);
            assert!((navigation.camera.target - navigation.ball.center).length() < 1e-12);
        }
    }
}
