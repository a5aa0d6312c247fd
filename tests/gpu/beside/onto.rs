//! A view by one call, onto images of the engine's.

use ash::vk;
use glam::{
    DVec3,
    dcamera::rh::{proj::directx, view::look_at_mat4},
};
use surfel::{
    Settings,
    embed::{HostCamera, HostImage, ImageState, Placed, Rendering, View, ViewFrame},
    scene::{Rasterizer, Scene},
};

use super::{Beside, COLOR_FORMAT, RED, REVERSED, SIZE_PX, engine::Engine};
use crate::common::scenes;

const CORNERS: [DVec3; 3] =
    [DVec3::new(-30.0, -20.0, 12.0), DVec3::new(30.0, -20.0, 3.0), DVec3::new(0.0, 30.0, -14.0)];

/// Whatever was done, and will be.
const ALL: ImageState = ImageState {
    stages: vk::PipelineStageFlags2::ALL_COMMANDS,
    access: vk::AccessFlags2::from_raw(
        vk::AccessFlags2::MEMORY_READ.as_raw() | vk::AccessFlags2::MEMORY_WRITE.as_raw(),
    ),
    layout: vk::ImageLayout::UNDEFINED,
};

/// The engine brings its images into another layout.
fn bring(engine: &Engine, from: vk::ImageLayout, to: vk::ImageLayout) {
    let images = [
        (engine.color.image, vk::ImageAspectFlags::COLOR),
        (engine.depth.image, vk::ImageAspectFlags::DEPTH),
    ];
    let barriers = images.map(|(image, aspect)| {
        let range = vk::ImageSubresourceRange::default().aspect_mask(aspect).level_count(1).layer_count(1);
        vk::ImageMemoryBarrier2::default()
            .src_stage_mask(ALL.stages)
            .src_access_mask(ALL.access)
            .dst_stage_mask(ALL.stages)
            .dst_access_mask(ALL.access)
            .old_layout(from)
            .new_layout(to)
            .image(image)
            .subresource_range(range)
    });
    let info = vk::DependencyInfo::default().image_memory_barriers(&barriers);
    // SAFETY: recording, outside of rendering.
    unsafe { engine.device.cmd_pipeline_barrier2(engine.commands, &info) };
}

/// Over what is there it is what two calls within the engine's own rendering draw; where nothing is there, what they draw over nothing. The engine's images are left as it says.
#[test]
fn one_call_draws_what_two_draw() {
    let camera = HostCamera {
        view_from_world: look_at_mat4(DVec3::new(0.4, 0.9, 4.0), DVec3::ZERO, DVec3::Y),
        clip_from_view: directx::perspective_infinite_reverse(0.7, 160.0 / 120.0, 0.5),
        flips_y: true,
    };
    let mut beside = Beside::new(REVERSED);
    let ball = beside.upload(&Scene { objects: vec![scenes::sphere(3000, DVec3::ZERO)], ..Scene::default() });
    let scenes = [Placed::at_home(&ball)];
    for rasterizer in [Rasterizer::Compute, Rasterizer::Perspective] {
        let settings = Settings { size_px: SIZE_PX, rasterizer, ..Settings::default() };
        beside.draw(&scenes, &camera, &settings, &CORNERS, false);
        let over = (beside.engine.pixels(), beside.engine.depths());
        for clears in [false, true] {
            let in_clip =
                |at: DVec3| (camera.clip_from_view * camera.view_from_world * at.extend(1.0)).as_vec4();
            let corners = CORNERS.map(|at| in_clip(at).to_array());
            let Beside { engine, view, renderer, .. } = &mut beside;
            engine.begin();
            engine.begin_rendering(true);
            engine.triangle(corners, RED, camera.flips_y);
            engine.end_rendering();
            // They are lent in a layout in which nothing is drawn, and given back so.
            let (lent, attached) = (vk::ImageLayout::GENERAL, vk::ImageLayout::ATTACHMENT_OPTIMAL);
            bring(engine, attached, lent);
            let given = |image: HostImage| {
                let before = if clears { vk::ImageLayout::UNDEFINED } else { lent };
                HostImage {
                    before: ImageState { layout: before, ..ALL },
                    after: ImageState { layout: lent, ..ALL },
                    ..image
                }
            };
            let color = given(HostImage::color(engine.color.image, engine.color.view));
            let depth = given(HostImage::depth(engine.depth.image, engine.depth.view));
            let frame = ViewFrame::new(&scenes, &camera, &settings);
            // SAFETY: recording, outside of rendering; all is alive until the wait.
            unsafe { view.record(renderer, engine.commands, &frame, &[Some(color)], Some(depth)) }.unwrap();
            bring(engine, lent, attached);
            beside.submit();
            let drawn = (beside.engine.pixels(), beside.engine.depths());
            if !clears {
                assert!(drawn == over, "{rasterizer:?}");
                continue;
            }
            // As if the triangle were behind all.
            let Beside { engine, view, renderer, .. } = &mut beside;
            engine.begin();
            // SAFETY: as above.
            unsafe { view.prepare(renderer, engine.commands, &frame) }.unwrap();
            engine.begin_rendering(true);
            // SAFETY: inside of the rendering that the view was made for.
            unsafe { view.draw(renderer, engine.commands) }.unwrap();
            engine.end_rendering();
            beside.submit();
            assert!(drawn == (beside.engine.pixels(), beside.engine.depths()), "{rasterizer:?}");
            assert!(drawn.0 != over.0);
        }
    }
    // Images that the view's rendering does not have.
    let Beside { engine, view, renderer, .. } = &mut beside;
    let settings = Settings { size_px: SIZE_PX, ..Settings::default() };
    let frame = ViewFrame::new(&scenes, &camera, &settings);
    let color = Some(HostImage::color(engine.color.image, engine.color.view));
    let depth = Some(HostImage::depth(engine.depth.image, engine.depth.view));
    let refused = |view: &mut View, colors: &[Option<HostImage>], depth| {
        // SAFETY: refused before anything is recorded.
        unsafe { view.record(renderer, engine.commands, &frame, colors, depth) }.unwrap_err().to_string()
    };
    for colors in [&[][..], &[None], &[color, color]] {
        assert!(refused(view, colors, depth).starts_with("colors: expected an image for each format"));
    }
    assert!(refused(view, &[color], None).starts_with("depth: the view's rendering has one"));
    let without = Rendering {
        color_formats: vec![COLOR_FORMAT],
        depth_format: vk::Format::UNDEFINED,
        ..Rendering::default()
    };
    let mut without = View::new(renderer, &without).unwrap();
    assert!(refused(&mut without, &[color], depth).starts_with("depth: the view's rendering has none"));
    drop((without, ball));
    beside.end();
}
