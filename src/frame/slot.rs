//! What a frame needs until the device has finished it. One slot for each frame in flight.

use crate::{
    error::{ErrorKind, Result},
    graph::execute::{Profile, Profiler, Transients},
    vk::{DescriptorPool, Device},
};

/// Descriptor sets, queries and transients of one frame at a time.
pub struct FrameSlot {
    device: Device,
    descriptors: Option<(DescriptorPool, [u32; 3])>,
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

    /// Makes the slot ready for a frame with this many sets, storage buffers and sampled images.
    ///
    /// # Safety
    /// The frame recorded last in this slot has finished.
    ///
    /// # Errors
    /// Whatever the driver answers.
    pub(crate) unsafe fn begin(&mut self, sets: [u32; 3], profile: Option<Profile>) -> Result<()> {
        match &self.descriptors {
            // SAFETY: this function's contract.
            Some((pool, room)) if (0..3).all(|i| sets[i] <= room[i]) => unsafe { pool.reset() }?,
            _ => {
                let pool = DescriptorPool::new(&self.device, "frame sets", sets[0], sets[1], sets[2])?;
                self.descriptors = Some((pool, sets));
            }
        }
        match profile {
            None => self.profiler = None,
            Some(wanted) => {
                if self.profiler.as_ref().is_none_or(|(_, profile)| *profile != wanted) {
                    self.profiler = Some((Profiler::new(&self.device, wanted)?, wanted));
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
