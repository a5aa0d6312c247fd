//! The body: element after element, from whichever encoding.

use std::{io, path::Path};

use ply_rs_bw::{
    parser::Parser,
    ply::{ElementDef, Encoding, PropertyAccess},
};

use super::{ascii, header, header::Header};
use crate::error::{Error, Result};

/// How many elements are read between two progress messages.
const PROGRESS_ELEMENTS: usize = 1 << 16;

/// The bytes that are left to read.
pub(super) struct Body<'a> {
    path: &'a Path,
    encoding: Encoding,
    rest: &'a [u8],
    file_bytes: usize,
    /// The number of the last line read, from 1; in ascii files only.
    line: usize,
}

impl<'a> Body<'a> {
    pub(super) fn new(path: &'a Path, header: &Header, bytes: &'a [u8]) -> Self {
        let rest = &bytes[header.body_start..];
        Self { path, encoding: header.encoding, rest, file_bytes: bytes.len(), line: header.lines }
    }

    pub(super) fn bytes_read(&self) -> usize {
        self.file_bytes - self.rest.len()
    }

    /// Refuses a count that the rest of the file can't hold, before anything is allocated for it.
    pub(super) fn check_size(&self, def: &ElementDef) -> Result<()> {
        let each = header::min_element_bytes(def, self.encoding);
        // The last line of an ascii file may lack its end.
        let left = self.rest.len() as u64 + u64::from(self.encoding == Encoding::Ascii);
        if (def.count as u64).checked_mul(each).is_some_and(|needed| needed <= left) {
            return Ok(());
        }
        let problem = format!(
            "the header declares {} of at least {each} bytes each, the file has {} bytes left for them",
            def.count,
            self.rest.len()
        );
        Err(Error::input(self.path, format!("element {}", def.name), problem))
    }

    /// Reads all elements of this kind, handing each with its number to `take`.
    pub(super) fn read<E: PropertyAccess>(
        &mut self,
        def: &ElementDef,
        on_progress: &mut dyn FnMut(&Self),
        mut take: impl FnMut(usize, E) -> Result<()>,
    ) -> Result<()> {
        self.check_size(def)?;
        let parser = Parser::<E>::new();
        for i in 0..def.count {
            let element = match self.encoding {
                Encoding::Ascii => self.read_ascii(def, i)?,
                Encoding::BinaryLittleEndian => {
                    let read = parser.read_little_endian_element(&mut self.rest, def);
                    read.map_err(|e| self.binary_error(def, i, &e))?
                }
                Encoding::BinaryBigEndian => {
                    let read = parser.read_big_endian_element(&mut self.rest, def);
                    read.map_err(|e| self.binary_error(def, i, &e))?
                }
            };
            take(i, element)?;
            if i % PROGRESS_ELEMENTS == 0 {
                on_progress(self);
            }
        }
        Ok(())
    }

    fn read_ascii<E: PropertyAccess>(&mut self, def: &ElementDef, i: usize) -> Result<E> {
        loop {
            if self.rest.is_empty() {
                return Err(self.ends_early(def, i));
            }
            let end = self.rest.iter().position(|&b| b == b'\n').unwrap_or(self.rest.len());
            let line = &self.rest[..end];
            self.rest = self.rest.get(end + 1..).unwrap_or_default();
            self.line += 1;
            if line.trim_ascii().is_empty() {
                continue;
            }
            return ascii::element(line, def).map_err(|problem| {
                Error::input(self.path, format!("line {}", self.line), format!("{} {i}: {problem}", def.name))
            });
        }
    }

    fn ends_early(&self, def: &ElementDef, i: usize) -> Error {
        let problem = format!("the file ends here, the header declares {}", def.count);
        Error::input(self.path, format!("{} {i}", def.name), problem)
    }

    fn binary_error(&self, def: &ElementDef, i: usize, e: &ply_rs_bw::parser::ParseError) -> Error {
        if e.kind() == io::ErrorKind::UnexpectedEof {
            return self.ends_early(def, i);
        }
        let message = e.to_string();
        let message = message.lines().next().unwrap_or_default().trim_end_matches('.').to_owned();
        Error::input(self.path, format!("{} {i}", def.name), message)
    }
}
