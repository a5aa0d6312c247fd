//! Where the passes of a frame go.

use ash::vk;

use crate::{passes::plan::ahead::Ahead, scene::Settings};

/// Where passes go.
pub(super) enum To {
    /// Into a host's commands.
    Commands(vk::CommandBuffer),
    /// Nowhere: pipelines are made for frames as they may become, of this size.
    Pipelines(Ahead, [u32; 2]),
    /// Nowhere: it is told what memory they need.
    Needs,
}

impl To {
    /// As what frames may become, of those that are not recorded.
    pub fn ahead(&self) -> Option<Ahead> {
        match self {
            Self::Commands(_) | Self::Needs => None,
            Self::Pipelines(ahead, _) => Some(*ahead),
        }
    }

    /// The settings of a frame, in its size.
    pub fn settings(&self, settings: Settings) -> Settings {
        match *self {
            Self::Commands(_) | Self::Needs => settings,
            Self::Pipelines(_, size_px) => Settings { size_px, ..settings },
        }
    }

    /// Whether what is recorded is seen by a device.
    pub fn is_recorded(&self) -> bool {
        matches!(self, Self::Commands(_))
    }
}
