//! How many descriptors a stage, and a layout of all stages, may have on a device.

use ash::vk;

use super::{descriptors::Binding, device::Device, layout::STAGES};
use crate::error::{Error, Result};

/// Refuses bindings that are more than the device's limits.
///
/// # Errors
/// [`crate::ErrorKind::Option`], which names the limit.
pub(super) fn check<'a>(
    device: &Device,
    name: &str,
    bindings: impl Iterator<Item = &'a Binding> + Clone,
) -> Result<()> {
    // SAFETY: instance and device are alive.
    let has = unsafe { device.instance().raw().get_physical_device_properties(device.physical()) }.limits;
    use vk::DescriptorType as T;
    let texels = [T::COMBINED_IMAGE_SAMPLER, T::SAMPLED_IMAGE, T::UNIFORM_TEXEL_BUFFER];
    let kinds = [
        (
            &[T::STORAGE_BUFFER][..],
            [has.max_per_stage_descriptor_storage_buffers, has.max_descriptor_set_storage_buffers],
            "storage buffers",
        ),
        (
            &[T::UNIFORM_BUFFER],
            [has.max_per_stage_descriptor_uniform_buffers, has.max_descriptor_set_uniform_buffers],
            "uniform buffers",
        ),
        (
            &texels,
            [has.max_per_stage_descriptor_sampled_images, has.max_descriptor_set_sampled_images],
            "sampled images",
        ),
        (
            &[T::STORAGE_IMAGE, T::STORAGE_TEXEL_BUFFER],
            [has.max_per_stage_descriptor_storage_images, has.max_descriptor_set_storage_images],
            "storage images",
        ),
        (
            &[T::COMBINED_IMAGE_SAMPLER],
            [has.max_per_stage_descriptor_samplers, has.max_descriptor_set_samplers],
            "samplers",
        ),
    ];
    let seen_by = |stage: vk::ShaderStageFlags| {
        bindings.clone().filter(move |binding| binding.stages.intersects(stage)).map(|binding| binding.kind)
    };
    let refused = |count, most, what, of| {
        Err(Error::option(name, format!("{count} {what} {of}: the device has {most}")))
    };
    for stage in [vk::ShaderStageFlags::VERTEX, vk::ShaderStageFlags::FRAGMENT, vk::ShaderStageFlags::COMPUTE]
    {
        for (of_kind, [most, _], what) in kinds {
            let count = seen_by(stage).filter(|kind| of_kind.contains(kind)).count();
            if count > most as usize {
                return refused(count, most, what, "in a stage");
            }
        }
        let count = seen_by(stage).count();
        if count > has.max_per_stage_resources as usize {
            return refused(count, has.max_per_stage_resources, "resources", "in a stage");
        }
    }
    for (of_kind, [_, most], what) in kinds {
        let count = seen_by(STAGES).filter(|kind| of_kind.contains(kind)).count();
        if count > most as usize {
            return refused(count, most, what, "in all sets");
        }
    }
    Ok(())
}
