//! The bytes of a file, and what its reader needs beside them.

use std::{fs, path::Path};

#[cfg(test)]
use super::Loaded;
use super::{LoadOptions, file_name};
use crate::{
    error::{Error, Result},
    progress::Progress,
};

/// A file in memory, on its way through a reader.
#[derive(Clone, Copy)]
pub(super) struct Input<'a> {
    /// Its name in messages.
    pub path: &'a Path,
    /// The whole of it.
    pub bytes: &'a [u8],
    /// How it is to be read.
    pub options: &'a LoadOptions,
    /// Is told how far the reader is.
    pub progress: &'a dyn Progress,
}

impl Input<'_> {
    /// An error of this file. `place` is an element, a line or a byte in words; it may be empty.
    pub fn fault(&self, place: impl Into<String>, problem: impl Into<String>) -> Error {
        Error::input(self.path, place, problem)
    }

    /// Tells that `done` bytes are read.
    pub fn step(&self, done: usize) {
        let task = format!("read {}", file_name(self.path));
        self.progress.step(&task, done as u64, self.bytes.len() as u64);
    }
}

/// The whole file. Only regular files: a device or a pipe may never end, and counts are checked against the size.
pub(super) fn read_file(path: &Path) -> Result<Vec<u8>> {
    let metadata = fs::metadata(path).map_err(|e| Error::file(path, "read", e))?;
    if !metadata.is_file() {
        return Err(Error::input(path, "", "not a file; expected a PLY or OBJ file"));
    }
    fs::read(path).map_err(|e| Error::file(path, "read", e))
}

/// Bytes that were never in a file, for the tests of readers.
#[cfg(test)]
pub(super) fn of_bytes(
    name: &str,
    bytes: &[u8],
    parse: impl Fn(&Input<'_>) -> Result<Loaded>,
) -> Result<Loaded> {
    parse(&Input { path: Path::new(name), bytes, options: &LoadOptions::default(), progress: &() })
}
