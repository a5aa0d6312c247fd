//! Bytes that change often, on their way to the device: through one buffer that is kept, in which those of each epoch lie behind those of the epoch before, and take the place of
//! those that the device has finished with.

use std::{
    collections::VecDeque,
    ptr::NonNull,
    sync::{
        Arc, Mutex, PoisonError,
        atomic::{AtomicU64, Ordering},
    },
};

use ash::vk;

use super::{
    buffer::{Buffer, BufferDesc},
    device::Device,
    memory::MemoryUse,
};
use crate::error::{ErrorKind, Result};

/// A ring of staging. Threads share it: each has a region of its own.
pub(crate) struct StagingRing {
    device: Device,
    kept: Mutex<Kept>,
    /// The epoch in which it is looked at next, whether it is too large.
    look_at: AtomicU64,
}

#[derive(Default)]
struct Kept {
    buffer: Option<Arc<Buffer>>,
    spans: Spans,
    /// The most that was in use at once since it was looked at last.
    most_bytes: u64,
    /// What a new buffer has at least.
    expected_bytes: u64,
}

/// What is not used in so many epochs is given back.
pub(crate) const EPOCHS_OF_LATE: u64 = 1000;

/// A buffer is made anew that is so many times as large as what was in use of it: more than one ever has that had to grow, which is twice what was in use and a rest at the end.
const MOST_TIMES_TOO_LARGE: u64 = 4;

/// Regions begin at multiples of so many bytes.
const ALIGNMENT: u64 = 16;

impl StagingRing {
    /// A ring without memory yet.
    pub fn new(device: &Device) -> Self {
        let look_at = AtomicU64::new(EPOCHS_OF_LATE);
        Self { device: device.clone(), kept: Mutex::default(), look_at }
    }

    /// Room for so many bytes (above 0), until the epoch that is recorded now is done.
    ///
    /// # Errors
    /// Whatever the allocator answers.
    pub fn reserve(&self, bytes: u64) -> Result<Region> {
        self.give_back_idle();
        let mut kept = self.kept.lock().unwrap_or_else(PoisonError::into_inner);
        let Kept { buffer, spans, most_bytes, expected_bytes } = &mut *kept;
        spans.free(self.device.epochs_done());
        let taken = bytes.next_multiple_of(ALIGNMENT);
        // Read under the lock, so that epochs follow one another in the ring.
        let epoch = self.device.epoch();
        let place = match (buffer.as_ref(), spans.take(taken, epoch)) {
            (Some(buffer), Some(offset)) => Some((Arc::clone(buffer), offset)),
            _ => None,
        };
        let (buffer, offset) = match place {
            Some(place) => place,
            None => {
                let needed = (spans.used() + taken).max(spans.capacity).max(*expected_bytes);
                let made = self.buffer(2 * needed).or_else(|_| self.buffer(taken))?;
                // The buffer before goes when all that is recorded now is done.
                *spans = Spans { capacity: made.size(), ..Spans::default() };
                spans.take(taken, epoch);
                (Arc::clone(buffer.insert(Arc::new(made))), 0)
            }
        };
        *most_bytes = (*most_bytes).max(spans.used());
        drop(kept);
        let Some(first) = buffer.mapped() else {
            let (object, reason) = ("update of splats".to_owned(), "its memory is not mapped".to_owned());
            return Err(ErrorKind::Memory { object, bytes, reason }.into());
        };
        Ok(Region { buffer, first, next: offset, end: offset + bytes })
    }

    /// Gives back a buffer that was not used of late, or little of it: asked for often, it looks rarely.
    pub fn give_back_idle(&self) {
        let (epoch, look_at) = (self.device.epoch(), self.look_at.load(Ordering::Relaxed));
        let next = epoch + EPOCHS_OF_LATE;
        let (stored, failed) = (Ordering::Relaxed, Ordering::Relaxed);
        if epoch < look_at || self.look_at.compare_exchange(look_at, next, stored, failed).is_err() {
            return;
        }
        let mut kept = self.kept.lock().unwrap_or_else(PoisonError::into_inner);
        kept.expected_bytes = kept.most_bytes;
        if kept.spans.capacity / MOST_TIMES_TOO_LARGE > kept.most_bytes || kept.most_bytes == 0 {
            // It goes when all that is recorded now is done.
            (kept.buffer, kept.spans) = (None, Spans::default());
        }
        kept.most_bytes = 0;
    }

    fn buffer(&self, size: u64) -> Result<Buffer> {
        let usage = vk::BufferUsageFlags::TRANSFER_SRC;
        Buffer::new(&self.device, BufferDesc { name: "update of splats", size, usage }, MemoryUse::Upload)
    }
}

/// A part of a ring's buffer that is one's own until the epoch is done in which it was reserved.
pub(crate) struct Region {
    buffer: Arc<Buffer>,
    /// Of the buffer.
    first: NonNull<u8>,
    next: u64,
    end: u64,
}

impl Region {
    /// The buffer.
    pub fn buffer(&self) -> vk::Buffer {
        self.buffer.raw()
    }

    /// Puts bytes behind those before: where in the buffer they are. What has no room is left out.
    pub fn push(&mut self, bytes: &[u8]) -> Option<u64> {
        let (at, length) = (self.next, bytes.len() as u64);
        if length > self.end - at {
            return None;
        }
        // SAFETY: these bytes lie in the buffer, which is mapped as long as it is here; until the epoch is done the ring gives them to nobody else, and nothing that was submitted reads
        // them any more.
        let room =
            unsafe { std::slice::from_raw_parts_mut(self.first.as_ptr().add(at as usize), bytes.len()) };
        room.copy_from_slice(bytes);
        self.next += length;
        Some(at)
    }
}

/// Which bytes of a buffer are in use, and up to which epoch.
#[derive(Default)]
struct Spans {
    capacity: u64,
    /// Where the next one begins, and where the oldest does.
    head: u64,
    tail: u64,
    /// Epochs, the oldest first, and where the bytes of each end. None has none.
    ends: VecDeque<(u64, u64)>,
}

impl Spans {
    /// What an epoch had that is done is free.
    fn free(&mut self, done: u64) {
        while let Some((_, end)) = self.ends.front().filter(|(epoch, _)| *epoch <= done) {
            self.tail = *end;
            self.ends.pop_front();
        }
        if self.ends.is_empty() {
            (self.head, self.tail) = (0, 0);
        }
    }

    /// Some bytes in a row, for an epoch that is not before others: where they begin.
    fn take(&mut self, bytes: u64, epoch: u64) -> Option<u64> {
        let goes_around = !self.ends.is_empty() && self.head <= self.tail;
        let end = if goes_around { self.tail } else { self.capacity };
        let begin = match end - self.head >= bytes {
            true => self.head,
            false if !goes_around && self.tail >= bytes => 0,
            false => return None,
        };
        self.head = begin + bytes;
        match self.ends.back_mut().filter(|(last, _)| *last == epoch) {
            Some((_, end)) => *end = self.head,
            None => self.ends.push_back((epoch, self.head)),
        }
        Some(begin)
    }

    /// Bytes from the oldest to the newest.
    fn used(&self) -> u64 {
        match (self.ends.is_empty(), self.head > self.tail) {
            (true, _) => 0,
            (false, true) => self.head - self.tail,
            (false, false) => self.capacity - self.tail + self.head,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::SplitMix;

    /// What is in use is never given twice, and once enough is there nothing is refused.
    #[test]
    fn bytes_in_use_are_given_to_nobody_else_and_what_is_free_is_found() {
        let mut random = SplitMix(3);
        let mut below = |most: u64| (random.unit() * most as f64) as u64;
        for in_flight in 1..5 {
            let mut spans = Spans { capacity: 4000, ..Spans::default() };
            let mut taken: VecDeque<(u64, u64, u64)> = VecDeque::new();
            let mut refused = 0;
            for epoch in 1..2000_u64 {
                let done = epoch.saturating_sub(in_flight);
                spans.free(done);
                taken.retain(|(of, ..)| *of > done);
                for _ in 0..=below(3) {
                    let bytes = 1 + below(400);
                    let Some(begin) = spans.take(bytes, epoch) else {
                        refused += 1;
                        continue;
                    };
                    let end = begin + bytes;
                    assert!(end <= 4000 && spans.used() <= 4000);
                    assert!(
                        taken.iter().all(|(_, b, e)| end <= *b || *e <= begin),
                        "{begin} {end} {taken:?}"
                    );
                    taken.push_back((epoch, begin, end));
                    assert!(taken.iter().map(|(_, b, e)| e - b).sum::<u64>() <= spans.used());
                }
            }
            // Up to 3 a frame, of 400 at most: what 2 frames leave is more than those of the next and a rest at the end.
            assert!(in_flight > 2 || refused == 0, "{in_flight}: {refused}");
        }
        let mut spans = Spans { capacity: 100, ..Spans::default() };
        assert_eq!((spans.take(60, 1), spans.take(50, 1), spans.take(40, 2)), (Some(0), None, Some(60)));
        assert_eq!((spans.take(1, 2), spans.used()), (None, 100));
        spans.free(1);
        assert_eq!((spans.take(60, 3), spans.take(1, 3)), (Some(0), None));
        spans.free(3);
        assert_eq!((spans.used(), spans.take(100, 4)), (0, Some(0)));
    }
}
