//! Where the passes of a frame go.

use std::borrow::Cow;

use ash::vk;

use crate::{passes::plan::ahead::Ahead, scene::Settings};

/// Where passes go.
pub(super) enum To {
    /// Into a host's commands.
    Commands(vk::CommandBuffer),
    /// Nowhere: pipelines are made for frames as they may become, of this size.
    Pipelines(Ahead, [u32; 2]),
}

impl To {
    /// As what frames may become, of those that are not recorded.
    pub fn ahead(&self) -> Option<Ahead> {
        match self {
            Self::Commands(_) => None,
            Self::Pipelines(ahead, _) => Some(*ahead),
        }
    }

    /// The settings of a frame, in its size.
    pub fn settings<'s>(&self, settings: &'s Settings) -> Cow<'s, Settings> {
        match *self {
            Self::Commands(_) => Cow::Borrowed(settings),
            Self::Pipelines(_, size_px) => Cow::Owned(Settings { size_px, ..settings.clone() }),
        }
    }
}
