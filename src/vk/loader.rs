//! What is installed beside the devices: the Vulkan loader and the validation layer.

use ash::vk;

use super::{result::VkResultExt, validation::VALIDATION_LAYER};
use crate::error::{ErrorKind, Result};

/// Versions of the system's Vulkan parts.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LoaderFacts {
    /// The loader's Vulkan version, `[major, minor, patch]`.
    pub version: [u32; 3],
    /// The validation layer's: the Vulkan version it was written for, and its own number. `None` where it is not
    /// installed.
    pub validation_layer: Option<([u32; 3], u32)>,
}

/// Asks the loader, without making an instance.
///
/// # Errors
/// [`ErrorKind::NoDevice`] without a Vulkan loader, or whatever it answers.
pub fn loader_facts() -> Result<LoaderFacts> {
    // SAFETY: loading the system's Vulkan loader runs its initializers, which is what it is installed for.
    let entry = unsafe { ash::Entry::load() }.map_err(|error| {
        let reason = format!("the Vulkan loader (libvulkan) is not installed or can't be loaded: {error}");
        ErrorKind::NoDevice { reasons: vec![reason] }
    })?;
    // SAFETY: no contract beyond a loaded entry, here and in the next call.
    let version = unsafe { entry.try_enumerate_instance_version() }
        .of_call("vkEnumerateInstanceVersion", "")?
        .unwrap_or(vk::API_VERSION_1_0);
    // SAFETY: as above.
    let layers = unsafe { entry.enumerate_instance_layer_properties() }
        .of_call("vkEnumerateInstanceLayerProperties", "")?;
    let validation = layers.iter().find(|layer| layer.layer_name_as_c_str() == Ok(VALIDATION_LAYER));
    Ok(LoaderFacts {
        version: parts(version),
        validation_layer: validation.map(|layer| (parts(layer.spec_version), layer.implementation_version)),
    })
}

fn parts(version: u32) -> [u32; 3] {
    [vk::api_version_major(version), vk::api_version_minor(version), vk::api_version_patch(version)]
}
