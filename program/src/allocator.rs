//! The process's own memory: freed memory is kept, and all of it is counted.
//!
//! Software drivers build a frame's triangles and points in tens of megabytes of small pieces, freed when the frame is
//! done. The C library gives them back to the system each time, and the next frame pays for fresh, zeroed pages: on
//! lavapipe a fifth of the frame (the three passes over Igea, 1024×1024, 75 ms to 61 ms).
//!
//! Every byte that comes from Rust's allocator is counted, so that figures are the same in each run. What a driver takes for
//! itself is not in them.

use std::{
    alloc::{GlobalAlloc, Layout, System},
    sync::atomic::{AtomicUsize, Ordering},
};

/// The system's allocator, with a count of what is taken from it. `realloc` is the trait's own, which holds the old and the
/// new at once: an upper bound.
struct Counting;

static LIVE_BYTES: AtomicUsize = AtomicUsize::new(0);
static PEAK_BYTES: AtomicUsize = AtomicUsize::new(0);

#[global_allocator]
static ALLOCATOR: Counting = Counting;

// SAFETY: every call is the system allocator's own.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        // SAFETY: this function's contract.
        let pointer = unsafe { System.alloc(layout) };
        count(pointer, layout.size());
        pointer
    }

    // Its own, so that large zeroed memory stays untouched till it is used.
    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        // SAFETY: this function's contract.
        let pointer = unsafe { System.alloc_zeroed(layout) };
        count(pointer, layout.size());
        pointer
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        LIVE_BYTES.fetch_sub(layout.size(), Ordering::Relaxed);
        // SAFETY: this function's contract.
        unsafe { System.dealloc(pointer, layout) }
    }
}

/// Counts memory that was given; refusals do not count.
fn count(pointer: *mut u8, bytes: usize) {
    if !pointer.is_null() {
        let live = LIVE_BYTES.fetch_add(bytes, Ordering::Relaxed) + bytes;
        PEAK_BYTES.fetch_max(live, Ordering::Relaxed);
    }
}

/// Begins to look for the peak anew; answers how many bytes there are now.
pub fn begin_peak() -> usize {
    let live = LIVE_BYTES.load(Ordering::Relaxed);
    PEAK_BYTES.store(live, Ordering::Relaxed);
    live
}

/// The most bytes since [`begin_peak`].
pub fn peak_bytes() -> usize {
    PEAK_BYTES.load(Ordering::Relaxed)
}

/// How many bytes there are now.
pub fn live_bytes() -> usize {
    LIVE_BYTES.load(Ordering::Relaxed)
}

/// Writes the most bytes of the whole run into the file that the environment variable `SURFEL_PEAK_FILE` names, if there is one: tests of
/// files that are refused look at it.
pub fn tell_peak() {
    if let Some(path) = std::env::var_os("SURFEL_PEAK_FILE") {
        let _ = std::fs::write(path, peak_bytes().to_string());
    }
}

/// Raises the amounts that the C library keeps; call once, at the start. Nothing to do on other C libraries.
pub fn keep_freed_memory() {
    #[cfg(all(target_os = "linux", target_env = "gnu"))]
    {
        use std::ffi::c_int;
        // From <malloc.h>, fixed since glibc 2.0.
        const M_TRIM_THRESHOLD: c_int = -1;
        const M_TOP_PAD: c_int = -2;
        unsafe extern "C" {
            fn mallopt(parameter: c_int, value: c_int) -> c_int;
        }
        // SAFETY: glibc's own function with its own constants; it may be called at any time and fails by returning 0,
        // which leaves things as they are.
        unsafe {
            mallopt(M_TRIM_THRESHOLD, 1 << 30);
            mallopt(M_TOP_PAD, 64 << 20);
        }
    }
}
