//! What a host has for each of its frames in flight.

use std::sync::Mutex;

use ash::vk;
use surfel::{
    frame::{FrameSlot, Target},
    graph::ImageState,
    vk::{Buffer, BufferDesc, Device, MemoryUse},
};

use crate::common::host::Host;

/// The format of the host's image.
pub const FORMAT: vk::Format = vk::Format::R8G8B8A8_SRGB;

/// One frame in flight of the host's: its command pool, its fence, the image that it will show, our slot.
pub struct InFlight {
    pool: vk::CommandPool,
    pub commands: vk::CommandBuffer,
    fence: vk::Fence,
    image: vk::Image,
    view: vk::ImageView,
    memory: vk::DeviceMemory,
    pub slot: FrameSlot,
    /// What this frame was submitted as, while it is under way.
    pub epoch: Option<u64>,
    pub pixels: Buffer,
}

impl InFlight {
    pub fn new(host: &Host, ours: &Device, [width, height]: [u32; 2]) -> Self {
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

    pub fn begin(&self, host: &Host) {
        let info = vk::CommandBufferBeginInfo::default().flags(vk::CommandBufferUsageFlags::ONE_TIME_SUBMIT);
        // SAFETY: the frame's earlier submission was waited for.
        unsafe {
            host.device.reset_command_pool(self.pool, vk::CommandPoolResetFlags::empty()).unwrap();
            host.device.begin_command_buffer(self.commands, &info).unwrap();
        }
    }

    /// The host's submission, which is also the end of an epoch of ours.
    pub fn submit(&mut self, host: &Host, ours: &Device) {
        let commands = [vk::CommandBufferSubmitInfo::default().command_buffer(self.commands)];
        let info = vk::SubmitInfo2::default().command_buffer_infos(&commands);
        // SAFETY: recorded just now; all of it is alive until `wait`.
        unsafe {
            host.device.end_command_buffer(self.commands).unwrap();
            host.device.queue_submit2(host.queue, &[info], self.fence).unwrap();
        }
        self.epoch = Some(ours.end_epoch());
    }

    pub fn wait(&mut self, host: &Host, ours: &Device) {
        if let Some(epoch) = self.epoch.take() {
            // SAFETY: the fence was submitted; after it this submission and, the queue being one, all before are done.
            unsafe {
                host.device.wait_for_fences(&[self.fence], true, u64::MAX).unwrap();
                host.device.reset_fences(&[self.fence]).unwrap();
                ours.epoch_done(epoch);
            }
        }
    }

    /// The same where several threads submit, while none does: in layers of before March 2024 what a wait has settled comes back with a submission that another thread is in the midst of, and is
    /// taken for a hazard (Vulkan-ValidationLayers, issue 7250, mended by 7663). Until the frame is done others have their turns.
    pub fn wait_in_turn(&mut self, host: &Host, ours: &Device, turn: &Mutex<()>) {
        loop {
            let turn = turn.lock().unwrap();
            // SAFETY: the fence was submitted.
            if unsafe { host.device.get_fence_status(self.fence) }.unwrap() {
                return self.wait(host, ours);
            }
            drop(turn);
            std::thread::yield_now();
        }
    }

    /// The host's image as a target. The host copies it afterwards, so it wants it in that state.
    pub fn target(&self, [width, height]: [u32; 2]) -> Target {
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
    pub fn copy_target(&self, host: &Host, [width, height]: [u32; 2]) {
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

    pub fn destroy(self, host: &Host) {
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
