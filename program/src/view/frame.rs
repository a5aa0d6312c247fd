//! What one frame in flight has of its own, and how the window's image is rendered to.

use ash::vk;
use surfel::{
    Result,
    vk::{CommandPool, DescriptorPool, Device, Semaphore, SwapchainImage},
};

use super::{
    overlay::{OverlayBuffers, OverlayPass},
    show::Show,
};

/// One frame in flight.
pub struct Frame {
    /// Its command buffer.
    pub commands: CommandPool,
    /// Signaled once the window's image is free.
    pub acquired: Semaphore,
    /// The sets of the passes that draw to the window.
    pub sets: DescriptorPool,
    /// The triangles that lie over the picture.
    pub overlay: OverlayBuffers,
    /// Its last submission; 0 before the first.
    pub epoch: u64,
}

impl Frame {
    /// A frame that was not submitted yet.
    ///
    /// # Errors
    /// Whatever the driver answers.
    pub fn new(device: &Device, number: usize) -> Result<Self> {
        let name = format!("window frame {number}");
        let room = Show::ROOM.plus(&OverlayPass::ROOM);
        Ok(Self {
            commands: CommandPool::new(device, &name)?,
            acquired: Semaphore::new(device, "window image is free")?,
            sets: DescriptorPool::new(device, &format!("sets of {name}"), room)?,
            overlay: OverlayBuffers::default(),
            epoch: 0,
        })
    }
}

/// Begins to render to an image of the window, which is cleared, with viewport and scissor over all of it.
///
/// # Safety
/// `commands` is recording outside of rendering; the image is acquired, of this size, and alive until they have run.
pub unsafe fn begin_rendering(
    device: &Device,
    commands: vk::CommandBuffer,
    image: &SwapchainImage,
    extent: vk::Extent2D,
) {
    let area = vk::Rect2D { offset: vk::Offset2D::default(), extent };
    let gray = vk::ClearColorValue { float32: [0.05, 0.05, 0.05, 1.0] };
    let attachments = [vk::RenderingAttachmentInfo::default()
        .image_view(image.view)
        .image_layout(vk::ImageLayout::ATTACHMENT_OPTIMAL)
        .load_op(vk::AttachmentLoadOp::CLEAR)
        .store_op(vk::AttachmentStoreOp::STORE)
        .clear_value(vk::ClearValue { color: gray })];
    let info = vk::RenderingInfo::default().render_area(area).layer_count(1).color_attachments(&attachments);
    let viewport = vk::Viewport {
        width: extent.width as f32,
        height: extent.height as f32,
        max_depth: 1.0,
        ..Default::default()
    };
    let color = vk::PipelineStageFlags2::COLOR_ATTACHMENT_OUTPUT;
    let barrier = barrier(image.image)
        // Behind the semaphore, which colors wait for.
        .src_stage_mask(color)
        .dst_stage_mask(color)
        .dst_access_mask(vk::AccessFlags2::COLOR_ATTACHMENT_WRITE)
        .old_layout(vk::ImageLayout::UNDEFINED)
        .new_layout(vk::ImageLayout::ATTACHMENT_OPTIMAL);
    // SAFETY: this function's contract.
    unsafe {
        change(device, commands, barrier);
        device.raw().cmd_begin_rendering(commands, &info);
        device.raw().cmd_set_viewport(commands, 0, &[viewport]);
        device.raw().cmd_set_scissor(commands, 0, &[area]);
    }
}

/// Ends it; the image can be presented then.
///
/// # Safety
/// Rendering to the image was begun by [`begin_rendering`].
pub unsafe fn end_rendering(device: &Device, commands: vk::CommandBuffer, image: &SwapchainImage) {
    let barrier = barrier(image.image)
        .src_stage_mask(vk::PipelineStageFlags2::COLOR_ATTACHMENT_OUTPUT)
        .src_access_mask(vk::AccessFlags2::COLOR_ATTACHMENT_WRITE)
        // The semaphore of the presentation is behind everything.
        .dst_stage_mask(vk::PipelineStageFlags2::BOTTOM_OF_PIPE)
        .old_layout(vk::ImageLayout::ATTACHMENT_OPTIMAL)
        .new_layout(vk::ImageLayout::PRESENT_SRC_KHR);
    // SAFETY: this function's contract.
    unsafe {
        device.raw().cmd_end_rendering(commands);
        change(device, commands, barrier);
    }
}

fn barrier(image: vk::Image) -> vk::ImageMemoryBarrier2<'static> {
    let all = vk::ImageSubresourceRange::default()
        .aspect_mask(vk::ImageAspectFlags::COLOR)
        .level_count(1)
        .layer_count(1);
    vk::ImageMemoryBarrier2::default()
        .image(image)
        .subresource_range(all)
        .src_queue_family_index(vk::QUEUE_FAMILY_IGNORED)
        .dst_queue_family_index(vk::QUEUE_FAMILY_IGNORED)
}

/// # Safety
/// `commands` is recording outside of rendering; the image is alive until they have run.
unsafe fn change(device: &Device, commands: vk::CommandBuffer, barrier: vk::ImageMemoryBarrier2<'_>) {
    let barriers = [barrier];
    let info = vk::DependencyInfo::default().image_memory_barriers(&barriers);
    // SAFETY: this function's contract.
    unsafe { device.raw().cmd_pipeline_barrier2(commands, &info) };
}
