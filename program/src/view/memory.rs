//! Memory that was freed, given back to the system.

use std::time::{Duration, Instant};

/// Has the allocator give back what it keeps of freed memory, while nothing is drawn that would soon take it again. The program has it keep all of it (`allocator.rs`), as a
/// driver takes and frees tens of megabytes a frame; and one that compiles for the CPU makes each pipeline of some megabytes of small pieces, between which pages stay that
/// nobody uses. Without this a window that shows ever other views grows by some ten megabytes in as many minutes while what is in use stays the same, and by a hundred where its pipelines change, too.
pub fn give_back() {
    #[cfg(all(target_os = "linux", target_env = "gnu"))]
    {
        unsafe extern "C" {
            fn malloc_trim(pad: usize) -> std::ffi::c_int;
        }
        // SAFETY: of glibc, as declared there; any thread may call it at any time.
        unsafe { malloc_trim(0) };
    }
}

/// Has glibc sort what is free in its first heap, for a tenth of a second at most: trimming leaves all of it in one list, and the first larger piece that anybody asks for sorts up to ten
/// thousand of them, which took 84 ms of the first frame of a hand under a profiler, where a driver had compiled pipelines there; 1 to 3 ms at rest without one.
pub fn sort() {
    const LARGE_BYTES: usize = 100_000;
    const TIMES: usize = 32;
    const MOST: Duration = Duration::from_millis(100);
    if cfg!(all(target_os = "linux", target_env = "gnu")) {
        let begun = Instant::now();
        let ask = |_| drop(std::hint::black_box(Vec::<u8>::with_capacity(LARGE_BYTES)));
        (0..TIMES).take_while(|_| begun.elapsed() < MOST).for_each(ask);
    }
}
