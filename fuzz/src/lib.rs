//! What all targets do with a file.

use std::path::Path;

use surfel::{
    ErrorKind,
    load::{LoadOptions, load_bytes},
};

/// Reads it as a file of this name. It may be refused, in one line that names it; the fuzzer sees panics, hangs and
/// memory.
pub fn read(name: &str, bytes: &[u8]) {
    if let Err(error) = load_bytes(Path::new(name), bytes.to_vec(), &LoadOptions::default(), &()) {
        let text = error.to_string();
        let is_input = matches!(error.kind(), ErrorKind::Input { .. });
        assert!(is_input && text.starts_with(name) && !text.contains('\n'), "{text}");
    }
}
