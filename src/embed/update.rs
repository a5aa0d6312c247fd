//! Splats of an uploaded scene are changed by a host's commands.

use ash::vk;

use crate::{error::Result, prepare::PreparedScene, renderer::Renderer, scene::Splats};

impl Renderer {
    /// Records a change of splats of a scene that was uploaded with [`crate::scene::Scene::updatable`]: of its object with this number, those from number `first` on become
    /// `splats`, of the object's own kind (disks or ellipses; opaque where the object is). How much the surface overlaps itself and how near another one is, which an upload
    /// measures, stays. Frames that are recorded from now on show it; those that were recorded before and run before it show what was.
    ///
    /// The bytes go through memory that the host writes, which goes when the epoch that is recorded now is done. Nothing waits.
    ///
    /// # Errors
    /// [`crate::ErrorKind::Option`] for another scene, numbers that the object does not have, splats that the upload left out, splats that can't be drawn or are of another
    /// kind; whatever the allocator or the driver answers. Then nothing is recorded, and nothing has changed.
    ///
    /// # Safety
    /// `commands` must be recording, outside of rendering, and be submitted to the device's queue, in the epoch that is not ended yet; the scene is alive until it has run.
    pub unsafe fn update(
        &self,
        commands: vk::CommandBuffer,
        scene: &mut PreparedScene,
        object: usize,
        first: u32,
        splats: &Splats,
    ) -> Result<()> {
        let Some(staging) = scene.update(Some(self.device()), object, first, splats)? else { return Ok(()) };
        // What was recorded before reads what is there now.
        let barriers = [vk::MemoryBarrier2::default()
            .src_stage_mask(vk::PipelineStageFlags2::VERTEX_SHADER | vk::PipelineStageFlags2::COMPUTE_SHADER)
            .dst_stage_mask(vk::PipelineStageFlags2::COPY)
            .src_access_mask(vk::AccessFlags2::NONE)
            .dst_access_mask(vk::AccessFlags2::TRANSFER_WRITE)];
        let info = vk::DependencyInfo::default().memory_barriers(&barriers);
        // SAFETY: this function's contract. The batch is dropped here, and its memory waits for the epoch.
        unsafe {
            self.device().raw().cmd_pipeline_barrier2(commands, &info);
            staging.record(commands);
        }
        Ok(())
    }
}
