//! The bytes of a glTF file's buffers: in the file, or in others in its folder or below.

use std::{
    collections::HashMap,
    fs::{self, File},
    io::Read,
    path::PathBuf,
    rc::Rc,
};

use base64::{
    Engine as _,
    alphabet::STANDARD,
    engine::{DecodePaddingMode, GeneralPurpose, GeneralPurposeConfig},
};

use super::document::{Buffer, Document};
use crate::{
    error::{Error, Result},
    load::{
        Input,
        beside::{self, Refusal},
        lines::shown,
    },
};

/// The bytes of one buffer.
#[derive(Clone)]
pub(super) enum Bytes<'a> {
    OfFile(&'a [u8]),
    Read(Rc<Vec<u8>>),
}

impl std::ops::Deref for Bytes<'_> {
    type Target = [u8];

    fn deref(&self) -> &[u8] {
        match self {
            Self::OfFile(bytes) => bytes,
            Self::Read(bytes) => bytes,
        }
    }
}

/// The buffers that something is read from, each opened when it is first asked for.
pub(super) struct Buffers<'a> {
    input: &'a Input<'a>,
    document: &'a Document<'a>,
    binary: Option<&'a [u8]>,
    known: HashMap<u32, Bytes<'a>>,
    /// Several buffers may be one file.
    files: HashMap<PathBuf, Rc<Vec<u8>>>,
}

impl<'a> Buffers<'a> {
    pub fn new(input: &'a Input<'a>, document: &'a Document<'a>, binary: Option<&'a [u8]>) -> Self {
        Self { input, document, binary, known: HashMap::new(), files: HashMap::new() }
    }

    /// The bytes of buffer `i`, at least as many as the file says.
    pub fn get(&mut self, i: u32) -> Result<Bytes<'a>> {
        if let Some(known) = self.known.get(&i) {
            return Ok(known.clone());
        }
        let Some(buffer) = self.document.buffers.get(i as usize) else {
            let problem = format!("not there; the file has {}", self.document.buffers.len());
            return Err(self.fault(i, problem));
        };
        let bytes = self.open(i, buffer)?;
        if (bytes.len() as u64) < buffer.byte_length {
            return Err(self.fault(i, format!("{} bytes; expected {}", bytes.len(), buffer.byte_length)));
        }
        self.known.insert(i, bytes.clone());
        Ok(bytes)
    }

    fn fault(&self, i: u32, problem: impl Into<String>) -> Error {
        self.input.fault(format!("buffer {i}"), problem)
    }

    fn open(&mut self, i: u32, buffer: &Buffer<'_>) -> Result<Bytes<'a>> {
        let Some(uri) = buffer.uri.as_deref() else {
            let binary = self.binary.filter(|_| i == 0);
            return binary
                .map(Bytes::OfFile)
                .ok_or_else(|| self.fault(i, "no uri, and no chunk of GLB for it"));
        };
        if let Some(data) = uri.strip_prefix("data:") {
            let Some((_, text)) = data.split_once(";base64,") else {
                return Err(self.fault(i, format!("data '{}'; expected base64", shown(data.as_bytes()))));
            };
            let bytes = decode(text).ok_or_else(|| self.fault(i, "data that is not base64"))?;
            return Ok(Bytes::Read(Rc::new(bytes)));
        }
        let path = self.find(i, uri)?;
        if let Some(bytes) = self.files.get(&path) {
            return Ok(Bytes::Read(Rc::clone(bytes)));
        }
        // Whoever reads a device would not come back.
        let is_file = fs::metadata(&path).map_err(|e| Error::file(&path, "read", e))?.is_file();
        if !is_file {
            return Err(self.fault(i, format!("'{}' is not a file", shown(uri.as_bytes()))));
        }
        let file = File::open(&path).map_err(|e| Error::file(&path, "read", e))?;
        let mut bytes = Vec::new();
        file.take(buffer.byte_length).read_to_end(&mut bytes).map_err(|e| Error::file(&path, "read", e))?;
        let bytes = Rc::new(bytes);
        self.files.insert(path, Rc::clone(&bytes));
        Ok(Bytes::Read(bytes))
    }

    /// The file that a buffer names.
    fn find(&self, i: u32, uri: &str) -> Result<PathBuf> {
        let name = shown(uri.as_bytes());
        let Some(folder) = self.input.folder else {
            return Err(
                self.fault(i, format!("'{name}' is another file, and standard input has no folder for it"))
            );
        };
        let Some(decoded) = percent_decoded(uri) else {
            return Err(self.fault(i, format!("'{name}'; expected the name of a file")));
        };
        beside::find(folder, &decoded, self.input.options.allow_outside).map_err(|refusal| {
            let problem = match refusal {
                Refusal::Missing(_, e) => format!("'{name}': cannot read: {e}"),
                Refusal::Rooted => {
                    format!("'{name}'; expected a path relative to the file's folder, or --allow-outside")
                }
                Refusal::Outside => {
                    format!(
                    "'{name}' is outside of the file's folder; expected it there or below, or --allow-outside"
                )
                }
            };
            self.fault(i, problem)
        })
    }
}

/// Some writers leave the padding away.
fn decode(text: &str) -> Option<Vec<u8>> {
    let config = GeneralPurposeConfig::new().with_decode_padding_mode(DecodePaddingMode::Indifferent);
    GeneralPurpose::new(&STANDARD, config).decode(text).ok()
}

/// A name in which %20 stands for a blank; `None` if it is no text.
fn percent_decoded(uri: &str) -> Option<String> {
    let mut parts = uri.split('%');
    let mut bytes = parts.next().unwrap_or_default().as_bytes().to_vec();
    for part in parts {
        let (code, rest) = part.split_at_checked(2)?;
        bytes.push(u8::from_str_radix(code, 16).ok()?);
        bytes.extend_from_slice(rest.as_bytes());
    }
    String::from_utf8(bytes).ok().filter(|name| !name.contains('\0'))
}
