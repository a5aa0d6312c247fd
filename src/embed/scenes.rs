//! Scenes that a host brings to the device by its own commands, or writes there.

use ash::vk;

use crate::{
    error::Result,
    prepare::{DynamicSplats, PreparedScene},
    renderer::Renderer,
    scene::Scene,
    vk::{Staging, Upload},
};

impl Renderer {
    /// Records the upload of a scene, which frames recorded later may show.
    ///
    /// # Errors
    /// As [`Renderer::prepare`]. Then the commands hold copies to what is gone: they must not be submitted.
    ///
    /// # Safety
    /// `commands` must be recording, outside of rendering, and be submitted to the device's queue, before any frame that shows the scene; in whichever epoch, for
    /// what is copied from goes when the device has told that the copies have run. The scene is alive until then, or they never run.
    pub unsafe fn upload(&self, commands: vk::CommandBuffer, scene: &Scene) -> Result<PreparedScene> {
        let upload = Upload::default();
        let mut record = |staging: Staging| {
            // SAFETY: this function's contract. The scene keeps the batch until it has run.
            unsafe { staging.record_and_tell(commands) };
            upload.keep(staging);
            Ok(())
        };
        let prepared = self.prepare(scene, &mut record, &|_, _| {})?;
        Ok(PreparedScene { upload: upload.begin(self.device()), ..prepared })
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
