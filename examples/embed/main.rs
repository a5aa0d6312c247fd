//! Splats within an engine: its own device, triangles, depth and submission; each hides the other where it is nearer.
//!
//! `cargo run --release --example embed -- out.png`. All that concerns splats is between the two lines below, as `docs/embedding.md` has it; `examples/engine/` is what an engine has anyway.

#[path = "../engine/mod.rs"]
mod engine;

use engine::{COLOR_FORMAT, Engine, Style};
use glam::{
    DVec3,
    dcamera::rh::{proj::vulkan, view},
};
use surfel::{
    Scene, Settings,
    embed::{Device, HostCamera, Import, Placed, Placement, Renderer, Rendering, View, ViewFrame},
};

const SIZE_PX: [u32; 2] = [640, 480];

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let engine = Engine::new(Style::reversed(SIZE_PX));
    // ---- Splats
    // Once: the engine's device becomes ours too, and a scene goes there.
    let host = Import {
        instance: &engine.instance,
        debug_utils: true,
        physical: engine.physical,
        device: &engine.device,
        queue_family: engine.family,
        enabled: engine.enabled,
        memory: None,
    };
    // SAFETY: all is the engine's own, and outlives what is made from it.
    let device = unsafe { Device::import(&host) }?;
    let renderer = Renderer::new(&device, None)?;
    let rendering = Rendering { color_formats: vec![COLOR_FORMAT], ..Rendering::default() };
    let mut view = View::new(&renderer, &rendering)?;
    let scene = Scene::from(surfel::load::builtin::sphere(40_000));

    engine.begin();
    // SAFETY: recording; submitted below.
    let ball = unsafe { renderer.upload(engine.commands, &scene) }?;

    // Each frame: scenes stand where the engine says; its camera is ours.
    let camera = HostCamera {
        view_from_world: view::look_at_mat4(DVec3::new(0.0, 1.2, 4.5), DVec3::ZERO, DVec3::Y),
        clip_from_view: vulkan::perspective_infinite_reverse(0.8, 640.0 / 480.0, 0.1),
        flips_y: false,
    };
    let at = |x, scale| Placement { translation: DVec3::new(x, 0.0, 0.0), scale, ..Placement::default() };
    let scenes = [Placed::new(&ball, at(-0.6, 1.0)), Placed::new(&ball, at(1.1, 0.6))];
    let settings = Settings { size_px: SIZE_PX, ..Settings::default() };
    let frame = ViewFrame::new(&scenes, &camera, &settings);
    // SAFETY: recording, outside of rendering; all is alive until the wait.
    unsafe { view.prepare(&renderer, engine.commands, &frame) }?;

    engine.begin_rendering(true);
    let corners = [DVec3::new(-2.0, -0.9, 0.7), DVec3::new(2.0, -0.6, 0.7), DVec3::new(0.0, 0.9, -0.7)];
    let in_clip = |at: DVec3| (camera.clip_from_view * camera.view_from_world * at.extend(1.0)).as_vec4();
    engine.triangle(corners.map(|at| in_clip(at).to_array()), [0.9, 0.4, 0.05, 1.0], camera.flips_y);
    // SAFETY: inside of the rendering that the view was made for.
    unsafe { view.draw(&renderer, engine.commands) }?;
    // What comes later is hidden by splats.
    let later = corners.map(|at| in_clip(DVec3::new(-0.8 * at.x, at.y + 0.3, -at.z)).to_array());
    engine.triangle(later, [0.1, 0.5, 0.3, 1.0], camera.flips_y);
    engine.end_rendering();
    engine.submit();
    let epoch = device.end_epoch();
    engine.wait();
    // SAFETY: waited for.
    unsafe { device.epoch_done(epoch) };
    // ----

    let file = std::env::args().nth(1).unwrap_or_else(|| "embed.png".to_owned());
    engine.save(&file)?;
    let [width, height] = SIZE_PX.map(|side| side as usize);
    println!("{file}; the depth in its middle is {}", engine.depths()[height / 2 * width + width / 2]);
    drop((view, ball, renderer, device));
    engine.end()
}
