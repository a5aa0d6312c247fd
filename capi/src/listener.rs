//! Who is told how far a long step is, and what was noticed on the way.

use std::ffi::{CString, c_char, c_void};

use surfel::Progress;

use crate::{
    result::Result,
    structs::{Struct, SurfelStructureType, read},
};

/// Is told that `done` of `total` parts of a task are finished; its name is UTF-8, valid during the call. Must return.
pub type SurfelStep =
    Option<unsafe extern "C" fn(user: *mut c_void, task: *const c_char, done: u64, total: u64)>;

/// Is told something that is no error, such as elements that were left out: a sentence, valid during the call. Must return.
pub type SurfelNote = Option<unsafe extern "C" fn(user: *mut c_void, note: *const c_char)>;

/// Who listens to a call that may take long, on the thread of that call.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct SurfelListener {
    /// `SURFEL_STRUCTURE_TYPE_LISTENER`.
    pub s_type: u32,
    /// `sizeof(SurfelListener)`.
    pub size: u32,
    /// NULL.
    pub p_next: *const c_void,
    /// What both functions are given first; may be NULL.
    pub user: *mut c_void,
    /// Is told how far the call is; may be NULL.
    pub step: SurfelStep,
    /// Is told what was noticed; may be NULL.
    pub note: SurfelNote,
}

// SAFETY: it begins so, and a test looks for padding.
unsafe impl Struct for SurfelListener {
    const TYPE: SurfelStructureType = SurfelStructureType::Listener;
}

/// One of C's, or nobody.
pub struct Listener(Option<SurfelListener>);

impl Listener {
    /// # Safety
    /// `given` is NULL or leads to as much as it says; its functions may be called for as long as this lives.
    pub unsafe fn new(given: *const SurfelListener) -> Result<Self> {
        // SAFETY: this function's contract.
        let read = |given| unsafe { read(given, "listener") };
        Ok(Self((!given.is_null()).then_some(given).map(read).transpose()?))
    }
}

impl Progress for Listener {
    fn step(&self, task: &str, done: u64, total: u64) {
        if let Some(SurfelListener { user, step: Some(step), .. }) = self.0 {
            // SAFETY: `new`'s contract.
            unsafe { step(user, of_c(task).as_ptr(), done, total) };
        }
    }

    fn note(&self, text: &str) {
        if let Some(SurfelListener { user, note: Some(note), .. }) = self.0 {
            // SAFETY: as above.
            unsafe { note(user, of_c(text).as_ptr()) };
        }
    }
}

fn of_c(text: &str) -> CString {
    CString::new(text.replace('\0', " ")).unwrap_or_default()
}
