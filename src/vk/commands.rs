//! Command pools, each with one command buffer that is recorded again and again.

use std::cell::Cell;

use ash::vk;

use super::{device::Device, garbage::Retired, owned::Owned, result::VkResultExt};
use crate::error::{Error, Result};

/// A pool and its one command buffer.
pub struct CommandPool {
    owned: Owned<vk::CommandPool>,
    buffer: vk::CommandBuffer,
    name: String,
    // A cell, so that the pool is not `Sync`: Vulkan wants its calls one at a time.
    recording: Cell<bool>,
}

impl CommandPool {
    /// A pool for the device's queue family.
    ///
    /// # Errors
    /// Whatever the driver answers.
    pub fn new(device: &Device, name: &str) -> Result<Self> {
        let info = vk::CommandPoolCreateInfo::default()
            .queue_family_index(device.queue_family())
            .flags(vk::CommandPoolCreateFlags::TRANSIENT);
        // SAFETY: the device is alive.
        let raw =
            unsafe { device.raw().create_command_pool(&info, None) }.of_call("vkCreateCommandPool", name)?;
        let owned = device.own(raw, name, Retired::CommandPool);
        let info = vk::CommandBufferAllocateInfo::default()
            .command_pool(raw)
            .level(vk::CommandBufferLevel::PRIMARY)
            .command_buffer_count(1);
        // SAFETY: the pool is alive and ours alone.
        let buffer = unsafe { device.raw().allocate_command_buffers(&info) }
            .of_call("vkAllocateCommandBuffers", name)?[0];
        device.set_name(buffer, name);
        Ok(Self { owned, buffer, name: name.to_owned(), recording: Cell::new(false) })
    }

    /// Starts recording anew.
    ///
    /// # Safety
    /// No unfinished submission uses the command buffer.
    ///
    /// # Errors
    /// Whatever the driver answers.
    pub unsafe fn begin(&self) -> Result<vk::CommandBuffer> {
        let Owned { device, raw, .. } = &self.owned;
        // SAFETY: this function's contract.
        unsafe { device.raw().reset_command_pool(*raw, vk::CommandPoolResetFlags::empty()) }
            .of_call("vkResetCommandPool", &self.name)?;
        let info = vk::CommandBufferBeginInfo::default().flags(vk::CommandBufferUsageFlags::ONE_TIME_SUBMIT);
        // SAFETY: the buffer was just reset.
        unsafe { device.raw().begin_command_buffer(self.buffer, &info) }
            .of_call("vkBeginCommandBuffer", &self.name)?;
        self.recording.set(true);
        Ok(self.buffer)
    }

    /// Ends recording.
    ///
    /// # Errors
    /// [`crate::ErrorKind::Option`] if it was not begun; whatever the driver answers.
    pub fn end(&self) -> Result<vk::CommandBuffer> {
        if !self.recording.replace(false) {
            return Err(Error::option(self.name.clone(), "its recording ends without having begun"));
        }
        // SAFETY: the buffer is recording.
        unsafe { self.owned.device.raw().end_command_buffer(self.buffer) }
            .of_call("vkEndCommandBuffer", &self.name)?;
        Ok(self.buffer)
    }
}
