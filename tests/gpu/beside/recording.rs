//! What recording a frame costs the processor.

mod alone;
mod kinds;
mod objects_cost;
mod unrecorded;

use std::time::Instant;

use glam::{
    DVec3,
    dcamera::rh::{proj::directx, view::look_at_mat4},
};
use surfel::{
    Settings,
    embed::{Device, HostCamera, Import, Placed, Placement, Renderer, Rendering, View, ViewFrame},
    graph::execute::Profile,
    scene::{Budget, ClipBox, ClipPlanes, Colors, Layers, Rasterizer, Scene, TileMemory},
};

use super::{Beside, COLOR_FORMAT, REVERSED, engine::Style};
use crate::{common::scenes, memory::ALLOCATIONS};

const FRAMES: usize = 60;

/// Enough for a dozen blocks and more.
const SPLATS: usize = 5000;

/// Frames after which nothing is made any more.
const SETTLED: usize = 20;

/// Enough to see whether settled frames take anything from the heap.
const FEW_FRAMES: usize = SETTLED + 16;

/// Of settled frames.
struct Cost {
    /// Microseconds, median and largest.
    us: [f64; 2],
    /// The median where a frame is recorded once more with nothing drawn meanwhile: by a processor's device caches are cold otherwise.
    again_us: f64,
    /// The most that one took from the heap.
    allocations: usize,
}

/// The median of what is ours of it, in the same place of a frame: by the same device, but that it records nothing. Names and labels are the driver's, too.
fn ours_us(beside: &mut Beside, (scene, places): (&Scene, &[Placement]), settings: &Settings) -> f64 {
    let engine = &beside.engine;
    let unrecorded = unrecorded::device(&engine.instance, &engine.device);
    let import = Import { device: &unrecorded, debug_utils: false, ..engine.lent() };
    // SAFETY: all is the engine's own, which goes last.
    let device = unsafe { Device::import(&import) }.unwrap();
    let renderer = Renderer::new(&device, None).unwrap();
    let rendering = Rendering { color_formats: vec![COLOR_FORMAT], ..Rendering::default() };
    let mut view = View::new(&renderer, &rendering).unwrap();
    let drawn = beside.upload(scene);
    beside.engine.begin();
    // SAFETY: recording; the copies are never submitted.
    let unseen = unsafe { renderer.upload(beside.engine.commands, scene) }.unwrap();
    let camera = camera(0.0);
    let [drawn, not_drawn] =
        [&drawn, &unseen].map(|scene| places.iter().map(|at| Placed::new(scene, *at)).collect::<Vec<_>>());
    let mut times = Vec::new();
    for _ in 0..FRAMES {
        let Beside { engine, view: of_engine, renderer: of_engine_too, .. } = &mut *beside;
        engine.begin();
        engine.begin_rendering(true);
        engine.end_rendering();
        let begin = Instant::now();
        // SAFETY: recording; all is alive until the wait, here and below.
        unsafe { view.prepare(&renderer, engine.commands, &ViewFrame::new(&not_drawn, &camera, settings)) }
            .unwrap();
        times.push(1e6 * begin.elapsed().as_secs_f64());
        // SAFETY: what is never submitted never runs.
        unsafe { device.epoch_done(device.end_epoch()) };
        let frame = ViewFrame::new(&drawn, &camera, settings);
        // SAFETY: as above.
        unsafe { of_engine.prepare(of_engine_too, engine.commands, &frame) }.unwrap();
        engine.begin_rendering(false);
        // SAFETY: inside of the rendering that the view was made for.
        unsafe { of_engine.draw(of_engine_too, engine.commands) }.unwrap();
        engine.end_rendering();
        beside.submit();
    }
    drop((drawn, not_drawn));
    drop((view, unseen, renderer));
    // SAFETY: nothing was submitted.
    unsafe { device.epoch_done(device.end_epoch()) };
    let mut steady = times.split_off(SETTLED);
    steady.sort_by(f64::total_cmp);
    steady[steady.len() / 2]
}

fn camera(turn: f64) -> HostCamera {
    HostCamera {
        view_from_world: look_at_mat4(DVec3::new(0.4 + turn, 0.9, 6.0), DVec3::ZERO, DVec3::Y),
        clip_from_view: directx::perspective_infinite_reverse(0.7, 160.0 / 120.0, 0.5),
        flips_y: true,
    }
}

fn cost(
    beside: &mut Beside,
    scenes: &[Placed<'_>],
    settings: &Settings,
    (moves, frames): (bool, usize),
    profile: Option<Profile>,
) -> Cost {
    let (mut times, mut times_again) = (Vec::new(), Vec::new());
    let mut allocations = 0;
    for number in 0..frames {
        let turn = if moves { 0.01 * number as f64 } else { 0.0 };
        let camera = camera(turn);
        let hides = Some(beside.hides());
        let frame = ViewFrame { hides, profile, ..ViewFrame::new(scenes, &camera, settings) };
        let Beside { engine, view, renderer, .. } = &mut *beside;
        for times in [&mut times, &mut times_again] {
            engine.begin();
            engine.begin_rendering(true);
            engine.end_rendering();
            let (begin, before) = (Instant::now(), ALLOCATIONS.get());
            // SAFETY: recording; all is alive until the wait. What was recorded first is never submitted.
            unsafe { view.prepare(renderer, engine.commands, &frame) }.unwrap();
            let (secs, taken) = (begin.elapsed().as_secs_f64(), ALLOCATIONS.get() - before);
            times.push(1e6 * secs);
            if number >= SETTLED {
                allocations = allocations.max(taken);
            }
        }
        engine.begin_rendering(false);
        // SAFETY: inside of the rendering that the view was made for.
        unsafe { view.draw(renderer, engine.commands) }.unwrap();
        engine.end_rendering();
        beside.submit();
    }
    let [steady, again] = [times, times_again].map(|mut times| {
        let mut steady = times.split_off(SETTLED);
        steady.sort_by(f64::total_cmp);
        steady
    });
    let (middle, last) = (steady.len() / 2, steady.len() - 1);
    Cost { us: [steady[middle], steady[last]], again_us: again[middle], allocations }
}

/// Once pipelines and lists are made, a frame takes what it needs from memory that is kept: whatever it is drawn by, and while the camera moves.
#[test]
fn a_frame_like_those_before_takes_nothing_from_the_heap() {
    let mut wrong = Vec::new();
    let mut beside = Beside::new(Style { validates: false, ..REVERSED });
    for rasterizer in [Rasterizer::Compute, Rasterizer::Perspective, Rasterizer::Quad] {
        for alpha in [1.0, 0.5] {
            let mut ball = scenes::sphere(SPLATS, DVec3::ZERO);
            ball.splats.colors = Colors::Uniform([0.5, 0.6, 0.7, alpha]);
            let ball = beside.upload(&Scene { objects: vec![ball], ..Scene::default() });
            let settings =
                Settings { size_px: [160, 120], rasterizer, layers: Layers::Fixed(2), ..Settings::default() };
            let translation = DVec3::new(0.1, 0.3, -0.2);
            let at = Placement { translation, ..Placement::default() };
            let placed = [Placed::at_home(&ball), Placed::new(&ball, at)];
            for moves in [false, true] {
                let Cost { allocations, .. } =
                    cost(&mut beside, &placed, &settings, (moves, FEW_FRAMES), None);
                if allocations > 0 {
                    wrong.push(format!(
                        "{rasterizer:?}, alpha {alpha}, moves {moves}: {allocations} allocations"
                    ));
                }
            }
        }
    }
    beside.end();
    assert!(wrong.is_empty(), "{wrong:#?}");
}

/// Nor do frames that planes cut, that are timed, or that have a budget.
#[test]
fn frames_that_are_cut_or_timed_or_have_a_budget_take_nothing_from_the_heap() {
    let mut beside = Beside::new(Style { validates: false, ..REVERSED });
    let mut of = |what: &str, rasterizer, profile| {
        let has_budget = what == "budget";
        let ball = Scene {
            objects: vec![scenes::sphere(SPLATS, DVec3::ZERO)],
            levels: has_budget,
            budget: has_budget,
            ..Scene::default()
        };
        let ball = beside.upload(&ball);
        let settings = Settings { size_px: [160, 120], rasterizer, ..Settings::default() };
        let settings = match what {
            "box" => Settings { clip_box: ClipBox(Some([[-0.5; 3], [2.0; 3]])), ..settings },
            "plane" => {
                let planes = [[1.0, 0.5, 0.3, 0.1], [0.2, -0.9, 0.1, -0.8]];
                Settings { clip_planes: ClipPlanes(planes.into()), ..settings }
            }
            "budget" => Settings { budget: Budget::Splats(5000), ..settings },
            _ => settings,
        };
        let placed = [Placed::at_home(&ball)];
        // By a budget other splats are drawn with each move, of which lists have to have room.
        let moves = if has_budget { &[false][..] } else { &[false, true] };
        let taken = moves
            .iter()
            .map(|moves| cost(&mut beside, &placed, &settings, (*moves, FEW_FRAMES), profile).allocations);
        taken.max().unwrap()
    };
    let mut found = Vec::new();
    for rasterizer in [Rasterizer::Compute, Rasterizer::Perspective] {
        let times = [Some(Profile::Times), Some(Profile::Counts)].map(|profile| ("timed", profile));
        let cut = ["box", "plane", "budget"].map(|what| (what, None));
        for (what, profile) in cut.into_iter().chain(times) {
            found.push((what, rasterizer, of(what, rasterizer, profile)));
        }
    }
    beside.end();
    assert!(found.iter().all(|(.., taken)| *taken == 0), "{found:?}");
}

/// Without a layer: `cargo test --release --test gpu recording_costs -- --ignored --nocapture`.
#[test]
#[ignore = "a measurement"]
fn recording_costs_so_much() {
    println!(
        "| rasterizer | scenes | splats each | camera | median us | most us | ours us | again us | allocations |"
    );
    // By tiles also where lists have all the memory that they want; else a million splats are drawn in bands.
    let plenty = TileMemory::Most(1 << 30);
    for (rasterizer, tile_memory) in [
        (Rasterizer::Compute, TileMemory::Auto),
        (Rasterizer::Compute, plenty),
        (Rasterizer::Perspective, TileMemory::Auto),
    ] {
        let settings = Settings { size_px: [160, 120], rasterizer, tile_memory, ..Settings::default() };
        println!("{}, {tile_memory:?}", rasterizer.name());
        let mut of_one = Vec::new();
        for (scene_count, splats) in
            [(1, 1000), (1, 10_000), (1, 100_000), (1, 1_000_000), (8, 1000), (64, 1000)]
        {
            let mut beside = Beside::new(Style { validates: false, ..REVERSED });
            let scene = Scene { objects: vec![scenes::sphere(splats, DVec3::ZERO)], ..Scene::default() };
            let ball = beside.upload(&scene);
            let places: Vec<_> = (0..scene_count)
                .map(|i| {
                    let translation = 0.02 * f64::from(i) * DVec3::new(1.0, 0.3, -0.2);
                    Placement { translation, ..Placement::default() }
                })
                .collect();
            let placed: Vec<_> = places.iter().map(|at| Placed::new(&ball, *at)).collect();
            for moves in [false, true] {
                let Cost { us: [median, most], again_us, allocations } =
                    cost(&mut beside, &placed, &settings, (moves, FRAMES), None);
                let camera = if moves { "moves" } else { "still" };
                let ours = match moves {
                    true => "".to_owned(),
                    false => format!("{:.0}", ours_us(&mut beside, (&scene, &places), &settings)),
                };
                println!(
                    "| {} | {scene_count} | {splats} | {camera} | {median:.0} | {most:.0} | {ours} | {again_us:.0} | {allocations} |",
                    rasterizer.name()
                );
                if scene_count == 1 && !moves {
                    of_one.push(median);
                }
            }
            drop(placed);
            drop(ball);
            beside.end();
        }
        println!("one scene of a thousand splats and of a million: {:.0} and {:.0} us", of_one[0], of_one[3]);
    }
}
