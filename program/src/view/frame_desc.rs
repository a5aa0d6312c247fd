//! What a frame of the window is to be, and what came of it.

use std::time::Instant;

use ash::vk;
use surfel::{graph::execute::Profile, renderer::Seen};

use super::{overlay::OverlayFrame, picture::Use, show::ShowDesc};

/// A scene as a picture of it is drawn.
#[derive(Clone, Copy)]
pub struct SceneView<'a> {
    /// What is seen.
    pub seen: Seen<'a>,
    /// The picture is light, not colors.
    pub is_light: bool,
    /// It is one of several samples of a picture.
    pub sample: Option<Ends>,
    /// Another one where the scene is not what it was.
    pub scene_number: u64,
    /// What is measured of its passes.
    pub profile: Option<Profile>,
}

/// Whether a sample is the first of a picture, and whether the last.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Ends {
    pub first: bool,
    pub last: bool,
}

impl SceneView<'_> {
    /// Of the picture.
    pub fn format(&self) -> vk::Format {
        format(self.is_light)
    }

    /// The picture is another one after this frame.
    pub fn shows(&self) -> bool {
        self.sample.is_none_or(|ends| ends.last)
    }
}

/// The format of pictures, of light or of colors.
pub fn format(is_light: bool) -> vk::Format {
    if is_light { vk::Format::R16G16B16A16_SFLOAT } else { vk::Format::R8G8B8A8_SRGB }
}

/// A frame to draw.
pub struct FrameDesc<'a> {
    /// Pictures to draw anew; others stay as they are.
    pub views: &'a [(Use, SceneView<'a>)],
    /// The pictures to show; nothing where there is none yet.
    pub shown: Option<([Use; 2], ShowDesc)>,
    /// The picture to show in place of one that is not whole after this frame.
    pub before: Use,
    /// What lies over it.
    pub overlay: Option<&'a OverlayFrame>,
    /// What it is to the picture, in a word.
    pub what: &'static str,
    /// The input that it answers to.
    pub input: Option<Instant>,
}

/// What drawing came to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Drawn {
    /// The window shows it, or will soon.
    Shown,
    /// The window has no pixels.
    Hidden,
    /// The window changes; it is to be tried again.
    Again,
}
