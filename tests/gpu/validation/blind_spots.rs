//! Facts about what the layer sees. They are printed for every version of it, and held fast for 1.3.239, so that the
//! list at the head of `validation.rs` stays true.

use ash::vk;
use surfel::vk::{Buffer, BufferDesc, Image, ImageDesc, MemoryUse};

use crate::common::watched::{TRANSFER_WRITE, Watched, barrier, fill};

/// The layer that the facts were found with, as it writes its own version.
const KNOWN: [u32; 3] = [1, 3, 239];

const COLOR_WRITE: (vk::PipelineStageFlags2, vk::AccessFlags2) =
    (vk::PipelineStageFlags2::COLOR_ATTACHMENT_OUTPUT, vk::AccessFlags2::COLOR_ATTACHMENT_WRITE);

fn layer_version() -> [u32; 3] {
    // SAFETY: loading the loader, and asking it for its layers.
    let layers = unsafe { ash::Entry::load().unwrap().enumerate_instance_layer_properties() }.unwrap();
    let name = c"VK_LAYER_KHRONOS_validation";
    let layer = layers.iter().find(|layer| layer.layer_name_as_c_str() == Ok(name)).unwrap();
    let version = layer.spec_version;
    [vk::api_version_major(version), vk::api_version_minor(version), vk::api_version_patch(version)]
}

/// Prints whether `defect` was seen, and fails if the known layer behaves otherwise.
fn fact(defect: &str, said: &[String], seen_by_the_known_layer: bool) {
    let seen = said.iter().any(|vuid| vuid.starts_with("SYNC-HAZARD"));
    let version = layer_version();
    println!("layer {version:?}: {defect}: {}", if seen { "seen" } else { "not seen" });
    assert!(version != KNOWN || seen == seen_by_the_known_layer, "{defect}: seen is {seen}: {said:?}");
}

fn color_image(watched: &Watched) -> Image {
    let extent = vk::Extent2D { width: 64, height: 64 };
    let usage = vk::ImageUsageFlags::COLOR_ATTACHMENT
        | vk::ImageUsageFlags::TRANSFER_SRC
        | vk::ImageUsageFlags::TRANSFER_DST;
    let desc = ImageDesc { name: "the image", format: vk::Format::R8G8B8A8_UNORM, extent, usage };
    Image::new(&watched.device, desc).unwrap()
}

const WHOLE: vk::ImageSubresourceRange = vk::ImageSubresourceRange {
    aspect_mask: vk::ImageAspectFlags::COLOR,
    base_mip_level: 0,
    level_count: 1,
    base_array_layer: 0,
    layer_count: 1,
};

/// Brings an image without content into the layout `GENERAL`, for rendering and copies: the transition itself is a
/// write that the layer sees, and shall not be what it finds.
fn begin(device: &ash::Device, commands: vk::CommandBuffer, image: vk::Image) {
    let barriers = [vk::ImageMemoryBarrier2::default()
        .dst_stage_mask(COLOR_WRITE.0 | TRANSFER_WRITE.0)
        .dst_access_mask(COLOR_WRITE.1 | TRANSFER_WRITE.1 | vk::AccessFlags2::TRANSFER_READ)
        .new_layout(vk::ImageLayout::GENERAL)
        .image(image)
        .subresource_range(WHOLE)];
    let info = vk::DependencyInfo::default().image_memory_barriers(&barriers);
    // SAFETY: recording, outside of rendering.
    unsafe { device.cmd_pipeline_barrier2(commands, &info) };
}

/// Clears an image by rendering nothing to it.
fn render(device: &ash::Device, commands: vk::CommandBuffer, image: &Image) {
    let colors = [vk::RenderingAttachmentInfo::default()
        .image_view(image.view())
        .image_layout(vk::ImageLayout::GENERAL)
        .load_op(vk::AttachmentLoadOp::CLEAR)
        .store_op(vk::AttachmentStoreOp::STORE)];
    let info = vk::RenderingInfo::default()
        .render_area(vk::Rect2D::default().extent(image.extent()))
        .layer_count(1)
        .color_attachments(&colors);
    // SAFETY: recording; the image is in the layout named above.
    unsafe {
        device.cmd_begin_rendering(commands, &info);
        device.cmd_end_rendering(commands);
    }
}

#[test]
fn attachments_of_dynamic_rendering() {
    let watched = Watched::new();
    let image = color_image(&watched);
    let said = watched.run(&[&|d, c| {
        begin(d, c, image.raw());
        render(d, c, &image);
        render(d, c, &image);
    }]);
    fact("an attachment written twice without a barrier", &said, false);

    let rows = Buffer::new(
        &watched.device,
        BufferDesc { name: "rows", size: 4 * 64 * 64, usage: vk::BufferUsageFlags::TRANSFER_DST },
        MemoryUse::Readback,
    )
    .unwrap();
    let said = watched.run(&[&|d, c| {
        begin(d, c, image.raw());
        render(d, c, &image);
        let layers =
            vk::ImageSubresourceLayers::default().aspect_mask(vk::ImageAspectFlags::COLOR).layer_count(1);
        let region =
            vk::BufferImageCopy::default().image_subresource(layers).image_extent(image.extent().into());
        // SAFETY: recording; both are alive, the buffer has room. The missing barrier is what this is about.
        unsafe {
            d.cmd_copy_image_to_buffer(c, image.raw(), vk::ImageLayout::GENERAL, rows.raw(), &[region]);
        }
    }]);
    fact("an attachment copied from without a barrier", &said, false);
}

/// Submissions that a timeline semaphore orders, on the device and then through the host: no hazard at all.
#[test]
fn order_by_timeline_semaphores() {
    let watched = Watched::new();
    let buffer = watched.buffer(vk::BufferUsageFlags::TRANSFER_DST);
    let device = watched.device.raw();
    let mut kind = vk::SemaphoreTypeCreateInfo::default().semaphore_type(vk::SemaphoreType::TIMELINE);
    let info = vk::SemaphoreCreateInfo::default().push_next(&mut kind);
    // SAFETY: destroyed below.
    let semaphore = unsafe { device.create_semaphore(&info, None) }.unwrap();
    // SAFETY: the only queue; nobody else submits meanwhile.
    let queue = unsafe { device.get_device_queue(watched.device.queue_family(), 0) };
    let pools = [0, 1].map(|_| surfel::vk::CommandPool::new(&watched.device, "program").unwrap());
    let submit = |pool: &surfel::vk::CommandPool, wait: Option<u64>, signal: u64| {
        let at = |value| {
            let stages = vk::PipelineStageFlags2::ALL_TRANSFER;
            vk::SemaphoreSubmitInfo::default().semaphore(semaphore).value(value).stage_mask(stages)
        };
        let waits: Vec<_> = wait.map(at).into_iter().collect();
        let signals = [at(signal)];
        // SAFETY: the pool's earlier submission was waited for; what is recorded is alive until it has run.
        unsafe {
            fill(device, pool.begin().unwrap(), &buffer);
            let commands = [vk::CommandBufferSubmitInfo::default().command_buffer(pool.end().unwrap())];
            let info = vk::SubmitInfo2::default()
                .command_buffer_infos(&commands)
                .wait_semaphore_infos(&waits)
                .signal_semaphore_infos(&signals);
            device.queue_submit2(queue, &[info], vk::Fence::null()).unwrap();
        }
    };
    let wait_host = |value| {
        let (semaphores, values) = ([semaphore], [value]);
        let info = vk::SemaphoreWaitInfo::default().semaphores(&semaphores).values(&values);
        // SAFETY: the value was submitted.
        unsafe { device.wait_semaphores(&info, u64::MAX) }.unwrap();
    };
    submit(&pools[0], None, 1);
    submit(&pools[1], Some(1), 2);
    wait_host(2);
    fact("a false hazard between submissions that a timeline semaphore orders", &watched.said(), false);
    submit(&pools[0], None, 3);
    wait_host(3);
    fact("a false hazard after the host's wait for a timeline semaphore", &watched.said(), true);
    // SAFETY: idle after this; the semaphore is destroyed once.
    unsafe {
        device.queue_wait_idle(queue).unwrap();
        device.destroy_semaphore(semaphore, None);
    }
    // With a barrier of its own, as in the silent twin of the seeded defect, nothing is said whoever waits.
    let said = watched.run(&[&|d, c| fill(d, c, &buffer), &|d, c| {
        barrier(d, c, TRANSFER_WRITE, TRANSFER_WRITE);
        fill(d, c, &buffer);
    }]);
    assert!(said.is_empty(), "{said:?}");
}
