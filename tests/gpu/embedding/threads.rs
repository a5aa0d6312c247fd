//! One device, one queue, two threads: each has a renderer, a scene and frames of its own; only submissions take turns.

use std::sync::Mutex;

use glam::DVec3;
use surfel::{
    Settings,
    renderer::Renderer,
    scene::{Rasterizer, Scene},
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
            frame.wait(&host, &ours);
            pictures.push(frame.pixels.bytes().to_vec());
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
