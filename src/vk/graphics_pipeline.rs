//! Graphics pipelines for dynamic rendering: no vertex buffers, dynamic viewport and scissor.

use ash::vk;

use super::{
    Stage, device::Device, garbage::Retired, layout::PipelineLayout, owned::Owned,
    pipeline_cache::PipelineCache, result::VkResultExt,
};
use crate::error::Result;

/// How a fragment's color meets the attachment's.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Blend {
    /// It replaces it.
    Replace,
    /// It is added, all four components.
    Add,
    /// It is added, the first three components times the fourth.
    AddWeighted,
    /// It is put under it: added, all four components times what the attachment's fourth leaves of 1.
    Under,
    /// It is put over it, its first three components times its fourth already.
    Over,
}

/// The depth test.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DepthState {
    /// The attachment's format.
    pub format: vk::Format,
    /// A fragment passes if `fragment compare attachment`.
    pub compare: vk::CompareOp,
    /// Whether the fragment's depth is then written.
    pub write: bool,
}

/// What else the attachments are that a pipeline draws to; the default is our own passes': one sample a pixel, all color attachments written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Attachments {
    /// Samples of a pixel.
    pub samples: vk::SampleCountFlags,
    /// The format of the stencil attachment, which is left as it is.
    pub stencil_format: vk::Format,
    /// The first color attachment is written as `blend` says, and so many behind it are replaced; the others are left. `None`: all are written alike. With
    /// several attachments it needs `independentBlend`.
    pub beside_first: Option<u32>,
}

impl Default for Attachments {
    fn default() -> Self {
        Self {
            samples: vk::SampleCountFlags::TYPE_1,
            stencil_format: vk::Format::UNDEFINED,
            beside_first: None,
        }
    }
}

/// The description of a graphics pipeline.
#[derive(Clone, Copy)]
pub struct GraphicsPipelineDesc<'a> {
    /// Its debug name.
    pub name: &'a str,
    /// The vertex stage; it makes its own vertices from the index.
    pub vertex: Stage<'a>,
    /// The fragment stage.
    pub fragment: Stage<'a>,
    /// The primitives that the vertices form.
    pub topology: vk::PrimitiveTopology,
    /// Triangles whose corners are clockwise, as the picture shows them, are not drawn.
    pub cull_clockwise: bool,
    /// Formats of the color attachments.
    pub color_formats: &'a [vk::Format],
    /// How colors are written, the same for each attachment.
    pub blend: Blend,
    /// The depth test, where there is one.
    pub depth: Option<DepthState>,
    /// The rest of what it draws to.
    pub attachments: Attachments,
    /// Sets and push constants.
    pub layout: &'a PipelineLayout,
}

/// A graphics pipeline.
pub struct GraphicsPipeline(Owned<vk::Pipeline>);

impl GraphicsPipeline {
    /// Compiles a pipeline.
    ///
    /// # Safety
    /// As [`super::ComputePipeline::new`], of both stages, which agree on what goes from one to the other; the device draws into these formats with so many samples.
    ///
    /// # Errors
    /// Whatever the driver answers.
    pub unsafe fn new(
        device: &Device,
        cache: &PipelineCache,
        desc: &GraphicsPipelineDesc<'_>,
    ) -> Result<Self> {
        let vertex = CompiledStage::new(device, desc.vertex)?;
        let fragment = CompiledStage::new(device, desc.fragment)?;
        let (vertex_constants, fragment_constants) = (vertex.specialization(), fragment.specialization());
        let stages = [
            vertex.info(vk::ShaderStageFlags::VERTEX, &vertex_constants),
            fragment.info(vk::ShaderStageFlags::FRAGMENT, &fragment_constants),
        ];
        let vertex_input = vk::PipelineVertexInputStateCreateInfo::default();
        let assembly = vk::PipelineInputAssemblyStateCreateInfo::default().topology(desc.topology);
        let viewport = vk::PipelineViewportStateCreateInfo::default().viewport_count(1).scissor_count(1);
        let raster = vk::PipelineRasterizationStateCreateInfo::default()
            .polygon_mode(vk::PolygonMode::FILL)
            .cull_mode(if desc.cull_clockwise { vk::CullModeFlags::BACK } else { vk::CullModeFlags::NONE })
            .front_face(vk::FrontFace::COUNTER_CLOCKWISE)
            .line_width(1.0);
        let samples =
            vk::PipelineMultisampleStateCreateInfo::default().rasterization_samples(desc.attachments.samples);
        let depth = desc.depth.map_or_else(vk::PipelineDepthStencilStateCreateInfo::default, |state| {
            vk::PipelineDepthStencilStateCreateInfo::default()
                .depth_test_enable(true)
                .depth_write_enable(state.write)
                .depth_compare_op(state.compare)
        });
        let left_of_destination = match desc.blend {
            Blend::Over => vk::BlendFactor::ONE_MINUS_SRC_ALPHA,
            _ => vk::BlendFactor::ONE,
        };
        let add = vk::PipelineColorBlendAttachmentState::default()
            .blend_enable(desc.blend != Blend::Replace)
            .src_color_blend_factor(match desc.blend {
                Blend::AddWeighted => vk::BlendFactor::SRC_ALPHA,
                Blend::Under => vk::BlendFactor::ONE_MINUS_DST_ALPHA,
                _ => vk::BlendFactor::ONE,
            })
            .dst_color_blend_factor(left_of_destination)
            .color_blend_op(vk::BlendOp::ADD)
            .src_alpha_blend_factor(match desc.blend {
                Blend::Under => vk::BlendFactor::ONE_MINUS_DST_ALPHA,
                _ => vk::BlendFactor::ONE,
            })
            .dst_alpha_blend_factor(left_of_destination)
            .alpha_blend_op(vk::BlendOp::ADD)
            .color_write_mask(vk::ColorComponentFlags::RGBA);
        let untouched = vk::PipelineColorBlendAttachmentState::default();
        let replaced = untouched.color_write_mask(vk::ColorComponentFlags::RGBA);
        let attachment = |i: usize| match desc.attachments.beside_first {
            Some(replace) if i > replace as usize => untouched,
            Some(_) if i > 0 => replaced,
            _ => add,
        };
        let attachments: Vec<_> = (0..desc.color_formats.len()).map(attachment).collect();
        let blend = vk::PipelineColorBlendStateCreateInfo::default().attachments(&attachments);
        let dynamic_states = [vk::DynamicState::VIEWPORT, vk::DynamicState::SCISSOR];
        let dynamic = vk::PipelineDynamicStateCreateInfo::default().dynamic_states(&dynamic_states);
        let mut rendering = vk::PipelineRenderingCreateInfo::default()
            .color_attachment_formats(desc.color_formats)
            .depth_attachment_format(desc.depth.map_or(vk::Format::UNDEFINED, |state| state.format))
            .stencil_attachment_format(desc.attachments.stencil_format);
        let info = vk::GraphicsPipelineCreateInfo::default()
            .flags(device.pipeline_flags())
            .stages(&stages)
            .vertex_input_state(&vertex_input)
            .input_assembly_state(&assembly)
            .viewport_state(&viewport)
            .rasterization_state(&raster)
            .multisample_state(&samples)
            .depth_stencil_state(&depth)
            .color_blend_state(&blend)
            .dynamic_state(&dynamic)
            .layout(desc.layout.raw())
            .push_next(&mut rendering);
        // SAFETY: everything the info points to lives until the call returns and belongs to this device; the rest is this function's contract.
        let made = unsafe { device.raw().create_graphics_pipelines(cache.raw(), &[info], None) };
        let raw = made.map_err(|(_, result)| result).of_call("vkCreateGraphicsPipelines", desc.name)?[0];
        Ok(Self(device.own(raw, desc.name, Retired::Pipeline)))
    }

    /// The raw pipeline.
    pub fn raw(&self) -> vk::Pipeline {
        self.0.raw
    }
}

/// A shader module for as long as its pipeline is being made.
pub(super) struct CompiledStage<'a> {
    device: &'a Device,
    module: vk::ShaderModule,
    entries: Vec<vk::SpecializationMapEntry>,
    data: Vec<u8>,
}

impl<'a> CompiledStage<'a> {
    pub(super) fn new(device: &'a Device, stage: Stage<'_>) -> Result<Self> {
        let info = vk::ShaderModuleCreateInfo::default().code(stage.spirv);
        // SAFETY: the code is SPIR-V that our build validated.
        let module = unsafe { device.raw().create_shader_module(&info, None) }
            .of_call("vkCreateShaderModule", stage.name)?;
        device.set_name(module, stage.name);
        let entry = |(i, (id, _)): (usize, &(u32, u32))| {
            vk::SpecializationMapEntry::default().constant_id(*id).offset(4 * i as u32).size(4)
        };
        Ok(Self {
            device,
            module,
            entries: stage.constants.iter().enumerate().map(entry).collect(),
            data: stage.constants.iter().flat_map(|(_, value)| value.to_ne_bytes()).collect(),
        })
    }

    pub(super) fn specialization(&self) -> vk::SpecializationInfo<'_> {
        vk::SpecializationInfo::default().map_entries(&self.entries).data(&self.data)
    }

    pub(super) fn info<'s>(
        &self,
        stage: vk::ShaderStageFlags,
        specialization: &'s vk::SpecializationInfo<'s>,
    ) -> vk::PipelineShaderStageCreateInfo<'s> {
        vk::PipelineShaderStageCreateInfo::default()
            .stage(stage)
            .module(self.module)
            .name(c"main")
            .specialization_info(specialization)
    }
}

impl Drop for CompiledStage<'_> {
    fn drop(&mut self) {
        // SAFETY: modules are needed only while pipelines are made from them, which is over.
        unsafe { self.device.raw().destroy_shader_module(self.module, None) };
    }
}
