//! Work on a picture band by band, on all cores.

use std::num::NonZero;
use std::sync::{Mutex, PoisonError};
use std::thread;

/// Calls `work(index, band)` for every band of `band_len` pixels, the last one perhaps shorter. Which thread takes
/// which band is open; none is taken twice.
pub(super) fn for_each<T: Send>(pixels: &mut [T], band_len: usize, work: impl Fn(usize, &mut [T]) + Sync) {
    let bands = Mutex::new(pixels.chunks_mut(band_len).enumerate());
    let take = || {
        loop {
            // The lock is held only while the next band is taken: nothing can be left half done under it.
            let next = bands.lock().unwrap_or_else(PoisonError::into_inner).next();
            let Some((i, band)) = next else { break };
            work(i, band);
        }
    };
    let threads = thread::available_parallelism().map_or(1, NonZero::get);
    thread::scope(|scope| {
        for _ in 1..threads {
            scope.spawn(take);
        }
        take();
    });
}
