//! Splats that move: a compute shader of the engine's writes their places each frame, into buffers of ours.
//!
//! `cargo run --release --example animated -- 8 wave%04d.png`.

#[path = "../engine/mod.rs"]
mod engine;

use engine::{COLOR_FORMAT, Compute, Engine, Style};
use glam::{
    DVec3,
    dcamera::rh::{proj::vulkan, view},
};
use surfel::{
    Settings,
    embed::{Device, DynamicSplats, HostCamera, Placed, Renderer, Rendering, View, ViewFrame},
};

const SIZE_PX: [u32; 2] = [480, 360];

/// Disks along a side of the sheet.
const SIDE: u32 = 128;

/// A sheet of disks from -1 to 1, on which a wave runs. Positions and a radius, normals and the 2.0 that every disk has there; colors as
/// 16-bit fractions.
const WAVE: &str = "#version 460
layout(local_size_x = 64) in;
layout(set = 0, binding = 0) writeonly buffer Shapes { vec4 shapes[]; };
layout(set = 0, binding = 1) writeonly buffer Colors { uvec2 colors[]; };
layout(push_constant) uniform Numbers { uint side; float time; };
void main()
{
    uint i = gl_GlobalInvocationID.x;
    if (i >= side * side) {
        return;
    }
    vec2 at = (vec2(i % side, i / side) + 0.5) * 2.0 / float(side) - 1.0;
    float distance = length(at);
    float phase = 9.0 * distance - time;
    vec2 slope = 0.12 * 9.0 * cos(phase) * at / max(distance, 1e-3);
    shapes[2 * i] = vec4(at.x, 0.12 * sin(phase), at.y, 2.4 / float(side));
    shapes[2 * i + 1] = vec4(normalize(vec3(-slope.x, 1.0, -slope.y)), 2.0);
    vec4 color = vec4(0.1, 0.35 + 0.3 * sin(phase), 0.7, 1.0);
    colors[i] = uvec2(packUnorm2x16(color.rg), packUnorm2x16(color.ba));
}";

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let count: u32 = arguments.next().map_or(Ok(8), |count| count.parse())?;
    let pattern = arguments.next().unwrap_or_else(|| "wave%04d.png".to_owned());
    let engine = Engine::new(Style::reversed(SIZE_PX));
    // SAFETY: all is the engine's own, and outlives what is made from it.
    let device = unsafe { Device::import(&engine.lent()) }?;
    let renderer = Renderer::new(&device, None)?;
    let rendering = Rendering { color_formats: vec![COLOR_FORMAT], ..Rendering::default() };
    let mut view = View::new(&renderer, &rendering)?;
    // What is known of all that the shader may write.
    let sheet = renderer.dynamic(&DynamicSplats {
        capacity: SIDE * SIDE,
        count: SIDE * SIDE,
        origin: DVec3::ZERO,
        bounds: [DVec3::new(-1.0, -0.12, -1.0), DVec3::new(1.0, 0.12, 1.0)],
        largest_radius: 2.5 / f64::from(SIDE),
        // 4.5 disks lie over a place where the sheet is level, 3 where it is steepest.
        overlap: 3.0,
        closed: false,
        transparent: false,
    })?;
    let buffers = sheet.dynamic_buffers().ok_or("the engine writes it")?;
    let wave = Compute::new(&engine, WAVE, [buffers.shapes, buffers.colors]);

    let camera = HostCamera {
        view_from_world: view::look_at_mat4(DVec3::new(1.2, 1.5, 2.4), DVec3::ZERO, DVec3::Y),
        clip_from_view: vulkan::perspective_infinite_reverse(0.7, 480.0 / 360.0, 0.1),
        flips_y: false,
    };
    let scenes = [Placed::at_home(&sheet)];
    let settings = Settings { size_px: SIZE_PX, ..Settings::default() };
    for number in 0..count {
        engine.begin();
        let time = std::f32::consts::TAU * number as f32 / count as f32;
        wave.dispatch(&engine, (SIDE * SIDE).div_ceil(64), [SIDE, time.to_bits()]);
        let frame = ViewFrame::new(&scenes, &camera, &settings);
        // SAFETY: recording, outside of rendering; all is alive until the wait.
        unsafe { view.prepare(&renderer, engine.commands, &frame) }?;
        engine.begin_rendering(true);
        // SAFETY: inside of the rendering that the view was made for.
        unsafe { view.draw(&renderer, engine.commands) }?;
        engine.end_rendering();
        engine.submit();
        let epoch = device.end_epoch();
        engine.wait();
        // SAFETY: waited for.
        unsafe { device.epoch_done(epoch) };
        engine.save(&pattern.replace("%04d", &format!("{number:04}")))?;
    }
    println!("{count} pictures, {pattern}");
    wave.destroy(&engine);
    drop((view, sheet, renderer, device));
    engine.end()
}
