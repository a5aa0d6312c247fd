//! A pass of the engine's own behind splats: fog by the depth that they have written, and lines where one object ends, by their numbers.
//!
//! `cargo run --release --example custom_pass -- out.png`. All that concerns splats is in [`main`]; `examples/engine/` is what an engine has anyway.

#[path = "../engine/mod.rs"]
mod engine;

use engine::{COLOR_FORMAT, Engine, OBJECT_FORMATS, Screen, Style};
use glam::{
    DVec3,
    dcamera::rh::{proj::vulkan, view},
};
use surfel::{
    Scene, Settings,
    embed::{Device, HostCamera, Placed, Placement, Renderer, Rendering, View, ViewFrame},
};

const SIZE_PX: [u32; 2] = [640, 480];

const NEAR: f64 = 0.1;

/// The engine's shader.
const FOG_AND_LINES: &str = "#version 460
#extension GL_EXT_samplerless_texture_functions : require
layout(set = 0, binding = 0) uniform texture2D depth;    // near / z
layout(set = 0, binding = 1) uniform utexture2D numbers; // of objects
layout(push_constant) uniform Numbers { float near; };
layout(location = 0) out vec4 color;

void main()
{
    ivec2 at = ivec2(gl_FragCoord.xy);
    uint own = texelFetch(numbers, at, 0).r;
    ivec2 last = textureSize(numbers, 0) - 1;
    bool ends = false;
    for (int side = 0; side < 4; side++) {
        ivec2 step = ivec2(side < 2 ? 1 - 2 * side : 0, side < 2 ? 0 : 5 - 2 * side);
        ends = ends || texelFetch(numbers, clamp(at + step, ivec2(0), last), 0).r < own;
    }
    float d = texelFetch(depth, at, 0).r;
    float fog = d > 0.0 ? 1.0 - exp(-0.12 * max(near / d - 3.0, 0.0)) : 0.0;
    color = ends ? vec4(0.0, 0.0, 0.0, 1.0) : vec4(0.55, 0.62, 0.7, fog);
}";

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let engine = Engine::new(Style { tells_objects: true, ..Style::reversed(SIZE_PX) });
    // SAFETY: all is the engine's own, and outlives what is made from it.
    let device = unsafe { Device::import(&engine.lent()) }?;
    let renderer = Renderer::new(&device, None)?;
    // Numbers of objects are the second attachment, motion the third.
    let [ids, motion] = OBJECT_FORMATS;
    let color_formats = vec![COLOR_FORMAT, ids, motion];
    let rendering = Rendering { color_formats, ids: true, motion: true, ..Rendering::default() };
    let mut view = View::new(&renderer, &rendering)?;
    let scene = Scene::from(surfel::load::builtin::sphere(40_000));
    let fog_and_lines = Screen::new(&engine, FOG_AND_LINES);

    engine.begin();
    // SAFETY: recording; submitted below.
    let ball = unsafe { renderer.upload(engine.commands, &scene) }?;
    let camera = HostCamera {
        view_from_world: view::look_at_mat4(DVec3::new(0.0, 1.6, 5.0), DVec3::new(0.0, 0.0, -1.0), DVec3::Y),
        clip_from_view: vulkan::perspective_infinite_reverse(0.8, 640.0 / 480.0, NEAR),
        flips_y: false,
    };
    // One scene, many times: each with a number and a color of its own, and each has come a step nearer since the frame before.
    let placed = |i: u32| {
        let [column, row] = [i % 4, i / 4].map(f64::from);
        let at = |z| Placement {
            translation: DVec3::new(1.2 * column - 1.8, 0.2 * row, z - 2.0 * row),
            scale: 0.6,
            ..Placement::default()
        };
        let tint = [1.0 - 0.25 * column as f32, 0.4 + 0.2 * row as f32, 0.3 + 0.2 * column as f32, 1.0];
        Placed { before: Some(at(0.9)), id: 1 + i, tint, ..Placed::new(&ball, at(1.0)) }
    };
    let scenes: Vec<_> = (0..16).map(placed).collect();
    let settings = Settings { size_px: SIZE_PX, ..Settings::default() };
    let frame = ViewFrame::new(&scenes, &camera, &settings);
    // SAFETY: recording, outside of rendering; all is alive until the wait.
    unsafe { view.prepare(&renderer, engine.commands, &frame) }?;

    engine.begin_rendering(true);
    let corners = [DVec3::new(-9.0, -0.7, 3.0), DVec3::new(9.0, -0.7, 3.0), DVec3::new(0.0, -0.1, -40.0)];
    let in_clip = |at: DVec3| (camera.clip_from_view * camera.view_from_world * at.extend(1.0)).as_vec4();
    engine.triangle(corners.map(|at| in_clip(at).to_array()), [0.2, 0.25, 0.15, 1.0], camera.flips_y);
    // SAFETY: inside of the rendering that the view was made for.
    unsafe { view.draw(&renderer, engine.commands) }?;
    engine.end_rendering();
    fog_and_lines.draw(&engine, NEAR as f32);
    engine.submit();
    let epoch = device.end_epoch();
    engine.wait();
    // SAFETY: waited for.
    unsafe { device.epoch_done(epoch) };

    let file = std::env::args().nth(1).unwrap_or_else(|| "custom_pass.png".to_owned());
    engine.save(&file)?;
    let (numbers, moved) = engine.told();
    let middle = (SIZE_PX[1] * SIZE_PX[0] / 2 + SIZE_PX[0] * 5 / 8) as usize;
    println!(
        "{file}; right of its middle is object {}, which has moved by {:?} pixels",
        numbers[middle], moved[middle]
    );
    fog_and_lines.destroy(&engine);
    drop((view, ball, renderer, device));
    engine.end()
}
