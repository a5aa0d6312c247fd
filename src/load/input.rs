//! The bytes of a file, and what its reader needs beside them.

use std::path::Path;

use super::{LoadOptions, file_name};
use crate::{error::Error, progress::Progress};
#[cfg(test)]
use crate::{error::Result, load::Loaded};

/// A file in memory, on its way through a reader.
#[derive(Clone, Copy)]
pub(super) struct Input<'a> {
    /// Its name in messages.
    pub path: &'a Path,
    /// Where files are that it may name; `None` for standard input.
    pub folder: Option<&'a Path>,
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

    /// The line that has this byte, as a place in words.
    pub fn line(&self, at: usize) -> String {
        let end = if self.bytes.contains(&b'\n') { b'\n' } else { b'\r' };
        let before = self.bytes.get(..at).unwrap_or(self.bytes);
        format!("line {}", before.iter().filter(|b| **b == end).count() + 1)
    }

    /// Tells that `done` bytes are read.
    pub fn step(&self, done: usize) {
        let task = format!("read {}", file_name(self.path));
        self.progress.step(&task, done as u64, self.bytes.len() as u64);
    }
}

/// Bytes that were never in a file, for the tests of readers.
#[cfg(test)]
pub(super) fn of_bytes(
    name: &str,
    bytes: &[u8],
    parse: impl Fn(&Input<'_>) -> Result<Loaded>,
) -> Result<Loaded> {
    parse(&Input {
        path: Path::new(name),
        folder: None,
        bytes,
        options: &LoadOptions::default(),
        progress: &(),
    })
}
