//! Pointers that C holds for objects, and other pointers that it gives.

use std::ffi::{CStr, c_char};

use crate::result::{Failure, Result};

/// Where a value goes that a call tells: nothing is read from there, so that C need not have set it.
pub struct Place<T>(*mut T);

impl<T> Place<T> {
    /// # Safety
    /// `to` is NULL, not aligned, or may be written for as long as this lives.
    pub unsafe fn new(to: *mut T, name: &str) -> Result<Self> {
        check(to, name)?;
        Ok(Self(to))
    }

    pub fn write(&self, value: T) {
        // SAFETY: `new`'s contract; aligned.
        unsafe { self.0.write(value) };
    }
}

/// Where an object goes that a call makes; NULL until it is made.
pub struct Out<T>(Place<*mut T>);

impl<T> Out<T> {
    /// # Safety
    /// As [`Place::new`].
    pub unsafe fn new(out: *mut *mut T, name: &str) -> Result<Self> {
        // SAFETY: this function's contract.
        let place = unsafe { Place::new(out, name) }?;
        place.write(std::ptr::null_mut());
        Ok(Self(place))
    }

    pub fn give(self, object: T) -> Result<()> {
        self.0.write(Box::into_raw(Box::new(object)));
        Ok(())
    }
}

pub fn null(name: &str) -> Failure {
    Failure::invalid(format!("{name} is NULL"))
}

/// Refuses a pointer that leads nowhere, or to where no such thing can be.
pub fn check<T>(pointer: *const T, name: &str) -> Result<()> {
    match pointer.is_aligned() {
        _ if pointer.is_null() => Err(null(name)),
        true => Ok(()),
        false => Err(Failure::invalid(format!("{name} is not aligned"))),
    }
}

/// # Safety
/// `object` is NULL, not aligned, or lives as long as what is returned, and nobody changes it meanwhile.
pub unsafe fn get<'a, T>(object: *const T, name: &str) -> Result<&'a T> {
    check(object, name)?;
    // SAFETY: this function's contract.
    Ok(unsafe { &*object })
}

/// # Safety
/// `object` is NULL, not aligned, or lives as long as what is returned, and nobody else uses it meanwhile.
pub unsafe fn get_mut<'a, T>(object: *mut T, name: &str) -> Result<&'a mut T> {
    check(object, name)?;
    // SAFETY: this function's contract.
    Ok(unsafe { &mut *object })
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

/// Tells a text: how many bytes it has, and of these, with a closing zero, as many as there is room for.
///
/// # Safety
/// Both pointers are NULL, not aligned, or may be written, `to` for as many bytes as it is said to have room for.
pub unsafe fn told(
    own: &str,
    (to, capacity, name): (*mut c_char, u64, &str),
    length: *mut u64,
) -> Result<()> {
    // SAFETY: this function's contract.
    unsafe { Place::new(length, "length") }?.write(own.len() as u64);
    let Some(most) = capacity.checked_sub(1) else { return Ok(()) };
    if to.is_null() {
        return Err(null(name));
    }
    let count = own.len().min(usize::try_from(most).unwrap_or(usize::MAX));
    // SAFETY: this function's contract: there is room for `capacity`, which is more than `count`.
    unsafe {
        to.copy_from_nonoverlapping(own.as_ptr().cast(), count);
        to.add(count).write(0);
    }
    Ok(())
}
