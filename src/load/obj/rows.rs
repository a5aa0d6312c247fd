//! The rows of an OBJ file that make a mesh, checked one by one before `tobj` sees them.
//!
//! This closes what `tobj` 4.0.5 leaves open: it reports no line; an index near 2⁶³ overflows its arithmetic; colors
//! that only some vertices have move to others; groups split the mesh and with it the shared vertices.

use std::io::{self, BufRead, Read, Write as _};

/// A row that is wrong.
#[derive(Clone, Debug)]
pub(super) struct Fault {
    /// From 1.
    pub line: u64,
    pub problem: String,
}

/// How many lines are read between two progress messages.
const PROGRESS_LINES: u64 = 1 << 16;

/// Gives the kept rows as text, one row a `fill_buf`; ends at the first fault.
pub(super) struct Rows<'a, P: Fn(usize)> {
    bytes: &'a [u8],
    rest: &'a [u8],
    on_progress: P,
    line: u64,
    row: Vec<u8>,
    used: usize,
    vertices: u64,
    normals: u64,
    has_colors: bool,
    has_faces: bool,
    a_corner_lacks_normal: bool,
    /// The face rows that name the largest vertex and normal numbers; faces may stand before their vertices.
    largest: [(u64, u64); 2],
    fault: Option<Fault>,
}

impl<'a, P: Fn(usize)> Rows<'a, P> {
    pub(super) fn new(bytes: &'a [u8], on_progress: P) -> Self {
        Self {
            bytes,
            rest: bytes,
            on_progress,
            line: 0,
            row: Vec::new(),
            used: 0,
            vertices: 0,
            normals: 0,
            has_colors: false,
            has_faces: false,
            a_corner_lacks_normal: false,
            largest: [(0, 0); 2],
            fault: None,
        }
    }

    /// The first fault, or the face with a number beyond the file's vertices or normals.
    pub(super) fn fault(&self) -> Option<Fault> {
        let beyond = |what: &str, (number, line): (u64, u64), count: u64| {
            let problem = format!("{what} {number}, but the file has {count}");
            (number > count).then_some(Fault { line, problem })
        };
        self.fault
            .clone()
            .or_else(|| beyond("vertex", self.largest[0], self.vertices))
            .or_else(|| beyond("normal", self.largest[1], self.normals))
    }

    pub(super) fn vertices(&self) -> u64 {
        self.vertices
    }

    pub(super) fn has_colors(&self) -> bool {
        self.has_colors
    }

    pub(super) fn has_faces(&self) -> bool {
        self.has_faces
    }

    pub(super) fn all_corners_have_normals(&self) -> bool {
        !self.a_corner_lacks_normal
    }

    /// Puts the next kept row into `row`; leaves it empty at the end.
    fn advance(&mut self) {
        self.used = 0;
        self.row.clear();
        while self.row.is_empty() && !self.rest.is_empty() && self.fault.is_none() {
            let end = self.rest.iter().position(|&b| b == b'\n').unwrap_or(self.rest.len());
            let line = &self.rest[..end];
            self.rest = self.rest.get(end + 1..).unwrap_or_default();
            self.line += 1;
            if self.line.is_multiple_of(PROGRESS_LINES) || self.rest.is_empty() {
                (self.on_progress)(self.bytes.len() - self.rest.len());
            }
            if let Err(problem) = self.keep(line) {
                self.row.clear();
                self.fault = Some(Fault { line: self.line, problem });
            }
        }
    }

    fn keep(&mut self, line: &[u8]) -> Result<(), String> {
        let keyword_end = line.iter().position(u8::is_ascii_whitespace).unwrap_or(line.len());
        let keyword = &line[..keyword_end];
        if !matches!(keyword, b"v" | b"vn" | b"f") {
            return Ok(());
        }
        let text = str::from_utf8(&line[keyword_end..]).map_err(|_| "not text".to_owned())?;
        let words = text.split('#').next().unwrap_or_default().split_ascii_whitespace();
        match keyword {
            b"v" => self.vertex(words),
            b"vn" => self.normal(words),
            _ => self.face(words),
        }
    }

    /// `x y z`, then nothing, the divisor `w`, or `r g b`.
    fn vertex<'w>(&mut self, words: impl Iterator<Item = &'w str>) -> Result<(), String> {
        let (values, count) = numbers::<6>(words)?;
        let [x, y, z, ..] = values;
        let (w, rgb) = match count {
            3 => (1.0, None),
            4 if values[3] != 0.0 => (values[3], None),
            4 => return Err("a vertex with w = 0".to_owned()),
            6 => (1.0, Some([values[3], values[4], values[5]])),
            _ => return Err(format!("a vertex of {count} numbers, expected 3, 4 or 6")),
        };
        self.vertices += 1;
        self.has_colors |= rgb.is_some();
        let [r, g, b] = rgb.unwrap_or([0.8; 3]);
        // A shortest decimal form gives the same f64 back.
        self.write(format_args!("v {} {} {} {r} {g} {b}", x / w, y / w, z / w))
    }

    fn normal<'w>(&mut self, words: impl Iterator<Item = &'w str>) -> Result<(), String> {
        let ([x, y, z], count) = numbers::<3>(words)?;
        if count != 3 {
            return Err(format!("a normal of {count} numbers, expected 3"));
        }
        self.normals += 1;
        self.write(format_args!("vn {x} {y} {z}"))
    }

    /// Corners `v`, `v/vt`, `v//vn` or `v/vt/vn`; negative numbers count back from the last row so far.
    fn face<'w>(&mut self, words: impl Iterator<Item = &'w str>) -> Result<(), String> {
        self.has_faces = true;
        self.row.extend_from_slice(b"f");
        let mut corners = 0_usize;
        for word in words {
            let mut parts = word.split('/');
            let vertex = parts.next().unwrap_or_default();
            let vertex = self.number("vertex", vertex, 0)?;
            let normal = match (parts.next(), parts.next(), parts.next()) {
                (_, None | Some(""), None) => None,
                (_, Some(normal), None) => Some(self.number("normal", normal, 1)?),
                _ => return Err(format!("a corner '{}', expected v/vt/vn", shown(word))),
            };
            self.a_corner_lacks_normal |= normal.is_none();
            match normal {
                Some(normal) => self.write_part(format_args!(" {vertex}//{normal}"))?,
                None => self.write_part(format_args!(" {vertex}"))?,
            }
            corners += 1;
        }
        if corners == 0 {
            return Err("a face without corners".to_owned());
        }
        self.write_part(format_args!("\n"))
    }

    /// A vertex (`kind` 0) or normal (1) number, made positive.
    fn number(&mut self, what: &str, word: &str, kind: usize) -> Result<u64, String> {
        let count = [self.vertices, self.normals][kind];
        let refuse = || format!("{what} '{}', but the file has {count} so far", shown(word));
        let number: i64 = word
            .parse()
            .map_err(|_| format!("a corner with {what} '{}', expected a whole number", shown(word)))?;
        let number = match u64::try_from(number) {
            // More than a mesh of ours can index, and small enough for all of tobj's arithmetic.
            Ok(0) => return Err(refuse()),
            Ok(n) if n > u64::from(u32::MAX) => return Err(refuse()),
            Ok(n) => n,
            Err(_) => count.checked_sub(number.unsigned_abs()).map(|n| n + 1).ok_or_else(refuse)?,
        };
        if number > self.largest[kind].0 {
            self.largest[kind] = (number, self.line);
        }
        Ok(number)
    }

    fn write(&mut self, row: std::fmt::Arguments<'_>) -> Result<(), String> {
        self.write_part(format_args!("{row}\n"))
    }

    fn write_part(&mut self, text: std::fmt::Arguments<'_>) -> Result<(), String> {
        self.row.write_fmt(text).map_err(|e| e.to_string())
    }
}

/// Up to `N` numbers and how many words there are in all.
fn numbers<'w, const N: usize>(words: impl Iterator<Item = &'w str>) -> Result<([f64; N], usize), String> {
    let (mut values, mut count) = ([0.0; N], 0);
    for word in words {
        let value = word.parse().map_err(|_| format!("'{}', expected a number", shown(word)))?;
        if let Some(slot) = values.get_mut(count) {
            *slot = value;
        }
        count += 1;
    }
    Ok((values, count))
}

/// A word for a message: short and printable.
fn shown(word: &str) -> String {
    word.chars().take(40).collect::<String>().escape_debug().to_string()
}

impl<P: Fn(usize)> Read for Rows<'_, P> {
    fn read(&mut self, out: &mut [u8]) -> io::Result<usize> {
        let n = self.fill_buf()?.read(out)?;
        self.consume(n);
        Ok(n)
    }
}

impl<P: Fn(usize)> BufRead for Rows<'_, P> {
    fn fill_buf(&mut self) -> io::Result<&[u8]> {
        if self.used == self.row.len() {
            self.advance();
        }
        Ok(&self.row[self.used..])
    }

    fn consume(&mut self, amount: usize) {
        self.used += amount;
    }
}
