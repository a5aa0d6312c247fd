//! The header: what elements follow, checked for what the crate lets pass.

use std::{collections::HashSet, path::Path};

use ply_rs_bw::{
    parser::{Parser, Reader},
    ply::{ElementDef, Encoding, KeyMap, PropertyType, ScalarType},
};

use super::skip::Skipped;
use crate::error::{Error, Result};

/// A parsed header and where the body starts.
pub(super) struct Header {
    /// How the body is written.
    pub encoding: Encoding,
    /// The elements in the order of the body.
    pub elements: KeyMap<ElementDef>,
    /// Offset of the body's first byte.
    pub body_start: usize,
    /// How many lines the header has.
    pub lines: usize,
    /// It has the line `comment surfel closed`: the splats sample a closed surface and their normals point outward.
    pub closed: bool,
}

/// A comment that says what a splat file has no property for, see [`Header::closed`]. `save/` writes it.
const CLOSED: &str = "surfel closed";

pub(super) fn parse(path: &Path, bytes: &[u8]) -> Result<Header> {
    let mut reader = Reader::new(bytes);
    let parsed = Parser::<Skipped>::new().read_header(&mut reader).map_err(|e| {
        if e.kind() == std::io::ErrorKind::UnexpectedEof {
            return Error::input(path, "header", "the file ends before 'end_header'");
        }
        if e.kind() == std::io::ErrorKind::InvalidData {
            return Error::input(path, "header", "not text before 'end_header'");
        }
        // The crate's message has several lines; its first says what is wrong.
        let message = e.to_string();
        let message = message.lines().next().unwrap_or_default();
        let message = message.split_once(": ").map_or(message, |(_, rest)| rest).trim_end_matches('.');
        match e.line() {
            Some(line) => {
                Error::input(path, format!("line {line}"), format!("{message}: '{}'", line_text(bytes, line)))
            }
            None => Error::input(path, "header", message),
        }
    })?;
    let body_start = bytes.len() - reader.get_ref().len();
    let text = String::from_utf8_lossy(&bytes[..body_start]);
    refuse_duplicates(path, &text)?;
    for def in parsed.elements.values() {
        if def.properties.is_empty() && def.count > 0 {
            return Err(Error::input(path, "header", format!("element '{}' has no properties", def.name)));
        }
        for property in def.properties.values() {
            if let PropertyType::List(ScalarType::Float | ScalarType::Double, _) = property.data_type {
                let problem = format!("list '{}' has a length that is no integer type", property.name);
                return Err(Error::input(path, format!("element {}", def.name), problem));
            }
        }
    }
    Ok(Header {
        encoding: parsed.encoding,
        elements: parsed.elements,
        body_start,
        lines: text.lines().count(),
        closed: parsed.comments.iter().any(|comment| comment.trim() == CLOSED),
    })
}

/// The crate keeps the last of two equal names, and would then read the body with a wrong record size.
fn refuse_duplicates(path: &Path, header: &str) -> Result<()> {
    let mut elements: HashSet<&str> = HashSet::new();
    let mut properties: HashSet<&str> = HashSet::new();
    for (i, line) in header.lines().enumerate() {
        let mut words = line.split_ascii_whitespace();
        let (kind, name, seen) = match words.next() {
            Some("element") => {
                properties.clear();
                ("element", words.next(), &mut elements)
            }
            Some("property") => ("property", words.next_back(), &mut properties),
            _ => continue,
        };
        let name = name.unwrap_or_default();
        if !seen.insert(name) {
            return Err(Error::input(path, format!("line {}", i + 1), format!("a second {kind} '{name}'")));
        }
    }
    Ok(())
}

/// A line of the file for a message: short, and without control characters.
fn line_text(bytes: &[u8], line: usize) -> String {
    let text = bytes.split(|&b| b == b'\n').nth(line - 1).unwrap_or_default();
    let text = String::from_utf8_lossy(&text[..text.len().min(60)]).into_owned();
    text.trim_end().escape_debug().to_string()
}

/// Bytes of one value in a binary body.
fn scalar_bytes(scalar: &ScalarType) -> u64 {
    match scalar {
        ScalarType::Char | ScalarType::UChar => 1,
        ScalarType::Short | ScalarType::UShort => 2,
        ScalarType::Int | ScalarType::UInt | ScalarType::Float => 4,
        ScalarType::Double => 8,
    }
}

/// The fewest bytes that one element can take, its lists empty.
pub(super) fn min_element_bytes(def: &ElementDef, encoding: Encoding) -> u64 {
    let of_property = |data_type: &PropertyType| match (encoding, data_type) {
        // A digit and a separator.
        (Encoding::Ascii, _) => 2,
        (_, PropertyType::Scalar(scalar) | PropertyType::List(scalar, _)) => scalar_bytes(scalar),
    };
    def.properties.values().map(|p| of_property(&p.data_type)).sum()
}
