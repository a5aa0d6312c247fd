//! Nothing leaks and nothing dies too early: whatever the order of drops, with work under way, and whichever step of
//! making something fails. The validation layer reports what is left when a device is destroyed, and what is destroyed
//! in use.

mod common;

use std::any::Any;

use ash::vk;
use common::{
    faults,
    host::Host,
    scenes::{self, Random},
    watched::Watched,
};
use glam::DVec3;
use surfel::{
    Error,
    frame::{FrameSlot, HeadlessTarget},
    graph::execute::Profile,
    renderer::{Readbacks, Renderer},
    scene::Settings,
    shaders,
    vk::{
        Binding, Blend, Buffer, BufferDesc, CommandPool, ComputePipeline, ComputePipelineDesc, Descriptor,
        DescriptorPool, EnabledFeatures, GraphicsPipeline, GraphicsPipelineDesc, Image, ImageDesc, Memory,
        MemoryUse, PipelineCache, PipelineLayout, Queue, SetLayout, Stage, Staging, Statistics, Timestamps,
    },
};

const SIZE_PX: [u32; 2] = [96, 64];
const FORMAT: vk::Format = vk::Format::R8G8B8A8_SRGB;

fn settings() -> Settings {
    Settings { size_px: SIZE_PX, ..scenes::settings() }
}

/// A scene with large splats: every pass and every buffer that there is.
fn scene() -> surfel::scene::Scene {
    let mut builder = scenes::Builder::default();
    builder.disk(DVec3::new(0.0, 0.0, -1.0), DVec3::Z, 300.0, [0.5; 4]);
    let mut objects = vec![builder.object(false)];
    objects.push(scenes::sphere(500, DVec3::ZERO));
    surfel::scene::Scene { objects }
}

fn pixels(device: &surfel::vk::Device, name: &str, bytes_per_pixel: u64) -> Result<Buffer, Error> {
    let size = u64::from(SIZE_PX[0]) * u64::from(SIZE_PX[1]) * bytes_per_pixel;
    let desc = BufferDesc { name, size, usage: vk::BufferUsageFlags::TRANSFER_DST };
    Buffer::new(device, desc, MemoryUse::Readback)
}

/// One of everything, with a frame of it submitted and not waited for.
fn everything(watched: Watched, profile: Profile) -> Vec<Box<dyn Any>> {
    let Watched { device, queue, .. } = watched;
    let mut things: Vec<Box<dyn Any>> = Vec::new();
    let mut keep = |thing: Box<dyn Any>| things.push(thing);

    let desc = BufferDesc { name: "buffer", size: 1 << 16, usage: vk::BufferUsageFlags::TRANSFER_DST };
    let buffer = Buffer::new(&device, desc, MemoryUse::Device).unwrap();
    let mut staging = Staging::new(&device, "staging", 1 << 16).unwrap();
    staging.push(&buffer, &[3; 1 << 16]).unwrap();
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
    let images = SetLayout::new(&device, "images", &[sampled; 2]).unwrap();
    let compute_layout = {
        let stages = vk::ShaderStageFlags::COMPUTE;
        PipelineLayout::new(&device, "compute", &[&splats, &large], 128, stages).unwrap()
    };
    let layout =
        PipelineLayout::new(&device, "graphics", &[&images], 32, vk::ShaderStageFlags::FRAGMENT).unwrap();
    let stage =
        |shader: &'static shaders::Shader| Stage { name: shader.name, spirv: shader.spirv, constants: &[] };
    let desc = ComputePipelineDesc {
        name: "compute",
        stage: stage(&shaders::LARGE_SCAN_COMP),
        layout: &compute_layout,
    };
    keep(Box::new(ComputePipeline::new(&device, &cache, &desc).unwrap()));
    let desc = GraphicsPipelineDesc {
        name: "graphics",
        vertex: stage(&shaders::FULLSCREEN_VERT),
        fragment: stage(&shaders::FINALIZE_FRAG),
        topology: vk::PrimitiveTopology::TRIANGLE_LIST,
        color_formats: &[FORMAT],
        blend: Blend::Replace,
        depth: None,
        layout: &layout,
    };
    keep(Box::new(GraphicsPipeline::new(&device, &cache, &desc).unwrap()));
    let pool = DescriptorPool::new(&device, "pool", 1, 2, 0).unwrap();
    let storage = BufferDesc { name: "storage", size: 256, usage: vk::BufferUsageFlags::STORAGE_BUFFER };
    let storage = Buffer::new(&device, storage, MemoryUse::Device).unwrap();
    let bound = Descriptor::Buffer(storage.raw());
    pool.set(&splats, &[(0, bound), (1, bound)]).unwrap();
    if let Some(timestamps) = Timestamps::new(&device, "timestamps", 4).unwrap() {
        keep(Box::new(timestamps));
    }
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
    let readbacks =
        Readbacks { target: Some(picture.raw()), surface: Some(surface.each_ref().map(Buffer::raw)) };
    let commands = CommandPool::new(&device, "frame").unwrap();
    // SAFETY: all that is recorded is alive when it is submitted; what is dropped after that, while the device works,
    // is what this test is about: the drops hand over to the device's deferred destruction.
    unsafe {
        let buffer = commands.begin().unwrap();
        staging.record(buffer);
        let camera = scenes::camera([0.0, 0.0, 3.2], [0.0; 3]);
        let (target, settings) = (target.target(), settings());
        let plan = renderer
            .record(buffer, &mut slot, &prepared, &camera, &settings, &target, readbacks, Some(profile))
            .unwrap();
        assert_eq!(plan.passes.len(), 7 + 5, "large lists, frame, export and read-backs:\n{plan}");
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

/// Fisher and Yates.
fn shuffle<T>(things: &mut [T], random: &mut Random) {
    for last in (1..things.len()).rev() {
        things.swap(last, (random.unit() * (last + 1) as f64) as usize);
    }
}

#[test]
fn any_order_of_drops_with_a_frame_under_way_leaks_nothing_and_destroys_nothing_in_use() {
    for seed in 0..12 {
        let watched = Watched::new();
        let (messages, device) = (watched.messages.clone(), watched.device.clone());
        let mut things = everything(watched, if seed % 2 == 0 { Profile::Times } else { Profile::Counts });
        shuffle(&mut things, &mut Random(seed));
        // Every second time our clone is gone first, so that the last of the things takes the device with it.
        let device = (seed % 4 < 2).then_some(device);
        things.into_iter().for_each(drop);
        if let Some(device) = device {
            assert_ne!(device.memory_in_use().1, 0, "what was dropped waits for its epoch");
            let queue = Queue::new(&device).unwrap();
            // SAFETY: nothing is recorded.
            unsafe { queue.wait_idle() }.unwrap();
            assert_eq!(device.memory_in_use(), (0, 0), "seed {seed}");
        }
        assert_eq!(messages.all(), [], "seed {seed}");
    }
}

/// The layer would have said so above.
#[test]
fn a_leaked_object_is_reported_when_the_device_is_destroyed() {
    let watched = Watched::new();
    // SAFETY: the leak is the defect.
    unsafe { watched.device.raw().create_fence(&vk::FenceCreateInfo::default(), None) }.unwrap();
    let messages = watched.messages.clone();
    drop(watched);
    let vuids: Vec<_> = messages.all().into_iter().map(|message| message.vuid).collect();
    assert_eq!(vuids, ["VUID-vkDestroyDevice-device-00378"]);

    let host = Host::new(EnabledFeatures::default());
    // SAFETY: as above.
    unsafe { host.device.create_fence(&vk::FenceCreateInfo::default(), None) }.unwrap();
    let said = host.destroy();
    assert!(said.len() == 1 && said[0].contains("VUID-vkDestroyDevice-device-00378"), "{said:?}");
}

/// So would it of an object that is destroyed before the host has waited for the device.
#[test]
fn an_object_destroyed_in_use_is_reported() {
    let watched = Watched::new();
    let device = watched.device.raw();
    let flag = BufferDesc { name: "flag", size: 256, usage: vk::BufferUsageFlags::TRANSFER_DST };
    let flag = Buffer::new(&watched.device, flag, MemoryUse::Readback).unwrap();
    let info = vk::BufferCreateInfo::default().size(256).usage(vk::BufferUsageFlags::TRANSFER_DST);
    let pool = CommandPool::new(&watched.device, "program").unwrap();
    // SAFETY: the buffer is destroyed too early by the rules: the defect. In fact the device has finished, which only
    // the flag's bytes tell, so that no driver stumbles over it.
    unsafe {
        let buffer = device.create_buffer(&info, None).unwrap();
        let needed = device.get_buffer_memory_requirements(buffer);
        let info = vk::MemoryAllocateInfo::default()
            .allocation_size(1 << 20)
            .memory_type_index(needed.memory_type_bits.trailing_zeros());
        let memory = device.allocate_memory(&info, None).unwrap();
        device.bind_buffer_memory(buffer, memory, 0).unwrap();
        watched.said();
        let commands = pool.begin().unwrap();
        device.cmd_fill_buffer(commands, buffer, 0, 256, 1);
        device.cmd_fill_buffer(commands, flag.raw(), 0, 256, !0);
        let epoch = watched.queue.submit(pool.end().unwrap()).unwrap();
        let last = &raw const flag.bytes()[255];
        while last.read_volatile() == 0 {
            std::thread::yield_now();
        }
        std::thread::sleep(std::time::Duration::from_millis(50));
        device.destroy_buffer(buffer, None);
        assert_eq!(watched.said(), ["VUID-vkDestroyBuffer-buffer-00922"]);
        watched.queue.wait(epoch).unwrap();
        device.free_memory(memory, None);
    }
}

#[test]
fn sizes_that_no_device_has_are_refused_and_leave_nothing() {
    let watched = Watched::new();
    let device = &watched.device;
    let beyond = device.facts().limits.max_image_side + 1;
    for (width, height) in [(0, 5), (5, 0), (beyond, 1), (1, beyond), (u32::MAX, u32::MAX)] {
        let extent = vk::Extent2D { width, height };
        let desc = ImageDesc { name: "wrong", format: FORMAT, extent, usage: vk::ImageUsageFlags::SAMPLED };
        let error = Image::new(device, desc).err().unwrap();
        assert!(error.to_string().starts_with(&format!("wrong: an image of {width}x{height}")), "{error}");
    }
    let usage = vk::BufferUsageFlags::TRANSFER_DST;
    let empty = BufferDesc { name: "empty", size: 0, usage };
    assert!(Buffer::new(device, empty, MemoryUse::Device).is_err());
    let mut staging = Staging::new(device, "staging", 16).unwrap();
    let small = BufferDesc { name: "small", size: 8, usage };
    let small = Buffer::new(device, small, MemoryUse::Device).unwrap();
    assert!(staging.push(&small, &[0; 9]).is_err(), "more than the target has");
    staging.push(&small, &[0; 8]).unwrap();
    staging.push(&small, &[0; 8]).unwrap();
    assert!(staging.push(&small, &[0; 1]).is_err(), "more than the batch has");
    let pool = CommandPool::new(device, "pool").unwrap();
    assert!(pool.end().is_err(), "not begun");
    drop((pool, staging, small));
    // SAFETY: nothing is recorded.
    unsafe { watched.queue.wait_idle() }.unwrap();
    assert_eq!(device.memory_in_use(), (0, 0));
    let messages = watched.messages.clone();
    drop(watched);
    assert_eq!(messages.all(), []);
}

/// Everything that a host does with us up to a recorded frame.
fn set_up_and_record(device: &surfel::vk::Device) -> Result<(), Error> {
    let commands = CommandPool::new(device, "frame")?;
    let renderer = Renderer::new(device, None)?;
    // SAFETY: new, and never submitted.
    let buffer = unsafe { commands.begin() }?;
    let mut submit = |staging: Staging| {
        // SAFETY: recording; never submitted.
        unsafe { staging.record(buffer) };
        Ok(())
    };
    let prepared = renderer.prepare(&scene(), &mut submit, &|_, _| {})?;
    let mut slot = FrameSlot::new(device);
    let target = HeadlessTarget::new(device, FORMAT, SIZE_PX)?;
    let picture = pixels(device, "picture", 4)?;
    let readbacks = Readbacks { target: Some(picture.raw()), surface: None };
    let camera = scenes::camera([0.0, 0.0, 3.2], [0.0; 3]);
    let (target, settings) = (target.target(), settings());
    // SAFETY: recording; never submitted.
    unsafe {
        let profile = Some(Profile::Times);
        renderer.record(buffer, &mut slot, &prepared, &camera, &settings, &target, readbacks, profile)
    }?;
    commands.end()?;
    Ok(())
}

/// The n-th call that makes something fails, for every n that there is.
#[test]
fn whichever_call_fails_is_named_and_leaves_nothing_behind() {
    let host = Host::new(EnabledFeatures { large_points: true, pipeline_statistics: false });
    let mut failed = Vec::new();
    for succeed in 0.. {
        assert!(succeed < 1000, "there is no end");
        let device = host.lend(faults::device(&host.device));
        faults::fail_after(succeed);
        let result = set_up_and_record(&device);
        let Some(function) = faults::stop() else {
            result.unwrap();
            break;
        };
        let error = result.expect_err(function);
        assert_eq!(error.exit_code(), 2, "{function}: {error}");
        assert!(!error.to_string().contains("''"), "{function}: no object is named: {error}");
        // SAFETY: nothing was ever submitted.
        unsafe { device.epoch_done(device.end_epoch()) };
        assert_eq!(device.memory_in_use(), (0, 0), "{succeed}: {function}");
        assert_eq!(host.said(), [] as [String; 0], "{succeed}: {function}");
        failed.push(function);
    }
    println!("{} calls failed one after the other", failed.len());
    assert!(failed.len() > 50, "{failed:?}");
    for function in ["allocate_memory", "create_image_view", "create_graphics_pipelines", "bind_image_memory"]
    {
        assert!(failed.contains(&function), "{function} is among them: {failed:?}");
    }
    assert_eq!(host.destroy(), [] as [String; 0]);
}
