//! An embedding host owns instance, device, queue, command buffers, target and submission; the renderer records.

mod common;

use ash::vk;
use common::{headless, host::Host, scenes};
use glam::DVec3;
use surfel::{
    frame::{FrameSlot, Target},
    graph::ImageState,
    prepare::PreparedScene,
    renderer::{Readbacks, Renderer, Wanted},
    scene::{Camera, Scene, Settings},
    vk::{Buffer, BufferDesc, Device, EnabledFeatures, MemoryUse, Queue, Staging},
};

const FORMAT: vk::Format = vk::Format::R8G8B8A8_SRGB;
const POINTS: EnabledFeatures = EnabledFeatures { large_points: true, pipeline_statistics: false };

fn scene() -> Scene {
    Scene { objects: vec![scenes::sphere(3000, DVec3::ZERO)] }
}

/// The scene from another side for each frame.
fn camera(frame: usize) -> Camera {
    let angle = 0.4 * frame as f64;
    scenes::camera([3.2 * angle.sin(), 0.3, 3.2 * angle.cos()], [0.0; 3])
}

fn settings() -> Settings {
    Settings { size_px: [200, 150], ..scenes::settings() }
}

/// The same frame from our own host.
fn expected(settings: &Settings, frames: usize) -> Vec<Vec<u8>> {
    let mut headless = headless();
    let prepared = headless.prepare(&scene(), &|_, _| {}).unwrap();
    let wanted = Wanted { picture: true, ..Wanted::default() };
    let mut picture = |frame| {
        let frame = headless.render(&prepared, &camera(frame), settings, wanted).unwrap();
        bytemuck::cast_slice(&frame.srgb).to_vec()
    };
    (0..frames).map(&mut picture).collect()
}

/// One frame in flight of the host's: its command pool, its fence, the image that it will show, our slot.
struct InFlight {
    pool: vk::CommandPool,
    commands: vk::CommandBuffer,
    fence: vk::Fence,
    image: vk::Image,
    view: vk::ImageView,
    memory: vk::DeviceMemory,
    slot: FrameSlot,
    /// What this frame was submitted as; none yet.
    epoch: Option<u64>,
    pixels: Buffer,
}

impl InFlight {
    fn new(host: &Host, ours: &Device, [width, height]: [u32; 2]) -> Self {
        let device = &host.device;
        let pool = vk::CommandPoolCreateInfo::default()
            .queue_family_index(host.queue_family)
            .flags(vk::CommandPoolCreateFlags::TRANSIENT);
        let image = vk::ImageCreateInfo::default()
            .image_type(vk::ImageType::TYPE_2D)
            .format(FORMAT)
            .extent(vk::Extent3D { width, height, depth: 1 })
            .mip_levels(1)
            .array_layers(1)
            .samples(vk::SampleCountFlags::TYPE_1)
            .usage(vk::ImageUsageFlags::COLOR_ATTACHMENT | vk::ImageUsageFlags::TRANSFER_SRC);
        // SAFETY: a host's own set-up; `destroy` undoes it.
        unsafe {
            let pool = device.create_command_pool(&pool, None).unwrap();
            let info = vk::CommandBufferAllocateInfo::default().command_pool(pool).command_buffer_count(1);
            let commands = device.allocate_command_buffers(&info).unwrap()[0];
            let fence = device.create_fence(&vk::FenceCreateInfo::default(), None).unwrap();
            let image = device.create_image(&image, None).unwrap();
            let needed = device.get_image_memory_requirements(image);
            let info = vk::MemoryAllocateInfo::default()
                .allocation_size(needed.size.max(1 << 20))
                .memory_type_index(needed.memory_type_bits.trailing_zeros());
            let memory = device.allocate_memory(&info, None).unwrap();
            device.bind_image_memory(image, memory, 0).unwrap();
            let range = vk::ImageSubresourceRange::default()
                .aspect_mask(vk::ImageAspectFlags::COLOR)
                .level_count(1)
                .layer_count(1);
            let info = vk::ImageViewCreateInfo::default()
                .image(image)
                .view_type(vk::ImageViewType::TYPE_2D)
                .format(FORMAT)
                .subresource_range(range);
            let view = device.create_image_view(&info, None).unwrap();
            let size = 4 * u64::from(width) * u64::from(height);
            let desc = BufferDesc { name: "host's pixels", size, usage: vk::BufferUsageFlags::TRANSFER_DST };
            let pixels = Buffer::new(ours, desc, MemoryUse::Readback).unwrap();
            let slot = FrameSlot::new(ours);
            Self { pool, commands, fence, image, view, memory, slot, epoch: None, pixels }
        }
    }

    fn begin(&self, host: &Host) {
        let info = vk::CommandBufferBeginInfo::default().flags(vk::CommandBufferUsageFlags::ONE_TIME_SUBMIT);
        // SAFETY: the frame's earlier submission was waited for.
        unsafe {
            host.device.reset_command_pool(self.pool, vk::CommandPoolResetFlags::empty()).unwrap();
            host.device.begin_command_buffer(self.commands, &info).unwrap();
        }
    }

    /// The host's submission, which is also the end of an epoch of ours.
    fn submit(&mut self, host: &Host, ours: &Device) {
        let commands = [vk::CommandBufferSubmitInfo::default().command_buffer(self.commands)];
        let info = vk::SubmitInfo2::default().command_buffer_infos(&commands);
        // SAFETY: recorded just now; all of it is alive until `wait`.
        unsafe {
            host.device.end_command_buffer(self.commands).unwrap();
            host.device.queue_submit2(host.queue, &[info], self.fence).unwrap();
        }
        self.epoch = Some(ours.end_epoch());
    }

    fn wait(&mut self, host: &Host, ours: &Device) {
        if let Some(epoch) = self.epoch.take() {
            // SAFETY: the fence was submitted; after it this submission and, the queue being one, all before are done.
            unsafe {
                host.device.wait_for_fences(&[self.fence], true, u64::MAX).unwrap();
                host.device.reset_fences(&[self.fence]).unwrap();
                ours.epoch_done(epoch);
            }
        }
    }

    /// The host's image as a target. The host copies it afterwards, so it wants it in that state.
    fn target(&self, [width, height]: [u32; 2]) -> Target {
        Target {
            image: self.image,
            view: self.view,
            format: FORMAT,
            extent: vk::Extent2D { width, height },
            // The copy of this frame's last use was waited for; its content is not needed.
            initial: ImageState::default(),
            last: Some(ImageState {
                stages: vk::PipelineStageFlags2::COPY,
                access: vk::AccessFlags2::TRANSFER_READ,
                layout: vk::ImageLayout::TRANSFER_SRC_OPTIMAL,
            }),
        }
    }

    /// The host's own use of the target, in the state it asked for: no barrier of the host's before it.
    fn copy_target(&self, host: &Host, [width, height]: [u32; 2]) {
        let layers =
            vk::ImageSubresourceLayers::default().aspect_mask(vk::ImageAspectFlags::COLOR).layer_count(1);
        let region = vk::BufferImageCopy::default().image_subresource(layers).image_extent(vk::Extent3D {
            width,
            height,
            depth: 1,
        });
        let to_host = [vk::MemoryBarrier2::default()
            .src_stage_mask(vk::PipelineStageFlags2::COPY)
            .src_access_mask(vk::AccessFlags2::TRANSFER_WRITE)
            .dst_stage_mask(vk::PipelineStageFlags2::HOST)
            .dst_access_mask(vk::AccessFlags2::HOST_READ)];
        let info = vk::DependencyInfo::default().memory_barriers(&to_host);
        let layout = vk::ImageLayout::TRANSFER_SRC_OPTIMAL;
        // SAFETY: recording, after our commands; all is alive until `wait`.
        unsafe {
            let device = &host.device;
            device.cmd_copy_image_to_buffer(self.commands, self.image, layout, self.pixels.raw(), &[region]);
            device.cmd_pipeline_barrier2(self.commands, &info);
        }
    }

    fn destroy(self, host: &Host) {
        // SAFETY: waited for; each once.
        unsafe {
            host.device.destroy_image_view(self.view, None);
            host.device.destroy_image(self.image, None);
            host.device.free_memory(self.memory, None);
            host.device.destroy_fence(self.fence, None);
            host.device.destroy_command_pool(self.pool, None);
        }
    }
}

/// Uploads with the host's own command buffer; the host may defer it, and so records all batches into one.
fn upload(
    host: &Host,
    ours: &Device,
    renderer: &Renderer,
    frame: &mut InFlight,
    scene: &Scene,
) -> PreparedScene {
    let mut batches: Vec<Staging> = Vec::new();
    frame.begin(host);
    let mut submit = |staging: Staging| {
        // SAFETY: recording; the batch is kept until the wait below.
        unsafe { staging.record(frame.commands) };
        batches.push(staging);
        Ok(())
    };
    let prepared = renderer.prepare(scene, &mut submit, &|_, _| {}).unwrap();
    frame.submit(host, ours);
    frame.wait(host, ours);
    drop(batches);
    prepared
}

fn record(
    renderer: &Renderer,
    frame: &mut InFlight,
    scene: &PreparedScene,
    number: usize,
    settings: &Settings,
) {
    let target = frame.target(settings.size_px);
    // SAFETY: the frame's commands are recording, and its earlier submission was waited for; scene, renderer, slot and
    // target stay alive until its next wait.
    unsafe {
        let (slot, none) = (&mut frame.slot, Readbacks::default());
        renderer.record(frame.commands, slot, scene, &camera(number), settings, &target, none, None)
    }
    .unwrap();
}

#[test]
fn a_foreign_host_gets_the_same_picture_with_two_frames_in_flight() {
    const FRAMES: usize = 5;
    let settings = settings();
    let expected = expected(&settings, FRAMES);
    let host = Host::new(POINTS);
    let ours = host.lend(host.device.clone());
    let renderer = Renderer::new(&ours, None).unwrap();
    let mut frames = [0, 1].map(|_| InFlight::new(&host, &ours, settings.size_px));
    let scene = upload(&host, &ours, &renderer, &mut frames[0], &scene());

    let mut pictures = Vec::new();
    for number in 0..FRAMES + 2 {
        let frame = &mut frames[number % 2];
        let submitted = frame.epoch.is_some();
        frame.wait(&host, &ours);
        if submitted {
            pictures.push(frame.pixels.bytes().to_vec());
        }
        if number < FRAMES {
            frame.begin(&host);
            record(&renderer, frame, &scene, number, &settings);
            frame.copy_target(&host, settings.size_px);
            frame.submit(&host, &ours);
        }
    }
    assert_eq!(pictures.len(), FRAMES);
    for (number, (picture, expected)) in pictures.iter().zip(&expected).enumerate() {
        assert!(picture == expected, "frame {number} differs");
    }
    assert_ne!(expected[0], expected[1], "the frames show different sides");

    frames.into_iter().for_each(|frame| frame.destroy(&host));
    drop((scene, renderer));
    // All was dropped with nothing under way: one more epoch, and the memory is back.
    // SAFETY: the host waited for both frames.
    unsafe { ours.epoch_done(ours.end_epoch()) };
    assert_eq!(ours.memory_in_use(), (0, 0));
    drop(ours);
    assert_eq!(host.said(), [] as [String; 0]);
    assert_eq!(host.destroy(), [] as [String; 0]);
}

/// Functions that only a host may call: `record` must do with what it is given.
static SUBMISSIONS_AND_WAITS: std::sync::atomic::AtomicU32 = std::sync::atomic::AtomicU32::new(0);

/// The host's device with the functions that submit or wait made to count and fail.
fn without_submission_and_waits(host: &Host) -> ash::Device {
    use std::sync::atomic::Ordering::Relaxed;
    unsafe extern "system" fn submit2(
        _: vk::Queue,
        _: u32,
        _: *const vk::SubmitInfo2<'_>,
        _: vk::Fence,
    ) -> vk::Result {
        SUBMISSIONS_AND_WAITS.fetch_add(1, Relaxed);
        vk::Result::ERROR_UNKNOWN
    }
    unsafe extern "system" fn submit(
        _: vk::Queue,
        _: u32,
        _: *const vk::SubmitInfo<'_>,
        _: vk::Fence,
    ) -> vk::Result {
        SUBMISSIONS_AND_WAITS.fetch_add(1, Relaxed);
        vk::Result::ERROR_UNKNOWN
    }
    unsafe extern "system" fn queue_wait(_: vk::Queue) -> vk::Result {
        SUBMISSIONS_AND_WAITS.fetch_add(1, Relaxed);
        vk::Result::ERROR_UNKNOWN
    }
    unsafe extern "system" fn device_wait(_: vk::Device) -> vk::Result {
        SUBMISSIONS_AND_WAITS.fetch_add(1, Relaxed);
        vk::Result::ERROR_UNKNOWN
    }
    unsafe extern "system" fn fences(
        _: vk::Device,
        _: u32,
        _: *const vk::Fence,
        _: vk::Bool32,
        _: u64,
    ) -> vk::Result {
        SUBMISSIONS_AND_WAITS.fetch_add(1, Relaxed);
        vk::Result::ERROR_UNKNOWN
    }
    unsafe extern "system" fn semaphores(
        _: vk::Device,
        _: *const vk::SemaphoreWaitInfo<'_>,
        _: u64,
    ) -> vk::Result {
        SUBMISSIONS_AND_WAITS.fetch_add(1, Relaxed);
        vk::Result::ERROR_UNKNOWN
    }
    let own = &host.device;
    let (mut fp_1_0, mut fp_1_2, mut fp_1_3) =
        (own.fp_v1_0().clone(), own.fp_v1_2().clone(), own.fp_v1_3().clone());
    (fp_1_0.queue_submit, fp_1_0.queue_wait_idle) = (submit, queue_wait);
    (fp_1_0.device_wait_idle, fp_1_0.wait_for_fences) = (device_wait, fences);
    fp_1_2.wait_semaphores = semaphores;
    fp_1_3.queue_submit2 = submit2;
    ash::Device::from_parts_1_3(own.handle(), fp_1_0, own.fp_v1_1().clone(), fp_1_2, fp_1_3)
}

#[test]
fn recording_never_submits_and_never_waits() {
    let settings = settings();
    let host = Host::new(POINTS);
    let ours = host.lend(without_submission_and_waits(&host));
    let renderer = Renderer::new(&ours, None).unwrap();
    let mut frame = InFlight::new(&host, &ours, settings.size_px);
    let scene = upload(&host, &ours, &renderer, &mut frame, &scene());
    frame.begin(&host);
    record(&renderer, &mut frame, &scene, 0, &settings);
    // Never submitted at all: that is fine too.
    // SAFETY: recording.
    unsafe { host.device.end_command_buffer(frame.commands) }.unwrap();
    frame.destroy(&host);
    drop((scene, renderer, ours));
    let calls = SUBMISSIONS_AND_WAITS.load(std::sync::atomic::Ordering::Relaxed);
    assert_eq!(calls, 0, "calls that submit or wait");
    assert_eq!(host.destroy(), [] as [String; 0]);
}

#[test]
fn a_hosts_queue_is_not_ours_to_take_and_an_owned_one_has_one_owner() {
    let host = Host::new(POINTS);
    let ours = host.lend(host.device.clone());
    assert_eq!(Queue::new(&ours).err().unwrap().exit_code(), 1);
    drop(ours);
    assert_eq!(host.destroy(), [] as [String; 0]);

    let watched = common::watched::Watched::new();
    let second = Queue::new(&watched.device).err().unwrap();
    assert!(second.to_string().contains("another owner"), "{second}");
    let common::watched::Watched { device, queue, messages } = watched;
    drop(queue);
    let next = Queue::new(&device).unwrap();
    assert!(next.wait(1).is_err(), "an epoch that was never submitted would never end");
    drop((next, device));
    assert_eq!(messages.all(), []);
}

/// Without `largePoints` every splat above one pixel is a quad: the same picture, but for rounding.
#[test]
fn without_large_points_every_splat_is_a_quad() {
    let settings = settings();
    let expected = expected(&settings, 1);
    let host = Host::new(EnabledFeatures::default());
    let ours = host.lend(host.device.clone());
    assert_eq!(ours.facts().limits.point_size_range, [1.0, 1.0]);
    let renderer = Renderer::new(&ours, None).unwrap();
    let mut frame = InFlight::new(&host, &ours, settings.size_px);
    let scene = upload(&host, &ours, &renderer, &mut frame, &scene());
    frame.begin(&host);
    record(&renderer, &mut frame, &scene, 0, &settings);
    frame.copy_target(&host, settings.size_px);
    frame.submit(&host, &ours);
    frame.wait(&host, &ours);
    let names = renderer.shaders.pipeline_names();
    assert!(names.iter().any(|name| name.starts_with("splat_large_quads")), "{names:?}");

    let picture = frame.pixels.bytes();
    assert!(picture.iter().any(|byte| *byte != 255), "the picture is not empty");
    let steps = |(a, b): (&u8, &u8)| a.abs_diff(*b);
    let largest = picture.iter().zip(&expected[0]).map(steps).max().unwrap();
    let different = picture.iter().zip(&expected[0]).filter(|pair| pair.0 != pair.1).count();
    println!("points against quads: {different} of {} bytes differ, by at most {largest}", picture.len());
    assert!(largest <= 1, "a byte differs by {largest}");

    frame.destroy(&host);
    drop((scene, renderer, ours));
    assert_eq!(host.destroy(), [] as [String; 0]);
}
