//! Splats that the engine writes on the device.

use ash::vk;
use glam::{
    DVec3,
    dcamera::rh::{proj::directx, view::look_at_mat4},
};
use surfel::{
    Settings,
    embed::{DynamicSplats, HostCamera, Placed, dynamic},
    scene::{Cull, Rasterizer, Scene, Shapes},
};

use super::{Beside, REVERSED, SIZE_PX};
use crate::common::scenes;

const BEHIND: [DVec3; 3] =
    [DVec3::new(-90.0, -60.0, -30.0), DVec3::new(90.0, -60.0, -30.0), DVec3::new(0.0, 90.0, -30.0)];

/// As many as one command copies.
const COUNT: usize = 1500;

#[test]
fn what_an_engine_writes_is_seen_as_what_is_uploaded() {
    let camera = HostCamera {
        view_from_world: look_at_mat4(DVec3::new(0.4, 0.9, 4.0), DVec3::ZERO, DVec3::Y),
        clip_from_view: directx::perspective_infinite_reverse(0.7, 160.0 / 120.0, 0.5),
        flips_y: true,
    };
    let mut beside = Beside::new(REVERSED);
    // The scene from its own middle, which f32 has exactly.
    let origin = DVec3::new(0.25, -0.125, 0.5);
    let ball = scenes::sphere(COUNT, origin);
    let Shapes::Disks { normals, radii } = &ball.splats.shapes else { panic!("a ball of disks") };
    let from_origin = |i: usize| (ball.splats.positions[i] - origin).as_vec3();
    let shapes: Vec<_> =
        (0..COUNT).flat_map(|i| dynamic::disk(from_origin(i), radii[i], normals[i].normalize())).collect();
    let colors: Vec<_> = (0..COUNT).flat_map(|i| dynamic::color(ball.splats.color(i))).collect();
    let splats = DynamicSplats {
        capacity: COUNT as u32,
        count: COUNT as u32,
        origin,
        bounds: [DVec3::splat(-1.01), DVec3::splat(1.01)],
        largest_radius: radii.iter().copied().fold(0.0, f32::max).into(),
        overlap: 2.0,
        closed: true,
        transparent: false,
    };
    let mut written = beside.renderer.dynamic(&splats).unwrap();
    let buffers = written.dynamic_buffers().unwrap();
    let uploaded = beside.upload(&Scene { objects: vec![ball], ..Scene::default() });
    assert!(uploaded.dynamic_buffers().is_none());
    let hard = |rasterizer| Settings {
        size_px: SIZE_PX,
        edges: surfel::scene::Edges::Hard,
        rasterizer,
        ..Settings::default()
    };
    beside.engine.begin();
    // SAFETY: recording, outside of rendering; both buffers are as large.
    unsafe {
        let (device, commands) = (&beside.engine.device, beside.engine.commands);
        device.cmd_update_buffer(commands, buffers.shapes, 0, bytemuck::cast_slice(&shapes));
        device.cmd_update_buffer(commands, buffers.colors, 0, bytemuck::cast_slice(&colors));
        let barriers = [vk::MemoryBarrier2::default()
            .src_stage_mask(vk::PipelineStageFlags2::ALL_TRANSFER)
            .src_access_mask(vk::AccessFlags2::TRANSFER_WRITE)
            .dst_stage_mask(vk::PipelineStageFlags2::COMPUTE_SHADER | vk::PipelineStageFlags2::VERTEX_SHADER)
            .dst_access_mask(vk::AccessFlags2::SHADER_STORAGE_READ)];
        device.cmd_pipeline_barrier2(commands, &vk::DependencyInfo::default().memory_barriers(&barriers));
    }
    beside.engine.begin_rendering(true);
    beside.engine.end_rendering();
    beside.submit();

    for rasterizer in [Rasterizer::Compute, Rasterizer::Perspective] {
        let mut picture = |scene| {
            beside.draw(&[Placed::at_home(scene)], &camera, &hard(rasterizer), &BEHIND, false);
            beside.engine.pixels()
        };
        let (of_written, of_uploaded) = (picture(&written), picture(&uploaded));
        let off = of_written.iter().flatten().zip(of_uploaded.iter().flatten()).map(|(a, b)| (a - b).abs());
        let (far, largest) =
            off.fold((0, 0.0), |(far, largest), off| (far + u32::from(off > 1e-3), f32::max(largest, off)));
        println!("{rasterizer:?}: {far} values differ by more than 1e-3, the largest by {largest}");
        // In another order, and rounded from another origin: a splat belongs to the nearest surface or not, now and then.
        assert!(far <= 40, "{far}");
    }

    // Fewer, and then none: nothing is written again. Whatever looks through them, block by block or one by one.
    let count_red = |pixels: &[[f32; 4]]| pixels.iter().filter(|pixel| **pixel == super::RED).count();
    for cull in [Cull::Auto, Cull::Setup] {
        let settings = Settings { cull, ..hard(Rasterizer::Perspective) };
        let mut red_of = |count| {
            written.set_dynamic(&DynamicSplats { count, ..splats }).unwrap();
            beside.draw(&[Placed::at_home(&written)], &camera, &settings, &BEHIND, false);
            count_red(&beside.engine.pixels())
        };
        let [all, some, none] = [COUNT as u32, 100, 0].map(&mut red_of);
        assert!(
            all < some && some < none && none == (SIZE_PX[0] * SIZE_PX[1]) as usize,
            "{all} {some} {none}"
        );
    }
    let refused = written.set_dynamic(&DynamicSplats { closed: false, ..splats }).unwrap_err().to_string();
    assert!(refused.contains("expected those that the scene was made with"), "{refused}");
    drop((written, uploaded));
    beside.end();
}
