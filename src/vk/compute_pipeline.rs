//! Compute pipelines.

use ash::vk;

use super::{
    Stage, device::Device, garbage::Retired, graphics_pipeline::CompiledStage, layout::PipelineLayout,
    owned::Owned, pipeline_cache::PipelineCache, result::VkResultExt,
};
use crate::error::Result;

/// The description of a compute pipeline.
#[derive(Clone, Copy)]
pub struct ComputePipelineDesc<'a> {
    /// Its debug name.
    pub name: &'a str,
    /// The one stage.
    pub stage: Stage<'a>,
    /// Sets and push constants.
    pub layout: &'a PipelineLayout,
}

/// A compute pipeline.
pub struct ComputePipeline(Owned<vk::Pipeline>);

impl ComputePipeline {
    /// Compiles a pipeline.
    ///
    /// # Safety
    /// The SPIR-V is valid for Vulkan 1.3, as `spirv-val` tells; it needs no feature that the device was not opened with, and has no other bindings and push constants than the layout. Cache
    /// and layout are of this device.
    ///
    /// # Errors
    /// Whatever the driver answers.
    pub unsafe fn new(
        device: &Device,
        cache: &PipelineCache,
        desc: &ComputePipelineDesc<'_>,
    ) -> Result<Self> {
        let stage = CompiledStage::new(device, desc.stage)?;
        let constants = stage.specialization();
        let info = vk::ComputePipelineCreateInfo::default()
            .flags(device.pipeline_flags())
            .stage(stage.info(vk::ShaderStageFlags::COMPUTE, &constants))
            .layout(desc.layout.raw());
        // SAFETY: everything the info points to lives until the call returns and belongs to this device; the rest is this function's contract.
        let made = unsafe { device.raw().create_compute_pipelines(cache.raw(), &[info], None) };
        let raw = made.map_err(|(_, result)| result).of_call("vkCreateComputePipelines", desc.name)?[0];
        Ok(Self(device.own(raw, desc.name, Retired::Pipeline)))
    }

    /// The raw pipeline.
    pub fn raw(&self) -> vk::Pipeline {
        self.0.raw
    }
}
