//! The header: what elements follow.
//!
//! It is read here and not by a crate, because those known keep the last of two equal names, refuse names such as
//! `scalar_Coord._Z` and comments that are not UTF-8, and read lines of any length.

use std::collections::HashSet;

use glam::DVec3;

use super::schema::{Element, Encoding, Kind, Property, Scalar};
use crate::{
    error::{Error, Result},
    load::Input,
};

/// A parsed header and where the body starts.
pub(super) struct Header {
    pub encoding: Encoding,
    /// In the order of the body.
    pub elements: Vec<Element>,
    /// Offset of the body's first byte.
    pub body_start: usize,
    /// How many lines the header has.
    pub lines: usize,
    /// What ends a line, also of an ascii body: a carriage return alone is how old systems wrote it.
    pub line_end: u8,
    /// It has the line `comment surfel closed`: the splats sample a closed surface and their normals point outward.
    pub closed: bool,
    /// The direction of a line such as `comment surfel up 0 0 1`.
    pub up: Option<DVec3>,
    /// `save/` wrote it: colors have the whole range of their type, 0 to 1 for `float`.
    pub own: bool,
}

/// The comment of all files that `save/` writes.
const OWN: &str = "splats: disks with radius, or tangent vectors";

/// A comment that says what a splat file has no property for, see [`Header::closed`]. `save/` writes it.
const CLOSED: &str = "surfel closed";
const UP: &str = "surfel up ";

pub(super) fn parse(input: &Input<'_>) -> Result<Header> {
    let line_end = match input.bytes {
        [b'p', b'l', b'y', b'\r', next, ..] if *next != b'\n' => b'\r',
        _ => b'\n',
    };
    let mut lines = Lines { input, start: 0, line: 0, line_end };
    let first = lines.next()?;
    if first.trim_ascii() != b"ply" {
        return Err(lines.fault(format!("'{}'; expected 'ply'", shown(first))));
    }
    let mut statements = Statements::default();
    loop {
        let line = lines.next()?;
        if line.trim_ascii() == b"end_header" {
            break;
        }
        statements.add(line).map_err(|problem| lines.fault(problem))?;
    }
    let Some(encoding) = statements.encoding else {
        return Err(input.fault("header", "no line 'format'; expected one"));
    };
    for element in &statements.elements {
        if element.properties.is_empty() && element.count > 0 {
            let problem = format!("element '{}' has no properties; expected one at least", element.name);
            return Err(input.fault("header", problem));
        }
    }
    Ok(Header {
        encoding,
        elements: statements.elements,
        body_start: lines.start,
        lines: lines.line,
        line_end,
        closed: statements.closed,
        up: statements.up,
        own: statements.own,
    })
}

/// The lines of a header, each within the limits.
struct Lines<'a> {
    input: &'a Input<'a>,
    /// Where the next line starts.
    start: usize,
    /// The number of the line before it.
    line: usize,
    line_end: u8,
}

impl<'a> Lines<'a> {
    fn next(&mut self) -> Result<&'a [u8]> {
        let limits = self.input.options.limits;
        let rest = self.input.bytes.get(self.start..).unwrap_or_default();
        let room = limits.header_bytes.saturating_sub(self.start).min(limits.line_bytes);
        let window = rest.get(..room).unwrap_or(rest);
        self.line += 1;
        if let Some(end) = window.iter().position(|&b| b == self.line_end) {
            self.start += end + 1;
            return rest.get(..end).ok_or_else(|| self.ends());
        }
        if window.len() == rest.len() {
            // The last line of a file without a body may lack its end.
            self.start += rest.len();
            return if rest.trim_ascii() == b"end_header" { Ok(rest) } else { Err(self.ends()) };
        }
        let problem = if room == limits.line_bytes {
            format!("longer than {room} bytes; expected at most that many")
        } else {
            format!("the header is longer than {} bytes; expected 'end_header' before", limits.header_bytes)
        };
        Err(self.fault(problem))
    }

    fn ends(&self) -> Error {
        self.input.fault("header", "the file ends before 'end_header'")
    }

    fn fault(&self, problem: String) -> Error {
        self.input.fault(format!("line {}", self.line), problem)
    }
}

/// What the lines said so far.
#[derive(Default)]
struct Statements {
    encoding: Option<Encoding>,
    elements: Vec<Element>,
    closed: bool,
    up: Option<DVec3>,
    own: bool,
    element_names: HashSet<String>,
    /// Those of the last element.
    property_names: HashSet<String>,
}

/// The direction that a comment says is up.
fn up(comment: &[u8]) -> Option<DVec3> {
    let words = str::from_utf8(comment.strip_prefix(UP.as_bytes())?).ok()?;
    let numbers: Vec<f64> =
        words.split_ascii_whitespace().map(|word| word.parse().ok()).collect::<Option<_>>()?;
    let up = DVec3::from(<[f64; 3]>::try_from(numbers).ok()?);
    (up.is_finite() && up != DVec3::ZERO).then_some(up)
}

impl Statements {
    fn add(&mut self, line: &[u8]) -> Result<(), String> {
        let line = line.trim_ascii();
        let end = line.iter().position(u8::is_ascii_whitespace).unwrap_or(line.len());
        let (keyword, rest) = line.split_at(end);
        if matches!(keyword, b"comment" | b"obj_info" | b"") {
            // They may have any encoding.
            self.closed |= keyword == b"comment" && rest.trim_ascii() == CLOSED.as_bytes();
            if keyword == b"comment" {
                self.up = up(rest.trim_ascii()).or(self.up);
            }
            self.own |= keyword == b"comment" && rest.trim_ascii() == OWN.as_bytes();
            return Ok(());
        }
        let rest = str::from_utf8(rest).map_err(|_| "not text; expected a line of a header".to_owned())?;
        let words: Vec<&str> = rest.split_ascii_whitespace().collect();
        match (keyword, words.as_slice()) {
            (b"format", [encoding, "1.0"]) => self.format(encoding),
            (b"element", [name, count]) => self.element(name, count),
            (b"property", ["list", length, item, name]) => {
                let kind = Kind::List { length: scalar(length)?, item: scalar(item)? };
                self.property(name, kind)
            }
            (b"property", [kind, name]) => self.property(name, Kind::One(scalar(kind)?)),
            (b"format", _) => Err(format!("'{}'; expected 'format ENCODING 1.0'", shown(line))),
            (b"element", _) => Err(format!("'{}'; expected 'element NAME COUNT'", shown(line))),
            (b"property", _) => {
                let forms = "'property TYPE NAME' or 'property list TYPE TYPE NAME'";
                Err(format!("'{}'; expected {forms}", shown(line)))
            }
            _ => Err(format!(
                "'{}'; expected format, comment, obj_info, element, property or end_header",
                shown(line)
            )),
        }
    }

    fn format(&mut self, word: &str) -> Result<(), String> {
        let encoding = Encoding::named(word).ok_or_else(|| {
            let known = "ascii, binary_little_endian or binary_big_endian";
            format!("format '{}'; expected {known}", shown(word.as_bytes()))
        })?;
        match self.encoding.replace(encoding) {
            None => Ok(()),
            Some(_) => Err("a second line 'format'; expected one".to_owned()),
        }
    }

    fn element(&mut self, name: &str, count: &str) -> Result<(), String> {
        let count = count
            .parse()
            .map_err(|_| format!("a count of '{}'; expected 0 to {}", shown(count.as_bytes()), u64::MAX))?;
        if !self.element_names.insert(name.to_owned()) {
            return Err(format!("a second element '{}'; expected each once", shown(name.as_bytes())));
        }
        self.property_names.clear();
        self.elements.push(Element { name: name.to_owned(), count, properties: Vec::new() });
        Ok(())
    }

    fn property(&mut self, name: &str, kind: Kind) -> Result<(), String> {
        let Some(element) = self.elements.last_mut() else {
            return Err("a property before any element; expected it after its element".to_owned());
        };
        let shown = shown(name.as_bytes());
        if let Kind::List { length: Scalar::Float | Scalar::Double, .. } = kind {
            return Err(format!("list '{shown}' has a length of type float; expected an integer type"));
        }
        if !self.property_names.insert(name.to_owned()) {
            return Err(format!("a second property '{shown}'; expected each once"));
        }
        element.properties.push(Property { name: name.to_owned(), kind });
        Ok(())
    }
}

fn scalar(word: &str) -> Result<Scalar, String> {
    Scalar::named(word).ok_or_else(|| {
        format!(
            "type '{}'; expected char, uchar, short, ushort, int, uint, int64, uint64, float or double",
            shown(word.as_bytes())
        )
    })
}

/// Text of the file for a message: short, and without control characters.
fn shown(text: &[u8]) -> String {
    let short = text.get(..60).unwrap_or(text);
    String::from_utf8_lossy(short.trim_ascii()).escape_debug().to_string()
}
