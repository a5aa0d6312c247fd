//! Splats of an uploaded scene are changed by a host's commands.

use ash::vk;

use crate::{error::Result, prepare::PreparedScene, renderer::Renderer, scene::Splats, vk::Copies};

impl Renderer {
    /// Records a change of splats of a scene that was uploaded with [`crate::scene::Scene::updatable`]: of its object with this number, those from number `first` on become
    /// `splats`, of the object's own kind (disks or ellipses; opaque where the object is). How much the surface overlaps itself and how near another one is, which an upload
    /// measures, stays. Frames that are recorded from now on show it; those that were recorded before and run before it show what was.
    ///
    /// The bytes go through one ring of memory that the renderer keeps for all its scenes, in which each epoch's wait until it is done. Nothing waits, and an update as large as those before takes
    /// nothing from the device's memory, and nothing from the heap. The ring grows where more is in flight at once; what a thousand epochs have not used of it is given back.
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
        let update = scene.update(Some(self.device()), object, first, splats)?;
        if update.bytes() > 0 {
            let region = self.staging.reserve(update.bytes())?;
            // SAFETY: this function's contract; runs of splats of a chunk do not overlap.
            let mut copies = unsafe { Copies::begin(self.device(), commands, region) };
            update.apply(Some(&mut copies));
            copies.end();
        }
        Ok(())
    }
}
