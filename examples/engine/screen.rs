//! A pass of the engine's over its whole picture, which reads the depth and the numbers of objects.

use ash::vk;

use super::{COLOR_FORMAT, Engine};

pub struct Screen {
    set_layout: vk::DescriptorSetLayout,
    pool: vk::DescriptorPool,
    set: vk::DescriptorSet,
    layout: vk::PipelineLayout,
    pipeline: vk::Pipeline,
}

impl Screen {
    /// A fragment shader of this text, whose color is blended over the picture by its alpha. Binding 0 is the depth, binding 1 the numbers; a float is its push
    /// constant.
    pub fn new(engine: &Engine, text: &str) -> Self {
        const WHOLE: &str = "#version 460\nvoid main() { gl_Position = vec4(ivec2(gl_VertexIndex & 1, gl_VertexIndex >> 1) * 4 - 1, 0, 1); }";
        let device = &engine.device;
        let numbers = engine.told.expect("a style that tells objects")[0];
        let (stage, sampled) = (vk::ShaderStageFlags::FRAGMENT, vk::DescriptorType::SAMPLED_IMAGE);
        let compiler = shaderc::Compiler::new().unwrap();
        // SAFETY: handles are used in the order of their creation; what infos point to lives until each call returns.
        unsafe {
            let binding = |binding| {
                vk::DescriptorSetLayoutBinding { binding, ..vk::DescriptorSetLayoutBinding::default() }
                    .descriptor_type(sampled)
                    .descriptor_count(1)
                    .stage_flags(stage)
            };
            let bindings = [binding(0), binding(1)];
            let info = vk::DescriptorSetLayoutCreateInfo::default().bindings(&bindings);
            let set_layouts = [device.create_descriptor_set_layout(&info, None).unwrap()];
            let sizes = [vk::DescriptorPoolSize { ty: sampled, descriptor_count: 2 }];
            let info = vk::DescriptorPoolCreateInfo::default().max_sets(1).pool_sizes(&sizes);
            let pool = device.create_descriptor_pool(&info, None).unwrap();
            let info =
                vk::DescriptorSetAllocateInfo::default().descriptor_pool(pool).set_layouts(&set_layouts);
            let set = device.allocate_descriptor_sets(&info).unwrap()[0];
            let image = |view| {
                let layout = vk::ImageLayout::READ_ONLY_OPTIMAL;
                [vk::DescriptorImageInfo::default().image_view(view).image_layout(layout)]
            };
            let [depth, numbers] = [image(engine.depth.view), image(numbers.view)];
            let write = |binding, image| {
                vk::WriteDescriptorSet::default()
                    .dst_set(set)
                    .dst_binding(binding)
                    .descriptor_type(sampled)
                    .image_info(image)
            };
            device.update_descriptor_sets(&[write(0, &depth), write(1, &numbers)], &[]);
            let ranges = [vk::PushConstantRange { stage_flags: stage, offset: 0, size: 4 }];
            let info = vk::PipelineLayoutCreateInfo::default()
                .set_layouts(&set_layouts)
                .push_constant_ranges(&ranges);
            let layout = device.create_pipeline_layout(&info, None).unwrap();
            let module = |text: &str, kind| {
                let words = compiler.compile_into_spirv(text, kind, "screen", "main", None).unwrap();
                let info = vk::ShaderModuleCreateInfo::default().code(words.as_binary());
                device.create_shader_module(&info, None).unwrap()
            };
            let modules =
                [module(WHOLE, shaderc::ShaderKind::Vertex), module(text, shaderc::ShaderKind::Fragment)];
            let of = |module, stage| {
                vk::PipelineShaderStageCreateInfo::default().stage(stage).module(module).name(c"main")
            };
            let stages = [of(modules[0], vk::ShaderStageFlags::VERTEX), of(modules[1], stage)];
            let vertices = vk::PipelineVertexInputStateCreateInfo::default();
            let assembly = vk::PipelineInputAssemblyStateCreateInfo::default()
                .topology(vk::PrimitiveTopology::TRIANGLE_LIST);
            let viewport = vk::PipelineViewportStateCreateInfo::default().viewport_count(1).scissor_count(1);
            let raster = vk::PipelineRasterizationStateCreateInfo::default().line_width(1.0);
            let samples = vk::PipelineMultisampleStateCreateInfo::default()
                .rasterization_samples(vk::SampleCountFlags::TYPE_1);
            let over = [vk::PipelineColorBlendAttachmentState::default()
                .blend_enable(true)
                .src_color_blend_factor(vk::BlendFactor::SRC_ALPHA)
                .dst_color_blend_factor(vk::BlendFactor::ONE_MINUS_SRC_ALPHA)
                .src_alpha_blend_factor(vk::BlendFactor::ONE)
                .dst_alpha_blend_factor(vk::BlendFactor::ONE_MINUS_SRC_ALPHA)
                .color_write_mask(vk::ColorComponentFlags::RGBA)];
            let blend = vk::PipelineColorBlendStateCreateInfo::default().attachments(&over);
            let states = [vk::DynamicState::VIEWPORT, vk::DynamicState::SCISSOR];
            let dynamic = vk::PipelineDynamicStateCreateInfo::default().dynamic_states(&states);
            let formats = [COLOR_FORMAT];
            let mut rendering = vk::PipelineRenderingCreateInfo::default().color_attachment_formats(&formats);
            let info = vk::GraphicsPipelineCreateInfo::default()
                .stages(&stages)
                .vertex_input_state(&vertices)
                .input_assembly_state(&assembly)
                .viewport_state(&viewport)
                .rasterization_state(&raster)
                .multisample_state(&samples)
                .color_blend_state(&blend)
                .dynamic_state(&dynamic)
                .layout(layout)
                .push_next(&mut rendering);
            let made = device.create_graphics_pipelines(vk::PipelineCache::null(), &[info], None);
            modules.into_iter().for_each(|module| device.destroy_shader_module(module, None));
            Self { set_layout: set_layouts[0], pool, set, layout, pipeline: made.unwrap()[0] }
        }
    }

    /// Records the pass, outside of rendering.
    pub fn draw(&self, engine: &Engine, number: f32) {
        let (attached, read) = (vk::ImageLayout::ATTACHMENT_OPTIMAL, vk::ImageLayout::READ_ONLY_OPTIMAL);
        let [width, height] = engine.style.size_px;
        let extent = vk::Extent2D { width, height };
        let area = vk::Rect2D { extent, ..vk::Rect2D::default() };
        let viewport = vk::Viewport {
            width: width as f32,
            height: height as f32,
            max_depth: 1.0,
            ..vk::Viewport::default()
        };
        let color = [vk::RenderingAttachmentInfo::default()
            .image_view(engine.color.view)
            .image_layout(attached)
            .load_op(vk::AttachmentLoadOp::LOAD)
            .store_op(vk::AttachmentStoreOp::STORE)];
        let info = vk::RenderingInfo::default().render_area(area).layer_count(1).color_attachments(&color);
        let (device, commands) = (&engine.device, engine.commands);
        engine.barrier_of_read(attached, read);
        // SAFETY: recording, outside of rendering, each image in its layout.
        unsafe {
            device.cmd_begin_rendering(commands, &info);
            device.cmd_set_viewport(commands, 0, &[viewport]);
            device.cmd_set_scissor(commands, 0, &[area]);
            let point = vk::PipelineBindPoint::GRAPHICS;
            device.cmd_bind_pipeline(commands, point, self.pipeline);
            device.cmd_bind_descriptor_sets(commands, point, self.layout, 0, &[self.set], &[]);
            let stage = vk::ShaderStageFlags::FRAGMENT;
            device.cmd_push_constants(commands, self.layout, stage, 0, &number.to_ne_bytes());
            device.cmd_draw(commands, 3, 1, 0, 0);
            device.cmd_end_rendering(commands);
        }
        engine.barrier_of_read(read, attached);
    }

    pub fn destroy(self, engine: &Engine) {
        // SAFETY: the engine waited; each once.
        unsafe {
            engine.device.destroy_pipeline(self.pipeline, None);
            engine.device.destroy_pipeline_layout(self.layout, None);
            engine.device.destroy_descriptor_pool(self.pool, None);
            engine.device.destroy_descriptor_set_layout(self.set_layout, None);
        }
    }
}
