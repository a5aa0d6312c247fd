//! What recording costs where nothing is drawn meanwhile: all of it is ours. And the same where all caches are emptied before each time, as a device that is a processor
//! empties them: what that takes is no more of many splats than of few, but for the bounds that are looked at.

use std::time::Instant;

use glam::DVec3;
use surfel::{
    Settings,
    embed::{Device, Import, Placed, Placement, Renderer, Rendering, View, ViewFrame},
    scene::{Object, Rasterizer, Scene, TileMemory},
};

use super::{
    super::{Beside, COLOR_FORMAT, REVERSED, engine::Style},
    camera, unrecorded,
};
use crate::common::scenes;

/// More than any cache holds, and than a processor keeps tables of pages of.
const EMPTYING_BYTES: usize = 128 << 20;

/// Frames of which caches are emptied before each.
const COLD_FRAMES: usize = 80;

/// Of 64 bytes.
const LINE_WORDS: usize = 8;

/// Open ones of which all lists have the memory that they want, so that frames are in one band.
const WITH_ROOM: &str = "open, lists have room";

fn sorted(times: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut times: Vec<_> = times.collect();
    times.sort_by(f64::total_cmp);
    times
}

/// What is recorded.
struct Row {
    kind: &'static str,
    objects: u32,
    splats: usize,
    size_px: [u32; 2],
    rasterizer: Rasterizer,
}

/// Of one object the larger the more, without a layer: `cargo test --release --test gpu recording_alone -- --ignored --nocapture`.
#[test]
#[ignore = "a measurement"]
fn recording_alone_costs_so_much() {
    let (mut rows, rasterizer) = (Vec::new(), Rasterizer::Compute);
    for size_px in [[160, 120], [1024, 768]] {
        for kind in ["closed", "open", "in levels of detail"] {
            let counts = [1000, 30_000, 100_000, 400_000, 1_000_000];
            rows.extend(counts.map(|splats| Row { kind, objects: 1, splats, size_px, rasterizer }));
        }
    }
    record(rows);
}

/// Of some objects, small and large: `cargo test --release --test gpu objects_alone -- --ignored --nocapture`.
#[test]
#[ignore = "a measurement"]
fn objects_alone_cost_so_much() {
    let mut rows = Vec::new();
    for rasterizer in [Rasterizer::Compute, Rasterizer::Perspective] {
        for kind in ["closed", "open", WITH_ROOM] {
            let row = |(objects, splats)| Row { kind, objects, splats, size_px: [160, 120], rasterizer };
            let some = [(1, 1000), (8, 1000), (64, 1000), (64, 10_000), (64, 30_000), (64, 100_000)];
            rows.extend(some.map(row));
        }
    }
    record(rows);
}

fn record(rows: Vec<Row>) {
    const FRAMES: usize = 400;
    println!(
        "| balls | objects | splats each | image | by | camera | median us | least us | median us, caches emptied |"
    );
    let beside = Beside::new(Style { validates: false, ..REVERSED });
    let engine = &beside.engine;
    let unrecorded = unrecorded::device(&engine.instance, &engine.device);
    let import = Import { device: &unrecorded, debug_utils: false, ..engine.lent() };
    // SAFETY: all is the engine's own, which goes last.
    let device = unsafe { Device::import(&import) }.unwrap();
    let renderer = Renderer::new(&device, None).unwrap();
    let mut lines = vec![1_u64; EMPTYING_BYTES / size_of::<u64>()];
    for Row { kind, objects, splats, size_px, rasterizer } in rows {
        let tile_memory = if kind == WITH_ROOM { TileMemory::Most(1 << 40) } else { TileMemory::Auto };
        let settings = Settings { size_px, rasterizer, tile_memory, ..Settings::default() };
        let is_open = ["open", WITH_ROOM].contains(&kind);
        let ball = Object { closed: !is_open, ..scenes::sphere(splats, DVec3::ZERO) };
        let levels = kind == "in levels of detail";
        let scene = Scene { objects: vec![ball], levels, ..Scene::default() };
        engine.begin();
        // SAFETY: recording; the copies are never submitted.
        let unseen = unsafe { renderer.upload(engine.commands, &scene) }.unwrap();
        let placed: Vec<_> = (0..objects)
            .map(|i| {
                let translation = 0.02 * f64::from(i) * DVec3::new(1.0, 0.3, -0.2);
                Placed::new(&unseen, Placement { translation, ..Placement::default() })
            })
            .collect();
        let rendering = Rendering { color_formats: vec![COLOR_FORMAT], ..Rendering::default() };
        let mut view = View::new(&renderer, &rendering).unwrap();
        for moves in [false, true] {
            let mut record = |number: usize| {
                let camera = camera(if moves { 0.002 * number as f64 } else { 0.0 });
                engine.begin();
                let begin = Instant::now();
                // SAFETY: recording; nothing is submitted.
                unsafe {
                    view.prepare(&renderer, engine.commands, &ViewFrame::new(&placed, &camera, &settings))
                }
                .unwrap();
                let us = 1e6 * begin.elapsed().as_secs_f64();
                // SAFETY: what is never submitted never runs.
                unsafe { device.epoch_done(device.end_epoch()) };
                us
            };
            let steady = sorted((0..FRAMES).map(&mut record).skip(FRAMES / 4));
            let cold = sorted((0..COLD_FRAMES).map(|number| {
                lines.iter_mut().step_by(LINE_WORDS).for_each(|word| *word = word.wrapping_add(1));
                std::hint::black_box(&mut lines);
                record(number)
            }));
            let camera = if moves { "moves" } else { "still" };
            let [width, height] = size_px;
            println!(
                "| {kind} | {objects} | {splats} | {width}x{height} | {} | {camera} | {:.1} | {:.1} | {:.0} |",
                rasterizer.name(),
                steady[steady.len() / 2],
                steady[0],
                cold[cold.len() / 2]
            );
        }
    }
    drop(renderer);
    // SAFETY: nothing was submitted.
    unsafe { device.epoch_done(device.end_epoch()) };
    // The engine's device goes last.
    drop(device);
    beside.end();
}
