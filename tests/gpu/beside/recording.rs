//! What recording a frame costs the processor.

use std::time::Instant;

use glam::{
    DVec3,
    dcamera::rh::{proj::directx, view::look_at_mat4},
};
use surfel::{
    Settings,
    embed::{HostCamera, Placed, Placement, ViewFrame},
    scene::{Colors, Layers, Rasterizer, Scene},
};

use super::{Beside, REVERSED, engine::Style};
use crate::{common::scenes, memory::ALLOCATIONS};

const FRAMES: usize = 60;

/// Frames after which nothing is made any more.
const SETTLED: usize = 20;

/// Microseconds of settled frames, median and largest, and the most that one of them took from the heap, in allocations.
fn cost(beside: &mut Beside, scenes: &[Placed<'_>], settings: &Settings, moves: bool) -> (f64, f64, usize) {
    let mut times = Vec::new();
    let mut allocations = 0;
    for number in 0..FRAMES {
        let turn = if moves { 0.01 * number as f64 } else { 0.0 };
        let camera = HostCamera {
            view_from_world: look_at_mat4(DVec3::new(0.4 + turn, 0.9, 6.0), DVec3::ZERO, DVec3::Y),
            clip_from_view: directx::perspective_infinite_reverse(0.7, 160.0 / 120.0, 0.5),
            flips_y: true,
        };
        let frame = ViewFrame { hides: Some(beside.hides()), ..ViewFrame::new(scenes, &camera, settings) };
        let Beside { engine, view, renderer, .. } = &mut *beside;
        engine.begin();
        engine.begin_rendering(true);
        engine.end_rendering();
        let (begin, before) = (Instant::now(), ALLOCATIONS.get());
        // SAFETY: recording; all is alive until the wait.
        unsafe { view.prepare(renderer, engine.commands, &frame) }.unwrap();
        let (secs, taken) = (begin.elapsed().as_secs_f64(), ALLOCATIONS.get() - before);
        times.push(1e6 * secs);
        if number >= SETTLED {
            allocations = allocations.max(taken);
        }
        engine.begin_rendering(false);
        // SAFETY: inside of the rendering that the view was made for.
        unsafe { view.draw(renderer, engine.commands) }.unwrap();
        engine.end_rendering();
        beside.submit();
    }
    let mut steady = times.split_off(SETTLED);
    steady.sort_by(f64::total_cmp);
    (steady[steady.len() / 2], steady[steady.len() - 1], allocations)
}

/// Once pipelines and lists are made, a frame takes what it needs from memory that is kept: whatever it is drawn by, and while the camera moves.
#[test]
fn a_frame_like_those_before_takes_nothing_from_the_heap() {
    let mut wrong = Vec::new();
    for rasterizer in [Rasterizer::Compute, Rasterizer::Perspective, Rasterizer::Quad] {
        for alpha in [1.0, 0.5] {
            let mut beside = Beside::new(Style { validates: false, ..REVERSED });
            let mut ball = scenes::sphere(20_000, DVec3::ZERO);
            ball.splats.colors = Colors::Uniform([0.5, 0.6, 0.7, alpha]);
            let ball = beside.upload(&Scene { objects: vec![ball], ..Scene::default() });
            let settings =
                Settings { size_px: [160, 120], rasterizer, layers: Layers::Fixed(2), ..Settings::default() };
            let translation = DVec3::new(0.1, 0.3, -0.2);
            let at = Placement { translation, ..Placement::default() };
            let placed = [Placed::at_home(&ball), Placed::new(&ball, at)];
            for moves in [false, true] {
                let (.., allocations) = cost(&mut beside, &placed, &settings, moves);
                if allocations > 0 {
                    wrong.push(format!(
                        "{rasterizer:?}, alpha {alpha}, moves {moves}: {allocations} allocations"
                    ));
                }
            }
            drop(ball);
            beside.end();
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

/// Without a layer: `cargo test --release --test gpu recording_costs -- --ignored --nocapture`.
#[test]
#[ignore = "a measurement"]
fn recording_costs_so_much() {
    println!("| rasterizer | scenes | splats each | camera | median us | most us | allocations |");
    for rasterizer in [Rasterizer::Compute, Rasterizer::Perspective] {
        let settings = Settings { size_px: [160, 120], rasterizer, ..Settings::default() };
        let mut of_one = Vec::new();
        for (scene_count, splats) in [(1, 1000), (1, 100_000), (1, 1_000_000), (8, 1000), (64, 1000)] {
            let mut beside = Beside::new(Style { validates: false, ..REVERSED });
            let ball = Scene { objects: vec![scenes::sphere(splats, DVec3::ZERO)], ..Scene::default() };
            let ball = beside.upload(&ball);
            let placed: Vec<_> = (0..scene_count)
                .map(|i| {
                    let translation = 0.02 * f64::from(i) * DVec3::new(1.0, 0.3, -0.2);
                    Placed::new(&ball, Placement { translation, ..Placement::default() })
                })
                .collect();
            for moves in [false, true] {
                let (median, most, allocations) = cost(&mut beside, &placed, &settings, moves);
                let camera = if moves { "moves" } else { "still" };
                println!(
                    "| {} | {scene_count} | {splats} | {camera} | {median:.0} | {most:.0} | {allocations} |",
                    rasterizer.name()
                );
                if scene_count == 1 && !moves {
                    of_one.push(median);
                }
            }
            drop(ball);
            beside.end();
        }
        // Blocks of splats are looked at one by one: 4000 of a million.
        println!("one scene of 1000 and of a million splats: {:.0} and {:.0} us", of_one[0], of_one[2]);
    }
}
