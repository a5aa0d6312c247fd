//! Depth alone, as for a map of shadows: a host's rendering has no image of colors.

use ash::vk;
use glam::{
    DVec3,
    dcamera::rh::{proj::directx, view::look_at_mat4},
};
use surfel::{
    Settings,
    embed::{HostCamera, Placed, Placement, Rendering, View, ViewFrame},
    scene::{Colors, Edges, Rasterizer, Scene},
};

use super::{Beside, RED, REVERSED, SIZE_PX, conventions::step_of};
use crate::common::scenes;

/// Cuts the ball.
const CORNERS: [DVec3; 3] =
    [DVec3::new(-30.0, -20.0, 12.0), DVec3::new(30.0, -20.0, 3.0), DVec3::new(0.0, 30.0, -14.0)];

/// A rendering over what there is, of depth alone.
fn begin(beside: &Beside) {
    let engine = &beside.engine;
    let depth = vk::RenderingAttachmentInfo::default()
        .image_view(engine.depth.view)
        .image_layout(vk::ImageLayout::ATTACHMENT_OPTIMAL)
        .load_op(vk::AttachmentLoadOp::LOAD)
        .store_op(vk::AttachmentStoreOp::STORE);
    let [width, height] = SIZE_PX;
    let all = vk::AccessFlags2::MEMORY_READ | vk::AccessFlags2::MEMORY_WRITE;
    let barriers = [vk::MemoryBarrier2::default()
        .src_stage_mask(vk::PipelineStageFlags2::ALL_COMMANDS)
        .src_access_mask(all)
        .dst_stage_mask(vk::PipelineStageFlags2::ALL_COMMANDS)
        .dst_access_mask(all)];
    let info = vk::RenderingInfo::default()
        .render_area(vk::Extent2D { width, height }.into())
        .layer_count(1)
        .depth_attachment(&depth);
    // SAFETY: recording, outside of rendering; the images are in this layout.
    unsafe {
        let dependencies = vk::DependencyInfo::default().memory_barriers(&barriers);
        engine.device.cmd_pipeline_barrier2(engine.commands, &dependencies);
        engine.device.cmd_begin_rendering(engine.commands, &info);
    }
}

/// But for two steps of 32 bits, for pipelines may divide in their own ways; whatever draws it, and beside what is transparent, which leaves
/// no depth.
#[test]
fn depth_without_a_picture_is_that_of_the_picture() {
    let camera = HostCamera {
        view_from_world: look_at_mat4(DVec3::new(0.4, 0.9, 4.0), DVec3::ZERO, DVec3::Y),
        clip_from_view: directx::perspective_infinite_reverse(0.7, 160.0 / 120.0, 0.5),
        flips_y: true,
    };
    let mut beside = Beside::new(REVERSED);
    let ball = scenes::sphere(3000, DVec3::ZERO);
    let mut glass = ball.clone();
    glass.splats.colors = Colors::Uniform([0.5, 0.6, 0.7, 0.4]);
    let [ball, glass] =
        [ball, glass].map(|object| beside.upload(&Scene { objects: vec![object], ..Scene::default() }));
    let beside_it = Placement { translation: DVec3::new(0.7, 0.3, 0.9), ..Placement::default() };
    let scenes = [Placed::at_home(&ball), Placed::new(&glass, beside_it)];
    let none = Rendering { color_formats: Vec::new(), ..Rendering::default() };
    let mut alone = View::new(&beside.renderer, &none).unwrap();
    for rasterizer in [Rasterizer::Compute, Rasterizer::Perspective] {
        for edges in [Edges::Hard, Edges::Coverage] {
            let settings = Settings { size_px: SIZE_PX, rasterizer, edges, ..Settings::default() };
            beside.draw(&scenes, &camera, &settings, &CORNERS, true);
            let depths = beside.engine.depths();
            let in_clip =
                |at: DVec3| (camera.clip_from_view * camera.view_from_world * at.extend(1.0)).as_vec4();
            let frame = ViewFrame::new(&scenes, &camera, &settings);
            beside.engine.begin();
            beside.engine.begin_rendering(true);
            beside.engine.triangle(CORNERS.map(|at| in_clip(at).to_array()), RED, camera.flips_y);
            beside.engine.end_rendering();
            // SAFETY: recording; all is alive until the wait.
            unsafe { alone.prepare(&beside.renderer, beside.engine.commands, &frame) }.unwrap();
            begin(&beside);
            // SAFETY: inside of the rendering that the view was made for.
            unsafe { alone.draw(&beside.renderer, beside.engine.commands) }.unwrap();
            beside.engine.end_rendering();
            beside.submit();
            let apart: Vec<_> = beside
                .engine
                .depths()
                .into_iter()
                .zip(depths.clone())
                .filter(|(a, b)| (a - b).abs() > 2.0 * step_of(vk::Format::D32_SFLOAT, *b))
                .collect();
            let some = &apart[..apart.len().min(3)];
            assert!(apart.is_empty(), "{rasterizer:?}, {edges:?}: {} differ, such as {some:?}", apart.len());
            let reds = beside.engine.pixels().iter().filter(|color| **color == RED).count();
            assert_eq!(reds, depths.len(), "{rasterizer:?}, {edges:?}: the picture is the engine's");
            beside.draw(&[], &camera, &settings, &CORNERS, false);
            let changed =
                beside.engine.depths().iter().zip(&depths).filter(|(one, other)| one != other).count();
            assert!(changed > 500, "{changed} pixels of the ball have its depth");
        }
    }
    drop((alone, ball, glass));
    beside.end();
}
