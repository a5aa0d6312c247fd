//! Pipelines ahead of the frames that need them.

use super::{Rendering, View, ViewFrame, fields::as_fields};
use crate::{arena::Arena, error::Result, passes::MissingPipelines, renderer::Renderer};

impl Renderer {
    /// Makes the pipelines that a frame like this needs within such a rendering, and tells how many were missing (and made meanwhile by other threads): [`View::prepare`] makes none for it
    /// then. Nothing is recorded. It may take long: do it while the host loads, or on a thread of its own, while others draw with what is there.
    ///
    /// A frame is like this with the same settings, showing what is of the same kind (opaque or transparent, disks or ellipses, closed or not, packed or not, polygons,
    /// lights), of about as many splats; and where a splat comes so near to the camera that it is large, from where that is so, too.
    ///
    /// # Errors
    /// As [`View::new`] and [`View::prepare`].
    pub fn compile_ahead(&self, rendering: &Rendering, frame: &ViewFrame<'_>) -> Result<u64> {
        let before = self.pipelines_made();
        let frame = ViewFrame { missing: MissingPipelines::Make, profile: None, ..*frame };
        let mut view = View::new(self, rendering)?;
        // SAFETY: the view is new, nothing is recorded, and so the depth image not looked at.
        unsafe { view.record_passes(&Arena::new(), self, None, &frame) }.map_err(as_fields)?;
        Ok(self.pipelines_made() - before)
    }

    /// How many pipelines were made so far: a frame during which it stays the same has made none.
    pub fn pipelines_made(&self) -> u64 {
        self.shaders.made()
    }
}
