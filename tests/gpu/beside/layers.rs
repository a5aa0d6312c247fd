//! Layers of one image, as an engine has them for two eyes: a view draws each, by its own depth, and no other one.

use ash::vk;
use glam::{
    DVec3,
    dcamera::rh::{proj::directx, view::look_at_mat4},
};
use surfel::{
    Settings,
    embed::{DepthImage, HostCamera, HostImage, ImageState, Placed, Rendering, View, ViewFrame},
    scene::{Colors, Scene},
};

use super::{Beside, COLOR_FORMAT, RED, REVERSED, SIZE_PX, engine::Engine};
use crate::common::scenes;

const LAYERS: u32 = 2;
const EXTENT: vk::Extent2D = vk::Extent2D { width: SIZE_PX[0], height: SIZE_PX[1] };

/// The layout in which the engine draws.
const ATTACHED: vk::ImageLayout = vk::ImageLayout::ATTACHMENT_OPTIMAL;

/// Whatever was done, and will be.
const ALL: ImageState = ImageState {
    stages: vk::PipelineStageFlags2::ALL_COMMANDS,
    access: vk::AccessFlags2::from_raw(
        vk::AccessFlags2::MEMORY_READ.as_raw() | vk::AccessFlags2::MEMORY_WRITE.as_raw(),
    ),
    layout: vk::ImageLayout::UNDEFINED,
};

/// What one layer has in bytes: of color, and of depth.
const BYTES: [u64; 2] = [16, 4];

/// An image of two layers, with a view of each.
struct Layered {
    image: vk::Image,
    views: [vk::ImageView; LAYERS as usize],
    memory: vk::DeviceMemory,
    aspect: vk::ImageAspectFlags,
}

/// Memory of the engine's that has the wanted properties.
unsafe fn memory(
    engine: &Engine,
    needed: vk::MemoryRequirements,
    wanted: vk::MemoryPropertyFlags,
) -> vk::DeviceMemory {
    // SAFETY: all handles are the engine's own.
    unsafe {
        let types = engine.instance.get_physical_device_memory_properties(engine.physical);
        let fits = |i: &u32| {
            needed.memory_type_bits & (1 << i) != 0
                && types.memory_types[*i as usize].property_flags.contains(wanted)
        };
        let kind = (0..types.memory_type_count).find(fits).unwrap();
        let info = vk::MemoryAllocateInfo::default().allocation_size(needed.size).memory_type_index(kind);
        engine.device.allocate_memory(&info, None).unwrap()
    }
}

impl Layered {
    unsafe fn new(
        engine: &Engine,
        format: vk::Format,
        aspect: vk::ImageAspectFlags,
        usage: vk::ImageUsageFlags,
    ) -> Self {
        let info = vk::ImageCreateInfo::default()
            .image_type(vk::ImageType::TYPE_2D)
            .format(format)
            .extent(vk::Extent3D { width: EXTENT.width, height: EXTENT.height, depth: 1 })
            .mip_levels(1)
            .array_layers(LAYERS)
            .samples(vk::SampleCountFlags::TYPE_1)
            .usage(usage | vk::ImageUsageFlags::TRANSFER_SRC);
        // SAFETY: all handles are the engine's own.
        unsafe {
            let image = engine.device.create_image(&info, None).unwrap();
            let needed = engine.device.get_image_memory_requirements(image);
            let memory = memory(engine, needed, vk::MemoryPropertyFlags::DEVICE_LOCAL);
            engine.device.bind_image_memory(image, memory, 0).unwrap();
            let views = [0, 1].map(|layer| {
                let info = vk::ImageViewCreateInfo::default()
                    .image(image)
                    .view_type(vk::ImageViewType::TYPE_2D)
                    .format(format)
                    .subresource_range(range(aspect, layer));
                engine.device.create_image_view(&info, None).unwrap()
            });
            Self { image, views, memory, aspect }
        }
    }

    unsafe fn destroy(self, engine: &Engine) {
        // SAFETY: nothing is under way.
        unsafe {
            self.views.into_iter().for_each(|view| engine.device.destroy_image_view(view, None));
            engine.device.destroy_image(self.image, None);
            engine.device.free_memory(self.memory, None);
        }
    }

    /// Brings a layer from one layout to another, after all that was done and before all that will be.
    unsafe fn bring(&self, engine: &Engine, layer: u32, [from, to]: [vk::ImageLayout; 2]) {
        let ImageState { stages, access, .. } = ALL;
        let barriers = [vk::ImageMemoryBarrier2::default()
            .src_stage_mask(stages)
            .src_access_mask(access)
            .dst_stage_mask(stages)
            .dst_access_mask(access)
            .old_layout(from)
            .new_layout(to)
            .image(self.image)
            .subresource_range(range(self.aspect, layer))];
        let info = vk::DependencyInfo::default().image_memory_barriers(&barriers);
        // SAFETY: recording, outside of rendering.
        unsafe { engine.device.cmd_pipeline_barrier2(engine.commands, &info) };
    }
}

fn range(aspect: vk::ImageAspectFlags, layer: u32) -> vk::ImageSubresourceRange {
    vk::ImageSubresourceRange::default()
        .aspect_mask(aspect)
        .level_count(1)
        .base_array_layer(layer)
        .layer_count(1)
}

fn camera(layer: u32) -> HostCamera {
    let x = 0.4 - 0.8 * f64::from(layer);
    HostCamera {
        view_from_world: look_at_mat4(DVec3::new(x, 0.9, 4.0), DVec3::ZERO, DVec3::Y),
        clip_from_view: directx::perspective_infinite_reverse(0.7, 160.0 / 120.0, 0.5),
        flips_y: true,
    }
}

/// Through both balls.
const CORNERS: [DVec3; 3] =
    [DVec3::new(-3.0, -2.0, 0.8), DVec3::new(3.0, -2.0, -0.3), DVec3::new(0.0, 2.5, 0.2)];

/// The engine's triangle, alone in one layer of its two images.
unsafe fn triangle(engine: &Engine, [color, depth]: &[Layered; 2], layer: u32) {
    let attached = |view, clear_value| {
        vk::RenderingAttachmentInfo::default()
            .image_view(view)
            .image_layout(ATTACHED)
            .load_op(vk::AttachmentLoadOp::CLEAR)
            .store_op(vk::AttachmentStoreOp::STORE)
            .clear_value(clear_value)
    };
    let farthest = vk::ClearValue::default();
    let [of_color, of_depth] = [color, depth].map(|image| attached(image.views[layer as usize], farthest));
    let colors = [of_color];
    let info = vk::RenderingInfo::default()
        .render_area(EXTENT.into())
        .layer_count(1)
        .color_attachments(&colors)
        .depth_attachment(&of_depth);
    let camera = camera(layer);
    let in_clip = |at: DVec3| (camera.clip_from_view * camera.view_from_world * at.extend(1.0)).as_vec4();
    // SAFETY: recording, outside of rendering.
    unsafe {
        for image in [color, depth] {
            image.bring(engine, layer, [vk::ImageLayout::UNDEFINED, ATTACHED]);
        }
        engine.device.cmd_begin_rendering(engine.commands, &info);
    }
    engine.triangle(CORNERS.map(|at| in_clip(at).to_array()), RED, true);
    engine.end_rendering();
}

/// What is opaque and what is transparent is in each layer what it is in an image of its own: bit by bit, by one call for each.
#[test]
fn each_layer_of_an_image_is_drawn_as_an_image_of_its_own() {
    let mut glass = scenes::sphere(1500, DVec3::ZERO);
    glass.splats.colors = Colors::Uniform([0.0, 0.5, 0.8, 0.4]);
    let objects = vec![glass, scenes::sphere(1500, DVec3::new(0.9, 0.0, 0.8))];
    let mut beside = Beside::new(REVERSED);
    let prepared = beside.upload(&Scene { objects, ..Scene::default() });
    let scenes = [Placed::at_home(&prepared)];
    let settings = Settings { size_px: SIZE_PX, ..Settings::default() };
    let expected = [0, 1].map(|layer| {
        beside.draw(&scenes, &camera(layer), &settings, &CORNERS, true);
        (beside.engine.pixels(), beside.engine.depths())
    });
    assert!(expected[0].0 != expected[1].0, "each has its own camera");

    let Beside { engine, renderer, .. } = &beside;
    let of_depth = vk::ImageUsageFlags::DEPTH_STENCIL_ATTACHMENT | vk::ImageUsageFlags::SAMPLED;
    let pixels = u64::from(EXTENT.width * EXTENT.height);
    let size = u64::from(LAYERS) * pixels * (BYTES[0] + BYTES[1]);
    // SAFETY: handles are the engine's own, and all is alive until the wait; recording between `begin` and `submit`.
    let read = unsafe {
        let images = [
            Layered::new(
                engine,
                COLOR_FORMAT,
                vk::ImageAspectFlags::COLOR,
                vk::ImageUsageFlags::COLOR_ATTACHMENT,
            ),
            Layered::new(engine, vk::Format::D32_SFLOAT, vk::ImageAspectFlags::DEPTH, of_depth),
        ];
        let info = vk::BufferCreateInfo::default().size(size).usage(vk::BufferUsageFlags::TRANSFER_DST);
        let buffer = engine.device.create_buffer(&info, None).unwrap();
        let needed = engine.device.get_buffer_memory_requirements(buffer);
        let visible = vk::MemoryPropertyFlags::HOST_VISIBLE | vk::MemoryPropertyFlags::HOST_COHERENT;
        let memory = memory(engine, needed, visible);
        engine.device.bind_buffer_memory(buffer, memory, 0).unwrap();
        let mapped =
            engine.device.map_memory(memory, 0, vk::WHOLE_SIZE, vk::MemoryMapFlags::empty()).unwrap();

        let rendering = Rendering { color_formats: vec![COLOR_FORMAT], ..Rendering::default() };
        let mut views = [(); 2].map(|()| View::new(renderer, &rendering).unwrap());
        engine.begin();
        // They are lent in a layout in which nothing is drawn, and come back to be copied.
        let (lent, source) = (vk::ImageLayout::GENERAL, vk::ImageLayout::TRANSFER_SRC_OPTIMAL);
        let lent_state = ImageState { layout: lent, ..ALL };
        let copied = ImageState { layout: source, ..ALL };
        for (layer, view) in (0..).zip(&mut views) {
            triangle(engine, &images, layer);
            images.iter().for_each(|image| image.bring(engine, layer, [ATTACHED, lent]));
            let [color, depth] = images.each_ref().map(|of| (of.image, of.views[layer as usize]));
            let hides = DepthImage {
                image: depth.0,
                view: depth.1,
                format: vk::Format::D32_SFLOAT,
                extent: EXTENT,
                layer,
                before: lent_state,
                after: lent_state,
            };
            let color = HostImage {
                layer,
                before: lent_state,
                after: copied,
                ..HostImage::color(color.0, color.1, COLOR_FORMAT, EXTENT)
            };
            let depth = HostImage {
                layer,
                before: lent_state,
                after: copied,
                ..HostImage::depth(depth.0, depth.1, vk::Format::D32_SFLOAT, EXTENT)
            };
            let camera = camera(layer);
            let frame = ViewFrame { hides: Some(hides), ..ViewFrame::new(&scenes, &camera, &settings) };
            view.record(renderer, engine.commands, &frame, &[Some(color)], Some(depth)).unwrap();
        }
        let mut at = 0;
        for (image, bytes) in images.iter().zip(BYTES) {
            for layer in 0..LAYERS {
                let layers = vk::ImageSubresourceLayers::default()
                    .aspect_mask(image.aspect)
                    .base_array_layer(layer)
                    .layer_count(1);
                let image_extent = vk::Extent3D { width: EXTENT.width, height: EXTENT.height, depth: 1 };
                let copy = vk::BufferImageCopy::default()
                    .buffer_offset(at)
                    .image_subresource(layers)
                    .image_extent(image_extent);
                engine.device.cmd_copy_image_to_buffer(engine.commands, image.image, source, buffer, &[copy]);
                at += bytes * pixels;
            }
        }
        // What the engine copies of its own images.
        engine.begin_rendering(true);
        engine.end_rendering();
        beside.submit();
        let bytes = std::slice::from_raw_parts(mapped.cast::<u8>(), size as usize).to_vec();
        drop(views);
        engine.device.destroy_buffer(buffer, None);
        engine.device.free_memory(memory, None);
        images.into_iter().for_each(|image| image.destroy(engine));
        bytes
    };
    let numbers: Vec<f32> = bytemuck::pod_collect_to_vec(&read);
    let (colors, depths) = numbers.split_at(4 * LAYERS as usize * pixels as usize);
    for (layer, (picture, depth)) in expected.iter().enumerate() {
        let of_layer = |all: &[f32], each: usize| all[layer * each..][..each].to_vec();
        let [colors, depths] = [of_layer(colors, 4 * pixels as usize), of_layer(depths, pixels as usize)];
        assert!(picture.as_flattened() == colors, "layer {layer}: picture");
        assert!(depth.iter().zip(depths).all(|(a, b)| *a == f64::from(b)), "layer {layer}: depth");
    }
    drop(prepared);
    beside.end();
}
