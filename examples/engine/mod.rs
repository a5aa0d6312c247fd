//! An engine in small: its own instance, device, images and triangles, with nothing of surfel but what a device must be created with, and a way to
//! write pictures.

#![allow(dead_code, reason = "each example, and the tests, use a part of it")]

mod compute;

#[allow(unused_imports, reason = "as above")]
pub use compute::Compute;

use std::{
    ffi::{CStr, c_void},
    sync::Mutex,
};

use ash::{ext, vk};

/// How the engine draws: what a renderer of splats has to go along with.
#[derive(Clone, Copy)]
pub struct Style {
    pub size_px: [u32; 2],
    pub depth_format: vk::Format,
    pub compare: vk::CompareOp,
    /// What its depth is cleared to.
    pub clear_depth: f32,
    pub samples: vk::SampleCountFlags,
    /// The validation layer watches.
    pub validates: bool,
}

/// The format of its picture: linear light.
pub const COLOR_FORMAT: vk::Format = vk::Format::R32G32B32A32_SFLOAT;

/// An image, its memory and its view.
#[derive(Clone, Copy)]
pub struct Attachment {
    pub image: vk::Image,
    pub view: vk::ImageView,
    memory: vk::DeviceMemory,
}

pub struct Engine {
    pub instance: ash::Instance,
    pub physical: vk::PhysicalDevice,
    pub device: ash::Device,
    pub family: u32,
    /// What was enabled on the device.
    pub enabled: surfel::embed::Features,
    pub style: Style,
    pub depth: Attachment,
    color: Attachment,
    /// Where samples are resolved to; the color itself where each pixel has one.
    resolved: Attachment,
    queue: vk::Queue,
    pool: vk::CommandPool,
    pub commands: vk::CommandBuffer,
    fence: vk::Fence,
    layout: vk::PipelineLayout,
    pipeline: vk::Pipeline,
    readback: (vk::Buffer, vk::DeviceMemory, *const u8),
    messenger: (ext::debug_utils::Instance, vk::DebugUtilsMessengerEXT),
    // Boxed: the messenger points to it.
    said: Box<Mutex<Vec<String>>>,
    _entry: ash::Entry,
}

impl Engine {
    /// An engine under validation.
    pub fn new(style: Style) -> Self {
        let said = Box::new(Mutex::new(Vec::new()));
        // SAFETY: handles are used in the order of their creation; what infos point to lives until each call returns.
        unsafe {
            let entry = ash::Entry::load().expect("a Vulkan loader");
            let app = vk::ApplicationInfo::default().api_version(vk::API_VERSION_1_3);
            let layers = [c"VK_LAYER_KHRONOS_validation".as_ptr()];
            let extensions = [ext::debug_utils::NAME.as_ptr(), ext::validation_features::NAME.as_ptr()];
            // The second is the layer's.
            let extensions = if style.validates { &extensions[..] } else { &extensions[..1] };
            let enables = [vk::ValidationFeatureEnableEXT::SYNCHRONIZATION_VALIDATION];
            let mut validation = vk::ValidationFeaturesEXT::default().enabled_validation_features(&enables);
            let info = vk::InstanceCreateInfo::default()
                .application_info(&app)
                .enabled_layer_names(if style.validates { &layers } else { &[] })
                .enabled_extension_names(extensions)
                .push_next(&mut validation);
            let instance = entry.create_instance(&info, None).expect("Vulkan 1.3 and its validation layer");
            let loader = ext::debug_utils::Instance::new(&entry, &instance);
            let info = vk::DebugUtilsMessengerCreateInfoEXT::default()
                .message_severity(
                    vk::DebugUtilsMessageSeverityFlagsEXT::WARNING
                        | vk::DebugUtilsMessageSeverityFlagsEXT::ERROR,
                )
                .message_type(vk::DebugUtilsMessageTypeFlagsEXT::VALIDATION)
                .pfn_user_callback(Some(on_message))
                .user_data((&raw const *said).cast_mut().cast());
            let messenger = (loader.create_debug_utils_messenger(&info, None).unwrap(), loader);
            let messenger = (messenger.1, messenger.0);

            // The first device that will do, created with what splats want and nothing else.
            let devices = instance.enumerate_physical_devices().unwrap();
            let asked =
                devices.iter().map(|physical| (*physical, surfel::requirements(&instance, *physical)));
            let (physical, needs) =
                asked.into_iter().find(|(_, needs)| needs.missing.is_empty()).expect("a device");
            let (family, enabled) = (needs.queue_family.unwrap(), needs.features);
            let queues =
                [vk::DeviceQueueCreateInfo::default().queue_family_index(family).queue_priorities(&[1.0])];
            let (core, mut vulkan12, mut vulkan13) = (enabled.core(), enabled.vulkan12(), enabled.vulkan13());
            let info = vk::DeviceCreateInfo::default()
                .queue_create_infos(&queues)
                .enabled_features(&core)
                .push_next(&mut vulkan12)
                .push_next(&mut vulkan13);
            let device = instance.create_device(physical, &info, None).unwrap();
            let queue = device.get_device_queue(family, 0);

            let pool = vk::CommandPoolCreateInfo::default().queue_family_index(family);
            let pool = device.create_command_pool(&pool, None).unwrap();
            let info = vk::CommandBufferAllocateInfo::default().command_pool(pool).command_buffer_count(1);
            let commands = device.allocate_command_buffers(&info).unwrap()[0];
            let fence = device.create_fence(&vk::FenceCreateInfo::default(), None).unwrap();
            let make = Make { instance: &instance, physical, device: &device, style };
            let (sampled, one) = (vk::ImageUsageFlags::SAMPLED, vk::SampleCountFlags::TYPE_1);
            let copied = vk::ImageUsageFlags::COLOR_ATTACHMENT | vk::ImageUsageFlags::TRANSFER_SRC;
            let of_depth = vk::ImageUsageFlags::DEPTH_STENCIL_ATTACHMENT | vk::ImageUsageFlags::TRANSFER_SRC;
            let depth = make.attachment(style.depth_format, of_depth | sampled, style.samples);
            let color = make.attachment(COLOR_FORMAT, copied, style.samples);
            let resolved =
                if style.samples == one { color } else { make.attachment(COLOR_FORMAT, copied, one) };
            let (layout, pipeline) = make.pipeline();
            let readback = make.readback();
            Self {
                physical,
                family,
                enabled,
                style,
                depth,
                color,
                resolved,
                queue,
                pool,
                commands,
                fence,
                layout,
                pipeline,
                readback,
                messenger,
                said,
                device,
                instance,
                _entry: entry,
            }
        }
    }

    /// Begins to record.
    pub fn begin(&self) {
        let once = vk::CommandBufferBeginInfo::default().flags(vk::CommandBufferUsageFlags::ONE_TIME_SUBMIT);
        // SAFETY: the submission before was waited for.
        unsafe {
            self.device.reset_command_pool(self.pool, vk::CommandPoolResetFlags::empty()).unwrap();
            self.device.begin_command_buffer(self.commands, &once).unwrap();
        }
    }

    /// Begins to draw: over what there is, or over nothing.
    pub fn begin_rendering(&self, clears: bool) {
        let Style { size_px: [width, height], samples, .. } = self.style;
        let load = if clears { vk::AttachmentLoadOp::CLEAR } else { vk::AttachmentLoadOp::LOAD };
        let from = if clears { vk::ImageLayout::UNDEFINED } else { vk::ImageLayout::ATTACHMENT_OPTIMAL };
        self.barrier(from, vk::ImageLayout::ATTACHMENT_OPTIMAL);
        let clear_depth = vk::ClearDepthStencilValue { depth: self.style.clear_depth, stencil: 0 };
        let attached = |view, clear_value| {
            vk::RenderingAttachmentInfo::default()
                .image_view(view)
                .image_layout(vk::ImageLayout::ATTACHMENT_OPTIMAL)
                .load_op(load)
                .store_op(vk::AttachmentStoreOp::STORE)
                .clear_value(clear_value)
        };
        let mut color = attached(self.color.view, vk::ClearValue::default());
        if samples != vk::SampleCountFlags::TYPE_1 {
            color = color
                .resolve_mode(vk::ResolveModeFlags::AVERAGE)
                .resolve_image_view(self.resolved.view)
                .resolve_image_layout(vk::ImageLayout::ATTACHMENT_OPTIMAL);
        }
        let colors = [color];
        let depth = attached(self.depth.view, vk::ClearValue { depth_stencil: clear_depth });
        let area = vk::Rect2D { extent: vk::Extent2D { width, height }, ..vk::Rect2D::default() };
        let info = vk::RenderingInfo::default()
            .render_area(area)
            .layer_count(1)
            .color_attachments(&colors)
            .depth_attachment(&depth);
        // SAFETY: recording, with both images in this layout.
        unsafe { self.device.cmd_begin_rendering(self.commands, &info) };
    }

    /// Draws a triangle, by its corners in clip space, in one color. With `flips_y` by a viewport of negative height.
    pub fn triangle(&self, corners: [[f32; 4]; 3], color: [f32; 4], flips_y: bool) {
        let [width, height] = self.style.size_px.map(|side| side as f32);
        let viewport = match flips_y {
            false => vk::Viewport { x: 0.0, y: 0.0, width, height, min_depth: 0.0, max_depth: 1.0 },
            true => {
                vk::Viewport { x: 0.0, y: height, width, height: -height, min_depth: 0.0, max_depth: 1.0 }
            }
        };
        let [width, height] = self.style.size_px;
        let scissor = vk::Rect2D { extent: vk::Extent2D { width, height }, ..vk::Rect2D::default() };
        let numbers: Vec<u8> =
            corners.iter().flatten().chain(&color).flat_map(|number| number.to_ne_bytes()).collect();
        let stages = vk::ShaderStageFlags::VERTEX | vk::ShaderStageFlags::FRAGMENT;
        // SAFETY: inside of rendering; the layout is the pipeline's.
        unsafe {
            self.device.cmd_bind_pipeline(self.commands, vk::PipelineBindPoint::GRAPHICS, self.pipeline);
            self.device.cmd_set_viewport(self.commands, 0, &[viewport]);
            self.device.cmd_set_scissor(self.commands, 0, &[scissor]);
            self.device.cmd_push_constants(self.commands, self.layout, stages, 0, &numbers);
            self.device.cmd_draw(self.commands, 3, 1, 0, 0);
        }
    }

    pub fn end_rendering(&self) {
        // SAFETY: inside of rendering.
        unsafe { self.device.cmd_end_rendering(self.commands) };
    }

    /// Copies picture and depth to where the host can read them, and submits. [`Engine::wait`] must follow.
    pub fn submit(&self) {
        self.barrier(vk::ImageLayout::ATTACHMENT_OPTIMAL, vk::ImageLayout::TRANSFER_SRC_OPTIMAL);
        let [width, height] = self.style.size_px;
        let copy = |aspect, buffer_offset| {
            let layers = vk::ImageSubresourceLayers::default().aspect_mask(aspect).layer_count(1);
            let image_extent = vk::Extent3D { width, height, depth: 1 };
            [vk::BufferImageCopy {
                buffer_offset,
                image_subresource: layers,
                image_extent,
                ..vk::BufferImageCopy::default()
            }]
        };
        let pixels = u64::from(width) * u64::from(height);
        let info = vk::SubmitInfo2::default();
        let commands = [vk::CommandBufferSubmitInfo::default().command_buffer(self.commands)];
        let source = vk::ImageLayout::TRANSFER_SRC_OPTIMAL;
        // SAFETY: outside of rendering, both images in this layout, the buffer large enough.
        unsafe {
            let (device, to) = (&self.device, self.readback.0);
            let color = copy(vk::ImageAspectFlags::COLOR, 0);
            device.cmd_copy_image_to_buffer(self.commands, self.resolved.image, source, to, &color);
            if self.style.samples == vk::SampleCountFlags::TYPE_1 {
                let depth = copy(vk::ImageAspectFlags::DEPTH, 16 * pixels);
                device.cmd_copy_image_to_buffer(self.commands, self.depth.image, source, to, &depth);
            }
            let barriers = [vk::MemoryBarrier2::default()
                .src_stage_mask(vk::PipelineStageFlags2::COPY)
                .src_access_mask(vk::AccessFlags2::TRANSFER_WRITE)
                .dst_stage_mask(vk::PipelineStageFlags2::HOST)
                .dst_access_mask(vk::AccessFlags2::HOST_READ)];
            device.cmd_pipeline_barrier2(
                self.commands,
                &vk::DependencyInfo::default().memory_barriers(&barriers),
            );
            device.end_command_buffer(self.commands).unwrap();
            device.queue_submit2(self.queue, &[info.command_buffer_infos(&commands)], self.fence).unwrap();
        }
    }

    pub fn wait(&self) {
        // SAFETY: the fence was submitted.
        unsafe {
            self.device.wait_for_fences(&[self.fence], true, u64::MAX).unwrap();
            self.device.reset_fences(&[self.fence]).unwrap();
        }
    }

    /// The picture: linear light, row by row.
    pub fn pixels(&self) -> Vec<[f32; 4]> {
        let [width, height] = self.style.size_px;
        // SAFETY: the host waited; the buffer begins with so many pixels of four floats, aligned as memory is mapped.
        unsafe { std::slice::from_raw_parts(self.readback.2.cast(), (width * height) as usize) }.to_vec()
    }

    /// The depth, as the device keeps it: floats, or whole numbers of its steps.
    pub fn depths(&self) -> Vec<f64> {
        let [width, height] = self.style.size_px;
        let pixels = (width * height) as usize;
        // SAFETY: as above; depths lie behind the colors, in two or four bytes.
        unsafe {
            let begin = self.readback.2.add(16 * pixels);
            match self.style.depth_format {
                vk::Format::D16_UNORM => {
                    let all = std::slice::from_raw_parts(begin.cast::<u16>(), pixels);
                    all.iter().map(|d| f64::from(*d) / 65_535.0).collect()
                }
                vk::Format::X8_D24_UNORM_PACK32 | vk::Format::D24_UNORM_S8_UINT => {
                    let all = std::slice::from_raw_parts(begin.cast::<u32>(), pixels);
                    all.iter().map(|d| f64::from(d & 0xff_ffff) / 16_777_215.0).collect()
                }
                _ => {
                    let all = std::slice::from_raw_parts(begin.cast::<f32>(), pixels);
                    all.iter().map(|d| f64::from(*d)).collect()
                }
            }
        }
    }

    /// Writes the picture over gray.
    pub fn save(&self, file: &str) -> Result<(), Box<dyn std::error::Error>> {
        let encode = |x: f32| if x <= 0.003_130_8 { 12.92 * x } else { 1.055 * x.powf(1.0 / 2.4) - 0.055 };
        let byte = |light: f32, alpha: f32| {
            (255.0 * encode((light + 0.5 * (1.0 - alpha)).clamp(0.0, 1.0))).round() as u8
        };
        let pixels = self.pixels();
        let bytes: Vec<u8> =
            pixels.iter().flat_map(|[r, g, b, a]| [r, g, b].map(|light| byte(*light, *a))).collect();
        Ok(surfel::save::png(file.as_ref(), self.style.size_px, 3, &bytes)?)
    }

    /// The engine goes; an error if the validation layer has said anything.
    pub fn end(self) -> Result<(), Box<dyn std::error::Error>> {
        let said = self.said();
        match said.is_empty() {
            true => Ok(()),
            false => Err(format!("the validation layer says: {}", said.join("\n")).into()),
        }
    }

    /// What the validation layer has said.
    pub fn said(&self) -> Vec<String> {
        self.said.lock().unwrap().clone()
    }

    fn barrier(&self, old: vk::ImageLayout, new: vk::ImageLayout) {
        let all = (
            vk::PipelineStageFlags2::ALL_COMMANDS,
            vk::AccessFlags2::MEMORY_READ | vk::AccessFlags2::MEMORY_WRITE,
        );
        let barrier = |image, aspect| {
            let range =
                vk::ImageSubresourceRange::default().aspect_mask(aspect).level_count(1).layer_count(1);
            vk::ImageMemoryBarrier2::default()
                .src_stage_mask(all.0)
                .src_access_mask(all.1)
                .dst_stage_mask(all.0)
                .dst_access_mask(all.1)
                .old_layout(old)
                .new_layout(new)
                .image(image)
                .subresource_range(range)
        };
        let depth_aspect = aspect_of(self.style.depth_format);
        let mut barriers = vec![
            barrier(self.color.image, vk::ImageAspectFlags::COLOR),
            barrier(self.depth.image, depth_aspect),
        ];
        if self.style.samples != vk::SampleCountFlags::TYPE_1 {
            barriers.push(barrier(self.resolved.image, vk::ImageAspectFlags::COLOR));
        }
        // SAFETY: recording, outside of rendering.
        unsafe {
            let info = vk::DependencyInfo::default().image_memory_barriers(&barriers);
            self.device.cmd_pipeline_barrier2(self.commands, &info);
        }
    }
}

impl Drop for Engine {
    fn drop(&mut self) {
        // SAFETY: each once, the children first, and after everything of surfel's.
        unsafe {
            let device = &self.device;
            device.device_wait_idle().unwrap();
            device.destroy_buffer(self.readback.0, None);
            device.free_memory(self.readback.1, None);
            device.destroy_pipeline(self.pipeline, None);
            device.destroy_pipeline_layout(self.layout, None);
            let several = self.style.samples != vk::SampleCountFlags::TYPE_1;
            for attachment in
                [Some(self.color), Some(self.depth), several.then_some(self.resolved)].into_iter().flatten()
            {
                device.destroy_image_view(attachment.view, None);
                device.destroy_image(attachment.image, None);
                device.free_memory(attachment.memory, None);
            }
            device.destroy_fence(self.fence, None);
            device.destroy_command_pool(self.pool, None);
            device.destroy_device(None);
            self.messenger.0.destroy_debug_utils_messenger(self.messenger.1, None);
            self.instance.destroy_instance(None);
        }
    }
}

/// What the engine's objects are made with.
struct Make<'a> {
    instance: &'a ash::Instance,
    physical: vk::PhysicalDevice,
    device: &'a ash::Device,
    style: Style,
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

    unsafe fn attachment(
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

    unsafe fn readback(&self) -> (vk::Buffer, vk::DeviceMemory, *const u8) {
        let [width, height] = self.style.size_px.map(u64::from);
        let info = vk::BufferCreateInfo::default()
            .size(20 * width * height)
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

    unsafe fn pipeline(&self) -> (vk::PipelineLayout, vk::Pipeline) {
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
            let all = [vk::PipelineColorBlendAttachmentState::default()
                .color_write_mask(vk::ColorComponentFlags::RGBA)];
            let blend = vk::PipelineColorBlendStateCreateInfo::default().attachments(&all);
            let states = [vk::DynamicState::VIEWPORT, vk::DynamicState::SCISSOR];
            let dynamic = vk::PipelineDynamicStateCreateInfo::default().dynamic_states(&states);
            let formats = [COLOR_FORMAT];
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

fn aspect_of(format: vk::Format) -> vk::ImageAspectFlags {
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

unsafe extern "system" fn on_message(
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
