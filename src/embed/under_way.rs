//! What a view's host side writes for a frame, kept apart as long as that may be under way: so a view may be prepared again before the frame before has run, or is drawn.

use super::table::Table;
use crate::{
    error::{Error, Result},
    frame::{FrameSlot, Written},
    vk::Device,
};

/// What a frame reads that the host writes.
#[derive(Default)]
pub(super) struct OfHost {
    /// Objects as the host numbers them; tints of what is opaque, and of what is transparent.
    pub objects: Table,
    pub tints: [Table; 2],
}

/// That of frames which may be under way.
#[derive(Default)]
pub(super) struct UnderWay {
    /// The epoch in which the frame was recorded that was prepared last; 0: there is none.
    epoch: u64,
    /// Those of frames before, each with its epoch.
    before: Vec<(u64, Written, OfHost)>,
}

/// Frames of one view that may be under way at once: more than any host records and resets in one epoch, for which no host shall be refused. Who never tells that an epoch is done is told so, in place of taking ever more.
const MOST: usize = 256;

impl UnderWay {
    /// Sees to it that nothing is written that a frame reads which may be under way. Where epochs are done by then, as with one view for each frame in flight, that is nothing.
    ///
    /// # Errors
    /// [`crate::ErrorKind::Option`] for too many frames of which it is not known that they are done.
    pub fn keep_apart(&mut self, device: &Device, slot: &mut FrameSlot, of_host: &mut OfHost) -> Result<()> {
        let done = device.epochs_done();
        if self.epoch > done {
            let mut free = match self.before.iter().position(|(epoch, ..)| *epoch <= done) {
                Some(place) => self.before.swap_remove(place),
                None if self.before.len() + 1 < MOST => Default::default(),
                None => {
                    return Err(Error::option(
                        "prepare",
                        format!(
                            "{MOST} frames of this view may be under way: expected Device::epoch_done for those that are done, or were \
                             recorded in an epoch of which nothing was submitted"
                        ),
                    ));
                }
            };
            slot.exchange(&mut free.1);
            std::mem::swap(of_host, &mut free.2);
            self.before.push((self.epoch, free.1, free.2));
            self.epoch = 0;
        }
        Ok(())
    }

    /// The frame is recorded now; one that is refused before is not under way.
    pub fn record(&mut self, device: &Device) {
        self.epoch = device.epoch();
    }

    /// Bytes of device memory.
    pub fn bytes(&self) -> u64 {
        self.before.iter().map(|(.., of_host)| of_host.bytes()).sum()
    }
}

impl OfHost {
    /// Bytes of device memory.
    pub fn bytes(&self) -> u64 {
        self.objects.bytes() + self.tints.iter().map(Table::bytes).sum::<u64>()
    }
}
