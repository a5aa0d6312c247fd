//! Pipeline layouts: which sets and push constants a pipeline takes.

use ash::vk;

use super::{
    descriptors::SetLayout, device::Device, garbage::Retired, owned::Owned, result::VkResultExt, stage_limits,
};
use crate::error::{Error, Result};

/// What every device has: bytes that are pushed, and sets; and the stages that we use.
const MOST_PUSH_BYTES: u32 = 128;
const MOST_SETS: usize = 4;
pub(super) const STAGES: vk::ShaderStageFlags = vk::ShaderStageFlags::from_raw(
    vk::ShaderStageFlags::VERTEX.as_raw()
        | vk::ShaderStageFlags::FRAGMENT.as_raw()
        | vk::ShaderStageFlags::COMPUTE.as_raw(),
);

/// The sets and push constants that pipelines share.
pub struct PipelineLayout {
    owned: Owned<vk::PipelineLayout>,
    push_stages: vk::ShaderStageFlags,
}

impl PipelineLayout {
    /// A layout of `sets` (set 0 first) and `push_bytes` of push constants seen by `push_stages`.
    ///
    /// # Errors
    /// [`crate::ErrorKind::Option`] for more sets and bytes than every device has, for more descriptors than this one has, and for sets of another device; whatever the driver answers.
    pub fn new(
        device: &Device,
        name: &str,
        sets: &[&SetLayout],
        push_bytes: u32,
        push_stages: vk::ShaderStageFlags,
    ) -> Result<Self> {
        let push_fits = push_bytes <= MOST_PUSH_BYTES
            && push_bytes.is_multiple_of(4)
            && (push_bytes == 0 || !push_stages.is_empty() && STAGES.contains(push_stages));
        if sets.len() > MOST_SETS || !push_fits {
            let problem = format!("{} sets, {push_bytes} bytes for {push_stages:?}", sets.len());
            return Err(Error::option(name, problem));
        }
        if !sets.iter().all(|set| set.is_of(device)) {
            return Err(Error::option(name, "a set of another device"));
        }
        stage_limits::check(device, name, sets.iter().flat_map(|set| set.bindings()))?;
        let sets: Vec<_> = sets.iter().map(|set| set.raw()).collect();
        let push = [vk::PushConstantRange::default().stage_flags(push_stages).size(push_bytes)];
        let push: &[_] = if push_bytes > 0 { &push } else { &[] };
        let info = vk::PipelineLayoutCreateInfo::default().set_layouts(&sets).push_constant_ranges(push);
        // SAFETY: the set layouts are alive and belong to this device, whose limits were looked at.
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
