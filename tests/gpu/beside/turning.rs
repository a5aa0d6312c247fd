//! Frames that differ in what is seen, and in size: once each has been drawn, none takes memory of the device any more, nor of the heap.

use glam::{
    DVec3,
    dcamera::rh::{proj::directx, view::look_at_mat4},
};
use surfel::{
    Settings,
    embed::{Device, HostCamera, Import, Placed, Placement, PreparedScene, ViewFrame},
    scene::{Colors, Layers, Scene},
};

use super::{Beside, Engine, REVERSED, SIZE_PX, Style, memory::OfEngine};
use crate::{common::scenes, memory::ALLOCATIONS};

const BALLS: usize = 10;

/// Of a turn.
const STEPS: usize = 16;

/// The view's size goes back and forth, as it does where a host keeps its pace by it.
const SIZES_PX: [[u32; 2]; 2] = [SIZE_PX, [SIZE_PX[0] * 3 / 4, SIZE_PX[1] * 3 / 4]];

fn looking(angle: f64) -> HostCamera {
    HostCamera {
        view_from_world: look_at_mat4(DVec3::ZERO, DVec3::new(angle.sin(), 0.0, angle.cos()), DVec3::Y),
        clip_from_view: directx::perspective_infinite_reverse(0.7, 160.0 / 120.0, 0.1),
        flips_y: true,
    }
}

/// Balls around the camera, the first half of them opaque.
fn around(balls: &[PreparedScene; 2]) -> Vec<Placed<'_>> {
    let at = |i: usize| {
        let (angle, distance) = (2.4 * i as f64, 1.0 + 0.3 * (i as f64).sqrt());
        let translation = distance * DVec3::new(angle.sin(), 0.0, angle.cos());
        Placed::new(
            &balls[usize::from(2 * i >= BALLS)],
            Placement { scale: 0.15, translation, ..Placement::default() },
        )
    };
    (0..BALLS).map(at).collect()
}

#[test]
fn a_camera_that_turns_takes_nothing_from_the_device_and_the_heap_after_its_first_turn() {
    for (validates, large_first) in [(true, true), (false, true), (false, false)] {
        crate::common::arm();
        let engine = Engine::new(Style { validates, ..REVERSED });
        let memory = OfEngine::new(&engine);
        let host = Import { memory: Some(memory.clone()), ..engine.lent() };
        // SAFETY: all is the engine's own, which goes last.
        let device = unsafe { Device::import(&host) }.unwrap();
        let mut beside = Beside::on(engine, device);
        let balls = [1.0, 0.5].map(|alpha| {
            let mut ball = scenes::sphere(500, DVec3::ZERO);
            ball.splats.colors = Colors::Uniform([0.5, 0.6, 0.7, alpha]);
            beside.upload(&Scene { objects: vec![ball], ..Scene::default() })
        });
        let placed = around(&balls);
        let turns = [(); 3].map(|()| {
            let asked = memory.asked();
            let taken = turn(&mut beside, &placed, large_first);
            (memory.asked() - asked, taken)
        });
        println!("of each turn, pieces of device memory and of the heap: {turns:?}");
        assert!(turns[0].0 > 0 && turns[0].1 > 0 && turns[1..] == [(0, 0); 2], "{turns:?}");
        drop(placed);
        drop(balls);
        beside.end();
    }
}

/// Draws all of a turn. How often it takes something from the heap.
fn turn(beside: &mut Beside, placed: &[Placed<'_>], large_first: bool) -> usize {
    let mut taken = 0;
    let mut sizes_px = SIZES_PX;
    if !large_first {
        sizes_px.reverse();
    }
    for step in 0..STEPS {
        let camera = looking(std::f64::consts::TAU * step as f64 / STEPS as f64);
        for size_px in sizes_px {
            let settings = Settings { size_px, layers: Layers::Fixed(2), ..Settings::default() };
            let hides = Some(beside.hides());
            let frame = ViewFrame { hides, ..ViewFrame::new(placed, &camera, &settings) };
            let Beside { engine, view, renderer, .. } = &mut *beside;
            engine.begin();
            engine.begin_rendering(true);
            engine.end_rendering();
            let before = ALLOCATIONS.get();
            // SAFETY: recording; all is alive until the wait, here and below.
            unsafe { view.prepare(renderer, engine.commands, &frame) }.unwrap();
            taken += ALLOCATIONS.get() - before;
            engine.begin_rendering(false);
            // SAFETY: inside of the rendering that the view was made for.
            unsafe { view.draw(renderer, engine.commands) }.unwrap();
            engine.end_rendering();
            beside.submit();
        }
    }
    taken
}

#[test]
fn memory_of_a_large_frame_is_given_back_after_a_thousand_small_ones() {
    let mut beside = Beside::new(Style { validates: false, ..REVERSED });
    let ball = Scene { objects: vec![scenes::sphere(2000, DVec3::ZERO)], ..Scene::default() };
    let ball = beside.upload(&ball);
    let placed =
        [Placed::new(&ball, Placement { translation: DVec3::new(0.0, 0.0, 3.0), ..Placement::default() })];
    let camera = looking(0.0);
    let mut bytes_after = |size_px: [u32; 2], frames: usize| {
        let Beside { engine, view, renderer, device, .. } = &mut beside;
        let settings = Settings { size_px, ..Settings::default() };
        for _ in 0..frames {
            engine.begin();
            // SAFETY: recording; never submitted.
            unsafe { view.prepare(renderer, engine.commands, &ViewFrame::new(&placed, &camera, &settings)) }
                .unwrap();
            // SAFETY: nothing was submitted.
            unsafe { device.epoch_done(device.end_epoch()) };
        }
        (view.bytes(), device.memory_in_use().0)
    };
    let [small, large] = [[32, 24], SIZE_PX];
    let alone = bytes_after(small, 1);
    let of_large = bytes_after(large, 1);
    let soon = bytes_after(small, 900);
    let late = bytes_after(small, 1200);
    println!("{alone:?} bytes alone, {of_large:?} large, {soon:?} soon, {late:?} late");
    assert!(of_large.0 > 2 * alone.0 && soon == of_large, "{alone:?} {of_large:?} {soon:?}");
    assert!(late.0 < 2 * alone.0 && of_large.1 - late.1 == of_large.0 - late.0, "{alone:?} {late:?}");
    drop(ball);
    beside.end();
}
