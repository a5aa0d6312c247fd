//! Memory that was freed, given back to the system.

/// Has the allocator give back what it keeps of freed memory. On a driver that compiles for the CPU each pipeline is some megabytes of small allocations, of several
/// threads; glibc keeps pages between those that are left, in an arena for each thread, and the process would grow by a hundred megabytes while what is in use
/// stays the same.
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
