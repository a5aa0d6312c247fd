//! What recording a frame costs the processor.

use std::time::Instant;

use glam::{
    DVec3,
    dcamera::rh::{proj::directx, view::look_at_mat4},
};
use surfel::{
    Settings,
    embed::{HostCamera, Placed, Placement, Rendering, View, ViewFrame},
    graph::execute::Profile,
    scene::{ClipBox, ClipPlanes, Colors, Layers, Rasterizer, Scene},
};

use super::{Beside, COLOR_FORMAT, OBJECT_FORMATS, REVERSED, engine::Style};
use crate::{common::scenes, memory::ALLOCATIONS};

const FRAMES: usize = 60;

/// Frames after which nothing is made any more.
const SETTLED: usize = 20;

/// Of settled frames.
struct Cost {
    /// Microseconds, median and largest.
    us: [f64; 2],
    /// The median where a frame is recorded once more with nothing drawn meanwhile: by a processor's device caches are cold otherwise.
    again_us: f64,
    /// The most that one took from the heap.
    allocations: usize,
}

fn cost(
    beside: &mut Beside,
    scenes: &[Placed<'_>],
    settings: &Settings,
    moves: bool,
    profile: Option<Profile>,
) -> Cost {
    let (mut times, mut times_again) = (Vec::new(), Vec::new());
    let mut allocations = 0;
    for number in 0..FRAMES {
        let turn = if moves { 0.01 * number as f64 } else { 0.0 };
        let camera = HostCamera {
            view_from_world: look_at_mat4(DVec3::new(0.4 + turn, 0.9, 6.0), DVec3::ZERO, DVec3::Y),
            clip_from_view: directx::perspective_infinite_reverse(0.7, 160.0 / 120.0, 0.5),
            flips_y: true,
        };
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
                let Cost { allocations, .. } = cost(&mut beside, &placed, &settings, moves, None);
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

/// Nor do frames that a box cuts, or that are timed. Planes are a list of their own wherever settings are kept: of the view, of what is opaque, of what is not.
#[test]
fn frames_that_are_cut_or_timed_take_nothing_from_the_heap_but_for_lists_of_planes() {
    let of = |cut: &str, rasterizer, profile| {
        let mut beside = Beside::new(Style { validates: false, ..REVERSED });
        let ball = Scene { objects: vec![scenes::sphere(20_000, DVec3::ZERO)], ..Scene::default() };
        let ball = beside.upload(&ball);
        let settings = Settings { size_px: [160, 120], rasterizer, ..Settings::default() };
        let settings = match cut {
            "box" => Settings { clip_box: ClipBox(Some([[-0.5; 3], [2.0; 3]])), ..settings },
            "plane" => Settings { clip_planes: ClipPlanes(vec![[1.0, 0.5, 0.3, 0.1]]), ..settings },
            _ => settings,
        };
        let Cost { allocations, .. } =
            cost(&mut beside, &[Placed::at_home(&ball)], &settings, false, profile);
        drop(ball);
        beside.end();
        allocations
    };
    let mut found = Vec::new();
    for rasterizer in [Rasterizer::Compute, Rasterizer::Perspective] {
        for (cut, profile) in
            [("box", None), ("plane", None), ("", Some(Profile::Times)), ("", Some(Profile::Counts))]
        {
            found.push((cut, of(cut, rasterizer, profile)));
        }
    }
    let expected = |cut: &str| if cut == "plane" { 3 } else { 0 };
    assert!(found.iter().all(|(cut, allocations)| *allocations == expected(cut)), "{found:?}");
}

/// Without a layer: `cargo test --release --test gpu recording_costs -- --ignored --nocapture`.
#[test]
#[ignore = "a measurement"]
fn recording_costs_so_much() {
    println!("| rasterizer | scenes | splats each | camera | median us | most us | again us | allocations |");
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
                let Cost { us: [median, most], again_us, allocations } =
                    cost(&mut beside, &placed, &settings, moves, None);
                let camera = if moves { "moves" } else { "still" };
                println!(
                    "| {} | {scene_count} | {splats} | {camera} | {median:.0} | {most:.0} | {again_us:.0} | {allocations} |",
                    rasterizer.name()
                );
                if scene_count == 1 && !moves {
                    of_one.push(median);
                }
            }
            drop(ball);
            beside.end();
        }
        println!("one scene of 1000 and of a million splats: {:.0} and {:.0} us", of_one[0], of_one[2]);
    }
}

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
