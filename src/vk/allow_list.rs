//! Validation messages that are known, harmless and counted instead of reported.

/// A message that may appear.
#[derive(Clone, Copy, Debug)]
pub struct Allowed {
    /// Its VUID, or the layer's own identifier.
    pub vuid: &'static str,
    /// Why it is harmless here, and for which versions of the layer.
    pub reason: &'static str,
}

/// All that may appear. Everything else is an error in every test and makes `--validate` exit with 3.
pub const ALLOWED: &[Allowed] = &[Allowed {
    vuid: "UNASSIGNED-BestPractices-vkCreateInstance-specialuse-extension-debugging",
    reason: "VK_EXT_debug_utils and VK_EXT_validation_features are enabled to debug: validation was asked for",
}];
