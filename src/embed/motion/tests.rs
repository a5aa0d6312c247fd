use glam::DQuat;

use super::*;
use crate::prepare::{PreparedScene, prepare_without_device};
use crate::scene::{Scene, Window};
use crate::vk::Limits;

const SIZE_PX: [u32; 2] = [160, 120];

fn nothing() -> PreparedScene {
    prepare_without_device(&Limits::plain(), &Scene::default()).unwrap()
}

/// Where a camera sees a point, in pixels from the corner, and its w.
fn seen(camera: &Camera, range: DepthRange, world: DVec3) -> [f64; 3] {
    let at = camera.view_from_world().point(world);
    let (focal_px, middle) = (camera.focal_px(SIZE_PX[1]), camera.middle_px(SIZE_PX));
    let (x, y, w) = match camera.is_orthographic() {
        true => (at.x, at.y, 1.0 - (at.z - range.from_eye) / range.end),
        false => (at.x / at.z, at.y / at.z, camera.near() / at.z),
    };
    [focal_px * x + middle[0], focal_px * y + middle[1], w]
}

/// As the shader has it.
fn motion_of(object: &HostObject, [x, y, w]: [f64; 3]) -> [f64; 2] {
    let dot = |row: [f32; 4]| {
        let [a, b, c, d] = row.map(f64::from);
        a * x + b * y + c + d * w
    };
    let over = dot(object.over);
    [x * over - dot(object.x), y * over - dot(object.y)].map(|moved| moved / (1.0 + over))
}

#[test]
fn motion_is_from_where_a_point_was_to_where_it_is() {
    let far = DVec3::new(4e5, -3e5, 100.0);
    let scene = nothing();
    let turned = |angle: f64, scale| Placement {
        rotation: DQuat::from_axis_angle(DVec3::new(0.3, 1.0, 0.2).normalize(), angle),
        scale,
        translation: far + DVec3::new(0.2 * angle, -0.1, 0.3),
    };
    let window = Window { whole_px: None, corner_px: [3.5, -2.25] };
    let now = Camera { eye: far + DVec3::new(0.5, 1.0, 4.0), target: far, window, ..Camera::default() };
    let before = Camera { eye: far + DVec3::new(0.4, 1.2, 3.8), window: Window::default(), ..now };
    let parallel = |camera| Camera { orthographic_height: Some(3.0), ..camera };
    let range = DepthRange { from_eye: 2.5, end: 6.0 };
    let local = DVec3::new(0.3, -0.2, 0.4);
    for cameras in [[now, before], [parallel(now), parallel(before)], [now, now], [parallel(now), before]] {
        for (at, stood) in [(turned(0.4, 1.1), turned(0.3, 1.0)), (turned(0.4, 1.1), turned(0.4, 1.1))] {
            let placed = Placed { before: Some(stood), id: 7, ..Placed::new(&scene, at) };
            let [is, was] = [at, stood].map(|at| at.world_from_scene().transform_point3(local));
            let object = Motion::new([&cameras[0], &cameras[1]], range, SIZE_PX).of(&placed);
            let ([x, y, w], [old_x, old_y, _]) =
                (seen(&cameras[0], range, is), seen(&cameras[1], range, was));
            let [dx, dy] = motion_of(&object, [x, y, w]);
            let off = (dx - (x - old_x)).abs().max((dy - (y - old_y)).abs());
            let moved = (x - old_x).hypot(y - old_y);
            // Of f32's rows, each of some pixels.
            assert!(off <= 1e-6 * (moved + 1.0) + 1e-5, "{off} of {moved}");
            assert_eq!(object.id, 7);
            let stands = cameras[0] == cameras[1] && at == stood;
            assert_eq!(moved < 1e-6, stands);
            assert!(!stands || off < 1e-6, "{off}");
        }
    }
}
