//! One device, one queue, two threads: each has a renderer, a scene and frames of its own; only submissions take turns.

use std::sync::{Barrier, Mutex};

use ash::vk;
use glam::{
    DVec3,
    dcamera::rh::{proj::directx, view::look_at_mat4},
};
use surfel::{
    Settings,
    embed::{HostCamera, HostImage, ImageState, Placed, Rendering, View, ViewFrame},
    renderer::Renderer,
    scene::{Colors, Filter, Kernel, Rasterizer, Scene},
    vk::Features,
};

use super::{POINTS, expected_of, in_flight::InFlight, record, upload_when};
use crate::common::{host::Host, scenes};

const FRAMES: usize = 12;

#[test]
fn two_threads_draw_on_one_device() {
    let host = Host::new(POINTS);
    let ours = host.lend(host.device.clone());
    let scene_of = |thread: usize| Scene {
        objects: vec![scenes::sphere([3000, 1200][thread], DVec3::new(0.2 * thread as f64, 0.0, 0.0))],
        ..Scene::default()
    };
    let settings_of = |thread: usize| Settings {
        size_px: [[200, 150], [120, 130]][thread],
        rasterizer: [Rasterizer::Perspective, Rasterizer::Quad][thread],
        ..super::settings()
    };
    let turn = Mutex::new(());
    let draw = |thread: usize| {
        let (scene, settings) = (scene_of(thread), settings_of(thread));
        let renderer = Renderer::new(&ours, None).unwrap();
        let mut frame = InFlight::new(&host, &ours, settings.size_px);
        let prepared = upload_when(&host, &ours, &renderer, &mut frame, &scene, &turn);
        let mut pictures = Vec::new();
        for number in 0..FRAMES {
            frame.begin(&host);
            record(&renderer, &mut frame, &prepared, number, &settings);
            frame.copy_target(&host, settings.size_px);
            {
                // A queue is for one thread at a time, and epochs end in the order of submissions.
                let _turn = turn.lock().unwrap();
                frame.submit(&host, &ours);
            }
            frame.wait_in_turn(&host, &ours, &turn);
            // SAFETY: waited for.
            pictures.push(unsafe { frame.pixels.bytes() }.to_vec());
        }
        frame.destroy(&host);
        pictures
    };
    let pictures = std::thread::scope(|scope| {
        let draw = &draw;
        let threads = [0, 1].map(|thread| scope.spawn(move || draw(thread)));
        threads.map(|thread| thread.join().unwrap())
    });
    for (thread, pictures) in pictures.iter().enumerate() {
        let expected = expected_of(&scene_of(thread), &settings_of(thread), FRAMES);
        for (number, (picture, expected)) in pictures.iter().zip(&expected).enumerate() {
            assert!(picture == expected, "thread {thread}, frame {number} differs");
        }
    }
    // SAFETY: the host waited for all frames.
    unsafe { ours.epoch_done(ours.end_epoch()) };
    assert_eq!(ours.memory_in_use(), (0, 0));
    drop(ours);
    assert_eq!(host.destroy(), [] as [String; 0]);
}

/// Rounds, each with a renderer that has no pipelines yet, and frames in each of them for every kind of frame.
const ROUNDS: usize = 3;
const OF_A_KIND: usize = 2;

/// One renderer, one scene, two threads that draw from it and one that makes pipelines ahead: all begin at once and want the same, so that they meet wherever pipelines,
/// memory and what was dropped are kept. A pipeline that two made stays once; the other's goes without harm to who draws with it.
#[test]
fn threads_that_share_a_renderer_want_the_same_pipelines_at_once() {
    let scene = Scene { objects: vec![scenes::sphere(1500, DVec3::ZERO)], ..Scene::default() };
    let of = |rasterizer, filter, kernel| Settings {
        size_px: [96, 80],
        rasterizer,
        filter,
        kernel,
        ..super::settings()
    };
    let kernel = Kernel::default();
    let kinds = [
        of(Rasterizer::Perspective, Filter::None, kernel),
        of(Rasterizer::Quad, Filter::Adjust, kernel),
        of(Rasterizer::Compute, Filter::None, kernel),
        of(Rasterizer::Quad, Filter::None, Kernel::Gaussian { sigma: 0.4 }),
    ];
    let expected: Vec<_> = kinds.iter().map(|kind| expected_of(&scene, kind, OF_A_KIND)).collect();
    let host = Host::new(Features { draw_indirect_first_instance: true, ..POINTS });
    let ours = host.lend(host.device.clone());
    let camera = HostCamera {
        view_from_world: look_at_mat4(DVec3::new(0.4, 0.9, 4.0), DVec3::ZERO, DVec3::Y),
        clip_from_view: directx::perspective_infinite_reverse(0.7, 1.2, 0.5),
        flips_y: true,
    };
    let (turn, mut made) = (Mutex::new(()), Vec::new());
    for _ in 0..ROUNDS {
        let renderer = Renderer::new(&ours, None).unwrap();
        let mut frames = [0, 1].map(|_| InFlight::new(&host, &ours, kinds[0].size_px));
        let prepared = upload_when(&host, &ours, &renderer, &mut frames[0], &scene, &turn);
        let barrier = Barrier::new(3);
        let draw = |frame: &mut InFlight| {
            let mut pictures = Vec::new();
            for kind in &kinds {
                barrier.wait();
                for number in 0..OF_A_KIND {
                    frame.begin(&host);
                    record(&renderer, frame, &prepared, number, kind);
                    frame.copy_target(&host, kind.size_px);
                    {
                        let _turn = turn.lock().unwrap();
                        frame.submit(&host, &ours);
                    }
                    frame.wait_in_turn(&host, &ours, &turn);
                    // SAFETY: waited for.
                    pictures.push(unsafe { frame.pixels.bytes() }.to_vec());
                }
            }
            pictures
        };
        let ahead = || {
            for kind in &kinds {
                barrier.wait();
                let scenes = [Placed::at_home(&prepared)];
                let frame = ViewFrame::new(&scenes, &camera, kind);
                renderer.compile_ahead(&Rendering::default(), &frame).unwrap();
            }
        };
        let [one, other] = &mut frames;
        let drawn = std::thread::scope(|scope| {
            let (draw, ahead) = (&draw, scope.spawn(ahead));
            let drawn = [one, other].map(|frame| scope.spawn(move || draw(frame)));
            let drawn = drawn.map(|thread| thread.join().unwrap());
            ahead.join().unwrap();
            drawn
        });
        for pictures in drawn {
            for (number, (picture, expected)) in pictures.iter().zip(expected.iter().flatten()).enumerate() {
                assert!(picture == expected, "frame {number} differs");
            }
        }
        let names = renderer.shaders().pipeline_names();
        made.push((renderer.pipelines_made(), names.len() as u64));
        frames.into_iter().for_each(|frame| frame.destroy(&host));
        drop((prepared, renderer));
        assert_eq!(host.said(), [] as [String; 0]);
    }
    println!("pipelines made, and those that stayed: {made:?}");
    assert!(made.iter().any(|(made, stayed)| made > stayed), "no two threads met: {made:?}");
    // SAFETY: the host waited for all frames.
    unsafe { ours.epoch_done(ours.end_epoch()) };
    assert_eq!(ours.memory_in_use(), (0, 0));
    drop(ours);
    assert_eq!(host.destroy(), [] as [String; 0]);
}

/// One renderer, and a scene that all see. Each thread has a view, and a scene of its own whose splats it changes in every frame: what it sees is what it sees alone.
#[test]
fn threads_that_share_a_renderer_update_scenes_and_draw_views_at_once() {
    const THREADS: usize = 3;
    const SIZE_PX: [u32; 2] = [96, 80];
    const PART: usize = 400;
    let host = Host::new(POINTS);
    let ours = host.lend(host.device.clone());
    let renderer = Renderer::new(&ours, None).unwrap();
    let turn = Mutex::new(());
    let mut frames = [0; THREADS].map(|_| InFlight::new(&host, &ours, SIZE_PX));
    let middle = Scene { objects: vec![scenes::sphere(900, DVec3::new(0.0, 0.0, -1.0))], ..Scene::default() };
    let shared = upload_when(&host, &ours, &renderer, &mut frames[0], &middle, &turn);
    let camera = HostCamera {
        view_from_world: look_at_mat4(DVec3::new(0.4, 0.9, 4.0), DVec3::ZERO, DVec3::Y),
        clip_from_view: directx::perspective_infinite_reverse(0.9, 1.2, 0.5),
        flips_y: true,
    };
    let settings = Settings { size_px: SIZE_PX, ..super::settings() };
    let color_formats = vec![super::in_flight::FORMAT];
    let rendering = Rendering { color_formats, depth_format: vk::Format::UNDEFINED, ..Rendering::default() };
    let draw = |thread: usize, frame: &mut InFlight| {
        let mut object = scenes::sphere(2000, DVec3::new(0.6 * thread as f64 - 0.6, 0.0, 0.0));
        let mut part = object.splats.clone();
        part.keep(&(0..2000).map(|i| i < PART).collect::<Vec<_>>());
        object.splats.colors = Colors::Each(vec![[0.5, 0.5, 0.5, 1.0]; 2000]);
        let scene = Scene { objects: vec![object], updatable: true, ..Scene::default() };
        let mut own = upload_when(&host, &ours, &renderer, frame, &scene, &turn);
        let mut view = View::new(&renderer, &rendering).unwrap();
        let mut pictures = Vec::new();
        for number in 0..FRAMES {
            {
                // What updates record is submitted before any other epoch ends.
                let _turn = turn.lock().unwrap();
                frame.begin(&host);
                let color = [0.05 * number as f32, 0.3 * thread as f32, 0.8, 1.0];
                for first in [0, 500, 1500] {
                    part.colors = Colors::Each(vec![color; PART]);
                    // SAFETY: recording; submitted at once.
                    unsafe { renderer.update(frame.commands, &mut own, 0, first, &part) }.unwrap();
                }
                frame.submit(&host, &ours);
            }
            frame.wait_in_turn(&host, &ours, &turn);
            frame.begin(&host);
            let target = frame.target(SIZE_PX);
            let image = HostImage {
                before: ImageState::default(),
                after: target.last.unwrap(),
                ..HostImage::color(target.image, target.view, target.format, target.extent)
            };
            let scenes = [Placed::at_home(&own), Placed::at_home(&shared)];
            let seen = ViewFrame::new(&scenes, &camera, &settings);
            // SAFETY: recording; all is alive until the wait.
            unsafe { view.record(&renderer, frame.commands, &seen, &[Some(image)], None) }.unwrap();
            frame.copy_target(&host, SIZE_PX);
            {
                let _turn = turn.lock().unwrap();
                frame.submit(&host, &ours);
            }
            frame.wait_in_turn(&host, &ours, &turn);
            // SAFETY: waited for.
            pictures.push(unsafe { frame.pixels.bytes() }.to_vec());
        }
        pictures
    };
    let alone: Vec<_> = (0..THREADS).map(|thread| draw(thread, &mut frames[thread])).collect();
    for pictures in &alone {
        assert!(pictures.windows(2).all(|two| two[0] != two[1]), "each update is seen");
    }
    let together = std::thread::scope(|scope| {
        let draw = &draw;
        let spawn = |(thread, frame): (usize, _)| scope.spawn(move || draw(thread, frame));
        let threads: Vec<_> = frames.iter_mut().enumerate().map(spawn).collect();
        threads.into_iter().map(|thread| thread.join().unwrap()).collect::<Vec<_>>()
    });
    for (thread, (together, alone)) in together.iter().zip(&alone).enumerate() {
        for (number, (picture, expected)) in together.iter().zip(alone).enumerate() {
            assert!(picture == expected, "thread {thread}, frame {number} differs");
        }
    }
    frames.into_iter().for_each(|frame| frame.destroy(&host));
    drop((shared, renderer));
    // SAFETY: the host waited for all frames.
    unsafe { ours.epoch_done(ours.end_epoch()) };
    assert_eq!(ours.memory_in_use(), (0, 0));
    drop(ours);
    assert_eq!(host.destroy(), [] as [String; 0]);
}
