//! The JSON of a glTF file and the bytes beside it: GLB has both in one file.

use crate::{
    error::Result,
    load::{Input, sniff::without_mark},
};

/// The parts of a file.
pub(super) struct Parts<'a> {
    pub json: &'a [u8],
    /// The first buffer of a GLB file.
    pub binary: Option<&'a [u8]>,
    pub format: &'static str,
}

const MAGIC: &[u8] = b"glTF";
const HEADER_BYTES: usize = 12;
const JSON_CHUNK: u32 = u32::from_le_bytes(*b"JSON");
const BINARY_CHUNK: u32 = u32::from_le_bytes(*b"BIN\0");

/// Takes a file apart; all of it is JSON if it does not start as GLB does.
pub(super) fn split<'a>(input: &Input<'a>) -> Result<Parts<'a>> {
    if !input.bytes.starts_with(MAGIC) {
        return Ok(Parts { json: without_mark(input.bytes), binary: None, format: "glTF" });
    }
    let word = |at: usize| {
        let bytes = input.bytes.get(at..).and_then(|rest| rest.first_chunk::<4>());
        bytes.map(|bytes| u32::from_le_bytes(*bytes))
    };
    match (word(4), word(8)) {
        (Some(2), Some(length)) if length as usize <= input.bytes.len() => {}
        (Some(2), Some(length)) => {
            let problem = format!("{length} bytes by its header, but the file has {}", input.bytes.len());
            return Err(input.fault("header", problem));
        }
        (Some(version), Some(_)) => {
            return Err(input.fault("header", format!("GLB of version {version}; expected 2")));
        }
        _ => return Err(input.fault("header", "the file ends within it; expected 12 bytes")),
    }
    let chunk = |at: usize| -> Option<(u32, &'a [u8])> {
        let (length, kind) = (word(at)? as usize, word(at.checked_add(4)?)?);
        let bytes = input.bytes.get(at.checked_add(8)?..)?.get(..length)?;
        Some((kind, bytes))
    };
    let Some((JSON_CHUNK, json)) = chunk(HEADER_BYTES) else {
        return Err(input.fault("header", "no whole chunk of JSON behind it"));
    };
    let second = HEADER_BYTES + 8 + json.len();
    let binary = match chunk(second) {
        Some((BINARY_CHUNK, bytes)) => Some(bytes),
        None if second < input.bytes.len() => {
            return Err(input.fault("", "the file ends within its second chunk"));
        }
        _ => None,
    };
    Ok(Parts { json, binary, format: "GLB" })
}
