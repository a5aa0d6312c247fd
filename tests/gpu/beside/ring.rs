//! The ring of memory that changes of splats go through: one for all, which is never written where commands still read, and taken from nothing once it is there.

use ash::vk;
use glam::{
    DVec3,
    dcamera::rh::{proj::directx, view::look_at_mat4},
};
use surfel::{
    ErrorKind, Settings,
    embed::{Device, HostCamera, Import, Placed, PreparedScene, ViewFrame},
    scene::{Colors, Edges, Scene, Splats},
};

use super::{Beside, Engine, REVERSED, SIZE_PX, Style, memory::OfEngine};
use crate::{common::scenes, memory::ALLOCATIONS};

const BEHIND: [DVec3; 3] =
    [DVec3::new(-90.0, -60.0, -30.0), DVec3::new(90.0, -60.0, -30.0), DVec3::new(0.0, 90.0, -30.0)];

/// Of a ball, and of an update of it.
const COUNT: usize = 20_000;
const PART: usize = 1500;

const FRAMES_IN_FLIGHT: usize = 3;

/// Frames after which nothing is made any more.
const SETTLED: usize = 20;

fn camera() -> HostCamera {
    HostCamera {
        view_from_world: look_at_mat4(DVec3::new(0.4, 0.9, 4.0), DVec3::ZERO, DVec3::Y),
        clip_from_view: directx::perspective_infinite_reverse(0.7, 160.0 / 120.0, 0.5),
        flips_y: true,
    }
}

fn settings() -> Settings {
    Settings { size_px: SIZE_PX, edges: Edges::Hard, ..Settings::default() }
}

fn ball() -> Splats {
    let mut splats = scenes::sphere(COUNT, DVec3::ZERO).splats;
    splats.colors = Colors::Each(vec![[0.5, 0.6, 0.7, 1.0]; COUNT]);
    splats
}

fn scene(splats: Splats) -> Scene {
    let mut object = scenes::sphere(3, DVec3::ZERO);
    object.splats = splats;
    Scene { objects: vec![object], updatable: true, ..Scene::default() }
}

/// Splats of a ball from this one on, in a color that tells the round.
fn part(splats: &mut Splats, first: usize, round: usize) -> Splats {
    let Colors::Each(colors) = &mut splats.colors else { panic!("a color each") };
    colors[first..first + PART].fill([0.1, 0.02 * (round % 50) as f32, 0.9, 1.0]);
    let keep: Vec<_> = (0..COUNT).map(|i| (first..first + PART).contains(&i)).collect();
    let mut part = splats.clone();
    part.keep(&keep);
    part
}

fn with_memory(style: Style) -> (Beside, std::sync::Arc<OfEngine>) {
    crate::common::arm();
    let engine = Engine::new(style);
    let memory = OfEngine::new(&engine);
    let host = Import { memory: Some(memory.clone()), ..engine.lent() };
    // SAFETY: all is the engine's own, which goes last.
    let device = unsafe { Device::import(&host) }.unwrap();
    (Beside::on(engine, device), memory)
}

fn picture(beside: &mut Beside, scene: &PreparedScene) -> Vec<[f32; 4]> {
    beside.draw(&[Placed::at_home(scene)], &camera(), &settings(), &BEHIND, false);
    beside.engine.pixels()
}

/// Each frame another part of two scenes, and a frame of them; of those before three are under way.
#[test]
fn an_update_as_large_as_those_before_takes_nothing_from_the_device_and_the_heap() {
    let (mut beside, memory) = with_memory(Style { validates: false, ..REVERSED });
    let mut splats = ball();
    let mut scenes = [(); 2].map(|()| beside.upload(&scene(ball())));
    let (mut taken, mut epochs) = (Vec::new(), std::collections::VecDeque::new());
    for frame in 0..SETTLED + 60 {
        let first = 173 * frame % (COUNT - PART);
        let part = part(&mut splats, first, frame);
        let Beside { engine, renderer, view, device, .. } = &mut beside;
        engine.begin();
        let (asked, before) = (memory.asked(), ALLOCATIONS.get());
        for scene in &mut scenes {
            // SAFETY: recording; never submitted.
            unsafe { renderer.update(engine.commands, scene, 0, first as u32, &part) }.unwrap();
        }
        let by_updates = ALLOCATIONS.get() - before;
        let placed = [Placed::at_home(&scenes[0])];
        let (camera, settings) = (camera(), settings());
        // SAFETY: as above.
        unsafe { view.prepare(renderer, engine.commands, &ViewFrame::new(&placed, &camera, &settings)) }
            .unwrap();
        let by_all = ALLOCATIONS.get() - before;
        taken.push((memory.asked() - asked, by_updates, by_all));
        epochs.push_back(device.end_epoch());
        if epochs.len() > FRAMES_IN_FLIGHT {
            // SAFETY: nothing was submitted.
            unsafe { device.epoch_done(epochs.pop_front().unwrap()) };
        }
    }
    println!("pieces of device memory and of the heap, by updates, and with the frame: {:?}", &taken[..8]);
    assert!(taken[0].0 > 0 && taken[SETTLED..].iter().all(|taken| *taken == (0, 0, 0)), "{taken:?}");
    drop(scenes);
    beside.end();
}

/// More than the ring had room for, in one command buffer: none is written over another.
#[test]
fn updates_that_are_under_way_together_are_all_seen() {
    let mut beside = Beside::new(REVERSED);
    let mut splats = ball();
    let mut updated = beside.upload(&scene(ball()));
    let before = picture(&mut beside, &updated);
    for round in 0..3 {
        beside.engine.begin();
        for number in 0..COUNT / PART {
            let part = part(&mut splats, number * PART, 7 * round + number);
            let (renderer, commands) = (&beside.renderer, beside.engine.commands);
            // SAFETY: recording; submitted at once.
            unsafe { renderer.update(commands, &mut updated, 0, (number * PART) as u32, &part) }.unwrap();
        }
        beside.engine.begin_rendering(true);
        beside.engine.end_rendering();
        beside.submit();
        let fresh = beside.upload(&scene(splats.clone()));
        let (seen, expected) = (picture(&mut beside, &updated), picture(&mut beside, &fresh));
        assert!(seen == expected && seen != before, "round {round}");
    }
    drop(updated);
    beside.end();
}

/// Threads record changes of a scene of their own each, through one renderer.
#[test]
fn threads_that_update_scenes_of_their_own_at_once_see_their_own_bytes() {
    let mut beside = Beside::new(REVERSED);
    let device = beside.engine.device.clone();
    let mut scenes = [(); 2].map(|()| beside.upload(&scene(ball())));
    let info = vk::CommandPoolCreateInfo::default().queue_family_index(beside.engine.family);
    // SAFETY: the device is alive.
    let pools = [(); 2].map(|()| unsafe { device.create_command_pool(&info, None) }.unwrap());
    for round in 0..4 {
        let begin = &std::sync::Barrier::new(2);
        let record = |number: usize, scene: &mut PreparedScene, pool| {
            let (device, renderer) = (&device, &beside.renderer);
            let mut splats = ball();
            let info = vk::CommandBufferAllocateInfo::default()
                .command_pool(pool)
                .level(vk::CommandBufferLevel::SECONDARY)
                .command_buffer_count(1);
            // SAFETY: the pool is this thread's.
            let commands = unsafe { device.allocate_command_buffers(&info) }.unwrap()[0];
            let inherited = vk::CommandBufferInheritanceInfo::default();
            let info = vk::CommandBufferBeginInfo::default().inheritance_info(&inherited);
            let colored = |at: usize| part(&mut splats, at * PART, 25 * number + at + round);
            let parts: Vec<_> = (0..COUNT / PART).map(colored).collect();
            begin.wait();
            // SAFETY: recorded here, and submitted in this epoch.
            unsafe {
                device.begin_command_buffer(commands, &info).unwrap();
                for (at, part) in parts.iter().enumerate() {
                    renderer.update(commands, scene, 0, (at * PART) as u32, part).unwrap();
                }
                device.end_command_buffer(commands).unwrap();
            }
            (commands, splats)
        };
        let [one, other] = &mut scenes;
        let recorded = std::thread::scope(|scope| {
            let thread = scope.spawn(|| record(0, one, pools[0]));
            [record(1, other, pools[1]), thread.join().unwrap()]
        });
        let recorded = [&recorded[1], &recorded[0]];
        beside.engine.begin();
        for (commands, _) in recorded {
            // SAFETY: recorded, and alive until the wait.
            unsafe { device.cmd_execute_commands(beside.engine.commands, std::slice::from_ref(commands)) };
        }
        beside.engine.begin_rendering(true);
        beside.engine.end_rendering();
        beside.submit();
        for (scene_of, (_, splats)) in scenes.iter().zip(recorded) {
            let fresh = beside.upload(&scene(splats.clone()));
            let (seen, expected) = (picture(&mut beside, scene_of), picture(&mut beside, &fresh));
            assert!(seen == expected, "round {round}");
        }
    }
    // SAFETY: nothing is under way.
    pools.iter().for_each(|pool| unsafe { device.destroy_command_pool(*pool, None) });
    drop(scenes);
    beside.end();
}

#[test]
fn a_ring_that_nobody_has_used_for_a_thousand_epochs_is_given_back() {
    let mut beside = Beside::new(Style { validates: false, ..REVERSED });
    let mut splats = ball();
    let mut updated = beside.upload(&scene(ball()));
    let _ = picture(&mut beside, &updated);
    let held = |beside: &Beside| beside.device.memory_in_use().0 - beside.view.bytes();
    let without = held(&beside);
    let part = part(&mut splats, 0, 1);
    let mut frames = |count: usize, updates: bool| {
        let Beside { engine, renderer, view, device, .. } = &mut beside;
        for _ in 0..count {
            engine.begin();
            if updates {
                // SAFETY: recording; never submitted.
                unsafe { renderer.update(engine.commands, &mut updated, 0, 0, &part) }.unwrap();
            }
            let placed = [Placed::at_home(&updated)];
            let (camera, settings) = (camera(), settings());
            // SAFETY: as above.
            unsafe { view.prepare(renderer, engine.commands, &ViewFrame::new(&placed, &camera, &settings)) }
                .unwrap();
            // SAFETY: nothing was submitted.
            unsafe { device.epoch_done(device.end_epoch()) };
        }
        held(&beside)
    };
    let (used, soon, late) = (frames(5, true), frames(900, false), frames(1200, false));
    println!("{without} bytes without a ring, {used} with it, {soon} soon, {late} late");
    assert!(used >= without + (40 * PART) as u64 && soon == used && late == without);
    drop(updated);
    beside.end();
}

#[test]
fn an_update_without_memory_changes_nothing_and_the_next_works() {
    let (mut beside, memory) = with_memory(REVERSED);
    let mut splats = ball();
    let mut updated = beside.upload(&scene(ball()));
    let before = picture(&mut beside, &updated);
    let refused = part(&mut splats.clone(), 0, 1);
    beside.engine.begin();
    memory.answer(Some(0));
    let (renderer, commands) = (&beside.renderer, beside.engine.commands);
    // SAFETY: recording; submitted at once.
    let error = unsafe { renderer.update(commands, &mut updated, 0, 0, &refused) }.unwrap_err();
    assert!(
        matches!(error.kind(), ErrorKind::Memory { object, .. } if object == "update of splats"),
        "{error}"
    );
    memory.answer(None);
    beside.engine.begin_rendering(true);
    beside.engine.end_rendering();
    beside.submit();
    assert!(picture(&mut beside, &updated) == before);
    // Others, with which some go along that lie between them: as they were.
    let next = part(&mut splats, PART, 2);
    beside.engine.begin();
    let (renderer, commands) = (&beside.renderer, beside.engine.commands);
    // SAFETY: as above.
    unsafe { renderer.update(commands, &mut updated, 0, PART as u32, &next) }.unwrap();
    beside.engine.begin_rendering(true);
    beside.engine.end_rendering();
    beside.submit();
    let fresh = beside.upload(&scene(splats));
    let (seen, expected) = (picture(&mut beside, &updated), picture(&mut beside, &fresh));
    assert!(seen == expected && seen != before);
    drop((updated, fresh));
    beside.end();
}
