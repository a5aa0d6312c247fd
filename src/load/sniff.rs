//! What a file is, by its content.

use std::path::Path;

use crate::error::{Error, Result};

/// The formats that can be read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Format {
    /// Starts with `ply` and a line end.
    Ply,
    /// No magic number: named `.obj` and text.
    Obj,
}

/// Other formats that people have, by their first bytes, so that the message can name them.
const KNOWN_OTHERS: [(&[u8], &str); 9] = [
    (b"version https://git-lfs", "a git-lfs pointer, not the file itself (run `git lfs pull`)"),
    (b"LASF", "a LAS or LAZ point cloud"),
    (b"glTF", "a binary glTF model"),
    (b"solid ", "an STL model"),
    (b"OFF", "an OFF model"),
    (b"# .PCD", "a PCD point cloud"),
    (b"PK\x03\x04", "a zip archive"),
    (b"\x1f\x8b", "a gzip archive"),
    (b"\x89PNG", "a PNG picture"),
];

/// How many bytes of an OBJ file must be text for it to be taken as one.
const TEXT_PROBE_BYTES: usize = 4096;

pub(super) fn format(path: &Path, bytes: &[u8]) -> Result<Format> {
    let refuse = |found: &str| Err(Error::input(path, "", format!("{found}; expected a PLY or OBJ file")));
    if bytes.is_empty() {
        return refuse("the file is empty");
    }
    if let [b'p', b'l', b'y', b'\r' | b'\n' | b' ' | b'\t', ..] = bytes {
        return Ok(Format::Ply);
    }
    for (magic, what) in KNOWN_OTHERS {
        if bytes.starts_with(magic) {
            return refuse(&format!("this is {what}"));
        }
    }
    let extension = path.extension().map(|e| e.to_string_lossy().to_ascii_lowercase()).unwrap_or_default();
    match extension.as_str() {
        "obj" if !bytes[..bytes.len().min(TEXT_PROBE_BYTES)].contains(&0) => Ok(Format::Obj),
        "obj" => refuse("named .obj, but its content is binary"),
        "ply" => refuse("named .ply, but its first line is not 'ply'"),
        _ => refuse("unknown format"),
    }
}
