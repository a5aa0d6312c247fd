//! What a mirror shows, as of an engine's planar reflection: the picture of a world that is mirrored itself, with the engine's own triangle, depth, numbers and motion.

use glam::{
    DAffine3, DMat4, DQuat, DVec3,
    dcamera::rh::{proj::directx, view::look_at_mat4},
};
use surfel::{
    Settings,
    embed::{HostCamera, Placed, Placement, ViewFrame},
    scene::{Colors, Object, Rasterizer, Scene},
};

use super::{Beside, FORWARD, RED, REVERSED, SIZE_PX, engine::Style};
use crate::common::scenes;

/// The mirror.
const ACROSS: DVec3 = DVec3::new(-1.0, 1.0, 1.0);

/// Cuts the ball and the veil.
const CORNERS: [DVec3; 3] =
    [DVec3::new(-30.0, -20.0, 33.3), DVec3::new(30.0, -20.0, -14.7), DVec3::new(0.0, 30.0, -12.2)];

/// The engine's depth is of f32, and so is the sum of a pixel's colors, which are added in another order.
const ROUNDING: f64 = 2e-5;
const ROUNDING_OF_COLORS: f32 = 1e-2;

/// A pixel that a splat's rim runs through, where rounding decides; of 19,200.
const MOST_AT_RIMS: usize = 20;

struct Seen {
    colors: Vec<[f32; 4]>,
    depths: Vec<f64>,
    ids: Vec<u32>,
    motion: Vec<[f32; 2]>,
}

fn opaque() -> Object {
    scenes::sphere(2500, DVec3::new(0.1, 0.0, -0.05))
}

fn veil() -> Object {
    let mut veil = scenes::sphere(800, DVec3::new(-0.6, 0.5, 1.2));
    veil.splats.colors = Colors::Uniform([0.1, 0.5, 0.8, 0.4]);
    veil
}

/// Where the ball stands, and stood.
fn places() -> [Placement; 2] {
    let at = |angle: f64, x: f64| Placement {
        rotation: DQuat::from_axis_angle(DVec3::new(0.2, 1.0, 0.1).normalize(), angle),
        scale: 0.9,
        translation: DVec3::new(x, 0.1, 0.2),
    };
    [at(0.5, 0.7), at(0.35, 0.5)]
}

/// Where it stands in the world that is mirrored.
fn mirrored(at: Placement) -> Placement {
    let [x, y, z, w] = at.rotation.to_array();
    Placement { rotation: DQuat::from_xyzw(x, -y, -z, w), translation: at.translation * ACROSS, ..at }
}

fn seen(
    beside: &mut Beside,
    settings: &Settings,
    (cameras, of_mirror): ([HostCamera; 2], bool),
    mirrors: bool,
) -> Seen {
    beside.mirrored = of_mirror;
    let across = DAffine3::from_scale(ACROSS);
    let upload = |beside: &Beside, own: Object| {
        let splats = if mirrors { own.splats.transformed(&across) } else { own.splats };
        beside.upload(&Scene { objects: vec![Object { splats, ..own }], ..Scene::default() })
    };
    let (ball, veil) = (upload(beside, opaque()), upload(beside, veil()));
    let [now, before] = places().map(|at| if mirrors { mirrored(at) } else { at });
    let corners = CORNERS.map(|corner| if mirrors { corner * ACROSS } else { corner });
    let placed = [
        Placed { id: 7, before: Some(before), ..Placed::new(&ball, now) },
        Placed { id: 9, ..Placed::at_home(&veil) },
    ];
    beside.draw_after(&placed, [&cameras[0], &cameras[1]], settings, &corners, true);
    let (ids, motion) = beside.engine.told();
    Seen { colors: beside.engine.pixels(), depths: beside.engine.depths(), ids, motion }
}

#[test]
fn a_mirror_shows_what_a_mirrored_world_would() {
    let [width, height] = SIZE_PX.map(f64::from);
    let look = |eye| look_at_mat4(eye, DVec3::new(0.2, 0.1, 0.0), DVec3::Y);
    let views = [DVec3::new(-0.9, 0.9, 4.0), DVec3::new(-0.7, 1.1, 4.2)].map(look);
    let jitter = DMat4::from_translation(DVec3::new(0.3 / width, -0.2 / height, 0.0));
    let off_center = directx::frustum(-0.21, 0.15, -0.12, 0.15, 0.5, 60.0);
    let infinite = jitter * directx::perspective_infinite_reverse(0.7, width / height, 0.5);
    let parallel = directx::orthographic(-1.7, 1.9, -1.2, 1.5, 0.5, 60.0);
    let mut besides = [REVERSED, FORWARD].map(|style| Beside::new(Style { tells_objects: true, ..style }));
    for (name, style, clip_from_view, rasterizer) in [
        ("jittered", 0, infinite, Rasterizer::Compute),
        ("jittered, points", 0, infinite, Rasterizer::Perspective),
        ("off center", 1, off_center, Rasterizer::Compute),
        ("parallel", 1, parallel, Rasterizer::Compute),
    ] {
        let beside: &mut Beside = &mut besides[style];
        let settings = Settings { size_px: SIZE_PX, rasterizer, ..Settings::default() };
        let camera = |view_from_world| HostCamera { view_from_world, clip_from_view, flips_y: true };
        let truth = seen(beside, &settings, (views.map(camera), false), true);
        // The mirror's plane turns the view over.
        let of_mirror = views.map(|view| camera(view * DMat4::from_scale(ACROSS)));
        let found = seen(beside, &settings, (of_mirror, true), false);

        let mut off = Vec::new();
        let (mut of_ball, mut of_veil, mut farthest) = (0, 0, 0.0_f32);
        for i in 0..truth.colors.len() {
            let far = |a: &[f32], b: &[f32]| a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
            of_ball += usize::from(truth.ids[i] == 7);
            of_veil += usize::from(truth.ids[i] != 7 && truth.colors[i] != RED && truth.colors[i][3] > 0.0);
            farthest = farthest.max(truth.motion[i][0].abs());
            let same = far(&truth.colors[i], &found.colors[i]) <= ROUNDING_OF_COLORS
                && (truth.depths[i] - found.depths[i]).abs() <= ROUNDING
                && truth.ids[i] == found.ids[i]
                && far(&truth.motion[i], &found.motion[i]) <= 160.0 * 1e-5;
            if !same {
                off.push((i, truth.colors[i], found.colors[i], truth.motion[i], found.motion[i]));
            }
        }
        println!(
            "{name}: {} pixels off, {of_ball} of the ball, {of_veil} of the veil, moved by {farthest}",
            off.len()
        );
        assert!(
            of_ball > 2000 && of_veil > 200 && farthest > 5.0,
            "{name}: {of_ball}, {of_veil}, {farthest}"
        );
        assert!(off.len() <= MOST_AT_RIMS, "{name}: {} pixels: {:?}", off.len(), &off[..5.min(off.len())]);
    }
    besides.into_iter().for_each(Beside::end);
}

/// What is said to be a mirror's and is none, and what is one and is not said to be.
#[test]
fn a_mirror_that_is_not_there_is_refused_by_name() {
    let mut beside = Beside::new(REVERSED);
    let ball = beside.upload(&Scene { objects: vec![opaque()], ..Scene::default() });
    let placed = [Placed::at_home(&ball)];
    let settings = Settings { size_px: SIZE_PX, ..Settings::default() };
    let plain = HostCamera {
        view_from_world: look_at_mat4(DVec3::new(0.4, 0.9, 4.0), DVec3::ZERO, DVec3::Y),
        clip_from_view: directx::perspective_infinite_reverse(0.7, 160.0 / 120.0, 0.5),
        flips_y: true,
    };
    let parallel =
        HostCamera { clip_from_view: directx::orthographic(-2.0, 2.0, -1.5, 1.5, 30.0, 0.5), ..plain };
    for (camera, mirrored, expected) in [
        (plain, true, "mirrored: "),
        (plain.of_mirror(), false, "camera: the picture is a mirror's"),
        (parallel, true, "compare: "),
        (parallel.of_mirror(), false, "compare: "),
    ] {
        let frame = ViewFrame { mirrored, ..ViewFrame::new(&placed, &camera, &settings) };
        // SAFETY: refused before anything is recorded.
        let refused = unsafe { beside.view.prepare(&beside.renderer, beside.engine.commands, &frame) };
        let refused = refused.unwrap_err().to_string();
        assert!(refused.starts_with(expected) && refused.contains("mirror's"), "{refused}");
    }
    drop(ball);
    beside.end();
}
