//! Pipelines ahead of the frames that need them.

use super::{Rendering, View, ViewFrame, fields::as_fields, to::To};
use crate::{
    arena::Arena,
    error::Result,
    passes::{MissingPipelines, plan::ahead::Ahead},
    renderer::Renderer,
};

impl Renderer {
    /// Makes all pipelines that frames like this need within such a rendering, wherever their cameras are: how many were missing (and made meanwhile by other threads). [`View::prepare`]
    /// makes none for them then. Nothing is recorded. It may take long: do it while the host loads, or on a thread of its own, while others draw with what is there.
    ///
    /// A frame is like this that shows scenes of the same kinds (opaque or transparent, disks or ellipses, closed or not, packed or not, with clip curves, levels of detail, polygons or
    /// lights, all of this or none), no more objects and splats of each, tinted or not as here; by the same settings, but for a budget, clip planes that are other ones, and a picture of this size or a smaller one; with a
    /// camera of the same projection, perspective or parallel, anywhere: from far off, where a splat is less than a pixel, to among splats that are larger than the picture; and with [`ViewFrame::hides`] as here.
    ///
    /// # Errors
    /// As [`View::new`] and [`View::prepare`].
    pub fn compile_ahead(&self, rendering: &Rendering, frame: &ViewFrame<'_>) -> Result<u64> {
        let before = self.pipelines_made();
        let frame = ViewFrame { missing: MissingPipelines::Make, profile: None, ..*frame };
        let mut view = View::new(self, rendering)?;
        let mut arena = Arena::new();
        // Planes may leave all as it is, as if there were none.
        let uncut = frame.settings.uncut();
        let of_uncut = (uncut != *frame.settings).then_some(ViewFrame { settings: &uncut, ..frame });
        for frame in [frame].iter().chain(&of_uncut) {
            for size_px in Ahead::sizes_px(frame.settings.size_px) {
                for ahead in Ahead::all(frame.scenes, frame.settings, &self.limits) {
                    let to = To::Pipelines(ahead, size_px);
                    // SAFETY: the view is new, nothing is recorded, and so the depth image not looked at.
                    unsafe { view.record_passes(&arena, self, to, frame) }.map_err(as_fields)?;
                    arena.reset();
                }
            }
        }
        Ok(self.pipelines_made() - before)
    }

    /// How many pipelines were made so far: a frame during which it stays the same has made none.
    pub fn pipelines_made(&self) -> u64 {
        self.shaders.made()
    }
}
