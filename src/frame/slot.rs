//! What a frame needs until the device has finished it. One slot for each frame in flight.

use crate::{
    error::{ErrorKind, Result},
    graph::execute::{Profile, Profiler, Transients},
    vk::{DescriptorPool, Device, PoolRoom},
};

/// Descriptor sets, queries and transients of one frame at a time.
pub struct FrameSlot {
    device: Device,
    descriptors: Option<(DescriptorPool, PoolRoom)>,
    profiler: Option<(Profiler, Profile)>,
    transients: Option<Transients>,
}

impl FrameSlot {
    /// An empty slot.
    pub fn new(device: &Device) -> Self {
        Self { device: device.clone(), descriptors: None, profiler: None, transients: None }
    }

    /// The profiler of the frame recorded last, if it was measured.
    pub fn profiler(&self) -> Option<&Profiler> {
        self.profiler.as_ref().map(|(profiler, _)| profiler)
    }

    /// Bytes of device memory in transients.
    pub fn transient_bytes(&self) -> u64 {
        self.transients.as_ref().map_or(0, Transients::bytes)
    }

    /// Makes the slot ready for a frame that takes so much from its pool.
    ///
    /// # Safety
    /// The frame recorded last in this slot has finished.
    ///
    /// # Errors
    /// Whatever the driver answers.
    pub(crate) unsafe fn begin(&mut self, wanted: PoolRoom, profile: Option<Profile>) -> Result<()> {
        match &self.descriptors {
            // SAFETY: this function's contract.
            Some((pool, room)) if room.holds(&wanted) => unsafe { pool.reset() }?,
            _ => {
                let pool = DescriptorPool::new(&self.device, "frame sets", wanted)?;
                self.descriptors = Some((pool, wanted));
            }
        }
        match profile {
            None => self.profiler = None,
            Some(profile) => {
                if self.profiler.as_ref().is_none_or(|(_, kept)| *kept != profile) {
                    self.profiler = Some((Profiler::new(&self.device, profile)?, profile));
                }
            }
        }
        Ok(())
    }

    /// Sets, transients and profiler, each to be borrowed by itself.
    ///
    /// # Errors
    /// [`ErrorKind::Graph`] before [`FrameSlot::begin`].
    pub(crate) fn parts(
        &mut self,
    ) -> Result<(&DescriptorPool, &mut Option<Transients>, Option<&mut Profiler>)> {
        let Some((descriptors, _)) = &self.descriptors else {
            let reason = "the frame slot was not begun".to_owned();
            return Err(ErrorKind::Graph { pass: String::new(), resource: String::new(), reason }.into());
        };
        let profiler = self.profiler.as_mut().map(|(profiler, _)| profiler);
        Ok((descriptors, &mut self.transients, profiler))
    }
}
