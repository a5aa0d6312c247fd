//! A camera that goes around a model: once it moves, frames find all that they need.

use glam::{DQuat, DVec3};
use surfel::{
    Camera, Settings,
    renderer::{Renderer, SceneFrame, Seen, Wanted},
    scene::{Cull, Rasterizer, Scene},
    vk::Features,
};

use crate::{
    common::{faults, headless, host::Host, scenes},
    embedding::{in_flight::InFlight, upload},
};

const FRAMES: usize = 60;

/// Frames in which nothing is made any more: pipelines and memory are settled.
const SETTLED: usize = 20;

/// Frames whose pictures are compared.
const COMPARED: [usize; 2] = [33, 59];

fn camera(scene: &Scene, settings: &Settings, frame: usize) -> Camera {
    let ball = scene.ball().unwrap();
    let camera = Camera::fit(&ball, settings.size_px, Camera::DEFAULT_FOV_Y_RAD);
    let turn = DQuat::from_rotation_y(std::f64::consts::TAU * frame as f64 / FRAMES as f64);
    Camera { eye: ball.center + turn * (camera.eye - ball.center), ..camera }
}

/// Goes around with two frames in flight. What was made in each frame, and the compared pictures.
fn go_around(scene: &Scene, settings: &Settings) -> (Vec<Vec<&'static str>>, Vec<Vec<u8>>) {
    let features = Features { large_points: true, draw_indirect_first_instance: true, ..Features::NEEDED };
    let host = Host::new(features);
    let ours = host.lend(faults::device(&host.instance, &host.device));
    let renderer = Renderer::new(&ours, None).unwrap();
    let mut slots = [0, 1].map(|_| InFlight::new(&host, &ours, settings.size_px));
    let prepared = upload(&host, &ours, &renderer, &mut slots[0], scene);
    let (mut made, mut pictures) = (Vec::new(), Vec::new());
    for frame in 0..FRAMES {
        let slot = &mut slots[frame % 2];
        slot.wait(&host, &ours);
        slot.begin(&host);
        faults::take_made();
        let (target, camera) = (slot.target(settings.size_px), camera(scene, settings, frame));
        // SAFETY: the slot's commands are recording, and its earlier submission was waited for; scene, renderer, slot and target
        // stay alive until its next wait.
        let plan = unsafe {
            let shown = SceneFrame::new(Seen { scene: &prepared, camera: &camera, settings }, &target);
            renderer.record(slot.commands, &mut slot.slot, &shown)
        }
        .unwrap();
        made.push(faults::take_made());
        if settings.rasterizer == Rasterizer::Compute {
            assert!(plan.passes.iter().any(|pass| pass.name == "fill tiles"), "{plan}");
        }
        slot.copy_target(&host, settings.size_px);
        slot.submit(&host, &ours);
        if COMPARED.contains(&frame) {
            slot.wait(&host, &ours);
            // SAFETY: waited for.
            pictures.push(unsafe { slot.pixels.bytes() }.to_vec());
        }
    }
    slots.iter_mut().for_each(|slot| slot.wait(&host, &ours));
    slots.into_iter().for_each(|slot| slot.destroy(&host));
    drop((prepared, renderer, ours));
    assert_eq!(host.destroy(), [] as [String; 0]);
    (made, pictures)
}

/// Sizes of lists follow what is visible. They have a reserve once they do, and shaders see none of it: pictures are
/// those of renderers that have drawn no frame before.
#[test]
fn a_camera_that_moves_makes_no_object_of_vulkan_once_it_is_under_way() {
    let scene = Scene { objects: vec![scenes::sphere(20_000, DVec3::ZERO)], ..Scene::default() };
    for rasterizer in [Rasterizer::Compute, Rasterizer::Perspective] {
        // Points have lists where they are asked for; tiles anyway.
        let settings = Settings { size_px: [128, 96], rasterizer, cull: Cull::List, ..Settings::default() };
        let (made, pictures) = go_around(&scene, &settings);
        let is_counted = ["create_buffer", "create_image", "create_compute_pipelines"];
        assert!(is_counted.iter().all(|function| made[0].contains(function)), "{:?}", made[0]);
        for (frame, made) in made.iter().enumerate().skip(SETTLED) {
            assert!(made.is_empty(), "{rasterizer:?}, frame {frame}: {made:?}");
        }
        for (frame, picture) in COMPARED.into_iter().zip(pictures) {
            let mut fresh = headless();
            let prepared = fresh.prepare(&scene, &|_, _| {}).unwrap();
            let wanted = Wanted { picture: true, ..Wanted::default() };
            let expected =
                fresh.render(&prepared, &camera(&scene, &settings, frame), &settings, wanted).unwrap();
            assert!(
                picture == bytemuck::cast_slice::<_, u8>(&expected.srgb),
                "{rasterizer:?}, frame {frame}"
            );
        }
    }
}
