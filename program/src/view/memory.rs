//! Memory that was freed, given back to the system.

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
        sort();
    }
}

/// Has glibc sort what is free in its first heap, where trimming leaves all of it in one list: the first larger piece that anybody asks for sorts up to ten thousand of them, which took
/// 60 to 90 ms of the first frame of a hand where a driver had compiled pipelines there.
#[cfg(all(target_os = "linux", target_env = "gnu"))]
fn sort() {
    const LARGE_BYTES: usize = 100_000;
    const TIMES: usize = 32;
    for _ in 0..TIMES {
        drop(std::hint::black_box(Vec::<u8>::with_capacity(LARGE_BYTES)));
    }
}
