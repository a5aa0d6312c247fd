//! How the engine's images, its buffer and its pipeline are made.

use std::{
    ffi::{CStr, c_void},
    sync::Mutex,
};

use ash::vk;

use super::{Attachment, COLOR_FORMAT, OBJECT_FORMATS, Style};

/// What the engine's objects are made with.
pub(super) struct Make<'a> {
    pub instance: &'a ash::Instance,
    pub physical: vk::PhysicalDevice,
    pub device: &'a ash::Device,
    pub style: Style,
}

impl Make<'_> {
    unsafe fn memory(
        &self,
        needed: vk::MemoryRequirements,
        wanted: vk::MemoryPropertyFlags,
    ) -> vk::DeviceMemory {
        // SAFETY: all handles are the engine's own.
        unsafe {
            let types = self.instance.get_physical_device_memory_properties(self.physical);
            let fits = |i: &u32| {
                needed.memory_type_bits & (1 << i) != 0
                    && types.memory_types[*i as usize].property_flags.contains(wanted)
            };
            let kind = (0..types.memory_type_count).find(fits).expect("memory");
            let info = vk::MemoryAllocateInfo::default().allocation_size(needed.size).memory_type_index(kind);
            self.device.allocate_memory(&info, None).unwrap()
        }
    }

    pub unsafe fn attachment(
        &self,
        format: vk::Format,
        usage: vk::ImageUsageFlags,
        samples: vk::SampleCountFlags,
    ) -> Attachment {
        let [width, height] = self.style.size_px;
        let info = vk::ImageCreateInfo::default()
            .image_type(vk::ImageType::TYPE_2D)
            .format(format)
            .extent(vk::Extent3D { width, height, depth: 1 })
            .mip_levels(1)
            .array_layers(1)
            .samples(samples)
            .usage(usage);
        // SAFETY: all handles are the engine's own.
        unsafe {
            let image = self.device.create_image(&info, None).unwrap();
            let needed = self.device.get_image_memory_requirements(image);
            let memory = self.memory(needed, vk::MemoryPropertyFlags::DEVICE_LOCAL);
            self.device.bind_image_memory(image, memory, 0).unwrap();
            let aspect = aspect_of(format) & !vk::ImageAspectFlags::STENCIL;
            let range =
                vk::ImageSubresourceRange::default().aspect_mask(aspect).level_count(1).layer_count(1);
            let info = vk::ImageViewCreateInfo::default()
                .image(image)
                .view_type(vk::ImageViewType::TYPE_2D)
                .format(format)
                .subresource_range(range);
            Attachment { image, view: self.device.create_image_view(&info, None).unwrap(), memory }
        }
    }

    pub unsafe fn readback(&self) -> (vk::Buffer, vk::DeviceMemory, *const u8) {
        let [width, height] = self.style.size_px.map(u64::from);
        let info = vk::BufferCreateInfo::default()
            .size(32 * width * height)
            .usage(vk::BufferUsageFlags::TRANSFER_DST);
        // SAFETY: all handles are the engine's own.
        unsafe {
            let buffer = self.device.create_buffer(&info, None).unwrap();
            let needed = self.device.get_buffer_memory_requirements(buffer);
            let visible = vk::MemoryPropertyFlags::HOST_VISIBLE | vk::MemoryPropertyFlags::HOST_COHERENT;
            let memory = self.memory(needed, visible);
            self.device.bind_buffer_memory(buffer, memory, 0).unwrap();
            let mapped =
                self.device.map_memory(memory, 0, vk::WHOLE_SIZE, vk::MemoryMapFlags::empty()).unwrap();
            (buffer, memory, mapped.cast_const().cast())
        }
    }

    pub unsafe fn pipeline(&self) -> (vk::PipelineLayout, vk::Pipeline) {
        const NUMBERS: &str =
            "#version 460\nlayout(push_constant) uniform Numbers { vec4 corners[3]; vec4 color; };\n";
        let vertex = format!("{NUMBERS} void main() {{ gl_Position = corners[gl_VertexIndex]; }}");
        let fragment =
            format!("{NUMBERS} layout(location = 0) out vec4 shown; void main() {{ shown = color; }}");
        let compiler = shaderc::Compiler::new().unwrap();
        // SAFETY: all handles are the engine's own; the modules live until the pipeline is made.
        unsafe {
            let module = |text: &str, kind| {
                let words = compiler.compile_into_spirv(text, kind, "engine", "main", None).unwrap();
                let info = vk::ShaderModuleCreateInfo::default().code(words.as_binary());
                self.device.create_shader_module(&info, None).unwrap()
            };
            let modules = [
                module(&vertex, shaderc::ShaderKind::Vertex),
                module(&fragment, shaderc::ShaderKind::Fragment),
            ];
            let kinds = [vk::ShaderStageFlags::VERTEX, vk::ShaderStageFlags::FRAGMENT];
            let stage = |i: usize| {
                vk::PipelineShaderStageCreateInfo::default().stage(kinds[i]).module(modules[i]).name(c"main")
            };
            let stages = [stage(0), stage(1)];
            let ranges = [vk::PushConstantRange { stage_flags: kinds[0] | kinds[1], offset: 0, size: 64 }];
            let info = vk::PipelineLayoutCreateInfo::default().push_constant_ranges(&ranges);
            let layout = self.device.create_pipeline_layout(&info, None).unwrap();
            let vertices = vk::PipelineVertexInputStateCreateInfo::default();
            let assembly = vk::PipelineInputAssemblyStateCreateInfo::default()
                .topology(vk::PrimitiveTopology::TRIANGLE_LIST);
            let viewport = vk::PipelineViewportStateCreateInfo::default().viewport_count(1).scissor_count(1);
            let raster = vk::PipelineRasterizationStateCreateInfo::default().line_width(1.0);
            let samples =
                vk::PipelineMultisampleStateCreateInfo::default().rasterization_samples(self.style.samples);
            let depth = vk::PipelineDepthStencilStateCreateInfo::default()
                .depth_test_enable(true)
                .depth_write_enable(true)
                .depth_compare_op(self.style.compare);
            let written = vk::PipelineColorBlendAttachmentState::default()
                .color_write_mask(vk::ColorComponentFlags::RGBA);
            let told = OBJECT_FORMATS.into_iter().filter(|_| self.style.tells_objects);
            let formats: Vec<_> = [COLOR_FORMAT].into_iter().chain(told).collect();
            let mut all = vec![vk::PipelineColorBlendAttachmentState::default(); formats.len()];
            all[0] = written;
            let blend = vk::PipelineColorBlendStateCreateInfo::default().attachments(&all);
            let states = [vk::DynamicState::VIEWPORT, vk::DynamicState::SCISSOR];
            let dynamic = vk::PipelineDynamicStateCreateInfo::default().dynamic_states(&states);
            let mut rendering = vk::PipelineRenderingCreateInfo::default()
                .color_attachment_formats(&formats)
                .depth_attachment_format(self.style.depth_format);
            let info = vk::GraphicsPipelineCreateInfo::default()
                .stages(&stages)
                .vertex_input_state(&vertices)
                .input_assembly_state(&assembly)
                .viewport_state(&viewport)
                .rasterization_state(&raster)
                .multisample_state(&samples)
                .depth_stencil_state(&depth)
                .color_blend_state(&blend)
                .dynamic_state(&dynamic)
                .layout(layout)
                .push_next(&mut rendering);
            let made = self.device.create_graphics_pipelines(vk::PipelineCache::null(), &[info], None);
            modules.into_iter().for_each(|module| self.device.destroy_shader_module(module, None));
            (layout, made.unwrap()[0])
        }
    }
}

pub(super) fn aspect_of(format: vk::Format) -> vk::ImageAspectFlags {
    match format {
        vk::Format::D16_UNORM | vk::Format::X8_D24_UNORM_PACK32 | vk::Format::D32_SFLOAT => {
            vk::ImageAspectFlags::DEPTH
        }
        vk::Format::D24_UNORM_S8_UINT | vk::Format::D32_SFLOAT_S8_UINT => {
            vk::ImageAspectFlags::DEPTH | vk::ImageAspectFlags::STENCIL
        }
        _ => vk::ImageAspectFlags::COLOR,
    }
}

pub(super) unsafe extern "system" fn on_message(
    _severity: vk::DebugUtilsMessageSeverityFlagsEXT,
    _kind: vk::DebugUtilsMessageTypeFlagsEXT,
    data: *const vk::DebugUtilsMessengerCallbackDataEXT<'_>,
    user_data: *mut c_void,
) -> vk::Bool32 {
    // SAFETY: the layer's data is valid for the call; `user_data` is the engine's boxed list.
    unsafe {
        let said = &*user_data.cast::<Mutex<Vec<String>>>();
        said.lock().unwrap().push(CStr::from_ptr((*data).p_message).to_string_lossy().into_owned());
    }
    vk::FALSE
}
