//! What a device must have, asked before there is one.

use std::{
    ffi::{CStr, c_void},
    ptr,
};

use surfel::{
    ash::{self, vk},
    embed::{Features, requirements},
};

use crate::{
    handle::{get_mut, null},
    result::{Failure, Result, SurfelResult, guard},
    structs::{Struct, SurfelStructureType, write},
};

/// Vulkan's own type of this name.
#[expect(non_camel_case_types, reason = "so that the header has Vulkan's name")]
pub type PFN_vkGetInstanceProcAddr = Option<vk::PFN_vkGetInstanceProcAddr>;

/// `synchronization2`: needed.
pub const SURFEL_FEATURE_SYNCHRONIZATION2: u64 = 1;
/// `dynamicRendering`: needed.
pub const SURFEL_FEATURE_DYNAMIC_RENDERING: u64 = 2;
/// `maintenance4`: needed.
pub const SURFEL_FEATURE_MAINTENANCE4: u64 = 4;
/// `shaderTerminateInvocation`: needed.
pub const SURFEL_FEATURE_SHADER_TERMINATE_INVOCATION: u64 = 8;
/// `largePoints`; without it every splat above one pixel is a quad.
pub const SURFEL_FEATURE_LARGE_POINTS: u64 = 16;
/// `drawIndirectFirstInstance`; without it splats are not drawn by tiles.
pub const SURFEL_FEATURE_DRAW_INDIRECT_FIRST_INSTANCE: u64 = 32;
/// `drawIndirectCount`; without it all layers of `layers` `auto` are drawn, the empty ones too.
pub const SURFEL_FEATURE_DRAW_INDIRECT_COUNT: u64 = 64;
/// `pipelineStatisticsQuery`; without it `SURFEL_MEASURE_COUNTS` counts nothing.
pub const SURFEL_FEATURE_PIPELINE_STATISTICS_QUERY: u64 = 128;
/// `independentBlend`; without it a view is drawn within renderings of one color attachment only.
pub const SURFEL_FEATURE_INDEPENDENT_BLEND: u64 = 256;

/// The most formats that are listed.
pub const SURFEL_MAX_FORMATS: usize = 16;

/// What a device must be created with, and what it has. `surfel_requirements` fills it. No extension of the device is needed.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct SurfelRequirements {
    /// `SURFEL_STRUCTURE_TYPE_REQUIREMENTS`.
    pub s_type: u32,
    /// `sizeof(SurfelRequirements)`.
    pub size: u32,
    /// NULL.
    pub p_next: *mut c_void,
    /// The features to enable, of `SURFEL_FEATURE_…`: those that are needed, and of the others those that the device offers.
    /// `surfel_enable_features` puts them into Vulkan's structs.
    pub features: u64,
    /// The least version of instance and device, as `VK_API_VERSION_1_3`.
    pub api_version: u32,
    /// What the queue must do to which our commands are submitted.
    pub queue_flags: vk::QueueFlags,
    /// The first family that does; `UINT32_MAX`: none.
    pub queue_family: u32,
    /// The largest side of a view, in pixels.
    pub max_image_side: u32,
    /// Bytes of a buffer that a shader can reach; scenes are cut into pieces of that size.
    pub max_storage_buffer_range: u64,
    /// The largest buffer, in bytes.
    pub max_buffer_size: u64,
    /// How many of `colorFormats` there are.
    pub color_format_count: u32,
    /// How many of `depthFormats` there are.
    pub depth_format_count: u32,
    /// Formats of color images that can be drawn to, of those that were looked for.
    pub color_formats: [vk::Format; SURFEL_MAX_FORMATS],
    /// Formats of depth images that can be tested, written, and read where transparent things are hidden by what the host has drawn.
    pub depth_formats: [vk::Format; SURFEL_MAX_FORMATS],
}

// SAFETY: it begins so, and a test looks for padding.
unsafe impl Struct for SurfelRequirements {
    const TYPE: SurfelStructureType = SurfelStructureType::Requirements;
}

pub fn flags_of(features: &Features) -> u64 {
    let Features {
        synchronization2,
        dynamic_rendering,
        maintenance4,
        shader_terminate_invocation,
        large_points,
        draw_indirect_first_instance,
        draw_indirect_count,
        pipeline_statistics_query,
        independent_blend,
    } = *features;
    let all = [
        (synchronization2, SURFEL_FEATURE_SYNCHRONIZATION2),
        (dynamic_rendering, SURFEL_FEATURE_DYNAMIC_RENDERING),
        (maintenance4, SURFEL_FEATURE_MAINTENANCE4),
        (shader_terminate_invocation, SURFEL_FEATURE_SHADER_TERMINATE_INVOCATION),
        (large_points, SURFEL_FEATURE_LARGE_POINTS),
        (draw_indirect_first_instance, SURFEL_FEATURE_DRAW_INDIRECT_FIRST_INSTANCE),
        (draw_indirect_count, SURFEL_FEATURE_DRAW_INDIRECT_COUNT),
        (pipeline_statistics_query, SURFEL_FEATURE_PIPELINE_STATISTICS_QUERY),
        (independent_blend, SURFEL_FEATURE_INDEPENDENT_BLEND),
    ];
    all.iter().map(|(has, flag)| if *has { *flag } else { 0 }).sum()
}

/// Refuses bits that are of no feature that this library knows: what they were to say would be lost.
pub fn check_features(flags: u64) -> Result<()> {
    let known = flags_of(&features_of(u64::MAX));
    match flags & !known {
        0 => Ok(()),
        unknown => {
            let text = format!("features: {unknown:#x} is of none: this library knows {known:#x}");
            Err(Failure::invalid(text))
        }
    }
}

/// Bits that are unknown say nothing: see [`check_features`].
pub fn features_of(flags: u64) -> Features {
    let has = |flag| flags & flag != 0;
    Features {
        synchronization2: has(SURFEL_FEATURE_SYNCHRONIZATION2),
        dynamic_rendering: has(SURFEL_FEATURE_DYNAMIC_RENDERING),
        maintenance4: has(SURFEL_FEATURE_MAINTENANCE4),
        shader_terminate_invocation: has(SURFEL_FEATURE_SHADER_TERMINATE_INVOCATION),
        large_points: has(SURFEL_FEATURE_LARGE_POINTS),
        draw_indirect_first_instance: has(SURFEL_FEATURE_DRAW_INDIRECT_FIRST_INSTANCE),
        draw_indirect_count: has(SURFEL_FEATURE_DRAW_INDIRECT_COUNT),
        pipeline_statistics_query: has(SURFEL_FEATURE_PIPELINE_STATISTICS_QUERY),
        independent_blend: has(SURFEL_FEATURE_INDEPENDENT_BLEND),
    }
}

/// The host's instance with its entry points.
///
/// # Safety
/// `instance` is alive, and `get` gives its entry points.
pub unsafe fn load_instance(get: PFN_vkGetInstanceProcAddr, instance: vk::Instance) -> Result<ash::Instance> {
    let Some(get_instance_proc_addr) = get else {
        return Err(null("getInstanceProcAddr"));
    };
    if instance == vk::Instance::null() {
        return Err(null("instance"));
    }
    // SAFETY: this function's contract.
    if unsafe { get_instance_proc_addr(instance, c"vkGetPhysicalDeviceToolProperties".as_ptr()) }.is_none() {
        let text = "the instance has no vkGetPhysicalDeviceToolProperties: it is not of Vulkan 1.3";
        return Err(Failure { code: SurfelResult::NoDevice, text: text.to_owned() });
    }
    // SAFETY: this function's contract.
    Ok(unsafe { ash::Instance::load(&ash::StaticFn { get_instance_proc_addr }, instance) })
}

/// Tells what a device of `physicalDevice` must be created with. `instance` must be of Vulkan 1.3. Where the device lacks something,
/// `requirements` is filled all the same, the answer is `SURFEL_RESULT_NO_DEVICE`, and `surfel_last_error` names what is missing.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn surfel_requirements(
    instance: vk::Instance,
    physical_device: vk::PhysicalDevice,
    get_instance_proc_addr: PFN_vkGetInstanceProcAddr,
    requirements: *mut SurfelRequirements,
) -> SurfelResult {
    guard("surfel_requirements", || {
        // SAFETY: the contract of the header.
        unsafe { fill(instance, physical_device, get_instance_proc_addr, requirements) }
    })
}

unsafe fn fill(
    instance: vk::Instance,
    physical: vk::PhysicalDevice,
    get: PFN_vkGetInstanceProcAddr,
    out: *mut SurfelRequirements,
) -> Result<()> {
    // SAFETY: this function's contract, here and below.
    let instance = unsafe { load_instance(get, instance) }?;
    if physical == vk::PhysicalDevice::null() {
        return Err(null("physicalDevice"));
    }
    // SAFETY: as above.
    let needs = unsafe { requirements(&instance, physical) };
    let listed = |formats: &[vk::Format]| {
        let mut all = [vk::Format::UNDEFINED; SURFEL_MAX_FORMATS];
        let count = formats.len().min(SURFEL_MAX_FORMATS);
        all[..count].copy_from_slice(&formats[..count]);
        (count as u32, all)
    };
    let (color_format_count, color_formats) = listed(&needs.color_formats);
    let (depth_format_count, depth_formats) = listed(&needs.depth_formats);
    let filled = SurfelRequirements {
        s_type: 0,
        size: 0,
        p_next: ptr::null_mut(),
        features: flags_of(&needs.features),
        api_version: needs.api_version,
        queue_flags: needs.queue,
        queue_family: needs.queue_family.unwrap_or(u32::MAX),
        max_image_side: needs.limits.max_image_side,
        max_storage_buffer_range: needs.limits.max_storage_buffer_range,
        max_buffer_size: needs.limits.max_buffer_size,
        color_format_count,
        depth_format_count,
        color_formats,
        depth_formats,
    };
    // SAFETY: as above.
    unsafe { write(out, "requirements", &filled) }?;
    debug_assert!(needs.extensions.is_empty(), "the header says so");
    match needs.missing.is_empty() {
        true => Ok(()),
        false => Err(Failure { code: SurfelResult::NoDevice, text: needs.missing.join("; ") }),
    }
}

/// Enables features (`SURFEL_FEATURE_…`) in the structs that a device is created with: sets those, leaves all others as they are.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn surfel_enable_features(
    features: u64,
    core: *mut vk::PhysicalDeviceFeatures,
    vulkan12: *mut vk::PhysicalDeviceVulkan12Features<'_>,
    vulkan13: *mut vk::PhysicalDeviceVulkan13Features<'_>,
) -> SurfelResult {
    guard("surfel_enable_features", || {
        // SAFETY: the contract of the header.
        let (core, vulkan12, vulkan13) = unsafe {
            (get_mut(core, "core")?, get_mut(vulkan12, "vulkan12")?, get_mut(vulkan13, "vulkan13")?)
        };
        check_features(features)?;
        let ours = features_of(features);
        let (core_of, of12, of13) = (ours.core(), ours.vulkan12(), ours.vulkan13());
        core.independent_blend |= core_of.independent_blend;
        core.large_points |= core_of.large_points;
        core.draw_indirect_first_instance |= core_of.draw_indirect_first_instance;
        core.pipeline_statistics_query |= core_of.pipeline_statistics_query;
        vulkan12.draw_indirect_count |= of12.draw_indirect_count;
        vulkan13.synchronization2 |= of13.synchronization2;
        vulkan13.dynamic_rendering |= of13.dynamic_rendering;
        vulkan13.maintenance4 |= of13.maintenance4;
        vulkan13.shader_terminate_invocation |= of13.shader_terminate_invocation;
        Ok(())
    })
}

/// The device's entry points, where it is of Vulkan 1.3.
///
/// # Safety
/// `device` is alive and of this instance.
pub unsafe fn load_device(instance: &ash::Instance, device: vk::Device) -> Result<ash::Device> {
    let newest: &CStr = c"vkCmdPipelineBarrier2";
    if device == vk::Device::null() {
        return Err(null("device"));
    }
    // SAFETY: this function's contract.
    if unsafe { instance.get_device_proc_addr(device, newest.as_ptr()) }.is_none() {
        let text = "the device has no vkCmdPipelineBarrier2: it is not of Vulkan 1.3";
        return Err(Failure { code: SurfelResult::NoDevice, text: text.to_owned() });
    }
    // SAFETY: this function's contract.
    Ok(unsafe { ash::Device::load(instance.fp_v1_0(), device) })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn features_are_flags_and_back() {
        for bit in 0..9 {
            let features = features_of(1 << bit);
            assert_eq!(flags_of(&features), 1 << bit);
            let needed = bit < 4;
            assert_eq!(features.missing().len(), if needed { 3 } else { 4 });
        }
        assert_eq!(features_of(15 | 1 << 60), Features::NEEDED);
    }
}
