//! The format of a file: by its content, and by its name only where the content leaves it open.

mod foreign;
#[cfg(test)]
mod tests;
mod words;

use std::path::Path;

use super::stl::is_text;
use crate::error::{Error, Result};
use foreign::{by_ending, foreign};
pub(super) use words::without_mark;

/// The formats that are known; not all are read by every build.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Format {
    /// Starts with `ply` and a line end.
    Ply,
    /// No magic number: text whose first word is one of this format, or that is named `.obj`.
    Obj,
    /// Text of `solid` and `facet`, or of just the size that its number of triangles asks for.
    Stl,
    /// Starts with `OFF`, or with letters before it that say what vertices have.
    Off,
    /// Starts with `# .PCD` or the fields of its header.
    Pcd,
    /// No magic number: text in rows of numbers.
    Rows,
    /// Starts with `glTF`, or JSON that has an `asset`.
    Gltf,
    /// Starts with `LASF`.
    Las,
    /// Starts with `ASTM-E57`.
    E57,
    /// JSON that has what the metadata of Potree 2 has.
    Potree,
}

impl Format {
    /// What people call it.
    #[cfg(not(all(feature = "e57", feature = "gltf", feature = "las", feature = "octrees")))]
    pub fn name(self) -> &'static str {
        match self {
            Self::Las => "LAS",
            Self::E57 => "E57",
            Self::Gltf => "glTF",
            Self::Potree => "Potree 2",
            _ => "other",
        }
    }

    /// The Cargo feature of those that need one.
    #[cfg(not(all(feature = "e57", feature = "gltf", feature = "las", feature = "octrees")))]
    pub fn feature(self) -> &'static str {
        match self {
            Self::Las => "las",
            Self::E57 => "e57",
            Self::Gltf => "gltf",
            _ => "octrees",
        }
    }
}

/// How many bytes are looked at where the first few don't tell.
const PROBE_BYTES: usize = 4096;

/// What can be read by this build, for messages.
pub(super) fn expected() -> &'static str {
    match (cfg!(feature = "las"), cfg!(feature = "e57"), cfg!(feature = "gltf")) {
        (true, true, true) => {
            "a PLY, OBJ, STL, OFF, glTF, PCD, LAS, LAZ or E57 file or rows of numbers, also in gzip or zstd"
        }
        (true, ..) => "a PLY, OBJ, STL, OFF, PCD, LAS or LAZ file or rows of numbers",
        _ => "a PLY, OBJ, STL, OFF or PCD file or rows of numbers",
    }
}

/// Which format the content has. `name` decides where it leaves that open; `path` is the file's name in messages.
pub(super) fn format(path: &Path, name: &Path, bytes: &[u8]) -> Result<Format> {
    let refuse = |found: &str| Err(Error::input(path, "", format!("{found}; expected {}", expected())));
    if bytes.is_empty() {
        return refuse("the file is empty");
    }
    if let Some(format) = by_magic(bytes) {
        return Ok(format);
    }
    let extension = name.extension().map(|e| e.to_string_lossy().to_ascii_lowercase()).unwrap_or_default();
    if is_binary_stl(bytes, extension == "stl") {
        return Ok(Format::Stl);
    }
    if let Some(what) = foreign(bytes, &extension) {
        return refuse(&format!("this is {what}"));
    }
    let probe = bytes.get(..PROBE_BYTES).unwrap_or(bytes);
    if is_json(probe) && is_potree(bytes) {
        return Ok(Format::Potree);
    }
    let words = words::by_words(probe);
    if probe.contains(&0) {
        // Their header is text, whatever follows it.
        if words == Some(Format::Pcd) {
            return Ok(Format::Pcd);
        }
        if extension == "stl" {
            return Ok(Format::Stl);
        }
        return refuse(&match (by_ending(&extension), extension.as_str()) {
            (Some(what), _) => format!("this is {what}"),
            (None, "") => "binary, of an unknown format".to_owned(),
            _ => format!("named .{}, but its content is binary of another format", extension.escape_debug()),
        });
    }
    match (words, extension.as_str()) {
        // Its first word may be left out.
        (Some(Format::Rows) | None, "off") => Ok(Format::Off),
        (Some(format), _) => Ok(format),
        (None, "toml") => refuse("this is a scene file"),
        (None, "obj") => Ok(Format::Obj),
        (None, "gltf") if is_json(probe) => Ok(Format::Gltf),
        (None, "xyz" | "pts" | "ptx" | "csv" | "txt" | "asc") => Ok(Format::Rows),
        (None, _) if is_json(probe) => refuse("this is JSON, but neither glTF nor the metadata of Potree 2"),
        (None, "ply") => refuse("named .ply, but its first line is not 'ply'"),
        (None, ending) => match by_ending(ending) {
            Some(what) => refuse(&format!("this is {what}")),
            None => refuse("text of an unknown format"),
        },
    }
}

/// How much of a file of JSON is looked at.
const JSON_PROBE_BYTES: usize = 1 << 16;

/// Whether JSON is the metadata of a Potree 2 octree, by two of its names.
pub(super) fn is_potree(bytes: &[u8]) -> bool {
    let head = bytes.get(..JSON_PROBE_BYTES).unwrap_or(bytes);
    let has = |name: &[u8]| head.windows(name.len()).any(|at| at == name);
    has(b"\"firstChunkSize\"") && has(b"\"boundingBox\"")
}

fn by_magic(bytes: &[u8]) -> Option<Format> {
    match bytes {
        [b'p', b'l', b'y', b'\r' | b'\n' | b' ' | b'\t', ..] => Some(Format::Ply),
        [b'L', b'A', b'S', b'F', ..] => Some(Format::Las),
        [b'A', b'S', b'T', b'M', b'-', b'E', b'5', b'7', ..] => Some(Format::E57),
        [b'g', b'l', b'T', b'F', ..] => Some(Format::Gltf),
        [0xef, 0xbb, 0xbf, rest @ ..] => by_magic(rest).filter(|format| *format == Format::Ply),
        _ => None,
    }
}

/// By its size, which no text can have by accident: four letters are a number above 150 million. `named`: some writers
/// append bytes, which the name then forgives.
fn is_binary_stl(bytes: &[u8], named: bool) -> bool {
    let Some(count) = bytes.get(80..84).and_then(|count| count.try_into().ok()).map(u32::from_le_bytes)
    else {
        return false;
    };
    let size = 84 + 50 * u64::from(count);
    bytes.len() as u64 == size || (named && !is_text(bytes) && count > 0 && bytes.len() as u64 > size)
}

/// Whether this may be JSON: an object or a list, that no scene file starts with.
fn is_json(probe: &[u8]) -> bool {
    match without_mark(probe).trim_ascii_start() {
        [b'{', ..] => true,
        [b'[', rest @ ..] => matches!(rest.trim_ascii_start(), [b'{' | b'"' | b'0'..=b'9' | b'-' | b']', ..]),
        _ => false,
    }
}
