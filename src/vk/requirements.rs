//! What a device must have, asked before there is one.

use std::ffi::CStr;

use ash::vk;

use super::{
    choose::{DeviceFacts, Limits},
    facts::facts,
    features::Features,
    formats::{COLOR_FORMATS, DEPTH_FORMATS},
};

/// What a host creates its device with so that we can be its guest, and what this physical device has of it.
#[derive(Clone, Debug)]
pub struct Requirements {
    /// The least version of instance and device.
    pub api_version: u32,
    /// Extensions of the device that must be enabled: none.
    pub extensions: &'static [&'static CStr],
    /// The features to enable: those that are needed, and of the optional ones those that the device offers. [`Features::core`],
    /// [`Features::vulkan12`] and [`Features::vulkan13`] have them for the chain.
    pub features: Features,
    /// What the queue must do to which our commands are submitted.
    pub queue: vk::QueueFlags,
    /// The first family that does.
    pub queue_family: Option<u32>,
    /// The limits that frames respect.
    pub limits: Limits,
    /// Formats of a host's color images that are drawn to: those that the device can blend in, of these that were looked for.
    pub color_formats: Vec<vk::Format>,
    /// Formats of a host's depth images that are tested and written, and read where transparent things are hidden by what the host has
    /// drawn.
    pub depth_formats: Vec<vk::Format>,
    /// What the device lacks, by name; empty where it will do.
    pub missing: Vec<String>,
}

/// What a device of this physical device must be created with.
///
/// ```no_run
/// use surfel::ash::{self, vk};
///
/// unsafe fn create(instance: &ash::Instance, physical: vk::PhysicalDevice, queue: vk::DeviceQueueCreateInfo<'_>) -> ash::Device {
///     // SAFETY: this function's contract: the physical device is the instance's.
///     let needs = unsafe { surfel::requirements(instance, physical) };
///     assert!(needs.missing.is_empty(), "it lacks {:?}", needs.missing);
///     let (core, mut v12, mut v13) = (needs.features.core(), needs.features.vulkan12(), needs.features.vulkan13());
///     let queues = [queue.queue_family_index(needs.queue_family.unwrap())];
///     let info = vk::DeviceCreateInfo::default().queue_create_infos(&queues).enabled_features(&core);
///     // SAFETY: as above; what is asked for is there, for nothing is missing.
///     unsafe { instance.create_device(physical, &info.push_next(&mut v12).push_next(&mut v13), None) }.unwrap()
/// }
/// ```
///
/// # Safety
/// `physical` must belong to `instance`, which is alive.
pub unsafe fn requirements(instance: &ash::Instance, physical: vk::PhysicalDevice) -> Requirements {
    // SAFETY: this function's contract, here and below.
    let facts = unsafe { facts(instance, physical, None) };
    let can = |format: &vk::Format, needed| {
        // SAFETY: as above.
        let properties = unsafe { instance.get_physical_device_format_properties(physical, *format) };
        properties.optimal_tiling_features.contains(needed)
    };
    let depth = vk::FormatFeatureFlags::DEPTH_STENCIL_ATTACHMENT | vk::FormatFeatureFlags::SAMPLED_IMAGE;
    Requirements {
        api_version: vk::API_VERSION_1_3,
        extensions: &[],
        features: offered(&facts),
        queue: vk::QueueFlags::GRAPHICS | vk::QueueFlags::COMPUTE,
        queue_family: facts.queue_family,
        limits: facts.limits,
        color_formats: COLOR_FORMATS
            .into_iter()
            .filter(|format| can(format, vk::FormatFeatureFlags::COLOR_ATTACHMENT_BLEND))
            .collect(),
        depth_formats: DEPTH_FORMATS.into_iter().filter(|format| can(format, depth)).collect(),
        missing: facts.refusals(),
    }
}

/// The features to enable of a device that has these facts.
pub(super) fn offered(facts: &DeviceFacts) -> Features {
    Features {
        large_points: facts.large_points,
        draw_indirect_first_instance: facts.limits.first_instance,
        draw_indirect_count: facts.draw_indirect_count,
        pipeline_statistics_query: facts.pipeline_statistics,
        independent_blend: facts.independent_blend,
        ..Features::NEEDED
    }
}
