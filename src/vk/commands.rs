//! Command pools, each with one command buffer that is recorded again and again.

use std::cell::Cell;

use ash::vk;

use super::{device::Device, garbage::Retired, result::VkResultExt};
use crate::error::{Error, Result};

/// A pool and its one command buffer.
pub struct CommandPool {
    device: Device,
    raw: vk::CommandPool,
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
        // From here on a failure must not leak the handle.
        let mut pool = Self {
            device: device.clone(),
            raw,
            buffer: vk::CommandBuffer::null(),
            name: name.to_owned(),
            recording: Cell::new(false),
        };
        device.set_name(raw, name);
        let info = vk::CommandBufferAllocateInfo::default()
            .command_pool(raw)
            .level(vk::CommandBufferLevel::PRIMARY)
            .command_buffer_count(1);
        // SAFETY: the pool is alive and ours alone.
        pool.buffer = unsafe { device.raw().allocate_command_buffers(&info) }
            .of_call("vkAllocateCommandBuffers", name)?[0];
        device.set_name(pool.buffer, name);
        Ok(pool)
    }

    /// Starts recording anew.
    ///
    /// # Safety
    /// No unfinished submission uses the command buffer.
    ///
    /// # Errors
    /// Whatever the driver answers.
    pub unsafe fn begin(&self) -> Result<vk::CommandBuffer> {
        // SAFETY: this function's contract.
        unsafe { self.device.raw().reset_command_pool(self.raw, vk::CommandPoolResetFlags::empty()) }
            .of_call("vkResetCommandPool", &self.name)?;
        let info = vk::CommandBufferBeginInfo::default().flags(vk::CommandBufferUsageFlags::ONE_TIME_SUBMIT);
        // SAFETY: the buffer was just reset.
        unsafe { self.device.raw().begin_command_buffer(self.buffer, &info) }
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
        unsafe { self.device.raw().end_command_buffer(self.buffer) }
            .of_call("vkEndCommandBuffer", &self.name)?;
        Ok(self.buffer)
    }
}

impl Drop for CommandPool {
    fn drop(&mut self) {
        self.device.retire(Retired::CommandPool(self.raw));
    }
}
