//! The camera stays where hands expect it.

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
fn a_camera_at_another_distance_looks_at_the_same_and_the_hand_has_its_own() {
    for parallel in [false, true] {
        let mut navigation = start();
        if parallel {
            navigation.toggle_projection();
        }
        let (before, pivot) = (navigation.camera, navigation.pivot());
        let near = navigation.at_distance(0.25, WINDOW_PX);
        let of = |camera: &Camera| camera.orthographic_height.unwrap_or(camera.eye.distance(pivot));
        assert!((of(&near) / of(&before) - 0.25).abs() < 1e-9 && navigation.camera == before);
        navigation.camera = near;
        assert_near(place_px(&navigation, pivot), [200.0, 150.0]);
    }
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
        navigation.zoom(0.4, ([77.0, 210.0], None), WINDOW_PX);
        assert_near(place_px(&navigation, point), [77.0, 210.0]);
        navigation.set_pivot(point);
        navigation.pan([10.0, -5.0], WINDOW_PX);
        assert_near(place_px(&navigation, point), [87.0, 205.0]);
    }
}

#[test]
fn the_surface_under_the_cursor_stays_there_and_is_never_passed() {
    let mut navigation = start();
    navigation.orbit([31.0, 17.0], WINDOW_PX);
    let (cursor, depth) = ([77.0, 210.0], 0.3 * navigation.distance());
    let surface = navigation.at(cursor, WINDOW_PX, depth);
    let mut before = navigation.camera.eye.distance(surface);
    for _ in 0..60 {
        navigation.zoom(0.8, (cursor, Some(surface)), WINDOW_PX);
        assert_near(place_px(&navigation, surface), cursor);
        let now = navigation.camera.eye.distance(surface);
        assert!((now / before - 0.8).abs() < 1e-3, "{now} of {before}");
        before = now;
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
    navigation.see_from(View::Right, &start().ball, WINDOW_PX, WINDOW_PX[0]);
    assert!(direction(&navigation).distance(DVec3::X) < 1e-12);
    navigation.set_axis(DVec3::Z);
    navigation.see_from(View::Top, &start().ball, WINDOW_PX, WINDOW_PX[0]);
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
fn each_axis_is_up_in_its_turn_but_those_that_the_camera_looks_along() {
    let mut navigation = start();
    navigation.see_from(View::Front, &start().ball, WINDOW_PX, WINDOW_PX[0]);
    let names: Vec<_> = (0..5).map(|_| navigation.next_axis()).collect();
    assert_eq!(names, ["-x", "-y", "x", "y", "-x"]);
    assert_eq!(navigation.camera.up, DVec3::NEG_X);
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

/// As where a panel hides the right of the window.
#[test]
fn what_fits_the_left_of_a_window_is_in_its_middle_and_within_it() {
    for parallel in [false, true] {
        let mut navigation = start();
        if parallel {
            navigation.toggle_projection();
        }
        let (ball, width_px) = (navigation.ball, 250);
        navigation.fit(&ball, WINDOW_PX, width_px);
        assert_near(place_px(&navigation, ball.center), [125.0, 150.0]);
        let rim = ball.center + ball.radius * navigation.axes()[0];
        assert!((200.0..250.0).contains(&place_px(&navigation, rim)[0]));
        // It turns about the ball.
        navigation.orbit([30.0, 10.0], WINDOW_PX);
        assert_near(place_px(&navigation, ball.center), [125.0, 150.0]);
    }
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
                navigation.zoom(factor, ([3.0, 299.0], None), WINDOW_PX);
                navigation.fly([0.1, -0.1, 0.3]);
                navigation.camera.validate().unwrap();
            }
        }
        navigation.fit(&start().ball, WINDOW_PX, WINDOW_PX[0]);
        assert!((navigation.camera.target - navigation.ball.center).length() < 1e-12);
    }
}
