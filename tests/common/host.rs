//! A foreign host: its own instance, device, queue and messenger, made without this library.

use std::{
    ffi::{CStr, c_void},
    sync::Mutex,
};

use ash::{ext, vk};
use surfel::vk::{Device, Features, Import, Instance};

/// What a host has before it knows of us. Destroys everything itself, after all of ours is dropped.
pub struct Host {
    pub instance: ash::Instance,
    pub physical: vk::PhysicalDevice,
    pub device: ash::Device,
    pub queue_family: u32,
    pub queue: vk::Queue,
    pub features: Features,
    messenger: (ext::debug_utils::Instance, vk::DebugUtilsMessengerEXT),
    // Boxed: the messenger points to it.
    said: Box<Mutex<Vec<String>>>,
    _entry: ash::Entry,
}

impl Host {
    /// A host under validation that enables these optional features, and the device's first queue for graphics and
    /// compute.
    pub fn new(features: Features) -> Self {
        super::arm();
        let said = Box::new(Mutex::new(Vec::new()));
        // SAFETY: handles are used in their creation's order, everything pointed to lives until each call returns,
        // and `said` is boxed and outlives the messenger.
        unsafe {
            let entry = ash::Entry::load().expect("tests need a Vulkan loader");
            let app = vk::ApplicationInfo::default().api_version(vk::API_VERSION_1_3);
            let layers = [c"VK_LAYER_KHRONOS_validation".as_ptr()];
            let extensions = [ext::debug_utils::NAME.as_ptr(), ext::validation_features::NAME.as_ptr()];
            let enables = [
                vk::ValidationFeatureEnableEXT::SYNCHRONIZATION_VALIDATION,
                vk::ValidationFeatureEnableEXT::BEST_PRACTICES,
            ];
            let mut validation = vk::ValidationFeaturesEXT::default().enabled_validation_features(&enables);
            let info = vk::InstanceCreateInfo::default()
                .application_info(&app)
                .enabled_layer_names(&layers)
                .enabled_extension_names(&extensions)
                .push_next(&mut validation);
            let instance = entry.create_instance(&info, None).expect("tests need the validation layer");
            let loader = ext::debug_utils::Instance::new(&entry, &instance);
            let info = vk::DebugUtilsMessengerCreateInfoEXT::default()
                .message_severity(
                    vk::DebugUtilsMessageSeverityFlagsEXT::WARNING
                        | vk::DebugUtilsMessageSeverityFlagsEXT::ERROR,
                )
                .message_type(
                    vk::DebugUtilsMessageTypeFlagsEXT::VALIDATION
                        | vk::DebugUtilsMessageTypeFlagsEXT::PERFORMANCE,
                )
                .pfn_user_callback(Some(on_message))
                .user_data((&raw const *said).cast_mut().cast());
            let messenger = loader.create_debug_utils_messenger(&info, None).unwrap();

            // The tests' own choice of device, so that host and headless renderer draw on the same one.
            let facts = surfel::vk::all_facts(&Instance::borrow(instance.clone(), true)).unwrap();
            let plain: Vec<_> = facts.iter().map(|(_, facts)| facts.clone()).collect();
            let asked = std::env::var("SURFEL_TEST_DEVICE").ok();
            let (physical, facts) = &facts[surfel::vk::choose(&plain, asked.as_deref()).unwrap()];
            let (physical, queue_family) = (*physical, facts.queue_family.unwrap());

            let mut features10 = vk::PhysicalDeviceFeatures2::default().features(features.core());
            let (mut features12, mut features13) = (features.vulkan12(), features.vulkan13());
            let queues = [vk::DeviceQueueCreateInfo::default()
                .queue_family_index(queue_family)
                .queue_priorities(&[1.0])];
            let info = vk::DeviceCreateInfo::default()
                .queue_create_infos(&queues)
                .push_next(&mut features10)
                .push_next(&mut features12)
                .push_next(&mut features13);
            let device = instance.create_device(physical, &info, None).unwrap();
            let queue = device.get_device_queue(queue_family, 0);
            let messenger = (loader, messenger);
            Self { instance, physical, device, queue_family, queue, features, messenger, said, _entry: entry }
        }
    }

    /// The host's device as ours, with `raw` in place of the host's own table of functions.
    pub fn lend(&self, raw: ash::Device) -> Device {
        let host = Import {
            instance: &self.instance,
            debug_utils: true,
            physical: self.physical,
            device: &raw,
            queue_family: self.queue_family,
            enabled: self.features,
            memory: None,
        };
        // SAFETY: all handles are the host's own and belong together; the tests drop all of ours before the host.
        unsafe { Device::import(&host) }.unwrap()
    }

    /// What the layer said since the last call.
    pub fn said(&self) -> Vec<String> {
        std::mem::take(&mut self.said.lock().unwrap())
    }

    /// Destroys the device and says what the layer said of that: leaked objects, each by its handle.
    pub fn destroy(mut self) -> Vec<String> {
        self.destroy_device();
        self.said()
    }

    fn destroy_device(&mut self) {
        if self.queue != vk::Queue::null() {
            self.queue = vk::Queue::null();
            // SAFETY: once, and after everything of ours.
            unsafe {
                let _ = self.device.device_wait_idle();
                self.device.destroy_device(None);
            }
        }
    }
}

impl Drop for Host {
    fn drop(&mut self) {
        self.destroy_device();
        // SAFETY: the children first, each once.
        unsafe {
            self.messenger.0.destroy_debug_utils_messenger(self.messenger.1, None);
            self.instance.destroy_instance(None);
        }
    }
}

unsafe extern "system" fn on_message(
    _severity: vk::DebugUtilsMessageSeverityFlagsEXT,
    _kind: vk::DebugUtilsMessageTypeFlagsEXT,
    data: *const vk::DebugUtilsMessengerCallbackDataEXT<'_>,
    user_data: *mut c_void,
) -> vk::Bool32 {
    // SAFETY: the layer's data is valid for the call; `user_data` is the host's boxed list.
    unsafe {
        let said = &*user_data.cast::<Mutex<Vec<String>>>();
        said.lock().unwrap().push(CStr::from_ptr((*data).p_message).to_string_lossy().into_owned());
    }
    vk::FALSE
}
