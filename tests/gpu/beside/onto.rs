//! A view by one call, onto images of the engine's.

use ash::vk;
use glam::{
    DVec3,
    dcamera::rh::{proj::directx, view::look_at_mat4},
};
use surfel::{
    Settings,
    embed::{Device, HostCamera, HostImage, ImageState, Import, Placed, Rendering, View, ViewFrame},
    scene::{Rasterizer, Scene},
};

use super::{Beside, COLOR_FORMAT, RED, REVERSED, SIZE_PX, engine::Engine};
use crate::common::scenes;

/// A device that notes the barriers of images.
mod noted {
    use std::{
        cell::{Cell, RefCell},
        ffi::CStr,
    };

    use ash::vk;

    thread_local! {
        static BARRIERS: RefCell<Vec<vk::ImageMemoryBarrier2<'static>>> = const { RefCell::new(Vec::new()) };
        static OWN: Cell<Option<vk::PFN_vkCmdPipelineBarrier2>> = const { Cell::new(None) };
    }

    /// Those since the last time that this was asked for.
    pub fn take() -> Vec<vk::ImageMemoryBarrier2<'static>> {
        BARRIERS.take()
    }

    unsafe extern "system" fn barrier(commands: vk::CommandBuffer, info: *const vk::DependencyInfo<'_>) {
        // SAFETY: Vulkan's contract of the call; what is noted is not followed to what may be chained to it.
        unsafe {
            let vk::DependencyInfo {
                image_memory_barrier_count: count, p_image_memory_barriers: first, ..
            } = *info;
            if count > 0 {
                let all = std::slice::from_raw_parts(first.cast(), count as usize);
                BARRIERS.with_borrow_mut(|barriers| barriers.extend_from_slice(all));
            }
            if let Some(own) = OWN.get() {
                own(commands, info);
            }
        }
    }

    pub fn device(instance: &ash::Instance, own: &ash::Device) -> ash::Device {
        OWN.set(Some(own.fp_v1_3().cmd_pipeline_barrier2));
        let find = instance.fp_v1_0().get_device_proc_addr;
        let barrier: vk::PFN_vkCmdPipelineBarrier2 = barrier;
        let found = |name: &CStr| match name.to_bytes() {
            b"vkCmdPipelineBarrier2" => barrier as *const std::ffi::c_void,
            // SAFETY: a function of this device.
            _ => unsafe {
                std::mem::transmute::<vk::PFN_vkVoidFunction, *const std::ffi::c_void>(find(
                    own.handle(),
                    name.as_ptr(),
                ))
            },
        };
        // SAFETY: functions of this device, or one that calls it.
        unsafe { ash::Device::load_with(found, own.handle()) }
    }
}

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

const EXTENT: vk::Extent2D = vk::Extent2D { width: SIZE_PX[0], height: SIZE_PX[1] };

fn color_of(engine: &Engine) -> HostImage {
    HostImage::color(engine.color.image, engine.color.view, COLOR_FORMAT, EXTENT)
}

fn depth_of(engine: &Engine) -> HostImage {
    HostImage::depth(engine.depth.image, engine.depth.view, engine.style.depth_format, EXTENT)
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
            let color = given(color_of(engine));
            let depth = given(depth_of(engine));
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
    let [of_color, of_depth] = [color_of(engine), depth_of(engine)];
    let [color, depth] = [of_color, of_depth].map(Some);
    let refused = |view: &mut View, colors: &[Option<HostImage>], depth| {
        // SAFETY: refused before anything is recorded.
        unsafe { view.record(renderer, engine.commands, &frame, colors, depth) }.unwrap_err().to_string()
    };
    for colors in [&[][..], &[None], &[color, color]] {
        assert!(refused(view, colors, depth).starts_with("colors: expected an image for each format"));
    }
    assert!(refused(view, &[color], None).starts_with("depth: the view's rendering has one"));
    let wrong = HostImage { format: vk::Format::R8G8B8A8_UNORM, ..of_color };
    let expected =
        format!("colors[0].format: R8G8B8A8_UNORM: expected {COLOR_FORMAT:?}, as the view's rendering has");
    assert_eq!(refused(view, &[Some(wrong)], depth), expected);
    let wrong = HostImage { usage: vk::ImageUsageFlags::SAMPLED, ..of_color };
    assert_eq!(
        refused(view, &[Some(wrong)], depth),
        "colors[0].usage: SAMPLED: expected COLOR_ATTACHMENT among it"
    );
    let wrong = HostImage { usage: vk::ImageUsageFlags::COLOR_ATTACHMENT, ..of_depth };
    let expected = "depth.usage: COLOR_ATTACHMENT: expected DEPTH_STENCIL_ATTACHMENT among it";
    assert_eq!(refused(view, &[color], Some(wrong)), expected);
    let wrong = HostImage { extent: vk::Extent2D { height: SIZE_PX[1] - 1, ..EXTENT }, ..of_depth };
    assert_eq!(
        refused(view, &[color], Some(wrong)),
        "depth.extent: 160x119: expected 160x120 pixels from 0,0 on"
    );
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

/// An image that others have is acquired from them, and released to them: with their families, from their layout and to it. What is of no family, of our own, or has nothing in it, stays.
#[test]
fn images_of_another_family_are_acquired_and_released() {
    let camera = HostCamera {
        view_from_world: look_at_mat4(DVec3::new(0.4, 0.9, 4.0), DVec3::ZERO, DVec3::Y),
        clip_from_view: directx::perspective_infinite_reverse(0.7, 160.0 / 120.0, 0.5),
        flips_y: true,
    };
    crate::common::arm();
    let engine = Engine::new(REVERSED);
    let noted = noted::device(&engine.instance, &engine.device);
    // SAFETY: all is the engine's own, which goes last.
    let device = unsafe { Device::import(&Import { device: &noted, ..engine.lent() }) }.unwrap();
    let mut beside = Beside::on(engine, device);
    let ball = beside.upload(&Scene { objects: vec![scenes::sphere(3000, DVec3::ZERO)], ..Scene::default() });
    let scenes = [Placed::at_home(&ball)];
    let settings = Settings { size_px: SIZE_PX, ..Settings::default() };
    let frame = ViewFrame::new(&scenes, &camera, &settings);
    let (color, attached) = (color_of(&beside.engine), vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL);
    let Beside { engine, view, renderer, .. } = &mut beside;
    let (none, ours, other) = (vk::QUEUE_FAMILY_IGNORED, engine.family, vk::QUEUE_FAMILY_EXTERNAL);
    let general = |state: ImageState| ImageState { layout: vk::ImageLayout::GENERAL, ..state };
    let mut recorded = |color: HostImage| {
        engine.begin();
        engine.begin_rendering(true);
        engine.end_rendering();
        noted::take();
        // SAFETY: recording; never submitted.
        unsafe { view.record(renderer, engine.commands, &frame, &[Some(color)], Some(depth_of(engine))) }
            .unwrap();
        let mut of_color = noted::take();
        of_color.retain(|barrier| barrier.image == color.image);
        let seen = of_color.iter().map(|barrier| {
            let families = [barrier.src_queue_family_index, barrier.dst_queue_family_index];
            (families, [barrier.old_layout, barrier.new_layout])
        });
        seen.collect::<Vec<_>>()
    };
    let lent = HostImage { after: general(color.after), ..color };
    let layouts = [[attached; 2], [attached, vk::ImageLayout::GENERAL]];
    let stays = [none; 2];
    for (before, after, families) in [
        (none, none, [stays, stays]),
        (ours, ours, [stays, stays]),
        (other, none, [[other, ours], stays]),
        (none, other, [stays, [ours, other]]),
        (other, other, [[other, ours], [ours, other]]),
    ] {
        let seen = recorded(HostImage { family_before: before, family_after: after, ..lent });
        assert_eq!(seen, [(families[0], layouts[0]), (families[1], layouts[1])]);
    }
    let nothing = ImageState { layout: vk::ImageLayout::UNDEFINED, ..color.before };
    let seen = recorded(HostImage { family_before: other, before: nothing, ..color });
    assert_eq!(seen[0], (stays, [vk::ImageLayout::UNDEFINED, attached]));
    drop(ball);
    beside.end();
}
