//! Pipelines of a frame, made ahead of it one after the other, so that a host goes on between.

use std::time::{Duration, Instant};

use ash::vk;

use super::{Readbacks, Renderer, Seen};
use crate::{
    arena::Arena,
    error::{ErrorKind, Result},
    frame::{FrameSlot, Target},
    graph::ImageState,
    passes::MissingPipelines,
    vk::check_color,
};

impl Renderer {
    /// Makes pipelines that such a frame needs, for a target of this format, and that are not there yet: one, and more until so much time has passed. Whether all are there then.
    /// Nothing is recorded. A frame that is read back, or the sum of several samples, needs more.
    ///
    /// # Errors
    /// [`ErrorKind::Option`] for a format that is not one of [`crate::vk::Requirements::color_formats`]; as [`Self::record`].
    #[cfg(feature = "inside")]
    pub fn make_pipelines(&self, seen: Seen<'_>, format: vk::Format, time: Duration) -> Result<bool> {
        check_color(&self.device, "format", format)?;
        let begun = Instant::now();
        let [width, height] = seen.settings.size_px;
        let target = Target {
            image: vk::Image::null(),
            view: vk::ImageView::null(),
            format,
            extent: vk::Extent2D { width, height },
            initial: ImageState::default(),
            last: None,
        };
        let mut slot = FrameSlot::new(&self.device);
        loop {
            let arena = Arena::new();
            let how = (None, MissingPipelines::UpTo(self.shaders.made() + 1));
            let onto = (&target, Readbacks::default());
            // SAFETY: nothing of the slot was ever recorded.
            match unsafe { self.declare_in(&arena, &mut slot, seen, onto, how, |_, _, _| Ok(())) } {
                Ok(()) => return Ok(true),
                Err(error) if !matches!(error.kind(), ErrorKind::NotReady { .. }) => return Err(error),
                Err(_) if begun.elapsed() >= time => return Ok(false),
                Err(_) => {}
            }
        }
    }
}
