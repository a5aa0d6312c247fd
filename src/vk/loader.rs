//! The Vulkan loader and the validation layer.

use std::ffi::CStr;

use ash::vk;

use super::result::VkResultExt;
use crate::error::{ErrorKind, Result};

/// Its name.
pub(super) const VALIDATION_LAYER: &CStr = c"VK_LAYER_KHRONOS_validation";

/// Versions of the system's Vulkan parts.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LoaderFacts {
    /// The loader's Vulkan version, `[major, minor, patch]`.
    pub version: [u32; 3],
    /// The validation layer's: the Vulkan version it was written for, and its own number. `None` where it is not
    /// installed.
    pub validation_layer: Option<([u32; 3], u32)>,
}

/// The system's Vulkan loader, and its version.
pub(super) fn load_entry() -> Result<(ash::Entry, u32)> {
    // SAFETY: loading the system's Vulkan loader runs its initializers, which is what it is installed for.
    let entry = unsafe { ash::Entry::load() }.map_err(|error| {
        let reason = format!("the Vulkan loader (libvulkan) is not installed or can't be loaded: {error}");
        ErrorKind::NoDevice { reasons: vec![reason] }
    })?;
    // SAFETY: no contract beyond a loaded entry.
    let version =
        unsafe { entry.try_enumerate_instance_version() }.of_call("vkEnumerateInstanceVersion", "")?;
    Ok((entry, version.unwrap_or(vk::API_VERSION_1_0)))
}

/// Asks the loader, without making an instance.
///
/// # Errors
/// [`ErrorKind::NoDevice`] without a Vulkan loader, or whatever it answers.
pub fn loader_facts() -> Result<LoaderFacts> {
    let (entry, version) = load_entry()?;
    // SAFETY: no contract beyond a loaded entry.
    let layers = unsafe { entry.enumerate_instance_layer_properties() }
        .of_call("vkEnumerateInstanceLayerProperties", "")?;
    let validation = layers.iter().find(|layer| layer.layer_name_as_c_str() == Ok(VALIDATION_LAYER));
    Ok(LoaderFacts {
        version: version_parts(version),
        validation_layer: validation
            .map(|layer| (version_parts(layer.spec_version), layer.implementation_version)),
    })
}

/// Major, minor and patch of a version.
pub(super) fn version_parts(version: u32) -> [u32; 3] {
    [vk::api_version_major(version), vk::api_version_minor(version), vk::api_version_patch(version)]
}
