//! A sampler.

use ash::vk;

use super::{device::Device, garbage::Retired, owned::Owned, result::VkResultExt};
use crate::error::Result;

/// Bilinear, clamped to the edge, without mip levels.
pub struct Sampler(Owned<vk::Sampler>);

impl Sampler {
    /// A bilinear sampler.
    ///
    /// # Errors
    /// Whatever the driver answers.
    pub fn new(device: &Device, name: &str) -> Result<Self> {
        let clamp = vk::SamplerAddressMode::CLAMP_TO_EDGE;
        let info = vk::SamplerCreateInfo::default()
            .mag_filter(vk::Filter::LINEAR)
            .min_filter(vk::Filter::LINEAR)
            .address_mode_u(clamp)
            .address_mode_v(clamp)
            .address_mode_w(clamp);
        // SAFETY: the device is alive.
        let raw = unsafe { device.raw().create_sampler(&info, None) }.of_call("vkCreateSampler", name)?;
        Ok(Self(device.own(raw, name, Retired::Sampler)))
    }

    /// The raw sampler.
    pub fn raw(&self) -> vk::Sampler {
        self.0.raw
    }
}
