//! Splats that are added to an uploaded scene and taken out of it, against an upload of what is there.

mod balls;

use std::collections::VecDeque;

use balls::{ball, joined, room, scene, some};
use glam::{DAffine3, DVec3, dcamera::rh::view::look_at_mat4};
use surfel::{
    Settings,
    embed::{MissingPipelines, Placed, PreparedScene, Rendering, ViewFrame},
    scene::{Colors, Cull, Edges, Epsilon, Rasterizer, Room, Shading, Splats},
};

use super::{
    Beside, COLOR_FORMAT, REVERSED, SIZE_PX, Style,
    updates::{BEHIND, COUNT, camera},
};
use crate::memory::ALLOCATIONS;

fn settings(rasterizer: Rasterizer) -> Settings {
    Settings {
        size_px: SIZE_PX,
        edges: Edges::Hard,
        epsilon: Epsilon::Length(0.05),
        rasterizer,
        ..Settings::default()
    }
}

/// Records something and submits it by itself.
fn submit(beside: &Beside, record: impl FnOnce(&Beside)) {
    beside.engine.begin();
    record(beside);
    beside.engine.begin_rendering(true);
    beside.engine.end_rendering();
    beside.submit();
}

fn append(beside: &Beside, scene: &mut PreparedScene, splats: &Splats) -> std::ops::Range<u32> {
    let mut numbers = 0..0;
    submit(beside, |Beside { renderer, engine, .. }| {
        // SAFETY: recording; submitted at once, and so below.
        numbers = unsafe { renderer.append(engine.commands, scene, 0, splats) }.unwrap();
    });
    numbers
}

fn update(beside: &Beside, scene: &mut PreparedScene, first: u32, splats: &Splats) {
    submit(beside, |Beside { renderer, engine, .. }| {
        // SAFETY: as above.
        unsafe { renderer.update(engine.commands, scene, 0, first, splats) }.unwrap();
    });
}

fn remove(beside: &Beside, scene: &mut PreparedScene, numbers: std::ops::Range<u32>) {
    submit(beside, |Beside { renderer, engine, .. }| {
        // SAFETY: as above.
        unsafe { renderer.remove(engine.commands, scene, 0, numbers) }.unwrap();
    });
}

fn picture(beside: &mut Beside, scene: &PreparedScene, settings: &Settings) -> (Vec<[f32; 4]>, Vec<f64>) {
    beside.draw(&[Placed::at_home(scene)], &camera(), settings, &BEHIND, scene.is_transparent());
    (beside.engine.pixels(), beside.engine.depths())
}

fn far_off(one: &[f32; 4], other: &[f32; 4]) -> bool {
    (0..4).any(|i| (one[i] - other[i]).abs() > 1.0 / 255.0)
}

/// Of another upload the order along the curve is another, and so are roundings.
fn assert_alike(beside: &mut Beside, [seen, fresh]: [&PreparedScene; 2], how: &[Settings], what: &str) {
    for settings in how {
        let [(seen, _), (expected, _)] = [seen, fresh].map(|scene| picture(beside, scene, settings));
        let others = seen.iter().zip(&expected).filter(|(one, other)| far_off(one, other)).count();
        let there = expected.iter().filter(|color| **color != super::RED).count();
        println!("{what}, {:?}: {others} of {there} pixels differ by more than 1/255", settings.rasterizer);
        assert!(others <= 12 && there > 100, "{what}, {:?}: {others} {there}", settings.rasterizer);
    }
}

/// By tiles and by the graphics pipeline, of listed splats and of all.
fn ways() -> Vec<Settings> {
    let unlisted = |rasterizer| Settings { cull: Cull::Setup, ..settings(rasterizer) };
    let hidden = Settings { cull: Cull::Hidden, ..settings(Rasterizer::Compute) };
    [Rasterizer::Compute, Rasterizer::Perspective, Rasterizer::Quad]
        .into_iter()
        .flat_map(|rasterizer| [settings(rasterizer), unlisted(rasterizer)])
        .chain([hidden])
        .collect()
}

#[test]
fn what_comes_and_goes_is_seen_as_an_upload_of_what_is_there() {
    let mut beside = Beside::new(REVERSED);
    // Of what is open, all splats of a block that is in the view are seen.
    for (alpha, ellipses, closed) in
        [(1.0, false, true), (1.0, false, false), (0.5, false, true), (1.0, true, true)]
    {
        let scene = |splats, room| scene(splats, room, closed);
        let ways = if alpha < 1.0 { vec![settings(Rasterizer::Compute)] } else { ways() };
        let [one, other] =
            [DVec3::new(-1.1, 0.0, 0.0), DVec3::new(1.1, 0.2, 0.0)].map(|at| ball(at, alpha, ellipses));
        let mut seen = beside.upload(&scene(one.clone(), room(COUNT + 300)));
        let what = |words: &str| format!("{words}, alpha {alpha}, ellipses {ellipses}, closed {closed}");
        let fresh = beside.upload(&scene(one.clone(), None));
        assert_alike(&mut beside, [&seen, &fresh], &ways, &what("as uploaded"));
        let before: Vec<_> = ways.iter().map(|way| picture(&mut beside, &seen, way)).collect();
        // Both balls, of which the second comes in parts.
        let first = append(&beside, &mut seen, &some(&other, |i| i < 1700));
        let second = append(&beside, &mut seen, &some(&other, |i| i >= 1700));
        assert_eq!((first, second), (4000..5700, 5700..8000));
        assert_eq!((seen.room_of(0), seen.splat_count()), (Some(300), 8000));
        let fresh = beside.upload(&scene(joined(one.clone(), &other), None));
        assert_alike(&mut beside, [&seen, &fresh], &ways, &what("both"));
        // Holes in both: single ones, and more than a block.
        let stays = |i: usize| !i.is_multiple_of(7) && !(1000..1800).contains(&i);
        remove(&beside, &mut seen, 1000..1800);
        remove(&beside, &mut seen, 5000..5800);
        for i in (0..4000).filter(|i| i % 7 == 0) {
            beside.engine.begin();
            let (renderer, commands) = (&beside.renderer, beside.engine.commands);
            for number in [i, i + 4000] {
                // SAFETY: recording; submitted at once.
                unsafe { renderer.remove(commands, &mut seen, 0, number..number + 1) }.unwrap();
            }
            beside.engine.begin_rendering(true);
            beside.engine.end_rendering();
            beside.submit();
        }
        let left = joined(some(&one, stays), &some(&other, stays));
        assert_eq!(seen.splat_count(), left.len() as u64);
        let fresh = beside.upload(&scene(left, None));
        assert_alike(&mut beside, [&seen, &fresh], &ways, &what("with holes"));
        // The second goes, but for a part in the middle, which is put back then; and what was there first is as it was.
        remove(&beside, &mut seen, 4000..8000);
        assert_eq!(seen.room_of(0), Some(4300));
        update(&beside, &mut seen, 5100, &some(&other, |i| (1100..3000).contains(&i)));
        assert_eq!(seen.room_of(0), Some(1300));
        let left = joined(some(&one, stays), &some(&other, |i| (1100..3000).contains(&i)));
        let fresh = beside.upload(&scene(left, None));
        assert_alike(&mut beside, [&seen, &fresh], &ways, &what("a part"));
        remove(&beside, &mut seen, 4000..8300);
        update(&beside, &mut seen, 0, &one);
        for (way, before) in ways.iter().zip(&before) {
            assert!(picture(&mut beside, &seen, way) == *before, "{}", what("as it was"));
        }
    }
    beside.end();
}

/// Most are taken out, of blocks of which all would be seen: what frames have room for goes by what is left.
#[test]
fn what_is_left_of_much_is_seen() {
    let mut beside = Beside::new(REVERSED);
    // So small that the host knows of whole blocks that they are in the picture.
    let all = ball(DVec3::ZERO, 1.0, false).transformed(&DAffine3::from_scale(DVec3::splat(0.4)));
    let mut seen = beside.upload(&scene(all.clone(), room(0), true));
    submit(&beside, |Beside { renderer, engine, .. }| {
        for first in (0..COUNT as u32).step_by(16) {
            let numbers = first + 1..first + 16;
            // SAFETY: recording; submitted at once.
            unsafe { renderer.remove(engine.commands, &mut seen, 0, numbers) }.unwrap();
        }
    });
    let fresh = beside.upload(&scene(some(&all, |i| i % 16 == 0), None, true));
    assert_alike(&mut beside, [&seen, &fresh], &ways(), "each sixteenth");
    drop((seen, fresh));
    beside.end();
}

/// An object that has nothing when it is uploaded, far from the world's origin; and its pipelines are made ahead.
#[test]
fn an_object_of_nothing_is_filled_and_emptied() {
    let mut beside = Beside::new(REVERSED);
    let far = DVec3::new(5e5, 4.6e6, 3e2);
    let none = some(&ball(DVec3::ZERO, 1.0, false), |_| false);
    let of_room = Room { splats: 2 * COUNT as u32, around: Some(far), overlap: Some(1.5) };
    let mut seen = beside.upload(&scene(none, Some(of_room), true));
    let mut camera = camera();
    camera.view_from_world = look_at_mat4(far + DVec3::new(0.4, 0.9, 6.0), far, DVec3::Y);
    let settings = [Edges::Hard, Edges::Coverage].map(|edges| Settings {
        edges,
        shading: Shading::Albedo,
        ..settings(Rasterizer::Compute)
    });
    let rendering = Rendering { color_formats: vec![COLOR_FORMAT], ..Rendering::default() };
    let draw = |beside: &mut Beside, scene: &PreparedScene, settings: &Settings, missing| {
        let placed = [Placed::at_home(scene)];
        let frame = ViewFrame { missing, ..ViewFrame::new(&placed, &camera, settings) };
        beside.engine.begin();
        let Beside { view, renderer, engine, .. } = beside;
        // SAFETY: recording; all is alive until the wait.
        unsafe { view.prepare(renderer, engine.commands, &frame) }.unwrap();
        engine.begin_rendering(true);
        // SAFETY: inside of the rendering that the view was made for.
        unsafe { view.draw(renderer, engine.commands) }.unwrap();
        engine.end_rendering();
        beside.submit();
        beside.engine.pixels()
    };
    let nothing = draw(&mut beside, &seen, &settings[0], MissingPipelines::Make);
    let placed = [Placed::at_home(&seen)];
    for settings in &settings {
        let frame = ViewFrame::new(&placed, &camera, settings);
        assert!(beside.renderer.compile_ahead(&rendering, &frame).unwrap() > 0);
    }
    let mut splats = ball(far, 1.0, false);
    splats.colors = Colors::Uniform([0.0, 0.5, 1.0, 1.0]);
    assert_eq!(append(&beside, &mut seen, &splats), 0..COUNT as u32);
    let fresh = beside.upload(&scene(splats.clone(), None, true));
    let [hard, covered] = settings.each_ref().map(|settings| {
        let seen = draw(&mut beside, &seen, settings, MissingPipelines::Refuse);
        seen.into_iter().zip(draw(&mut beside, &fresh, settings, MissingPipelines::Make)).collect::<Vec<_>>()
    });
    let others = hard.iter().filter(|(one, other)| far_off(one, other)).count();
    let there = hard.iter().filter(|(_, expected)| *expected != nothing[0]).count();
    // The triangle behind is red, the ball is not: of an overlap that is told as larger than it is, it would show through.
    let through = covered.iter().filter(|(one, other)| one[0] > other[0] + 0.1).count();
    println!("{others} of {there} pixels differ by more than 1/255; through {through} more is seen");
    assert!(others <= 12 && through <= 12 && there > 1800, "{others} {through} {there}");
    remove(&beside, &mut seen, 0..COUNT as u32);
    assert_eq!((seen.splat_count(), seen.room_of(0)), (0, Some(2 * COUNT as u32)));
    assert!(draw(&mut beside, &seen, &settings[0], MissingPipelines::Refuse) == nothing);
    drop((seen, fresh));
    beside.end();
}

/// A thousand changes at random of a model and of the scene; then each frame some more, which takes nothing from the heap.
#[test]
fn coming_and_going_takes_nothing_from_the_heap_and_the_device() {
    const SETTLED: usize = 40;
    const PART: usize = 100;
    const ROOM: usize = 6000;
    let mut beside = Beside::new(Style { validates: false, ..REVERSED });
    let ball = ball(DVec3::ZERO, 1.0, false);
    let part = |first: usize| some(&ball, |i| (first..first + PART).contains(&i));
    let parts: Vec<_> = (0..COUNT / PART).map(|number| part(number * PART)).collect();
    let mut seen = beside.upload(&scene(ball.clone(), room(ROOM), true));
    let (mut taken, mut epochs, mut held) = (Vec::new(), VecDeque::new(), Vec::new());
    for frame in 0..SETTLED + 100 {
        let Beside { engine, renderer, device, .. } = &mut beside;
        engine.begin();
        let before = ALLOCATIONS.get();
        for (number, part) in parts.iter().enumerate().filter(|(number, _)| number % 4 == frame % 4) {
            let first = (number * PART) as u32;
            // SAFETY: recording; never submitted.
            unsafe {
                renderer.remove(engine.commands, &mut seen, 0, first..first + PART as u32).unwrap();
                let numbers = renderer.append(engine.commands, &mut seen, 0, part).unwrap();
                renderer.update(engine.commands, &mut seen, 0, first, part).unwrap();
                if number % 8 < 4 || numbers.end as usize + PART > COUNT + ROOM {
                    renderer.remove(engine.commands, &mut seen, 0, COUNT as u32..numbers.end).unwrap();
                }
            }
        }
        taken.push(ALLOCATIONS.get() - before);
        epochs.push_back(device.end_epoch());
        held.push(device.memory_in_use());
        if epochs.len() > 3 {
            // SAFETY: nothing was submitted.
            unsafe { device.epoch_done(epochs.pop_front().unwrap()) };
        }
    }
    println!("pieces of the heap: {:?}", &taken[..8]);
    assert!(taken[SETTLED..].iter().all(|taken| *taken == 0), "{taken:?}");
    assert!(held[SETTLED..].iter().all(|bytes| *bytes == held[SETTLED]), "{held:?}");
    drop(seen);
    beside.end();
}
