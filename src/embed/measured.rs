//! What a view's frame has taken: time, and memory.

use super::View;
use crate::{
    error::Result,
    graph::execute::{FrameProfile, PassFigures},
};

impl View {
    /// How long each pass of the frame took that was prepared last; `None` if it was not to be timed.
    ///
    /// # Errors
    /// Whatever the driver answers.
    ///
    /// # Safety
    /// That frame has finished.
    pub unsafe fn profile(&self) -> Result<Option<FrameProfile>> {
        // SAFETY: this function's contract.
        self.slot.profiler().map(|profiler| unsafe { profiler.read() }).transpose()
    }

    /// Tells the same pass by pass and answers with the frame's own time, where it was measured; takes nothing from the heap, so that a host may look at each frame.
    ///
    /// # Errors
    /// As [`Self::profile`].
    ///
    /// # Safety
    /// As there.
    pub unsafe fn each_pass(&self, mut tell: impl FnMut(PassFigures<'_>)) -> Result<Option<f64>> {
        let Some(profiler) = self.slot.profiler() else { return Ok(None) };
        // SAFETY: this function's contract.
        unsafe { profiler.each(&mut tell) }
    }

    /// Bytes of device memory that the view holds: images for its draws, and what its passes share.
    pub fn bytes(&self) -> u64 {
        let of_host = self.of_host.bytes() + self.under_way.bytes();
        self.images.bytes() + of_host + self.slot.transient_bytes()
    }
}
