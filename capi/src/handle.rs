//! Pointers that C holds for objects, and other pointers that it gives.

use std::ffi::{CStr, c_char};

use crate::result::{Failure, Result};

/// Where an object goes that a call makes; NULL until it is made.
pub struct Out<T>(*mut *mut T);

impl<T> Out<T> {
    /// # Safety
    /// `out` is NULL or may be written.
    pub unsafe fn new(out: *mut *mut T, name: &str) -> Result<Self> {
        if out.is_null() {
            return Err(null(name));
        }
        // SAFETY: this function's contract.
        unsafe { out.write(std::ptr::null_mut()) };
        Ok(Self(out))
    }

    pub fn give(self, object: T) -> Result<()> {
        // SAFETY: `new`'s contract.
        unsafe { self.0.write(Box::into_raw(Box::new(object))) };
        Ok(())
    }
}

pub fn null(name: &str) -> Failure {
    Failure::invalid(format!("{name} is NULL"))
}

/// # Safety
/// `object` is NULL or lives as long as what is returned, and nobody changes it meanwhile.
pub unsafe fn get<'a, T>(object: *const T, name: &str) -> Result<&'a T> {
    // SAFETY: this function's contract.
    unsafe { object.as_ref() }.ok_or_else(|| null(name))
}

/// # Safety
/// `object` is NULL or lives as long as what is returned, and nobody else uses it meanwhile.
pub unsafe fn get_mut<'a, T>(object: *mut T, name: &str) -> Result<&'a mut T> {
    // SAFETY: this function's contract.
    unsafe { object.as_mut() }.ok_or_else(|| null(name))
}

/// # Safety
/// `object` is NULL or came from [`Out::give`], and is not used any more.
pub unsafe fn destroy<T>(function: &str, object: *mut T) {
    if !object.is_null() {
        crate::result::guard(function, || {
            // SAFETY: this function's contract.
            drop(unsafe { Box::from_raw(object) });
            Ok(())
        });
    }
}

/// # Safety
/// `text` is NULL or ends with a zero.
pub unsafe fn text<'a>(text: *const c_char, name: &str) -> Result<&'a str> {
    if text.is_null() {
        return Err(null(name));
    }
    // SAFETY: this function's contract.
    let bytes = unsafe { CStr::from_ptr(text) };
    bytes.to_str().map_err(|_| Failure::invalid(format!("{name} is not UTF-8")))
}
