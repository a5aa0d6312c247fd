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
    }
}
