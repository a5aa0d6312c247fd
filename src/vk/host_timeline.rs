//! Epochs by values of a host's own timeline: so a host that has a timeline semaphore keeps no list of which epoch was which of its submissions.

use std::{
    collections::VecDeque,
    sync::{Mutex, PoisonError},
};

use super::device::Device;
use crate::error::{Error, Result};

/// Epochs that were ended by a value and may not be done yet, each with it. Both rise.
#[derive(Default)]
pub(super) struct HostTimeline(Mutex<Ended>);

#[derive(Default)]
struct Ended {
    last: u64,
    under_way: VecDeque<(u64, u64)>,
}

impl Device {
    /// As [`Device::end_epoch`], by the value that the host's own timeline semaphore has once the device has finished the submission. Values rise from call to call, by whichever
    /// steps; submissions without our commands have values between.
    ///
    /// ```no_run
    /// use surfel::{ash::{self, vk}, embed::Device};
    ///
    /// /// `value` is what the submission signals `timeline` to, of which some before may not have finished.
    /// unsafe fn submitted(ours: &Device, host: &ash::Device, timeline: vk::Semaphore, value: u64) -> Result<(), Box<dyn std::error::Error>> {
    ///     ours.end_epoch_at(value)?;
    ///     // SAFETY: this function's contract: the semaphore is the host's, and has the value of what has finished.
    ///     unsafe { ours.timeline_at(host.get_semaphore_counter_value(timeline)?) };
    ///     Ok(())
    /// }
    /// ```
    ///
    /// # Errors
    /// [`crate::ErrorKind::Option`] for a value that is not above the one before. The epoch goes on then.
    pub fn end_epoch_at(&self, value: u64) -> Result<()> {
        // Under the lock, so that epochs rise with values.
        let mut ended = self.0.timeline.0.lock().unwrap_or_else(PoisonError::into_inner);
        if value <= ended.last {
            let problem = format!("{value}: expected more than {}, the value of the one before", ended.last);
            return Err(Error::option("epoch", problem));
        }
        ended.last = value;
        let epoch = self.end_epoch();
        ended.under_way.push_back((value, epoch));
        Ok(())
    }

    /// As [`Device::epoch_done`], for all epochs that were ended by this value or one below ([`Device::end_epoch_at`]).
    ///
    /// # Safety
    /// The device has finished every submission at which an epoch was ended by such a value, and every one before.
    pub unsafe fn timeline_at(&self, value: u64) {
        let mut done = None;
        {
            let mut ended = self.0.timeline.0.lock().unwrap_or_else(PoisonError::into_inner);
            while let Some((_, epoch)) = ended.under_way.front().copied().filter(|(of, _)| *of <= value) {
                ended.under_way.pop_front();
                done = Some(epoch);
            }
        }
        if let Some(epoch) = done {
            // SAFETY: this function's contract.
            unsafe { self.epoch_done(epoch) };
        }
    }
}
