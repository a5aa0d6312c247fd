//! Asks a physical device for the facts that [`choose`](super::choose) weighs.

use std::ffi::CStr;

use ash::{ext, khr, vk};

use super::{
    choose::{DeviceFacts, DeviceKind, Limits},
    instance::Instance,
    loader::version_parts,
    result::VkResultExt,
};
use crate::error::{ErrorKind, Result};

/// Storage buffers that a stage must be able to see: two of a chunk of splats, and those of lists.
pub(crate) const LEAST_STORAGE_BUFFERS: u32 = 8;

/// Every physical device with its facts, in Vulkan's order.
///
/// # Errors
/// Whatever `vkEnumeratePhysicalDevices` answers.
pub fn all_facts(instance: &Instance) -> Result<Vec<(vk::PhysicalDevice, DeviceFacts)>> {
    // SAFETY: the instance is alive.
    let devices =
        unsafe { instance.raw().enumerate_physical_devices() }.of_call("vkEnumeratePhysicalDevices", "")?;
    // SAFETY: each device was just enumerated from this instance.
    Ok(devices.into_iter().map(|device| (device, unsafe { facts(instance.raw(), device, None) })).collect())
}

/// Formats of images that shaders store to without naming them.
const STORED_FORMATS: [vk::Format; 4] = [
    vk::Format::R16G16B16A16_SFLOAT,
    vk::Format::R32G32B32A32_SFLOAT,
    vk::Format::R32G32_SFLOAT,
    vk::Format::R32_SFLOAT,
];

/// The facts of one device. `family` is that of the queue to be used; `None` takes the first that will do.
///
/// # Safety
/// `device` must belong to `instance`, and both must be alive.
pub(super) unsafe fn facts(
    instance: &ash::Instance,
    device: vk::PhysicalDevice,
    family: Option<u32>,
) -> DeviceFacts {
    // SAFETY: this function's contract, here and in the calls below.
    let properties = unsafe { instance.get_physical_device_properties(device) };
    let version = properties.api_version;
    let name = text(properties.device_name_as_c_str());
    // Before 1.2 the extended structures below don't exist; such a device is refused by its version alone.
    let modern = version >= vk::API_VERSION_1_2;
    let mut driver = vk::PhysicalDeviceDriverProperties::default();
    let mut subgroup = vk::PhysicalDeviceSubgroupProperties::default();
    let mut sizes = vk::PhysicalDeviceSubgroupSizeControlProperties::default();
    let mut maintenance4 = vk::PhysicalDeviceMaintenance4Properties::default();
    let mut features12 = vk::PhysicalDeviceVulkan12Features::default();
    let mut features13 = vk::PhysicalDeviceVulkan13Features::default();
    let mut features = vk::PhysicalDeviceFeatures2::default();
    let mut bus = vk::PhysicalDevicePCIBusInfoPropertiesEXT::default();
    // SAFETY: as above.
    let tells_bus = modern && unsafe { has_extension(instance, device, ext::pci_bus_info::NAME) };
    if modern {
        let mut extended =
            vk::PhysicalDeviceProperties2::default().push_next(&mut driver).push_next(&mut subgroup);
        if version >= vk::API_VERSION_1_3 {
            extended = extended.push_next(&mut maintenance4).push_next(&mut sizes);
        }
        if tells_bus {
            extended = extended.push_next(&mut bus);
        }
        // SAFETY: as above; the chain lives until the call returns.
        unsafe { instance.get_physical_device_properties2(device, &mut extended) };
        features = features.push_next(&mut features12);
        if version >= vk::API_VERSION_1_3 {
            features = features.push_next(&mut features13);
        }
        // SAFETY: as above.
        unsafe { instance.get_physical_device_features2(device, &mut features) };
    }
    let core = features.features;
    // SAFETY: as above.
    let families = unsafe { instance.get_physical_device_queue_family_properties(device) };
    let wanted = vk::QueueFlags::GRAPHICS | vk::QueueFlags::COMPUTE;
    let allowed = |index: usize| family.is_none_or(|family| family as usize == index);
    let queue_family = (0..families.len()).find(|&i| allowed(i) && families[i].queue_flags.contains(wanted));
    // SAFETY: as above.
    let format = |format| unsafe {
        instance.get_physical_device_format_properties(device, format).optimal_tiling_features
    };
    let stores = |format| {
        let mut extended = vk::FormatProperties3::default();
        let mut properties = vk::FormatProperties2::default().push_next(&mut extended);
        // SAFETY: as above; the chain lives until the call returns.
        unsafe { instance.get_physical_device_format_properties2(device, format, &mut properties) };
        extended.optimal_tiling_features.contains(vk::FormatFeatureFlags2::STORAGE_WRITE_WITHOUT_FORMAT)
    };
    let blended = vk::FormatFeatureFlags::COLOR_ATTACHMENT_BLEND | vk::FormatFeatureFlags::SAMPLED_IMAGE;
    let depth = vk::FormatFeatureFlags::DEPTH_STENCIL_ATTACHMENT | vk::FormatFeatureFlags::SAMPLED_IMAGE;
    let limits = properties.limits;
    let needed = [
        (features13.synchronization2 == vk::TRUE, "synchronization2"),
        (features13.dynamic_rendering == vk::TRUE, "dynamicRendering"),
        (features13.maintenance4 == vk::TRUE, "maintenance4"),
        (features13.shader_terminate_invocation == vk::TRUE, "shaderTerminateInvocation"),
        (format(vk::Format::D32_SFLOAT).contains(depth), "D32_SFLOAT depth attachments that can be sampled"),
        (
            format(vk::Format::R16G16B16A16_SFLOAT).contains(blended),
            "R16G16B16A16_SFLOAT attachments that can be blended and sampled",
        ),
        // Vulkan promises 128 and 4: see the sizes of workgroups in glsl/inc/config.glsl, and the sets of the splat passes.
        (
            limits.max_compute_work_group_invocations >= 256 && limits.max_compute_work_group_size[0] >= 256,
            "compute workgroups of 256",
        ),
        (
            limits.max_per_stage_descriptor_storage_buffers >= LEAST_STORAGE_BUFFERS,
            "7 storage buffers in a stage",
        ),
    ];
    DeviceFacts {
        name,
        kind: kind(properties.device_type),
        driver: format!("{} {}", text(driver.driver_name_as_c_str()), text(driver.driver_info_as_c_str()))
            .trim()
            .to_owned(),
        api_version: version_parts(version),
        ids: [properties.vendor_id, properties.device_id, properties.driver_version],
        pci: tells_bus.then_some([bus.pci_domain, bus.pci_bus, bus.pci_device, bus.pci_function]),
        queue_family: queue_family.and_then(|index| u32::try_from(index).ok()),
        missing: needed.iter().filter(|(there, _)| !there).map(|(_, name)| (*name).to_owned()).collect(),
        large_points: core.large_points == vk::TRUE,
        pipeline_statistics: core.pipeline_statistics_query == vk::TRUE,
        independent_blend: core.independent_blend == vk::TRUE,
        // Numbers of pixels are given as counts, which must not exceed the limit.
        draw_indirect_count: features12.draw_indirect_count == vk::TRUE
            && limits.max_draw_indirect_count >= 1 << 30,
        limits: Limits {
            blend_f32: [vk::Format::R32G32B32A32_SFLOAT, vk::Format::R32_SFLOAT]
                .into_iter()
                .all(|sums| format(sums).contains(blended)),
            max_storage_buffer_range: u64::from(limits.max_storage_buffer_range),
            max_texels: limits.max_texel_buffer_elements,
            point_size_range: match core.large_points == vk::TRUE {
                true => limits.point_size_range,
                false => [1.0, 1.0],
            },
            point_size_granularity: limits.point_size_granularity,
            max_buffer_size: maintenance4.max_buffer_size,
            max_image_side: limits
                .max_image_dimension2_d
                .min(limits.max_framebuffer_width)
                .min(limits.max_framebuffer_height)
                .min(limits.max_viewport_dimensions[0])
                .min(limits.max_viewport_dimensions[1]),
            timestamp_period_ns: limits.timestamp_period,
            timestamp_valid_bits: queue_family.map_or(0, |index| families[index].timestamp_valid_bits),
            stores_without_format: version >= vk::API_VERSION_1_3 && STORED_FORMATS.into_iter().all(stores),
            storage_buffers_a_stage: limits.max_per_stage_descriptor_storage_buffers,
            first_instance: core.draw_indirect_first_instance == vk::TRUE,
            is_cpu: properties.device_type == vk::PhysicalDeviceType::CPU,
            shuffles: sizes.min_subgroup_size >= 8
                && subgroup.supported_stages.contains(vk::ShaderStageFlags::COMPUTE)
                && subgroup.supported_operations.contains(
                    vk::SubgroupFeatureFlags::SHUFFLE
                        | vk::SubgroupFeatureFlags::VOTE
                        | vk::SubgroupFeatureFlags::BALLOT,
                ),
        },
    }
}

/// # Safety
/// As [`facts`].
pub(super) unsafe fn has_extension(
    instance: &ash::Instance,
    device: vk::PhysicalDevice,
    name: &CStr,
) -> bool {
    // SAFETY: this function's contract.
    let extensions = unsafe { instance.enumerate_device_extension_properties(device) };
    extensions.is_ok_and(|all| all.iter().any(|extension| extension.extension_name_as_c_str() == Ok(name)))
}

fn kind(kind: vk::PhysicalDeviceType) -> DeviceKind {
    match kind {
        vk::PhysicalDeviceType::DISCRETE_GPU => DeviceKind::Discrete,
        vk::PhysicalDeviceType::INTEGRATED_GPU => DeviceKind::Integrated,
        vk::PhysicalDeviceType::VIRTUAL_GPU => DeviceKind::Virtual,
        vk::PhysicalDeviceType::CPU => DeviceKind::Cpu,
        _ => DeviceKind::Other,
    }
}

fn text(raw: std::result::Result<&CStr, std::ffi::FromBytesUntilNulError>) -> String {
    raw.map(|text| text.to_string_lossy().into_owned()).unwrap_or_default()
}

/// Refuses a device that can't tell.
pub(super) fn check_executables(
    instance: &Instance,
    physical: vk::PhysicalDevice,
    facts: &DeviceFacts,
) -> Result<()> {
    let name = khr::pipeline_executable_properties::NAME;
    // SAFETY: the device was enumerated from this instance.
    let offered = unsafe { instance.raw().enumerate_device_extension_properties(physical) }
        .of_call("vkEnumerateDeviceExtensionProperties", &facts.name)?;
    match offered.iter().any(|extension| extension.extension_name_as_c_str() == Ok(name)) {
        true => Ok(()),
        false => {
            let reason = format!("{}: lacks {}", facts.name, name.to_string_lossy());
            Err(ErrorKind::NoDevice { reasons: vec![reason] }.into())
        }
    }
}
