//! How the validation layer is asked to watch.

use std::ffi::CStr;

use ash::{ext, vk};

use super::{
    loader::{VALIDATION_LAYER, load_entry},
    result::VkResultExt,
};
use crate::error::Result;

/// Whether the validation layer watches.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Validation {
    /// No layer is loaded.
    #[default]
    Off,
    /// Core, synchronization and best-practices checks. Hazards across submits too where
    /// [`arm_validation_across_submits`] came first.
    On,
}

/// Makes validation layers up to 1.3.239 or so look for hazards across submits, which they only do when told by
/// the environment. Adds to what the user has set. Newer layers do so by themselves, and where the environment sets
/// such an old flag they ignore what `VK_EXT_layer_settings` asks for: for them nothing is set.
///
/// # Safety
/// No other thread may read or write the process's environment at the same time; in a program: first thing in
/// `main`; in tests: before the process's first Vulkan instance, behind a `Once`.
pub unsafe fn arm_validation_across_submits() {
    const FLAG: &str = "VALIDATION_CHECK_ENABLE_SYNCHRONIZATION_VALIDATION_QUEUE_SUBMIT";
    let through = load_entry().and_then(|(entry, _)| Through::of_installed(&entry));
    if !matches!(through, Ok(Through::ValidationFeatures)) {
        return;
    }
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

/// Those checks for [`Through::LayerSettings`], and every message as often as it comes, as older layers do by themselves.
pub(super) fn settings() -> [vk::LayerSettingEXT<'static>; 3] {
    static VALUES: [vk::Bool32; 2] = [vk::FALSE, vk::TRUE];
    let settings =
        [(c"validate_sync", true), (c"validate_best_practices", true), (c"enable_message_limit", false)];
    settings.map(|(name, value)| {
        let mut setting = vk::LayerSettingEXT::default()
            .layer_name(VALIDATION_LAYER)
            .setting_name(name)
            .ty(vk::LayerSettingTypeEXT::BOOL32);
        // ash's own setter counts bytes, not values.
        setting.value_count = 1;
        setting.p_values = (&raw const VALUES[usize::from(value)]).cast();
        setting
    })
}
