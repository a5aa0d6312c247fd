//! Pipeline layouts: which sets and push constants a pipeline takes.

use ash::vk;

use super::{descriptors::SetLayout, device::Device, garbage::Retired, owned::Owned, result::VkResultExt};
use crate::error::Result;

/// The sets and push constants that pipelines share.
pub struct PipelineLayout {
    owned: Owned<vk::PipelineLayout>,
    push_stages: vk::ShaderStageFlags,
}

impl PipelineLayout {
    /// A layout of `sets` (set 0 first) and `push_bytes` of push constants seen by `push_stages`.
    ///
    /// # Errors
    /// Whatever the driver answers.
    pub fn new(
        device: &Device,
        name: &str,
        sets: &[&SetLayout],
        push_bytes: u32,
        push_stages: vk::ShaderStageFlags,
    ) -> Result<Self> {
        let sets: Vec<_> = sets.iter().map(|set| set.raw()).collect();
        let push = [vk::PushConstantRange::default().stage_flags(push_stages).size(push_bytes)];
        let push: &[_] = if push_bytes > 0 { &push } else { &[] };
        let info = vk::PipelineLayoutCreateInfo::default().set_layouts(&sets).push_constant_ranges(push);
        // SAFETY: the set layouts are alive and belong to this device.
        let raw = unsafe { device.raw().create_pipeline_layout(&info, None) }
            .of_call("vkCreatePipelineLayout", name)?;
        Ok(Self { owned: device.own(raw, name, Retired::PipelineLayout), push_stages })
    }

    /// The raw layout.
    pub fn raw(&self) -> vk::PipelineLayout {
        self.owned.raw
    }

    /// The stages that see the push constants.
    pub fn push_stages(&self) -> vk::ShaderStageFlags {
        self.push_stages
    }
}
