//! Deferred destruction: raw handles wait here until the device has finished with them.

use std::collections::VecDeque;

use ash::vk;

use super::host_memory::{Piece, Source};

/// A raw object whose owner is gone.
pub(super) enum Retired {
    Buffer(vk::Buffer, vk::BufferView, Option<Piece>),
    Image(vk::Image, vk::ImageView, Option<Piece>),
    Memory(Piece),
    Pipeline(vk::Pipeline),
    PipelineLayout(vk::PipelineLayout),
    PipelineCache(vk::PipelineCache),
    SetLayout(vk::DescriptorSetLayout),
    DescriptorPool(vk::DescriptorPool),
    QueryPool(vk::QueryPool),
    CommandPool(vk::CommandPool),
    Sampler(vk::Sampler),
    Semaphore(vk::Semaphore),
    /// With the functions of the extension, and the surface, which goes after it.
    #[cfg(feature = "view")]
    Swapchain(vk::SwapchainKHR, Box<(ash::khr::swapchain::Device, super::surface::Surface)>),
}

/// The queue of retired objects, each with the epoch (submission) that may use it last.
#[derive(Default)]
pub(super) struct Garbage {
    pending: VecDeque<(u64, Retired)>,
}

impl Garbage {
    /// Takes an object in. Epochs never decrease from call to call.
    pub fn push(&mut self, last_epoch: u64, object: Retired) {
        self.pending.push_back((last_epoch, object));
    }

    /// Whether there is any that no epoch after `done` uses.
    pub fn has(&self, done: u64) -> bool {
        self.pending.front().is_some_and(|(epoch, _)| *epoch <= done)
    }

    /// Destroys all that no epoch after `done` uses, in the order of retirement.
    ///
    /// # Safety
    /// The device has finished every submission up to epoch `done`, and `device` made every object.
    pub unsafe fn collect(&mut self, done: u64, device: &ash::Device, allocator: &mut Source) {
        while self.has(done) {
            if let Some((_, object)) = self.pending.pop_front() {
                // SAFETY: this function's contract.
                unsafe { destroy(object, device, allocator) };
            }
        }
    }
}

/// # Safety
/// `device` made the object and nothing uses it any more.
unsafe fn destroy(object: Retired, device: &ash::Device, allocator: &mut Source) {
    // SAFETY: this function's contract, for every call; memory goes after what is bound to it.
    unsafe {
        match object {
            Retired::Buffer(buffer, texels, allocation) => {
                device.destroy_buffer_view(texels, None);
                device.destroy_buffer(buffer, None);
                free(allocation, allocator);
            }
            Retired::Image(image, view, allocation) => {
                device.destroy_image_view(view, None);
                device.destroy_image(image, None);
                free(allocation, allocator);
            }
            Retired::Memory(allocation) => free(Some(allocation), allocator),
            Retired::Pipeline(raw) => device.destroy_pipeline(raw, None),
            Retired::PipelineLayout(raw) => device.destroy_pipeline_layout(raw, None),
            Retired::PipelineCache(raw) => device.destroy_pipeline_cache(raw, None),
            Retired::SetLayout(raw) => device.destroy_descriptor_set_layout(raw, None),
            Retired::DescriptorPool(raw) => device.destroy_descriptor_pool(raw, None),
            Retired::QueryPool(raw) => device.destroy_query_pool(raw, None),
            Retired::CommandPool(raw) => device.destroy_command_pool(raw, None),
            Retired::Sampler(raw) => device.destroy_sampler(raw, None),
            Retired::Semaphore(raw) => device.destroy_semaphore(raw, None),
            #[cfg(feature = "view")]
            Retired::Swapchain(raw, owner) => owner.0.destroy_swapchain(raw, None),
        }
    }
}

fn free(allocation: Option<Piece>, allocator: &mut Source) {
    if let Some(allocation) = allocation {
        allocator.free(allocation);
    }
}
