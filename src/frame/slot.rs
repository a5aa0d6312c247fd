//! What a frame needs until the device has finished it. One slot for each frame in flight.

use crate::{
    error::{ErrorKind, Result},
    graph::execute::{Profile, Profiler, Transients},
    passes::Needs,
    vk::{DescriptorPool, Device, Occlusion, PoolRoom},
};

/// Descriptor sets, queries and transients of one frame at a time.
pub struct FrameSlot {
    device: Device,
    descriptors: Option<(DescriptorPool, PoolRoom)>,
    profiler: Option<(Profiler, Profile)>,
    occlusion: Option<Occlusion>,
    transients: Option<Transients>,
}

/// The parts of a slot, each to be borrowed by itself.
pub(crate) struct SlotParts<'a> {
    pub descriptors: &'a DescriptorPool,
    pub occlusion: Option<&'a Occlusion>,
    pub transients: &'a mut Option<Transients>,
    pub profiler: Option<&'a mut Profiler>,
}

impl FrameSlot {
    /// An empty slot.
    pub fn new(device: &Device) -> Self {
        Self { device: device.clone(), descriptors: None, profiler: None, occlusion: None, transients: None }
    }

    /// The profiler of the frame recorded last, if it was measured.
    pub fn profiler(&self) -> Option<&Profiler> {
        self.profiler.as_ref().map(|(profiler, _)| profiler)
    }

    /// Bytes of device memory in transients.
    pub fn transient_bytes(&self) -> u64 {
        self.transients.as_ref().map_or(0, Transients::bytes)
    }

    /// Makes the slot ready for a frame that takes so much from it.
    ///
    /// # Safety
    /// The frame recorded last in this slot has finished.
    ///
    /// # Errors
    /// Whatever the driver answers.
    pub(crate) unsafe fn begin(&mut self, needs: Needs, profile: Option<Profile>) -> Result<()> {
        let wanted = needs.room;
        if needs.occlusion_queries == 0 {
            self.occlusion = None;
        } else if self.occlusion.as_ref().is_none_or(|pool| pool.count() < needs.occlusion_queries) {
            self.occlusion = Some(Occlusion::new(&self.device, "layers", needs.occlusion_queries)?);
        }
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

    /// Its parts.
    ///
    /// # Errors
    /// [`ErrorKind::Graph`] before [`FrameSlot::begin`].
    pub(crate) fn parts(&mut self) -> Result<SlotParts<'_>> {
        let Some((descriptors, _)) = &self.descriptors else {
            let reason = "the frame slot was not begun".to_owned();
            return Err(ErrorKind::Graph { pass: String::new(), resource: String::new(), reason }.into());
        };
        Ok(SlotParts {
            descriptors,
            occlusion: self.occlusion.as_ref(),
            transients: &mut self.transients,
            profiler: self.profiler.as_mut().map(|(profiler, _)| profiler),
        })
    }
}
