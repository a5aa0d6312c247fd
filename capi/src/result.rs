//! What calls answer, and the border that no panic crosses.

use std::{
    any::Any,
    cell::RefCell,
    ffi::{CString, c_char},
    panic::{AssertUnwindSafe, catch_unwind},
};

use surfel::{Error, ErrorKind, ash::vk};

/// What a call answers. `surfel_last_error` has the sentence.
#[repr(i32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SurfelResult {
    /// It is done.
    Success = 0,
    /// A pointer is NULL or not aligned, a count is too large, text is not UTF-8.
    InvalidArgument = -1,
    /// A struct's `sType` is not the one expected there, or its `pNext` leads to a struct that does not extend it.
    UnknownStruct = -2,
    /// A struct is larger than this library knows it, and what it doesn't know is not zero; or a member that is reserved is not zero: the header is newer than the library.
    NewerStruct = -3,
    /// A mistake in the library. The objects of the call may only be destroyed from now on.
    Panic = -4,
    /// The library was built without it.
    #[cfg_attr(feature = "files", expect(dead_code, reason = "only libraries without files answer so"))]
    Unsupported = -5,
    /// A value is out of its range, or rules another one out.
    Option = -6,
    /// The content of a file is not what its format demands.
    Input = -7,
    /// A file can't be read.
    File = -8,
    /// The device lacks something, by name.
    NoDevice = -9,
    /// There is no memory, of the host or the device.
    OutOfMemory = -10,
    /// The device is lost.
    DeviceLost = -11,
    /// Another Vulkan call failed.
    Vulkan = -12,
    /// Another error of the library.
    Internal = -13,
    /// A frame needs a pipeline that is not there yet, and was not to make one: `surfel_compile_ahead` does.
    NotReady = -14,
}

/// Why a call is refused.
#[derive(Debug)]
pub struct Failure {
    pub code: SurfelResult,
    pub text: String,
}

pub type Result<T> = std::result::Result<T, Failure>;

impl Failure {
    pub fn invalid(text: impl Into<String>) -> Self {
        Self { code: SurfelResult::InvalidArgument, text: text.into() }
    }

    #[cfg(not(feature = "files"))]
    pub fn without_files() -> Self {
        let text = "the library was built without the feature 'files'".to_owned();
        Self { code: SurfelResult::Unsupported, text }
    }
}

impl From<Error> for Failure {
    fn from(error: Error) -> Self {
        let code = match error.kind() {
            ErrorKind::Input { .. } => SurfelResult::Input,
            ErrorKind::Option { .. } => SurfelResult::Option,
            ErrorKind::File { .. } => SurfelResult::File,
            ErrorKind::NotReady { .. } => SurfelResult::NotReady,
            ErrorKind::NoDevice { .. } => SurfelResult::NoDevice,
            ErrorKind::Memory { .. } => SurfelResult::OutOfMemory,
            ErrorKind::Vulkan { result, .. } => match *result {
                vk::Result::ERROR_DEVICE_LOST => SurfelResult::DeviceLost,
                vk::Result::ERROR_OUT_OF_HOST_MEMORY | vk::Result::ERROR_OUT_OF_DEVICE_MEMORY => {
                    SurfelResult::OutOfMemory
                }
                _ => SurfelResult::Vulkan,
            },
            _ => SurfelResult::Internal,
        };
        Self { code, text: error.to_string() }
    }
}

thread_local! {
    static LAST: RefCell<CString> = RefCell::default();
}

/// Why the last call of this thread that failed did, in a sentence that begins with the function's name; empty where none has. Valid until
/// the next call of this thread that fails.
#[unsafe(no_mangle)]
pub extern "C" fn surfel_last_error() -> *const c_char {
    LAST.try_with(|last| last.borrow().as_ptr()).unwrap_or(c"".as_ptr())
}

/// Runs the body of a function: an error or a panic becomes a code and a sentence.
pub fn guard(function: &str, body: impl FnOnce() -> Result<()>) -> SurfelResult {
    // What a panic leaves half done is only destroyed after it, by the contract of `SurfelResult::Panic`.
    let done = catch_unwind(AssertUnwindSafe(body));
    let Failure { code, text } = match done {
        Ok(Ok(())) => return SurfelResult::Success,
        Ok(Err(failure)) => failure,
        Err(payload) => Failure { code: SurfelResult::Panic, text: said(&*payload).to_owned() },
    };
    let sentence = format!("{function}: {text}").replace('\0', " ");
    let sentence = CString::new(sentence).unwrap_or_default();
    // While a thread ends there is nobody to ask.
    let _ = LAST.try_with(|last| last.replace(sentence));
    code
}

fn said(payload: &(dyn Any + Send)) -> &str {
    let owned = payload.downcast_ref::<String>().map(String::as_str);
    owned.or_else(|| payload.downcast_ref::<&str>().copied()).unwrap_or("a panic without words")
}

#[cfg(test)]
mod tests {
    use std::ffi::CStr;

    use super::*;

    fn last() -> String {
        // SAFETY: valid until this thread's next failure.
        unsafe { CStr::from_ptr(surfel_last_error()) }.to_string_lossy().into_owned()
    }

    extern "C" fn panics(index: usize) -> SurfelResult {
        guard("panics", || {
            let none: [u8; 0] = [];
            let _ = none[index];
            Ok(())
        })
    }

    #[test]
    fn a_panic_becomes_a_code_and_a_sentence() {
        assert_eq!(panics(std::hint::black_box(7)), SurfelResult::Panic);
        assert!(last().starts_with("panics: index out of bounds"), "{}", last());
        let panic = std::thread::spawn(|| guard("other", || std::panic::panic_any(3_u8)));
        assert_eq!(panic.join().unwrap(), SurfelResult::Panic);
        assert!(last().starts_with("panics: "), "another thread's error is not ours");
    }

    #[test]
    fn each_error_has_its_code() {
        let code = |error: Error| guard("call", || Err(error.into()));
        let vulkan = |result| Error::vulkan("vkCreateBuffer", "splats", result);
        assert_eq!(code(Error::input("a.ply", "", "empty file")), SurfelResult::Input);
        assert_eq!(last(), "call: a.ply: empty file");
        guard("call", || Err(Failure::invalid("C's texts end\0here")));
        assert_eq!(last(), "call: C's texts end here");
        assert_eq!(code(Error::option("size", "0x0")), SurfelResult::Option);
        assert_eq!(code(vulkan(vk::Result::ERROR_DEVICE_LOST)), SurfelResult::DeviceLost);
        assert_eq!(code(vulkan(vk::Result::ERROR_OUT_OF_DEVICE_MEMORY)), SurfelResult::OutOfMemory);
        assert_eq!(code(vulkan(vk::Result::ERROR_UNKNOWN)), SurfelResult::Vulkan);
        let graph = ErrorKind::Graph { pass: String::new(), resource: String::new(), reason: String::new() };
        assert_eq!(code(graph.into()), SurfelResult::Internal);
    }
}
