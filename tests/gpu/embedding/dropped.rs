//! What is dropped while frames are in flight.

use std::sync::Mutex;

use glam::DVec3;
use surfel::{renderer::Renderer, scene::Scene};

use super::{POINTS, in_flight::InFlight, record, settings, upload_when};
use crate::common::{host::Host, scenes};

/// Two frames are under way when their scene and the renderer are dropped: with the first that is done nothing goes, and all goes in the end. The layer knows which
/// commands are under way, whether the device is done with them or not.
#[test]
fn what_frames_in_flight_use_stays_until_the_last_of_them_is_done() {
    dropped(true);
}

/// The second is recorded then, and submitted when the first is done.
#[test]
fn what_recorded_commands_use_stays_until_they_are_submitted_and_done() {
    dropped(false);
}

fn dropped(all_submitted: bool) {
    let host = Host::new(POINTS);
    let ours = host.lend(host.device.clone());
    let settings = settings();
    let scene = Scene { objects: vec![scenes::sphere(3000, DVec3::ZERO)], ..Scene::default() };
    let renderer = Renderer::new(&ours, None).unwrap();
    let mut frames = [0, 1].map(|_| InFlight::new(&host, &ours, settings.size_px));
    let prepared = upload_when(&host, &ours, &renderer, &mut frames[0], &scene, &Mutex::new(()));
    for (number, frame) in frames.iter_mut().enumerate() {
        frame.begin(&host);
        record(&renderer, frame, &prepared, number, &settings);
        frame.copy_target(&host, settings.size_px);
        if all_submitted || number == 0 {
            frame.submit(&host, &ours);
        }
    }
    let of_scene = prepared.bytes();
    drop((prepared, renderer));
    let [first, last] = &mut frames;
    first.wait(&host, &ours);
    if !all_submitted {
        last.submit(&host, &ours);
    }
    assert_eq!(host.said(), [] as [String; 0]);
    let (held, _) = ours.memory_in_use();
    last.wait(&host, &ours);
    // SAFETY: the host waited for both frames.
    unsafe { ours.epoch_done(ours.end_epoch()) };
    assert!(ours.memory_in_use().0 + of_scene <= held, "{} of {held}", ours.memory_in_use().0);
    frames.into_iter().for_each(|frame| frame.destroy(&host));
    // SAFETY: as above.
    unsafe { ours.epoch_done(ours.end_epoch()) };
    assert_eq!(ours.memory_in_use(), (0, 0));
    drop(ours);
    assert_eq!(host.destroy(), [] as [String; 0]);
}
