//! How the validation layer is asked to watch.

use std::ffi::CStr;

use ash::{ext, vk};

use super::result::VkResultExt;
use crate::error::Result;

pub(super) const VALIDATION_LAYER: &CStr = c"VK_LAYER_KHRONOS_validation";

/// Whether the validation layer watches.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Validation {
    /// No layer is loaded.
    Off,
    /// Core, synchronization and best-practices checks. Hazards across submits too where
    /// [`arm_validation_across_submits`] came first.
    On,
}

/// Makes validation layers up to 1.3.239 or so look for hazards across submits, which they only do when told by
/// the environment (newer ones do so by themselves). Adds to what the user has set.
///
/// # Safety
/// No other thread may read or write the process's environment at the same time; in a program: first thing in
/// `main`; in tests: before the process's first Vulkan instance, behind a `Once`.
pub unsafe fn arm_validation_across_submits() {
    const FLAG: &str = "VALIDATION_CHECK_ENABLE_SYNCHRONIZATION_VALIDATION_QUEUE_SUBMIT";
    let separator = if cfg!(windows) { ";" } else { ":" };
    let enables = match std::env::var("VK_LAYER_ENABLES") {
        Ok(set) if set.split(separator).any(|flag| flag == FLAG) => return,
        Ok(set) if !set.is_empty() => format!("{set}{separator}{FLAG}"),
        _ => FLAG.to_owned(),
    };
    // SAFETY: this function's own contract.
    unsafe { std::env::set_var("VK_LAYER_ENABLES", enables) };
}

/// The extension by which a layer is told what to check.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Through {
    /// `VK_EXT_layer_settings`.
    LayerSettings,
    /// `VK_EXT_validation_features`, which the other replaced: for layers before 1.3.280 or so.
    ValidationFeatures,
}

impl Through {
    /// That of the installed layer.
    pub fn of_installed(entry: &ash::Entry) -> Result<Self> {
        // SAFETY: no contract beyond a loaded entry.
        let extensions = unsafe { entry.enumerate_instance_extension_properties(Some(VALIDATION_LAYER)) }
            .of_call("vkEnumerateInstanceExtensionProperties", "of the validation layer")?;
        let name = Ok(ext::layer_settings::NAME);
        let settings = extensions.iter().any(|extension| extension.extension_name_as_c_str() == name);
        Ok(if settings { Self::LayerSettings } else { Self::ValidationFeatures })
    }

    /// Its name.
    pub fn extension(self) -> &'static CStr {
        match self {
            Self::LayerSettings => ext::layer_settings::NAME,
            Self::ValidationFeatures => ext::validation_features::NAME,
        }
    }
}

/// The checks beyond the layer's defaults, for [`Through::ValidationFeatures`].
pub(super) const FEATURES: [vk::ValidationFeatureEnableEXT; 2] = [
    vk::ValidationFeatureEnableEXT::SYNCHRONIZATION_VALIDATION,
    vk::ValidationFeatureEnableEXT::BEST_PRACTICES,
];

/// Those checks for [`Through::LayerSettings`].
pub(super) fn settings() -> [vk::LayerSettingEXT<'static>; 2] {
    static YES: vk::Bool32 = vk::TRUE;
    [c"validate_sync", c"validate_best_practices"].map(|name| {
        let mut setting = vk::LayerSettingEXT::default()
            .layer_name(VALIDATION_LAYER)
            .setting_name(name)
            .ty(vk::LayerSettingTypeEXT::BOOL32);
        // ash's own setter counts bytes, not values.
        setting.value_count = 1;
        setting.p_values = (&raw const YES).cast();
        setting
    })
}
