//! Several views of one scene in one frame, each with its own projection: two eyes, and a light that looks along parallel rays as for a shadow map.

use glam::{
    DVec3,
    dcamera::rh::{
        proj::directx::{frustum, orthographic},
        view::look_at_mat4,
    },
};
use surfel::{
    Settings,
    embed::{HostCamera, Placed, Rendering, View, ViewFrame},
    scene::{Edges, Rasterizer, Scene},
};

use super::{Beside, COLOR_FORMAT, REVERSED, SIZE_PX};
use crate::common::scenes;

/// Of one view: four fit into the engine's picture.
const EACH_PX: [u32; 2] = [SIZE_PX[0] / 2, SIZE_PX[1] / 2];
const CORNERS_PX: [[u32; 2]; 3] = [[0, 0], [EACH_PX[0], 0], [0, EACH_PX[1]]];

/// Reversed depth, as the engine has it.
fn reversed(clip_from_view: glam::DMat4) -> glam::DMat4 {
    let [x, y, w] = [glam::DVec4::X, glam::DVec4::Y, glam::DVec4::new(0.0, 0.0, 1.0, 1.0)];
    glam::DMat4::from_cols(x, y, glam::DVec4::new(0.0, 0.0, -1.0, 0.0), w) * clip_from_view
}

fn cameras() -> [HostCamera; 3] {
    let eye = |x: f64| {
        let shift = 0.02 * x;
        HostCamera {
            view_from_world: look_at_mat4(DVec3::new(x, 0.5, 4.0), DVec3::new(x, 0.0, 0.0), DVec3::Y),
            clip_from_view: reversed(frustum(-0.16 - shift, 0.16 - shift, -0.12, 0.12, 0.5, 50.0)),
            flips_y: true,
        }
    };
    let light = HostCamera {
        view_from_world: look_at_mat4(DVec3::new(2.0, 3.0, 2.0), DVec3::ZERO, DVec3::Y),
        clip_from_view: reversed(orthographic(-1.6, 1.6, -1.2, 1.2, 0.5, 50.0)),
        flips_y: true,
    };
    [eye(-0.15), eye(0.15), light]
}

#[test]
fn views_of_one_frame_are_each_what_they_are_alone() {
    for rasterizer in [Rasterizer::Compute, Rasterizer::Perspective] {
        let mut beside = Beside::new(REVERSED);
        let ball =
            beside.upload(&Scene { objects: vec![scenes::sphere(3000, DVec3::ZERO)], ..Scene::default() });
        let rendering = Rendering { color_formats: vec![COLOR_FORMAT], ..Rendering::default() };
        let mut views = [(); 3].map(|()| View::new(&beside.renderer, &rendering).unwrap());
        let settings = Settings { size_px: EACH_PX, rasterizer, edges: Edges::Hard, ..Settings::default() };
        let scenes = [Placed::at_home(&ball)];
        let mut drawn = |shown: &[usize]| {
            let Beside { engine, renderer, .. } = &mut beside;
            engine.begin();
            for number in shown {
                let camera = &cameras()[*number];
                let corner_px = CORNERS_PX[*number].map(|side| side as i32);
                let frame = ViewFrame { corner_px, ..ViewFrame::new(&scenes, camera, &settings) };
                // SAFETY: recording; all is alive until the wait.
                unsafe { views[*number].prepare(renderer, engine.commands, &frame) }.unwrap();
            }
            engine.begin_rendering(true);
            for number in shown {
                // SAFETY: inside of the rendering that the view was made for.
                unsafe { views[*number].draw(renderer, engine.commands) }.unwrap();
            }
            engine.end_rendering();
            beside.submit();
            let of_each: Vec<_> = beside.engine.pixels().into_iter().zip(beside.engine.depths()).collect();
            of_each
        };
        let part = |all: &[([f32; 4], f64)], [x, y]: [u32; 2]| -> Vec<_> {
            let rows = all.chunks(SIZE_PX[0] as usize).skip(y as usize).take(EACH_PX[1] as usize);
            rows.flat_map(|row| &row[x as usize..][..EACH_PX[0] as usize]).copied().collect()
        };
        let together = drawn(&[0, 1, 2]);
        let nothing = drawn(&[]);
        let mut parts = Vec::new();
        for (number, corner) in CORNERS_PX.into_iter().enumerate() {
            let alone = drawn(&[number]);
            assert!(part(&alone, corner) == part(&together, corner), "{rasterizer:?}, view {number}");
            let elsewhere = CORNERS_PX.into_iter().filter(|other| *other != corner);
            for other in elsewhere {
                assert!(part(&alone, other) == part(&nothing, other), "{rasterizer:?}, view {number}");
            }
            let covered = part(&alone, corner).iter().filter(|(_, depth)| *depth > 0.0).count();
            assert!(covered > 500, "{rasterizer:?}, view {number}: {covered} pixels have a depth");
            parts.push(part(&alone, corner));
        }
        assert!(parts[0] != parts[1] && parts[1] != parts[2], "each has its own camera");
        drop((views, ball));
        beside.end();
    }
}
