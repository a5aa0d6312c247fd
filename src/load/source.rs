//! The bytes of a file or of standard input, as they are and without what compresses them as a whole.

use std::{
    fs::{self, File},
    io::{self, Read},
    path::{Path, PathBuf},
};

use super::{Limits, packed, sniff};
use crate::error::{Error, Result};

/// The name that means standard input.
const STANDARD_INPUT: &str = "-";

/// What was read, and what it is called.
pub(super) struct Source {
    /// In messages.
    pub path: PathBuf,
    /// Where files are that it may name; `None` for standard input.
    pub folder: Option<PathBuf>,
    /// Tells the format where the content does not: without `.gz` and `.zst`.
    pub name: PathBuf,
    /// The content.
    pub bytes: Vec<u8>,
    /// What it was compressed with.
    pub packing: Option<packed::Packing>,
}

/// Reads a file whole, or standard input for `-`.
pub(super) fn read(path: &Path, limits: &Limits) -> Result<Source> {
    let (path, folder, bytes) = match path.as_os_str() == STANDARD_INPUT {
        true => {
            let path = PathBuf::from("standard input");
            let bytes = read_pipe(io::stdin().lock(), &path, limits.piped_bytes)?;
            (path, None, bytes)
        }
        false => {
            let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
            (path.to_owned(), Some(folder.unwrap_or(Path::new(".")).to_owned()), read_file(path)?)
        }
    };
    unpacked(path, folder, bytes, limits)
}

/// What was read, without what compresses it as a whole.
pub(super) fn unpacked(
    path: PathBuf,
    folder: Option<PathBuf>,
    bytes: Vec<u8>,
    limits: &Limits,
) -> Result<Source> {
    match packed::Packing::of(&bytes) {
        None => Ok(Source { name: path.clone(), path, folder, bytes, packing: None }),
        Some(packing) => {
            let bytes = packing.unpack(&path, &bytes, limits)?;
            if let Some(again) = packed::Packing::of(&bytes) {
                let problem =
                    format!("compressed twice, by {} and {}; expected once", packing.name(), again.name());
                return Err(Error::input(path, "", problem));
            }
            Ok(Source { name: packing.inner_name(&path), path, folder, bytes, packing: Some(packing) })
        }
    }
}

/// Refuses a file that is not there, or that nobody may read, as reading it would: before others are read, which may take long.
///
/// # Errors
/// [`crate::ErrorKind::File`] with its name.
pub fn check_there(path: &Path) -> Result<()> {
    let fail = |e| Error::file(path, "read", e);
    if path.as_os_str() == STANDARD_INPUT {
        return Ok(());
    }
    // Opening a pipe would wait for who writes to it.
    match fs::metadata(path).map_err(fail)?.is_file() {
        true => File::open(path).map(drop).map_err(fail),
        false => Ok(()),
    }
}

/// Only regular files: a device or a pipe may never end, and counts are checked against the size.
fn read_file(path: &Path) -> Result<Vec<u8>> {
    let refuse = |what: &str| Err(Error::input(path, "", format!("{what}; expected {}", sniff::expected())));
    let metadata = fs::metadata(path).map_err(|e| Error::file(path, "read", e))?;
    if metadata.is_dir() {
        return refuse("a folder");
    }
    if !metadata.is_file() {
        return refuse("neither a file nor `-` for standard input");
    }
    // Bounded by what was seen, for a file that grows meanwhile.
    let size = metadata.len();
    let mut bytes = Vec::new();
    let reserved = usize::try_from(size).is_ok_and(|size| bytes.try_reserve_exact(size).is_ok());
    if !reserved {
        return Err(Error::file(path, "read", io::ErrorKind::OutOfMemory.into()));
    }
    let file = File::open(path).map_err(|e| Error::file(path, "read", e))?;
    file.take(size).read_to_end(&mut bytes).map_err(|e| Error::file(path, "read", e))?;
    Ok(bytes)
}

/// All of a stream that has no size, up to a limit.
fn read_pipe(stream: impl Read, path: &Path, most: u64) -> Result<Vec<u8>> {
    let mut bytes = Vec::new();
    stream.take(most.saturating_add(1)).read_to_end(&mut bytes).map_err(|e| Error::file(path, "read", e))?;
    match bytes.len() as u64 > most {
        true => {
            Err(Error::input(path, "", format!("longer than {most} bytes; expected a file in its place")))
        }
        false => Ok(bytes),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_stream_is_read_to_its_end_or_its_limit() {
        let path = Path::new("standard input");
        assert_eq!(read_pipe(&b"1 2 3"[..], path, 5).unwrap(), b"1 2 3");
        let refused = read_pipe(io::repeat(b'x'), path, 5).unwrap_err();
        assert_eq!(refused.to_string(), "standard input: longer than 5 bytes; expected a file in its place");
    }
}
