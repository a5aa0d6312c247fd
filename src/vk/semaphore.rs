//! Binary semaphores, which order submissions and the presentation of images.

use ash::vk;

use super::{device::Device, garbage::Retired, owned::Owned, result::VkResultExt};
use crate::error::Result;

/// A binary semaphore.
pub struct Semaphore(Owned<vk::Semaphore>);

impl Semaphore {
    /// A semaphore that nothing has signaled.
    ///
    /// # Errors
    /// Whatever the driver answers.
    pub fn new(device: &Device, name: &str) -> Result<Self> {
        let info = vk::SemaphoreCreateInfo::default();
        // SAFETY: the device is alive.
        let raw = unsafe { device.raw().create_semaphore(&info, None) }.of_call("vkCreateSemaphore", name)?;
        Ok(Self(device.own(raw, name, Retired::Semaphore)))
    }

    /// What colors of a window's image wait for; before they are drawn nothing touches it.
    #[cfg(feature = "view")]
    pub(super) fn before_colors(&self) -> vk::SemaphoreSubmitInfo<'static> {
        let colors = vk::PipelineStageFlags2::COLOR_ATTACHMENT_OUTPUT;
        vk::SemaphoreSubmitInfo::default().semaphore(self.raw()).stage_mask(colors)
    }

    pub(super) fn raw(&self) -> vk::Semaphore {
        self.0.raw
    }
}
