//! An engine in small: its own instance, device, images and triangles, with nothing of surfel but what a device must be created with, and a way to
//! write pictures.

#![allow(dead_code, reason = "each example, and the tests, use a part of it")]

mod compute;
mod make;
mod picture;
mod screen;

#[allow(unused_imports, reason = "as above")]
pub use compute::Compute;
#[allow(unused_imports, reason = "as above")]
pub use screen::Screen;

use std::sync::Mutex;

use ash::{ext, vk};
use make::{Make, aspect_of, on_message};
use surfel::embed::Import;

/// How the engine draws: what a renderer of splats has to go along with.
#[derive(Clone, Copy)]
pub struct Style {
    pub size_px: [u32; 2],
    pub depth_format: vk::Format,
    pub compare: vk::CompareOp,
    /// What its depth is cleared to.
    pub clear_depth: f32,
    pub samples: vk::SampleCountFlags,
    /// Beside its picture it has images of the numbers of objects, and of motion.
    pub tells_objects: bool,
    /// The validation layer watches.
    pub validates: bool,
}

impl Style {
    /// Depth reversed, in 32 bits; one sample a pixel; watched.
    pub const fn reversed(size_px: [u32; 2]) -> Self {
        Self {
            size_px,
            depth_format: vk::Format::D32_SFLOAT,
            compare: vk::CompareOp::GREATER,
            clear_depth: 0.0,
            samples: vk::SampleCountFlags::TYPE_1,
            tells_objects: false,
            validates: true,
        }
    }
}

/// The format of its picture: linear light.
pub const COLOR_FORMAT: vk::Format = vk::Format::R32G32B32A32_SFLOAT;

/// The formats of numbers of objects, and of motion.
pub const OBJECT_FORMATS: [vk::Format; 2] = [vk::Format::R32_UINT, vk::Format::R32G32_SFLOAT];

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
    pub color: Attachment,
    /// Where samples are resolved to; the color itself where each pixel has one.
    resolved: Attachment,
    /// Numbers of objects and motion, where the style has them.
    pub told: Option<[Attachment; 2]>,
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

            // ---- Splats
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
            // ----
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
            let told = copied | sampled;
            let told = style
                .tells_objects
                .then(|| OBJECT_FORMATS.map(|format| make.attachment(format, told, style.samples)));
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
                told,
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

    /// This device, as it is lent to whoever draws splats on it.
    pub fn lent(&self) -> Import<'_> {
        Import {
            instance: &self.instance,
            debug_utils: true,
            physical: self.physical,
            device: &self.device,
            queue_family: self.family,
            enabled: self.enabled,
            memory: None,
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
        let told = self.told.iter().flatten().map(|told| attached(told.view, vk::ClearValue::default()));
        let colors: Vec<_> = [color].into_iter().chain(told).collect();
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
                for (told, at) in self.told.iter().flatten().zip([20, 24]) {
                    let told_copy = copy(vk::ImageAspectFlags::COLOR, at * pixels);
                    device.cmd_copy_image_to_buffer(self.commands, told.image, source, to, &told_copy);
                }
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

    /// Depth and numbers of objects, which a pass reads, are brought into another layout; all that was done is waited for.
    fn barrier_of_read(&self, old: vk::ImageLayout, new: vk::ImageLayout) {
        let numbers = self.told.map(|[numbers, _]| (numbers.image, vk::ImageAspectFlags::COLOR));
        let depth = (self.depth.image, aspect_of(self.style.depth_format));
        self.barriers([depth].into_iter().chain(numbers), [old, new]);
    }

    fn barrier(&self, old: vk::ImageLayout, new: vk::ImageLayout) {
        let color = vk::ImageAspectFlags::COLOR;
        let several = self.style.samples != vk::SampleCountFlags::TYPE_1;
        let told = self.told.into_iter().flatten().chain(several.then_some(self.resolved));
        let depth = (self.depth.image, aspect_of(self.style.depth_format));
        let colors = [self.color].into_iter().chain(told).map(|image| (image.image, color));
        self.barriers(colors.chain([depth]), [old, new]);
    }

    fn barriers(
        &self,
        images: impl Iterator<Item = (vk::Image, vk::ImageAspectFlags)>,
        [old, new]: [vk::ImageLayout; 2],
    ) {
        let all = (
            vk::PipelineStageFlags2::ALL_COMMANDS,
            vk::AccessFlags2::MEMORY_READ | vk::AccessFlags2::MEMORY_WRITE,
        );
        let barrier = |(image, aspect)| {
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
        let barriers: Vec<_> = images.map(barrier).collect();
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
            let own = [Some(self.color), Some(self.depth), several.then_some(self.resolved)];
            for attachment in own.into_iter().flatten().chain(self.told.into_iter().flatten()) {
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
