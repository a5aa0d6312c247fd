//! Two eyes in one frame: two views of the same scenes, side by side in one image of an engine, each with its own off-center projection.
//!
//! `cargo run --release --example stereo -- stereo.png`, to be looked at with crossed eyes.

#[path = "../engine/mod.rs"]
mod engine;

use ash::vk;
use engine::{COLOR_FORMAT, Engine, Style};
use glam::{
    DVec3,
    dcamera::rh::{proj::vulkan, view},
};
use surfel::{
    Scene, Settings,
    embed::{Device, HostCamera, Placed, Renderer, Rendering, View, ViewFrame},
};

/// Of one eye.
const SIZE_PX: [u32; 2] = [400, 400];

/// How far the eyes are apart, and where both look at the same place, in the scene's unit.
const APART: f64 = 0.3;
const MEETS_AT: f64 = 3.6;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let engine = Engine::new(Style {
        compare: vk::CompareOp::LESS,
        clear_depth: 1.0,
        ..Style::reversed([2 * SIZE_PX[0], SIZE_PX[1]])
    });
    // SAFETY: all is the engine's own, and outlives what is made from it.
    let device = unsafe { Device::import(&engine.lent()) }?;
    let renderer = Renderer::new(&device, None)?;
    let rendering =
        Rendering { color_formats: vec![COLOR_FORMAT], compare: vk::CompareOp::LESS, ..Rendering::default() };
    let mut views = [View::new(&renderer, &rendering)?, View::new(&renderer, &rendering)?];
    let scene = Scene::from(surfel::load::builtin::relief(40_000));

    engine.begin();
    // SAFETY: recording; submitted below.
    let prepared = unsafe { renderer.upload(engine.commands, &scene) }?;
    let scenes = [Placed::at_home(&prepared)];
    let settings = Settings { size_px: SIZE_PX, ..Settings::default() };
    for (number, view) in (0..).zip(&mut views) {
        let side = 0.5 * APART * if number == 0 { 1.0 } else { -1.0 };
        // A frustum that is the same at the place where both look.
        let (near, far, half) = (0.1, 20.0, 0.038);
        let shift = side * near / MEETS_AT;
        let camera = HostCamera {
            view_from_world: view::look_to_mat4(DVec3::new(side, 0.0, MEETS_AT), -DVec3::Z, DVec3::Y),
            clip_from_view: vulkan::frustum(-half - shift, half - shift, -half, half, near, far),
            flips_y: false,
        };
        let frame = ViewFrame {
            corner_px: [number * SIZE_PX[0] as i32, 0],
            ..ViewFrame::new(&scenes, &camera, &settings)
        };
        // SAFETY: recording, outside of rendering; all is alive until the wait.
        unsafe { view.prepare(&renderer, engine.commands, &frame) }?;
    }
    engine.begin_rendering(true);
    for view in &views {
        // SAFETY: inside of the rendering that the view was made for.
        unsafe { view.draw(&renderer, engine.commands) }?;
    }
    engine.end_rendering();
    engine.submit();
    let epoch = device.end_epoch();
    engine.wait();
    // SAFETY: waited for.
    unsafe { device.epoch_done(epoch) };

    let file = std::env::args().nth(1).unwrap_or_else(|| "stereo.png".to_owned());
    engine.save(&file)?;
    println!("{file}");
    drop((views, prepared, renderer, device));
    engine.end()
}
