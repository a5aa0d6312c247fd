//! Splats of an uploaded scene are changed, added and taken out by a host's commands.

use std::ops::Range;

use ash::vk;

use crate::{
    error::Result,
    prepare::{PreparedScene, Update},
    renderer::Renderer,
    scene::Splats,
    vk::Copies,
};

impl Renderer {
    /// Records a change of splats of a scene that was uploaded with [`crate::scene::Scene::updatable`]: of its object with this number, those from number `first` on become
    /// `splats`, of the object's own kind (disks or ellipses; opaque where the object is). How much the surface overlaps itself and how near another one is, which an upload
    /// measures, stays. Numbers of the object's room ([`crate::scene::Room`]), and those that were taken out, may be among them: then there are splats again. Frames that are recorded from now on show it; those that were recorded before and run before it show what was.
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
        // SAFETY: this function's contract.
        unsafe { self.change(commands, update) }
    }

    /// Records that splats are added to an object which has room ([`crate::scene::Scene::rooms`]), behind the last one there: their numbers, by which [`Self::update`] changes them and
    /// [`Self::remove`] takes them out. All else is as of [`Self::update`], what it takes of memory, too.
    ///
    /// Numbers stay: those of others are never changed by what is added or taken out. Where the last ones of the room are taken out, the next come in their place;
    /// numbers between are filled by [`Self::update`], in whichever order the host wants: [`PreparedScene::room_of`] tells how many are left behind the last.
    ///
    /// Splats that are added together lie together in the frame's lists, too: 256 numbers in a row have bounds of their own, so that a frame costs the least where they are near each other.
    ///
    /// # Errors
    /// As [`Self::update`], and for an object without room, or without enough of it behind its last splat.
    ///
    /// # Safety
    /// As [`Self::update`].
    pub unsafe fn append(
        &self,
        commands: vk::CommandBuffer,
        scene: &mut PreparedScene,
        object: usize,
        splats: &Splats,
    ) -> Result<Range<u32>> {
        let (update, numbers) = scene.append(Some(self.device()), object, splats)?;
        // SAFETY: this function's contract.
        unsafe { self.change(commands, update) }?;
        Ok(numbers)
    }

    /// Records that splats with these numbers are taken out of an object that has room ([`crate::scene::Scene::rooms`], of no splats, too); numbers of which there is none are left alone.
    /// What else a frame shows stays to the bit, but for what was hidden. All else is as of [`Self::update`].
    ///
    /// A place that has nothing costs a frame as much as to read 16 bytes of it where others of the 256 around it are seen, and nothing where there are none, or behind the last.
    ///
    /// # Errors
    /// [`crate::ErrorKind::Option`] for an object without room, numbers beyond it, and splats that clip curves cut; as [`Self::update`].
    ///
    /// # Safety
    /// As [`Self::update`].
    pub unsafe fn remove(
        &self,
        commands: vk::CommandBuffer,
        scene: &mut PreparedScene,
        object: usize,
        numbers: Range<u32>,
    ) -> Result<()> {
        let update = scene.remove(Some(self.device()), object, numbers)?;
        // SAFETY: this function's contract.
        unsafe { self.change(commands, update) }
    }

    /// # Safety
    /// As [`Self::update`].
    unsafe fn change(&self, commands: vk::CommandBuffer, update: Update<'_>) -> Result<()> {
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
