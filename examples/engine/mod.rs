//! An engine in small: its own instance, device, images and triangles, with nothing of surfel but what a device must be created with, and a way to
//! write pictures.

#![allow(dead_code, reason = "each example, and the tests, use a part of it")]

mod compute;
mod frame;
mod make;
mod picture;
mod screen;

#[allow(unused_imports, reason = "as above")]
pub use compute::Compute;
#[allow(unused_imports, reason = "as above")]
pub use screen::Screen;

use std::sync::Mutex;

use ash::{ext, vk};
use make::{Make, on_message};
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
