//! An embedding host owns instance, device, queue, command buffers, target and submission; the renderer records.

mod dropped;
mod in_flight;
mod no_waits;
mod orbit;
mod threads;

use crate::common::{builder, host::Host, scenes, shared, watched::Watched};
use std::sync::Mutex;

use glam::DVec3;
use in_flight::InFlight;
use no_waits::{SUBMISSIONS_AND_WAITS, without_submission_and_waits};
use surfel::{
    prepare::PreparedScene,
    renderer::{Renderer, SceneFrame, Seen, Wanted},
    scene::{Camera, Scene, Settings},
    vk::{Device, Features, Queue, Staging},
};

const POINTS: Features = Features { large_points: true, ..Features::NEEDED };

fn scene() -> Scene {
    Scene { objects: vec![scenes::sphere(3000, DVec3::ZERO)], ..Scene::default() }
}

/// The scene from another side for each frame.
fn camera(frame: usize) -> Camera {
    let angle = 0.4 * frame as f64;
    builder::camera([3.2 * angle.sin(), 0.3, 3.2 * angle.cos()], [0.0; 3])
}

fn settings() -> Settings {
    Settings { size_px: [200, 150], ..builder::settings() }
}

/// The same frame from our own host.
fn expected(settings: &Settings, frames: usize) -> Vec<Vec<u8>> {
    expected_of(&scene(), settings, frames)
}

fn expected_of(scene: &Scene, settings: &Settings, frames: usize) -> Vec<Vec<u8>> {
    let mut headless = shared();
    let prepared = headless.prepare(scene, &|_, _| {}).unwrap();
    let wanted = Wanted { picture: true, ..Wanted::default() };
    let mut picture = |frame| {
        let frame = headless.render(&prepared, &camera(frame), settings, wanted).unwrap();
        bytemuck::cast_slice(&frame.srgb).to_vec()
    };
    (0..frames).map(&mut picture).collect()
}

/// Uploads with the host's own command buffer; the host may defer it, and so records all batches into one.
fn upload(
    host: &Host,
    ours: &Device,
    renderer: &Renderer,
    frame: &mut InFlight,
    scene: &Scene,
) -> PreparedScene {
    upload_when(host, ours, renderer, frame, scene, &Mutex::new(()))
}

/// The same; what is submitted waits for its turn.
fn upload_when(
    host: &Host,
    ours: &Device,
    renderer: &Renderer,
    frame: &mut InFlight,
    scene: &Scene,
    turn: &Mutex<()>,
) -> PreparedScene {
    let mut batches: Vec<Staging> = Vec::new();
    frame.begin(host);
    let mut submit = |staging: Staging| {
        // SAFETY: recording; the batch is kept until the wait below.
        unsafe { staging.record(frame.commands) };
        batches.push(staging);
        Ok(())
    };
    let prepared = renderer.prepare(scene, &mut submit, &|_, _| {}).unwrap();
    {
        let _turn = turn.lock().unwrap();
        frame.submit(host, ours);
    }
    frame.wait_in_turn(host, ours, turn);
    drop(batches);
    prepared
}

fn record(
    renderer: &Renderer,
    frame: &mut InFlight,
    scene: &PreparedScene,
    number: usize,
    settings: &Settings,
) {
    let (target, camera) = (frame.target(settings.size_px), camera(number));
    let shown = SceneFrame::new(Seen { scene, camera: &camera, settings }, &target);
    // SAFETY: the frame's commands are recording, and its earlier submission was waited for; scene, renderer, slot and
    // target stay alive until its next wait.
    unsafe { renderer.record(frame.commands, &mut frame.slot, &shown) }.unwrap();
}

#[test]
fn a_foreign_host_gets_the_same_picture_with_two_frames_in_flight() {
    const FRAMES: usize = 5;
    let settings = settings();
    let expected = expected(&settings, FRAMES);
    let host = Host::new(POINTS);
    let ours = host.lend(host.device.clone());
    let renderer = Renderer::new(&ours, None).unwrap();
    let mut frames = [0, 1].map(|_| InFlight::new(&host, &ours, settings.size_px));
    let scene = upload(&host, &ours, &renderer, &mut frames[0], &scene());

    let mut pictures = Vec::new();
    for number in 0..FRAMES + 2 {
        let frame = &mut frames[number % 2];
        let submitted = frame.epoch.is_some();
        frame.wait(&host, &ours);
        if submitted {
            // SAFETY: waited for.
            pictures.push(unsafe { frame.pixels.bytes() }.to_vec());
        }
        if number < FRAMES {
            frame.begin(&host);
            record(&renderer, frame, &scene, number, &settings);
            frame.copy_target(&host, settings.size_px);
            frame.submit(&host, &ours);
        }
    }
    assert_eq!(pictures.len(), FRAMES);
    for (number, (picture, expected)) in pictures.iter().zip(&expected).enumerate() {
        assert!(picture == expected, "frame {number} differs");
    }
    assert_ne!(expected[0], expected[1], "the frames show different sides");

    frames.into_iter().for_each(|frame| frame.destroy(&host));
    drop((scene, renderer));
    // All was dropped with nothing under way: one more epoch, and the memory is back.
    // SAFETY: the host waited for both frames.
    unsafe { ours.epoch_done(ours.end_epoch()) };
    assert_eq!(ours.memory_in_use(), (0, 0));
    drop(ours);
    assert_eq!(host.said(), [] as [String; 0]);
    assert_eq!(host.destroy(), [] as [String; 0]);
}

#[test]
fn recording_never_submits_and_never_waits() {
    let settings = settings();
    let host = Host::new(POINTS);
    let ours = host.lend(without_submission_and_waits(&host));
    let renderer = Renderer::new(&ours, None).unwrap();
    let mut frame = InFlight::new(&host, &ours, settings.size_px);
    let scene = upload(&host, &ours, &renderer, &mut frame, &scene());
    frame.begin(&host);
    record(&renderer, &mut frame, &scene, 0, &settings);
    // Never submitted at all: that is fine too.
    // SAFETY: recording.
    unsafe { host.device.end_command_buffer(frame.commands) }.unwrap();
    frame.destroy(&host);
    drop((scene, renderer, ours));
    let calls = SUBMISSIONS_AND_WAITS.load(std::sync::atomic::Ordering::Relaxed);
    assert_eq!(calls, 0, "calls that submit or wait");
    assert_eq!(host.destroy(), [] as [String; 0]);
}

#[test]
fn a_hosts_queue_is_not_ours_to_take_and_an_owned_one_has_one_owner() {
    let host = Host::new(POINTS);
    let ours = host.lend(host.device.clone());
    assert_eq!(Queue::new(&ours).err().unwrap().exit_code(), 1);
    drop(ours);
    assert_eq!(host.destroy(), [] as [String; 0]);

    let watched = Watched::new();
    let second = Queue::new(&watched.device).err().unwrap();
    assert!(second.to_string().contains("another owner"), "{second}");
    let Watched { device, queue, messages } = watched;
    drop(queue);
    let next = Queue::new(&device).unwrap();
    assert!(next.wait(1).is_err(), "an epoch that was never submitted would never end");
    drop((next, device));
    assert_eq!(messages.all(), []);
}

/// Without `largePoints` every splat above one pixel is a quad: the same picture, but for rounding.
#[test]
fn without_large_points_every_splat_is_a_quad() {
    let settings = settings();
    let expected = expected(&settings, 1);
    let host = Host::new(Features::NEEDED);
    let ours = host.lend(host.device.clone());
    assert_eq!(ours.facts().limits.point_size_range, [1.0, 1.0]);
    let renderer = Renderer::new(&ours, None).unwrap();
    let mut frame = InFlight::new(&host, &ours, settings.size_px);
    let scene = upload(&host, &ours, &renderer, &mut frame, &scene());
    frame.begin(&host);
    record(&renderer, &mut frame, &scene, 0, &settings);
    frame.copy_target(&host, settings.size_px);
    frame.submit(&host, &ours);
    frame.wait(&host, &ours);
    let names = renderer.shaders().pipeline_names();
    assert!(names.iter().any(|name| name.starts_with("accumulate_quads")), "{names:?}");

    // SAFETY: waited for.
    let picture = unsafe { frame.pixels.bytes() };
    assert!(picture.iter().any(|byte| *byte != 255), "the picture is not empty");
    let steps = |(a, b): (&u8, &u8)| a.abs_diff(*b);
    let largest = picture.iter().zip(&expected[0]).map(steps).max().unwrap();
    let different = picture.iter().zip(&expected[0]).filter(|pair| pair.0 != pair.1).count();
    println!("points against quads: {different} of {} bytes differ, by at most {largest}", picture.len());
    assert!(largest <= 1, "a byte differs by {largest}");

    frame.destroy(&host);
    drop((scene, renderer, ours));
    assert_eq!(host.destroy(), [] as [String; 0]);
}
