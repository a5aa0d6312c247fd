//! Scenes that a host brings to the device by its own commands, or writes there.

use ash::vk;

use crate::{
    error::Result,
    prepare::{DynamicSplats, PreparedScene},
    renderer::Renderer,
    scene::Scene,
    vk::Staging,
};

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

    /// A scene of splats that the host writes on the device, by a compute shader or by copies: each time before a frame reads them, with a barrier to
    /// `SHADER_STORAGE_READ` of the compute and vertex stages. See [`crate::prepare::dynamic`] for the layout.
    ///
    /// # Errors
    /// [`crate::ErrorKind::Option`] for what is no bound; whatever the allocator or the driver answers.
    pub fn dynamic(&self, splats: &DynamicSplats) -> Result<PreparedScene> {
        PreparedScene::dynamic((self.device(), &self.limits), &self.shaders.splat_set, splats)
    }
}
