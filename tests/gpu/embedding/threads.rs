//! One device, one queue, two threads: each has a renderer, a scene and frames of its own; only submissions take turns.

use std::sync::{Barrier, Mutex};

use glam::{
    DVec3,
    dcamera::rh::{proj::directx, view::look_at_mat4},
};
use surfel::{
    Settings,
    embed::{HostCamera, Placed, Rendering, ViewFrame},
    renderer::Renderer,
    scene::{Filter, Kernel, Rasterizer, Scene},
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
