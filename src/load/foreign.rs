//! Decoders of other crates, which panic on some damaged input: here that is an error like any other.

use std::cell::Cell;
#[cfg(feature = "las")]
use std::panic::{AssertUnwindSafe, catch_unwind};

thread_local! {
    static RUNS: Cell<bool> = const { Cell::new(false) };
}

/// Whether this thread runs a decoder of another crate, whose panic becomes an error in one line. A program's panic hook that asks it stays
/// silent about what [`load`](super::load()) tells in a better way.
pub fn runs_foreign_decoder() -> bool {
    RUNS.get()
}

/// What a decoder returns, which keeps nothing when it ends; `None` where it panics. It has to stay on this thread.
#[cfg(feature = "las")]
pub(super) fn guarded<T>(decode: impl FnOnce() -> T) -> Option<T> {
    let before = RUNS.replace(true);
    let decoded = catch_unwind(AssertUnwindSafe(decode));
    RUNS.set(before);
    decoded.ok()
}
