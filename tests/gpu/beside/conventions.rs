//! A ball and a triangle that cut each other.

use ash::vk;
use glam::{
    DMat4, DVec3, DVec4,
    dcamera::rh::{proj::directx, view::look_at_mat4},
};
use surfel::{
    Settings,
    embed::{HostCamera, Placed},
    reference,
    scene::{Camera, Colors, DepthOfHost, Edges, Rasterizer, Scene, Shading},
};

use super::{Beside, FORWARD, RED, REVERSED, SIZE_PX, engine::Style, plane_depth};
use crate::common::scenes;

/// Through the ball, and over all of the picture.
const CORNERS: [DVec3; 3] =
    [DVec3::new(-30.0, -20.0, 12.0), DVec3::new(30.0, -20.0, 3.0), DVec3::new(0.0, 30.0, -14.0)];

fn conventions() -> Vec<(&'static str, Style, DMat4, bool)> {
    let (fov, aspect, near, far) = (0.7, 160.0 / 120.0, 0.5, 90.0);
    let down = DMat4::from_scale(DVec3::new(1.0, -1.0, 1.0));
    let jitter = DMat4::from_translation(DVec3::new(0.3 / 160.0, -0.2 / 120.0, 0.0));
    let reversed =
        DMat4::from_cols(DVec4::X, DVec4::Y, DVec4::new(0.0, 0.0, -1.0, 0.0), DVec4::new(0.0, 0.0, 1.0, 1.0));
    let plain = down * directx::perspective(fov, aspect, near, far);
    let infinite = directx::perspective_infinite_reverse(fov, aspect, near);
    let parallel = down * directx::orthographic(-1.7, 1.7, -1.275, 1.275, near, far);
    let format = |style, depth_format| Style { depth_format, ..style };
    let (d16, d24) = (vk::Format::D16_UNORM, vk::Format::X8_D24_UNORM_PACK32);
    vec![
        ("reversed and infinite", REVERSED, down * infinite, false),
        ("y up by the viewport", REVERSED, infinite, true),
        ("jittered", REVERSED, jitter * down * infinite, false),
        ("reversed", REVERSED, reversed * plain, false),
        ("forward", FORWARD, plain, false),
        ("forward, infinite", FORWARD, down * directx::perspective_infinite(fov, aspect, near), false),
        ("24 bits", format(FORWARD, d24), plain, false),
        ("16 bits, reversed", format(REVERSED, d16), reversed * plain, false),
        ("parallel", FORWARD, parallel, false),
        ("parallel, reversed", REVERSED, reversed * parallel, false),
    ]
}

/// Of a ball of one color, linear.
const BLUE: f32 = 0.8;

/// Of a depth, within which f32 does not tell.
const EPSILON_TIE: f64 = 1e-5;

/// What a step of the format is at a depth.
pub(super) fn step_of(format: vk::Format, depth: f64) -> f64 {
    match format {
        vk::Format::D16_UNORM => 1.0 / 65_535.0,
        vk::Format::X8_D24_UNORM_PACK32 => 1.0 / 16_777_215.0,
        _ => depth.abs().max(1e-30) * 2.0_f64.powi(-23),
    }
}

struct Expected {
    camera: Camera,
    depth: DepthOfHost,
    picture: reference::Picture,
}

/// The oracle's picture by the engine's own matrices.
fn expected(scene: &Scene, host: &HostCamera, settings: &Settings) -> Expected {
    let (camera, depth) = host.camera(SIZE_PX).unwrap();
    let settings = Settings { background: None, ..settings.clone() };
    let picture = reference::render(scene, &camera, &settings, &|_, _| {}).unwrap();
    Expected { camera, depth, picture }
}

/// The engine's depth where the plane of its triangle is seen, and where the ball is.
fn depths(expected: &Expected, pixel: usize) -> [f64; 2] {
    let Expected { camera, depth, picture } = expected;
    let (view, focal_px) = (camera.view_from_world(), camera.focal_px(SIZE_PX[1]));
    let middle_px = camera.middle_px(SIZE_PX);
    let [x, y] = [pixel % SIZE_PX[0] as usize, pixel / SIZE_PX[0] as usize];
    let at = [x, y].map(|at| at as f64 + 0.5);
    let [x, y] = [0, 1].map(|i| (at[i] - middle_px[i]) / focal_px);
    let (origin, direction) = match camera.is_orthographic() {
        true => (DVec3::new(x, y, 0.0), DVec3::Z),
        false => (DVec3::ZERO, DVec3::new(x, y, 1.0)),
    };
    let of_plane = plane_depth(CORNERS.map(|corner| view.point(corner)), origin, direction);
    [of_plane, picture.pixels[pixel].depth].map(|z| match *depth {
        DepthOfHost::Perspective { a, b } => a + b / z,
        DepthOfHost::Orthographic { a, b } => a + b * z,
    })
}

#[test]
fn balls_and_triangles_cut_each_other_where_the_oracle_says() {
    let scene = Scene { objects: vec![scenes::sphere(3000, DVec3::ZERO)], ..Scene::default() };
    for (name, style, clip_from_view, flips_y) in conventions() {
        let view_from_world = look_at_mat4(DVec3::new(0.4, 0.9, 4.0), DVec3::ZERO, DVec3::Y);
        let camera = HostCamera { view_from_world, clip_from_view, flips_y };
        let mut beside = Beside::new(style);
        let prepared = beside.upload(&scene);
        let scenes = [Placed::at_home(&prepared)];
        for rasterizer in [Rasterizer::Compute, Rasterizer::Perspective] {
            let settings = Settings {
                size_px: SIZE_PX,
                edges: Edges::Hard,
                rasterizer,
                shading: Shading::Albedo,
                ..Settings::default()
            };
            let expected = expected(&scene, &camera, &settings);
            beside.draw(&scenes, &camera, &settings, &CORNERS, false);
            let (pixels, written) = (beside.engine.pixels(), beside.engine.depths());
            let (mut of_ball, mut ties, mut exempt, mut worst, mut worst_steps) = (0, 0, 0, 0.0_f64, 0.0_f64);
            for (i, (color, written)) in pixels.iter().zip(written).enumerate() {
                let covered = expected.picture.pixels[i].weight > 0.0;
                let [of_plane, ball] = depths(&expected, i);
                let step = step_of(style.depth_format, of_plane);
                // Both are rounded to the format; ours is some ten roundings of f32, of 1 - w where depth runs forward.
                let size = if style.clear_depth == 1.0 { 1.0 } else { ball.abs() };
                let tolerance = 2.0 * step + size * 2.0_f64.powi(-20);
                let nearer = match style.compare {
                    vk::CompareOp::GREATER => ball > of_plane,
                    _ => ball < of_plane,
                };
                if covered && (ball - of_plane).abs() <= tolerance {
                    ties += 1;
                    continue;
                }
                let shows_ball = covered && nearer;
                assert_eq!(*color != RED, shows_ball, "{name}, {rasterizer:?}, pixel {i}: {ball} {of_plane}");
                of_ball += u32::from(shows_ball);
                // A splat that touches the pixel with its rim, or is as far behind the nearest one as belongs to its surface, is in the
                // mean or not, by rounding.
                let exact = &expected.picture.pixels[i];
                if shows_ball && (exact.epsilon_margin < EPSILON_TIE || exact.rim) {
                    exempt += 1;
                    continue;
                }
                let depth = if shows_ball { ball } else { of_plane };
                // The engine's own triangle lies between corners that a device moves by up to half of 1/256 pixel.
                let moved = || -> f64 {
                    let width = SIZE_PX[0] as usize;
                    let beside = [i + 1 - 2 * (i % 2), if i < width { i + width } else { i - width }];
                    beside.iter().map(|at| (depths(&expected, *at)[0] - of_plane).abs() / 512.0).sum()
                };
                let tolerance = if shows_ball { tolerance } else { tolerance + moved() };
                worst = worst.max((written - depth).abs() / tolerance);
                assert!((written - depth).abs() <= tolerance, "{name}, pixel {i}: {written} for {depth}");
                if shows_ball {
                    worst_steps =
                        worst_steps.max((written - depth).abs() / step_of(style.depth_format, depth));
                    let albedo = expected.picture.pixels[i].albedo;
                    let off = (0..3).map(|i| (f64::from(color[i]) - albedo[i]).abs()).fold(0.0, f64::max);
                    assert!(off < 1e-3, "{name}: {color:?} for {albedo:?}");
                }
            }
            println!(
                "{name}, {rasterizer:?}: {of_ball} pixels of the ball, {ties} ties, {exempt} exempt, depth within {worst:.2} of the tolerance, {worst_steps:.2} steps"
            );
            assert!(of_ball > 1000 && ties <= 20 && 100 * exempt <= of_ball, "{name}");
        }
        drop(prepared);
        beside.end();
    }
}

/// Whatever edges are, and with several samples of a pixel: inside nothing changes, and what covers less than half of a pixel leaves the
/// engine's depth as it was.
#[test]
fn edges_blend_with_the_engines_picture_and_leave_its_depth() {
    let mut ball = scenes::sphere(3000, DVec3::ZERO);
    ball.splats.colors = Colors::Uniform([0.0, 0.0, BLUE, 1.0]);
    let scene = Scene { objects: vec![ball], ..Scene::default() };
    let view_from_world = look_at_mat4(DVec3::new(0.4, 0.9, 4.0), DVec3::ZERO, DVec3::Y);
    let clip_from_view = directx::perspective_infinite_reverse(0.7, 160.0 / 120.0, 0.5);
    let camera = HostCamera { view_from_world, clip_from_view, flips_y: true };
    // Behind the ball.
    let behind = CORNERS.map(|corner| corner - DVec3::new(0.0, 3.0, 9.0));
    let settings = Settings { size_px: SIZE_PX, shading: Shading::Albedo, ..Settings::default() };
    let mut beside = Beside::new(REVERSED);
    let prepared = beside.upload(&scene);
    let scenes = [Placed::at_home(&prepared)];
    beside.draw(&scenes, &camera, &settings, &behind, false);
    let (soft, depths) = (beside.engine.pixels(), beside.engine.depths());
    beside.draw(&[], &camera, &settings, &behind, false);
    let (nothing, before) = (beside.engine.pixels(), beside.engine.depths());
    assert!(nothing.iter().all(|color| *color == RED));
    let mut partly = [0, 0];
    for i in 0..soft.len() {
        // Red goes, blue comes.
        let share = f64::from(soft[i][2]) / f64::from(BLUE);
        if share > 0.02 && share < 0.98 {
            let covers = share >= 0.5;
            partly[usize::from(covers)] += 1;
            if (share - 0.5).abs() > 0.01 {
                assert_eq!(depths[i] != before[i], covers, "pixel {i} of {share}");
            }
            assert!((soft[i][3] - 1.0).abs() < 1e-5);
        }
    }
    println!("{partly:?} pixels are covered by less than half, and by more");
    assert!(partly.iter().all(|count| *count > 30));
    drop(prepared);
    beside.end();

    let mut several = Beside::new(Style { samples: vk::SampleCountFlags::TYPE_4, ..REVERSED });
    let prepared = several.upload(&scene);
    several.draw(&[Placed::at_home(&prepared)], &camera, &settings, &behind, false);
    assert!(
        several.engine.pixels() == soft,
        "the triangle covers all samples, and the ball does as in a picture of one"
    );
    drop(prepared);
    several.end();
}
