//! Files that are read at places, of which only a part is ever in memory.

use std::{
    fs::{self, File},
    io::{self, Read, Seek, SeekFrom},
    path::{Path, PathBuf},
};

use super::tree::Span;
use crate::error::{Error, Result};

/// Something that is read at places.
pub(super) struct Source<R> {
    pub path: PathBuf,
    pub reader: R,
    pub bytes: u64,
}

impl<R: Read + Seek> Source<R> {
    /// The bytes of a span, which lies within it.
    pub fn read(&mut self, span: Span) -> Result<Vec<u8>> {
        let mut read = || -> io::Result<Vec<u8>> {
            self.reader.seek(SeekFrom::Start(span.at))?;
            let mut bytes = Vec::new();
            (&mut self.reader).take(span.bytes).read_to_end(&mut bytes)?;
            match bytes.len() as u64 == span.bytes {
                true => Ok(bytes),
                false => Err(io::ErrorKind::UnexpectedEof.into()),
            }
        };
        read().map_err(|e| Error::file(&self.path, "read", e))
    }
}

impl Source<File> {
    pub fn open(path: &Path) -> Result<Self> {
        let fail = |e| Error::file(path, "read", e);
        let metadata = fs::metadata(path).map_err(fail)?;
        if !metadata.is_file() {
            return Err(Error::input(path, "", "not a file"));
        }
        Ok(Self { path: path.to_owned(), reader: File::open(path).map_err(fail)?, bytes: metadata.len() })
    }
}
