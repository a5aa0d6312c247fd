//! What it costs to tell whose a pixel is, and how it has moved.

use std::time::Instant;

use glam::{
    DVec3,
    dcamera::rh::{proj::directx, view::look_at_mat4},
};
use surfel::{
    Settings,
    embed::{HostCamera, Placed, Placement, Rendering, View, ViewFrame},
    scene::{Rasterizer, Scene},
};

use super::super::{Beside, COLOR_FORMAT, OBJECT_FORMATS, engine::Style};
use crate::common::scenes;

/// Without a layer: `cargo test --release --test gpu objects_cost -- --ignored --nocapture`. Views of one picture take turns, so that nothing but what they ask for differs.
#[test]
#[ignore = "a measurement"]
fn objects_cost_so_much() {
    const SIDE_PX: u32 = 1024;
    const ROUNDS: usize = 15;
    let style = Style { validates: false, tells_objects: true, ..Style::reversed([SIDE_PX; 2]) };
    println!("| rasterizer | splats | asked for | median ms of a frame | ratio, quartiles |");
    for rasterizer in [Rasterizer::Compute, Rasterizer::Perspective] {
        for splats in [20_000, 200_000] {
            let beside = Beside::new(style);
            let ball = beside
                .upload(&Scene { objects: vec![scenes::sphere(splats, DVec3::ZERO)], ..Scene::default() });
            let color_formats: Vec<_> = [COLOR_FORMAT].into_iter().chain(OBJECT_FORMATS).collect();
            let mut views = [(false, false), (true, false), (true, true)].map(|(ids, motion)| {
                let rendering =
                    Rendering { color_formats: color_formats.clone(), ids, motion, ..Rendering::default() };
                View::new(&beside.renderer, &rendering).unwrap()
            });
            let settings = Settings { size_px: [SIDE_PX; 2], rasterizer, ..Settings::default() };
            let camera = HostCamera {
                view_from_world: look_at_mat4(DVec3::new(0.4, 0.9, 3.0), DVec3::ZERO, DVec3::Y),
                clip_from_view: directx::perspective_infinite_reverse(0.8, 1.0, 0.5),
                flips_y: true,
            };
            let scenes = [Placed { id: 17, before: Some(Placement::default()), ..Placed::at_home(&ball) }];
            let mut times = [const { Vec::new() }; 3];
            for round in 0..ROUNDS + 3 {
                for (view, times) in views.iter_mut().zip(&mut times) {
                    let frame = ViewFrame::new(&scenes, &camera, &settings);
                    let Beside { engine, renderer, .. } = &beside;
                    engine.begin();
                    // SAFETY: recording; all is alive until the wait.
                    unsafe { view.prepare(renderer, engine.commands, &frame) }.unwrap();
                    engine.begin_rendering(true);
                    // SAFETY: inside of the rendering that the view was made for.
                    unsafe { view.draw(renderer, engine.commands) }.unwrap();
                    engine.end_rendering();
                    let begin = Instant::now();
                    beside.submit();
                    if round >= 3 {
                        times.push(1e3 * begin.elapsed().as_secs_f64());
                    }
                }
            }
            for (asked, of) in ["neither", "numbers", "numbers and motion"].into_iter().zip(&times) {
                let sorted = |mut all: Vec<f64>| {
                    all.sort_by(f64::total_cmp);
                    all
                };
                let ratios = sorted(of.iter().zip(&times[0]).map(|(of, plain)| of / plain).collect());
                let [low, middle, high] = [ROUNDS / 4, ROUNDS / 2, 3 * ROUNDS / 4].map(|at| ratios[at]);
                let median = sorted(of.clone())[ROUNDS / 2];
                println!(
                    "| {} | {splats} | {asked} | {median:.1} | {middle:.2} ({low:.2} to {high:.2}) |",
                    rasterizer.name()
                );
            }
            drop((views, ball));
            beside.end();
        }
    }
}
