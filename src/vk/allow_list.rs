//! Validation messages that are known, harmless and counted instead of reported.

/// A message that may appear.
#[derive(Clone, Copy, Debug)]
pub struct Allowed {
    /// Its VUID, or the layer's own identifier.
    pub vuid: &'static str,
    /// The subject that it must have: one of these words is in its text.
    pub about: &'static [&'static str],
    /// Why it is harmless here, and for which versions of the layer.
    pub reason: &'static str,
}

impl Allowed {
    /// Whether a message is this one.
    pub(super) fn covers(&self, vuid: &str, text: &str) -> bool {
        self.vuid == vuid && self.about.iter().any(|word| text.contains(word))
    }
}

/// All that may appear. Everything else is an error in every test and makes `--validate` exit with 3.
pub const ALLOWED: &[Allowed] = &[
    Allowed {
        vuid: "UNASSIGNED-BestPractices-vkCreateInstance-specialuse-extension-debugging",
        about: &["VK_EXT_debug_utils", "VK_EXT_validation_features"],
        reason: "they are for debugging, and validation was asked for; layer 1.3.239 (Debian 12)",
    },
    Allowed {
        vuid: "BestPractices-specialuse-extension",
        about: &["VK_EXT_debug_utils"],
        reason: "it is for debugging, and validation was asked for; layer 1.4.309 (Debian 13)",
    },
    Allowed {
        vuid: "BestPractices-QueryPool-Unavailable",
        about: &["[pass counts]"],
        reason: "passes that copy count nothing: their queries are reset, and read with their availability; layer 1.4.309",
    },
    Allowed {
        vuid: "BestPractices-PushConstants",
        about: &["32 bytes were never set"],
        reason: "the papers' programs read 96 of the 128 bytes that their layout has room for; layer 1.4.309",
    },
    Allowed {
        vuid: "UNASSIGNED-BestPractices-SuboptimalSwapchain",
        about: &["VK_SUBOPTIMAL_KHR was returned"],
        reason: "a window changed its size after its image was acquired; the next frame has another swapchain; layer 1.3.239",
    },
];
