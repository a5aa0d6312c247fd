//! One of every object that there is.

use std::any::Any;

use ash::vk;
use glam::DVec3;
use surfel::{
    Error,
    frame::{FrameSlot, HeadlessTarget},
    graph::execute::Profile,
    renderer::{Readbacks, Renderer, SceneFrame, Seen},
    scene::Settings,
    shaders,
    vk::{
        Binding, Blend, Buffer, BufferDesc, CommandPool, ComputePipeline, ComputePipelineDesc, Descriptor,
        DescriptorPool, GraphicsPipeline, GraphicsPipelineDesc, Image, ImageDesc, Memory, MemoryUse,
        Occlusion, PipelineCache, PipelineLayout, PoolSizes, SetLayout, Stage, Staging, Statistics,
        Timestamps,
    },
};

use crate::common::{builder, scenes, watched::Watched};

pub const SIZE_PX: [u32; 2] = [96, 64];
pub const FORMAT: vk::Format = vk::Format::R8G8B8A8_SRGB;

pub fn settings() -> Settings {
    Settings { size_px: SIZE_PX, ..builder::settings() }
}

/// A scene with large splats: every pass and every buffer that there is.
pub fn scene() -> surfel::scene::Scene {
    let mut builder = builder::Builder::default();
    builder.disk(DVec3::new(0.0, 0.0, -1.0), DVec3::Z, 300.0, [0.5; 4]);
    let mut objects = vec![builder.object(false)];
    objects.push(scenes::sphere(500, DVec3::ZERO));
    surfel::scene::Scene { objects, ..Default::default() }
}

pub fn pixels(device: &surfel::vk::Device, name: &str, bytes_per_pixel: u64) -> Result<Buffer, Error> {
    let size = u64::from(SIZE_PX[0]) * u64::from(SIZE_PX[1]) * bytes_per_pixel;
    let desc = BufferDesc { name, size, usage: vk::BufferUsageFlags::TRANSFER_DST };
    Buffer::new(device, desc, MemoryUse::Readback)
}

/// One of everything, with a frame of it submitted and not waited for.
pub fn everything(watched: Watched, profile: Profile) -> Vec<Box<dyn Any>> {
    let Watched { device, queue, .. } = watched;
    let mut things: Vec<Box<dyn Any>> = Vec::new();
    let mut keep = |thing: Box<dyn Any>| things.push(thing);

    let desc = BufferDesc { name: "buffer", size: 1 << 16, usage: vk::BufferUsageFlags::TRANSFER_DST };
    let buffer = Buffer::new(&device, desc, MemoryUse::Device).unwrap();
    let mut staging = Staging::new(&device, "staging", 1 << 16).unwrap();
    staging.push(&buffer, 0, &[3; 1 << 16]).unwrap();
    let extent = vk::Extent2D { width: 33, height: 17 };
    let desc = ImageDesc { name: "image", format: FORMAT, extent, usage: vk::ImageUsageFlags::SAMPLED };
    keep(Box::new(Image::new(&device, desc).unwrap()));
    let requirements = vk::MemoryRequirements { size: 4096, alignment: 256, memory_type_bits: !0 };
    keep(Box::new(Memory::new(&device, "memory", requirements, true).unwrap()));

    let cache = PipelineCache::open(&device, None).unwrap();
    let binding = Binding {
        kind: vk::DescriptorType::STORAGE_BUFFER,
        stages: vk::ShaderStageFlags::COMPUTE | vk::ShaderStageFlags::VERTEX,
    };
    let sampled = Binding { kind: vk::DescriptorType::SAMPLED_IMAGE, stages: vk::ShaderStageFlags::FRAGMENT };
    let (splats, large) = (
        SetLayout::new(&device, "splats", &[binding; 2]).unwrap(),
        SetLayout::new(&device, "large", &[binding; 4]).unwrap(),
    );
    let lights = Binding { kind: vk::DescriptorType::UNIFORM_BUFFER, ..sampled };
    let of_finalization = [sampled, sampled, sampled, sampled, sampled, lights];
    let images = SetLayout::new(&device, "images", &of_finalization).unwrap();
    let compute_layout = {
        let stages = vk::ShaderStageFlags::COMPUTE;
        PipelineLayout::new(&device, "compute", &[&splats, &large], 128, stages).unwrap()
    };
    let layout =
        PipelineLayout::new(&device, "graphics", &[&images], 64, vk::ShaderStageFlags::FRAGMENT).unwrap();
    let stage =
        |shader: &'static shaders::Shader| Stage { name: shader.name, spirv: shader.spirv(), constants: &[] };
    let desc = ComputePipelineDesc {
        name: "compute",
        stage: stage(&shaders::LIST_SCAN_COMP),
        layout: &compute_layout,
    };
    // SAFETY: a shader of `glsl/` with its layout.
    keep(Box::new(unsafe { ComputePipeline::new(&device, &cache, &desc) }.unwrap()));
    let desc = GraphicsPipelineDesc {
        name: "graphics",
        vertex: stage(&shaders::FULLSCREEN_VERT),
        fragment: stage(&shaders::FINALIZE_FRAG),
        topology: vk::PrimitiveTopology::TRIANGLE_LIST,
        cull_clockwise: false,
        color_formats: &[FORMAT],
        blend: Blend::Replace,
        depth: None,
        attachments: surfel::vk::Attachments::default(),
        layout: &layout,
    };
    // SAFETY: as above.
    keep(Box::new(unsafe { GraphicsPipeline::new(&device, &cache, &desc) }.unwrap()));
    let pool =
        DescriptorPool::new(&device, "pool", PoolSizes { sets: 1, buffers: 2, ..PoolSizes::default() })
            .unwrap();
    let storage = BufferDesc { name: "storage", size: 256, usage: vk::BufferUsageFlags::STORAGE_BUFFER };
    let storage = Buffer::new(&device, storage, MemoryUse::Device).unwrap();
    let bound = Descriptor::Buffer(storage.raw(), storage.size());
    // SAFETY: a storage buffer of this device; no commands use the set.
    unsafe { pool.set(&splats, &[(0, bound), (1, bound)]) }.unwrap();
    if let Some(timestamps) = Timestamps::new(&device, "timestamps", 4).unwrap() {
        keep(Box::new(timestamps));
    }
    keep(Box::new(Occlusion::new(&device, "occlusion", 4).unwrap()));
    if let Some(statistics) = Statistics::new(&device, "statistics", 4).unwrap() {
        keep(Box::new(statistics));
    }

    let renderer = Renderer::new(&device, None).unwrap();
    let mut submit = |staging: Staging| {
        queue.run_once("upload", |commands| {
            // SAFETY: recording; `run_once` waits.
            unsafe { staging.record(commands) };
            Ok(())
        })
    };
    let prepared = renderer.prepare(&scene(), &mut submit, &|_, _| {}).unwrap();
    let mut slot = FrameSlot::new(&device);
    let target = HeadlessTarget::new(&device, FORMAT, SIZE_PX).unwrap();
    let picture = pixels(&device, "picture", 4).unwrap();
    let surface = [4, 16, 16, 4].map(|bytes| pixels(&device, "surface", bytes).unwrap());
    let readbacks = Readbacks {
        target: Some(picture.raw()),
        surface: Some(surface.each_ref().map(Buffer::raw)),
        sample: None,
    };
    let commands = CommandPool::new(&device, "frame").unwrap();
    // SAFETY: all that is recorded is alive when it is submitted; what is dropped after that, while the device works,
    // is what this test is about: the drops hand over to the device's deferred destruction.
    unsafe {
        let buffer = commands.begin().unwrap();
        staging.record(buffer);
        let camera = builder::camera([0.0, 0.0, 3.2], [0.0; 3]);
        let (target, settings) = (target.target(), settings());
        let shown = SceneFrame {
            readbacks,
            profile: Some(profile),
            ..SceneFrame::new(Seen { scene: &prepared, camera: &camera, settings: &settings }, &target)
        };
        let plan = renderer.record(buffer, &mut slot, &shown).unwrap();
        assert_eq!(
            plan.passes.len(),
            26,
            "opaque splats, lists, four layers, export and read-backs:\n{plan}"
        );
        queue.submit(commands.end().unwrap()).unwrap();
    }
    keep(Box::new((buffer, storage)));
    keep(Box::new(staging));
    keep(Box::new(cache));
    keep(Box::new(splats));
    keep(Box::new(large));
    keep(Box::new(images));
    keep(Box::new(compute_layout));
    keep(Box::new(layout));
    keep(Box::new(pool));
    keep(Box::new(renderer));
    keep(Box::new(prepared));
    keep(Box::new(slot));
    keep(Box::new(target));
    keep(Box::new(picture));
    keep(Box::new(surface));
    keep(Box::new(commands));
    keep(Box::new(queue));
    keep(Box::new(device.instance().clone()));
    keep(Box::new(device));
    things
}
