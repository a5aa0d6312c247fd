//! A world point has the same pixel and the same depth by the engine's matrices as by our camera, under every convention.

use glam::dcamera::rh::{proj::directx, view::look_at_mat4};

use super::*;

const SIZE_PX: [u32; 2] = [160, 120];

/// As a right-handed engine has it: looks along −z, y up.
fn looking(eye: DVec3, at: DVec3) -> DMat4 {
    look_at_mat4(eye, at, DVec3::new(0.2, 1.0, 0.1))
}

fn projections() -> Vec<(&'static str, DMat4, bool)> {
    let (fov, aspect, near, far) = (0.9, 160.0 / 120.0, 0.1, 50.0);
    // These have y up in clip space; Vulkan's engines flip it in the matrix or by the viewport.
    let down = DMat4::from_scale(DVec3::new(1.0, -1.0, 1.0));
    let shifted = DMat4::from_translation(DVec3::new(0.013, -0.007, 0.0));
    let reversed =
        DMat4::from_cols(DVec4::X, DVec4::Y, DVec4::new(0.0, 0.0, -1.0, 0.0), DVec4::new(0.0, 0.0, 1.0, 1.0));
    let plain = directx::perspective(fov, aspect, near, far);
    let parallel = directx::orthographic(-2.0, 2.0, -1.5, 1.5, near, far);
    vec![
        ("finite", down * plain, false),
        ("by the viewport", plain, true),
        ("reversed", down * reversed * plain, false),
        ("reversed and infinite", down * directx::perspective_infinite_reverse(fov, aspect, near), false),
        ("infinite", down * directx::perspective_infinite(fov, aspect, near), false),
        ("jittered", shifted * down * plain, false),
        ("off center", down * directx::frustum(-0.06, 0.1, -0.05, 0.07, near, far), false),
        ("scaled as a whole", down * plain * 3.0, false),
        ("parallel", down * parallel, false),
        ("parallel, reversed", down * reversed * parallel, false),
        ("parallel, jittered", shifted * down * parallel, false),
        ("parallel, by the viewport", parallel, true),
    ]
}

#[test]
fn points_have_the_engines_pixels_and_depths() {
    let far_off = DVec3::new(500_000.0, 4_600_000.0, 300.0);
    for origin in [DVec3::ZERO, far_off] {
        let in_meters = looking(origin + DVec3::new(3.0, 2.0, 4.0), origin);
        // Of an engine that counts in centimeters there, and one in kilometers.
        let units = [1.0, 100.0, 1e-3].map(|unit| DMat4::from_scale(DVec3::splat(unit)));
        let each = projections().into_iter().flat_map(|of| units.map(|unit| (unit, of)));
        for (unit, (name, in_meters_too, flips_y)) in each {
            let (view_from_world, clip_from_view) = (unit * in_meters, in_meters_too * unit.inverse());
            let host = HostCamera { view_from_world, clip_from_view, flips_y };
            let (camera, depth) = host.camera(SIZE_PX).unwrap();
            let (view, focal_px) = (camera.view_from_world(), camera.focal_px(SIZE_PX[1]));
            for point in [DVec3::ZERO, DVec3::new(0.3, -0.4, 0.2), DVec3::new(-0.6, 0.5, 1.0)] {
                let clip = clip_from_view * view_from_world * (origin + point).extend(1.0);
                let [x, y, d] = [clip.x, clip.y, clip.z].map(|part| part / clip.w);
                let y = if flips_y { -y } else { y };
                let expected =
                    [x, y].into_iter().zip(SIZE_PX).map(|(at, size)| 0.5 * (at + 1.0) * f64::from(size));
                let seen = view.point(origin + point);
                let unit = if camera.is_orthographic() { 1.0 } else { seen.z };
                let middle_px = camera.middle_px(SIZE_PX);
                for (i, expected) in expected.enumerate() {
                    let at = middle_px[i] + focal_px * seen[i] / unit;
                    // f64 has 1e-9 at 4.6e6, and a pixel is a fiftieth of a unit.
                    assert!((at - expected).abs() < 1e-6, "{name}: {at} {expected}");
                }
                let of_host = match depth {
                    DepthOfHost::Perspective { a, b } => a + b / seen.z,
                    DepthOfHost::Orthographic { a, b } => a + b * seen.z,
                };
                assert!((of_host - d).abs() < 1e-8, "{name}: {of_host} {d}");
            }
            assert!(
                (camera.near() - if camera.is_orthographic() { 0.0 } else { 0.1 }).abs() < 1e-12,
                "{name}"
            );
        }
    }
}

#[test]
fn a_left_handed_view_of_the_same_world_gives_the_same_camera() {
    let right_handed = HostCamera {
        view_from_world: looking(DVec3::new(3.0, 2.0, 4.0), DVec3::ZERO),
        clip_from_view: directx::perspective(0.9, 4.0 / 3.0, 0.1, 50.0),
        flips_y: true,
    };
    let mirror = DMat4::from_scale(DVec3::new(1.0, 1.0, -1.0));
    let left_handed = HostCamera {
        view_from_world: mirror * right_handed.view_from_world,
        clip_from_view: right_handed.clip_from_view * mirror,
        ..right_handed
    };
    let [(one, of_one), (other, of_other)] =
        [right_handed, left_handed].map(|host| host.camera(SIZE_PX).unwrap());
    assert!(one.eye.distance(other.eye) < 1e-14 && one.target.distance(other.target) < 1e-14);
    assert_eq!(of_one, of_other);
}

#[test]
fn what_is_no_camera_is_refused_by_name() {
    let plain = HostCamera {
        view_from_world: looking(DVec3::new(3.0, 2.0, 4.0), DVec3::ZERO),
        clip_from_view: directx::perspective(0.9, 4.0 / 3.0, 0.1, 50.0),
        flips_y: true,
    };
    plain.camera(SIZE_PX).unwrap();
    let problem = |host: HostCamera| host.camera(SIZE_PX).unwrap_err().to_string();
    let of = |clip_from_view| problem(HostCamera { clip_from_view, ..plain });
    assert!(problem(HostCamera { flips_y: false, ..plain }).contains("mirror"));
    assert!(of(directx::perspective(0.9, 1.0, 0.1, 50.0)).contains("square"));
    assert!(of(DMat4::IDENTITY * DMat4::from_rotation_x(0.1)).contains("turns or shears"));
    assert!(of(DMat4::ZERO).contains("neither"));
    assert!(of(DMat4::NAN).contains("finite"));
    let view_from_world = plain.view_from_world * 2.0;
    assert!(problem(HostCamera { view_from_world, ..plain }).contains("expected a motion"));
    let view_from_world = plain.view_from_world * DMat4::from_scale(DVec3::new(1.001, 1.0, 1.0));
    assert!(problem(HostCamera { view_from_world, ..plain }).contains("expected a motion"));
    for scale in [0.0, 1e-300] {
        let view_from_world = DMat4::from_scale(DVec3::splat(scale)) * plain.view_from_world;
        assert!(problem(HostCamera { view_from_world, ..plain }).contains("expected a motion"));
    }
}

/// A mirror's picture turned over is that of the camera without it, and the other way around.
#[test]
fn a_mirrors_picture_turned_over_is_a_cameras() {
    let view_from_world = looking(DVec3::new(3.0, 2.0, 4.0), DVec3::ZERO);
    for (name, clip_from_view, flips_y) in projections() {
        let host = HostCamera { view_from_world, clip_from_view, flips_y };
        let mirrored = HostCamera {
            view_from_world: view_from_world * DMat4::from_scale(DVec3::new(1.0, -1.0, 1.0)),
            ..host
        };
        let (camera, depth) = mirrored.of_mirror().camera(SIZE_PX).unwrap();
        let (view, focal_px) = (camera.view_from_world(), camera.focal_px(SIZE_PX[1]));
        let point = DVec3::new(0.3, -0.4, 0.2);
        let clip = mirrored.clip_from_view * mirrored.view_from_world * point.extend(1.0);
        let seen = view.point(point);
        let unit = if camera.is_orthographic() { 1.0 } else { seen.z };
        let at = camera.middle_px(SIZE_PX)[0] + focal_px * seen.x / unit;
        let expected = 0.5 * (clip.x / clip.w + 1.0) * f64::from(SIZE_PX[0]);
        assert!((f64::from(SIZE_PX[0]) - at - expected).abs() < 1e-9, "{name}: {at} {expected}");
        let of_host = match depth {
            DepthOfHost::Perspective { a, b } => a + b / seen.z,
            DepthOfHost::Orthographic { a, b } => a + b * seen.z,
        };
        assert!((of_host - clip.z / clip.w).abs() < 1e-10, "{name}: {of_host}");
    }
}

/// Engines of left-handed worlds look along +z, y up.
#[test]
fn a_left_handed_world_is_drawn_mirrored_with_its_own_matrices() {
    use crate::scene::Placement;
    use glam::dcamera::lh;

    let eye = DVec3::new(3.0, 2.0, -4.0);
    let host = HostCamera {
        view_from_world: lh::view::look_at_mat4(eye, DVec3::new(0.1, 0.0, 0.3), DVec3::Y),
        clip_from_view: lh::proj::directx::perspective(0.9, 160.0 / 120.0, 0.1, 50.0),
        flips_y: true,
    };
    assert!(host.camera(SIZE_PX).unwrap_err().to_string().contains("of_left_handed"));
    let (camera, depth) = host.of_left_handed().camera(SIZE_PX).unwrap();
    let DepthOfHost::Perspective { a, b } = depth else { panic!("{depth:?}") };
    let turned = DQuat::from_rotation_y(0.7) * DQuat::from_rotation_x(0.4);
    let world_from_scene =
        DMat4::from_scale_rotation_translation(DVec3::splat(1.5), turned, DVec3::new(0.2, -0.3, 0.4));
    let placement = Placement::of_left_handed(&world_from_scene).unwrap();
    for point in [DVec3::ZERO, DVec3::new(0.3, -0.4, 0.2), DVec3::new(-0.6, 0.5, 0.1)] {
        let clip = host.clip_from_view * host.view_from_world * world_from_scene * point.extend(1.0);
        let mirrored = point * DVec3::new(1.0, 1.0, -1.0);
        let seen = camera.view_from_world().point(placement.world_from_scene().transform_point3(mirrored));
        let focal_px = camera.focal_px(SIZE_PX[1]);
        let at = [0, 1].map(|i| camera.middle_px(SIZE_PX)[i] + focal_px * seen[i] / seen.z);
        let expected = [0.5 * (clip.x / clip.w + 1.0) * 160.0, 0.5 * (1.0 - clip.y / clip.w) * 120.0];
        assert!(
            (at[0] - expected[0]).abs() < 1e-9 && (at[1] - expected[1]).abs() < 1e-9,
            "{at:?} {expected:?}"
        );
        assert!((a + b / seen.z - clip.z / clip.w).abs() < 1e-12, "{seen}");
    }
}
