//! What recording costs where nothing is drawn meanwhile: all of it is ours, and no cache is cold.

use std::time::Instant;

use glam::DVec3;
use surfel::{
    Settings,
    embed::{Device, Import, Placed, Renderer, Rendering, View, ViewFrame},
    scene::{Object, Rasterizer, Scene},
};

use super::{
    super::{Beside, COLOR_FORMAT, REVERSED, engine::Style},
    camera, unrecorded,
};
use crate::common::scenes;

/// Without a layer: `cargo test --release --test gpu recording_alone -- --ignored --nocapture`.
#[test]
#[ignore = "a measurement"]
fn recording_alone_costs_so_much() {
    const FRAMES: usize = 400;
    println!("| ball | splats | image | camera | median us | least us |");
    let beside = Beside::new(Style { validates: false, ..REVERSED });
    let engine = &beside.engine;
    let unrecorded = unrecorded::device(&engine.instance, &engine.device);
    let import = Import { device: &unrecorded, debug_utils: false, ..engine.lent() };
    // SAFETY: all is the engine's own, which goes last.
    let device = unsafe { Device::import(&import) }.unwrap();
    let renderer = Renderer::new(&device, None).unwrap();
    let of = |kind: &str, splats: usize, size_px: [u32; 2]| {
        let settings = Settings { size_px, rasterizer: Rasterizer::Compute, ..Settings::default() };
        let ball = Object { closed: kind != "open", ..scenes::sphere(splats, DVec3::ZERO) };
        let levels = kind == "in levels of detail";
        let scene = Scene { objects: vec![ball], levels, ..Scene::default() };
        engine.begin();
        // SAFETY: recording; the copies are never submitted.
        let unseen = unsafe { renderer.upload(engine.commands, &scene) }.unwrap();
        let placed = [Placed::at_home(&unseen)];
        let rendering = Rendering { color_formats: vec![COLOR_FORMAT], ..Rendering::default() };
        let mut view = View::new(&renderer, &rendering).unwrap();
        for moves in [false, true] {
            let mut times = Vec::new();
            for number in 0..FRAMES {
                let camera = camera(if moves { 0.002 * number as f64 } else { 0.0 });
                engine.begin();
                let begin = Instant::now();
                // SAFETY: recording; nothing is submitted.
                unsafe {
                    view.prepare(&renderer, engine.commands, &ViewFrame::new(&placed, &camera, &settings))
                }
                .unwrap();
                times.push(1e6 * begin.elapsed().as_secs_f64());
            }
            let mut steady = times.split_off(FRAMES / 4);
            steady.sort_by(f64::total_cmp);
            let camera = if moves { "moves" } else { "still" };
            let [width, height] = size_px;
            println!(
                "| {kind} | {splats} | {width}x{height} | {camera} | {:.0} | {:.0} |",
                steady[steady.len() / 2],
                steady[0]
            );
        }
    };
    for size_px in [[160, 120], [1024, 768]] {
        for kind in ["closed", "open", "in levels of detail"] {
            for splats in [1000, 30_000, 100_000, 400_000, 1_000_000] {
                of(kind, splats, size_px);
            }
        }
    }
    drop(renderer);
    // SAFETY: nothing was submitted.
    unsafe { device.epoch_done(device.end_epoch()) };
    // The engine's device goes last.
    drop(device);
    beside.end();
}
