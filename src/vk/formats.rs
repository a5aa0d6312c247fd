//! Formats of a host's images: those that are drawn onto, and which a driver may be asked about at all.

use ash::vk;

use super::device::Device;
use crate::error::{Error, Result};

/// Of colors that are drawn to.
pub(crate) const COLOR_FORMATS: [vk::Format; 9] = [
    vk::Format::B8G8R8A8_SRGB,
    vk::Format::R8G8B8A8_SRGB,
    vk::Format::A8B8G8R8_SRGB_PACK32,
    vk::Format::B8G8R8A8_UNORM,
    vk::Format::R8G8B8A8_UNORM,
    vk::Format::A2B10G10R10_UNORM_PACK32,
    vk::Format::B10G11R11_UFLOAT_PACK32,
    vk::Format::R16G16B16A16_SFLOAT,
    vk::Format::R32G32B32A32_SFLOAT,
];

/// Of depth that is tested and written.
pub(crate) const DEPTH_FORMATS: [vk::Format; 5] = [
    vk::Format::D32_SFLOAT,
    vk::Format::D32_SFLOAT_S8_UINT,
    vk::Format::D24_UNORM_S8_UINT,
    vk::Format::X8_D24_UNORM_PACK32,
    vk::Format::D16_UNORM,
];

/// Whether it is a format of Vulkan 1.0: of any other number a driver may not be asked, unless an extension is enabled.
fn is_of_vulkan(format: vk::Format) -> bool {
    (vk::Format::R4G4_UNORM_PACK8..=vk::Format::ASTC_12X12_SRGB_BLOCK).contains(&format)
}

/// Whether images of a format, tiled as the device likes it, can be used so.
pub(crate) fn can(device: &Device, format: vk::Format, use_: vk::FormatFeatureFlags) -> bool {
    let (instance, physical) = (device.instance().raw(), device.physical());
    is_of_vulkan(format) && {
        // SAFETY: the device's own, which are alive; the format is one of Vulkan 1.0.
        let has = unsafe { instance.get_physical_device_format_properties(physical, format) };
        has.optimal_tiling_features.contains(use_)
    }
}

/// Whether a color of this format is drawn to on this device: [`super::Requirements::color_formats`] lists it.
pub(crate) fn is_drawn_to(device: &Device, format: vk::Format) -> bool {
    COLOR_FORMATS.contains(&format) && can(device, format, vk::FormatFeatureFlags::COLOR_ATTACHMENT_BLEND)
}

/// Refuses a format of color that is not drawn to.
///
/// # Errors
/// [`crate::ErrorKind::Option`] of this name.
pub(crate) fn check_color(device: &Device, name: &str, format: vk::Format) -> Result<()> {
    match is_drawn_to(device, format) {
        true => Ok(()),
        false => {
            let drawn: Vec<_> =
                COLOR_FORMATS.into_iter().filter(|format| is_drawn_to(device, *format)).collect();
            Err(Error::option(name, format!("{format:?}: expected one of {drawn:?}")))
        }
    }
}
