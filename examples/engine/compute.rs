//! A compute shader of the engine's, which writes two buffers.

use ash::vk;

use super::Engine;

pub struct Compute {
    set_layout: vk::DescriptorSetLayout,
    pool: vk::DescriptorPool,
    set: vk::DescriptorSet,
    layout: vk::PipelineLayout,
    pipeline: vk::Pipeline,
}

impl Compute {
    /// The shader of this text; the buffers are its bindings 0 and 1, and two words its push constants.
    pub fn new(engine: &Engine, text: &str, buffers: [vk::Buffer; 2]) -> Self {
        let (stage, storage) = (vk::ShaderStageFlags::COMPUTE, vk::DescriptorType::STORAGE_BUFFER);
        let compiler = shaderc::Compiler::new().unwrap();
        let words = compiler.compile_into_spirv(text, shaderc::ShaderKind::Compute, "compute", "main", None);
        let device = &engine.device;
        // SAFETY: handles are used in the order of their creation; what infos point to lives until each call returns.
        unsafe {
            let binding = |binding| {
                vk::DescriptorSetLayoutBinding { binding, ..vk::DescriptorSetLayoutBinding::default() }
                    .descriptor_type(storage)
                    .descriptor_count(1)
                    .stage_flags(stage)
            };
            let bindings = [binding(0), binding(1)];
            let info = vk::DescriptorSetLayoutCreateInfo::default().bindings(&bindings);
            let set_layouts = [device.create_descriptor_set_layout(&info, None).unwrap()];
            let sizes = [vk::DescriptorPoolSize { ty: storage, descriptor_count: 2 }];
            let info = vk::DescriptorPoolCreateInfo::default().max_sets(1).pool_sizes(&sizes);
            let pool = device.create_descriptor_pool(&info, None).unwrap();
            let info =
                vk::DescriptorSetAllocateInfo::default().descriptor_pool(pool).set_layouts(&set_layouts);
            let set = device.allocate_descriptor_sets(&info).unwrap()[0];
            let whole = |buffer| [vk::DescriptorBufferInfo::default().buffer(buffer).range(vk::WHOLE_SIZE)];
            let [shapes, colors] = buffers.map(whole);
            let write = |binding, buffer| {
                vk::WriteDescriptorSet::default()
                    .dst_set(set)
                    .dst_binding(binding)
                    .descriptor_type(storage)
                    .buffer_info(buffer)
            };
            device.update_descriptor_sets(&[write(0, &shapes), write(1, &colors)], &[]);
            let ranges = [vk::PushConstantRange { stage_flags: stage, offset: 0, size: 8 }];
            let info = vk::PipelineLayoutCreateInfo::default()
                .set_layouts(&set_layouts)
                .push_constant_ranges(&ranges);
            let layout = device.create_pipeline_layout(&info, None).unwrap();
            let words = words.unwrap();
            let info = vk::ShaderModuleCreateInfo::default().code(words.as_binary());
            let module = device.create_shader_module(&info, None).unwrap();
            let stage =
                vk::PipelineShaderStageCreateInfo::default().stage(stage).module(module).name(c"main");
            let info = vk::ComputePipelineCreateInfo::default().stage(stage).layout(layout);
            let made = device.create_compute_pipelines(vk::PipelineCache::null(), &[info], None);
            device.destroy_shader_module(module, None);
            Self { set_layout: set_layouts[0], pool, set, layout, pipeline: made.unwrap()[0] }
        }
    }

    /// Runs so many workgroups, and makes what they write visible to whoever reads splats: that frames before have read them is waited for, too.
    pub fn dispatch(&self, engine: &Engine, groups: u32, numbers: [u32; 2]) {
        let (device, commands) = (&engine.device, engine.commands);
        let readers = vk::PipelineStageFlags2::COMPUTE_SHADER | vk::PipelineStageFlags2::VERTEX_SHADER;
        let barrier = |from, wrote, to, reads| {
            [vk::MemoryBarrier2::default()
                .src_stage_mask(from)
                .src_access_mask(wrote)
                .dst_stage_mask(to)
                .dst_access_mask(reads)]
        };
        let before = barrier(
            readers,
            vk::AccessFlags2::NONE,
            vk::PipelineStageFlags2::COMPUTE_SHADER,
            vk::AccessFlags2::SHADER_STORAGE_WRITE,
        );
        let after = barrier(
            vk::PipelineStageFlags2::COMPUTE_SHADER,
            vk::AccessFlags2::SHADER_STORAGE_WRITE,
            readers,
            vk::AccessFlags2::SHADER_STORAGE_READ,
        );
        let words = numbers.map(u32::to_ne_bytes);
        let (point, stage) = (vk::PipelineBindPoint::COMPUTE, vk::ShaderStageFlags::COMPUTE);
        // SAFETY: recording, outside of rendering.
        unsafe {
            device.cmd_pipeline_barrier2(commands, &vk::DependencyInfo::default().memory_barriers(&before));
            device.cmd_bind_pipeline(commands, point, self.pipeline);
            device.cmd_bind_descriptor_sets(commands, point, self.layout, 0, &[self.set], &[]);
            device.cmd_push_constants(commands, self.layout, stage, 0, words.as_flattened());
            device.cmd_dispatch(commands, groups, 1, 1);
            device.cmd_pipeline_barrier2(commands, &vk::DependencyInfo::default().memory_barriers(&after));
        }
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
