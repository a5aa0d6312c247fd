//! Uploads within a host's own commands.

use ash::vk;

use crate::{error::Result, prepare::PreparedScene, renderer::Renderer, scene::Scene, vk::Staging};

impl Renderer {
    /// Records the upload of a scene, which frames recorded later may show.
    ///
    /// # Errors
    /// As [`Renderer::prepare`]. Then the commands hold copies to what is gone: they must not be submitted.
    ///
    /// # Safety
    /// `commands` must be recording, outside of rendering, and be submitted to the device's queue, in the epoch that is not ended yet
    /// ([`crate::vk::Device::end_epoch`]).
    pub unsafe fn upload(&self, commands: vk::CommandBuffer, scene: &Scene) -> Result<PreparedScene> {
        let mut record = |staging: Staging| {
            // SAFETY: this function's contract. The batch is dropped here, and its memory waits for the epoch.
            unsafe { staging.record(commands) };
            Ok(())
        };
        self.prepare(scene, &mut record, &|_, _| {})
    }
}
