//! Files that are compressed as a whole: gzip and zstd, told by their first bytes.
//!
//! What they expand to is limited by their size ([`Limits::unpacked_bytes`]), so that a small file can't fill the
//! memory.

use std::{
    io::{self, Read},
    path::{Path, PathBuf},
};

use super::Limits;
use crate::error::{Error, Result};

/// How many bytes are decoded at once.
const PART_BYTES: usize = 64 << 10;

/// The window that a decoder of zstd should have for any file (RFC 8878, section 3.1.1.1.2).
#[cfg(feature = "zstd")]
const USUAL_WINDOW_BYTES: u64 = 8 << 20;

/// How a file is compressed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Packing {
    Gzip,
    Zstd,
}

impl Packing {
    /// Told by the first bytes.
    pub fn of(bytes: &[u8]) -> Option<Self> {
        match bytes {
            [0x1f, 0x8b, ..] => Some(Self::Gzip),
            [0x28, 0xb5, 0x2f, 0xfd, ..] => Some(Self::Zstd),
            _ if skippable(bytes).is_some() => Some(Self::Zstd),
            _ => None,
        }
    }

    /// What people call it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Gzip => "gzip",
            Self::Zstd => "zstd",
        }
    }

    /// The name of what is inside: `a.ply` of `a.ply.gz`.
    pub fn inner_name(self, path: &Path) -> PathBuf {
        let extension = path.extension().map(|e| e.to_string_lossy().to_ascii_lowercase());
        match extension.as_deref() {
            Some("gz" | "gzip" | "zst" | "zstd") => path.with_extension(""),
            _ => path.to_owned(),
        }
    }

    /// What is inside.
    ///
    /// Its parts are kept by themselves until their size is known: a vector that grows holds up to three times what it is
    /// given.
    pub fn unpack(self, path: &Path, bytes: &[u8], limits: &Limits) -> Result<Vec<u8>> {
        let most = limits.unpacked(bytes.len());
        let (mut parts, mut size) = (Vec::new(), 0_usize);
        self.decode(path, bytes, limits, &mut |part| {
            size = size.saturating_add(part.len());
            if size as u64 > most {
                let (name, compressed) = (self.name(), bytes.len());
                let problem = format!(
                    "{name} of {compressed} bytes expands to more than {most}; unpack it first if you trust it"
                );
                return Err(Error::input(path, "", problem));
            }
            parts.push(part.to_vec());
            Ok(())
        })?;
        let mut unpacked = Vec::new();
        unpacked
            .try_reserve_exact(size)
            .map_err(|_| Error::file(path, "read", io::ErrorKind::OutOfMemory.into()))?;
        // Each is given back as soon as it is copied.
        parts.into_iter().for_each(|part| unpacked.extend_from_slice(&part));
        Ok(unpacked)
    }

    /// Gives what is inside to `take`, part by part.
    fn decode(self, path: &Path, bytes: &[u8], limits: &Limits, take: &mut Take<'_>) -> Result<()> {
        match self {
            Self::Gzip => gzip(path, bytes, take),
            Self::Zstd => zstd(path, bytes, limits, take),
        }
    }
}

/// What is behind a frame of zstd that decoders skip (RFC 8878, section 3.1.2), as programs that compress on many threads begin with; `None` of any other.
fn skippable(bytes: &[u8]) -> Option<&[u8]> {
    let [0x50..=0x5f, 0x2a, 0x4d, 0x18, size @ ..] = bytes else { return None };
    let (size, rest) = size.split_first_chunk()?;
    rest.get(u32::from_le_bytes(*size) as usize..)
}

/// What is done with a part of what is inside.
type Take<'a> = dyn FnMut(&[u8]) -> Result<()> + 'a;

#[cfg(feature = "gzip")]
fn gzip(path: &Path, bytes: &[u8], take: &mut Take<'_>) -> Result<()> {
    let mut rest = bytes;
    // A file may be several, one after the other, and blocks of tapes are filled with zeros.
    while rest.iter().any(|byte| *byte != 0) {
        let mut decoder = flate2::bufread::GzDecoder::new(rest);
        each_part(&mut decoder, Packing::Gzip, path, take)?;
        rest = decoder.into_inner();
    }
    Ok(())
}

#[cfg(not(feature = "gzip"))]
fn gzip(path: &Path, _: &[u8], _: &mut Take<'_>) -> Result<()> {
    Err(not_built(Packing::Gzip, path))
}

#[cfg(feature = "zstd")]
fn zstd(path: &Path, bytes: &[u8], limits: &Limits, take: &mut Take<'_>) -> Result<()> {
    use ruzstd::decoding::{FrameDecoder, StreamingDecoder, errors::FrameDecoderError};

    // The decoder keeps a window beside its output, of a size that the file names.
    let largest_window = (limits.unpacked(bytes.len()) / 4).max(USUAL_WINDOW_BYTES);
    let mut rest = bytes;
    // A file may be several, one after the other.
    while !rest.is_empty() {
        if let Some(behind) = skippable(rest) {
            rest = behind;
            continue;
        }
        let mut decoder = FrameDecoder::new();
        decoder.set_max_window_size(largest_window);
        let decoder = StreamingDecoder::new_with_decoder(&mut rest, decoder)
            .map_err(|error| match error {
                FrameDecoderError::WindowSizeTooBig { requested, .. } => {
                    let problem = format!(
                        "zstd with a window of {requested} bytes, where this file's may have {largest_window}; unpack it first if you trust it"
                    );
                    Error::input(path, "", problem)
                }
                _ => damaged(Packing::Zstd, path, 0),
            })?;
        each_part(decoder, Packing::Zstd, path, take)?;
    }
    Ok(())
}

#[cfg(not(feature = "zstd"))]
fn zstd(path: &Path, _: &[u8], _: &Limits, _: &mut Take<'_>) -> Result<()> {
    Err(not_built(Packing::Zstd, path))
}

#[cfg_attr(
    not(any(feature = "gzip", feature = "zstd")),
    allow(dead_code, reason = "nothing can be unpacked")
)]
fn each_part(mut stream: impl Read, packing: Packing, path: &Path, take: &mut Take<'_>) -> Result<()> {
    let (mut part, mut before) = (vec![0; PART_BYTES], 0_u64);
    loop {
        match stream.read(&mut part) {
            Ok(0) => return Ok(()),
            Ok(length) => {
                take(part.get(..length).unwrap_or_default())?;
                before += length as u64;
            }
            Err(e) if e.kind() == io::ErrorKind::Interrupted => {}
            Err(_) => return Err(damaged(packing, path, before)),
        }
    }
}

#[cfg_attr(
    not(any(feature = "gzip", feature = "zstd")),
    allow(dead_code, reason = "nothing can be unpacked")
)]
fn damaged(packing: Packing, path: &Path, before: u64) -> Error {
    let name = packing.name();
    let problem = format!(
        "damaged or cut {name}: {before} bytes of what is inside can be read, but no more; expected a whole file, so copy it again"
    );
    Error::input(path, "", problem)
}

#[cfg(not(all(feature = "gzip", feature = "zstd")))]
fn not_built(packing: Packing, path: &Path) -> Error {
    let name = packing.name();
    Error::input(path, "", format!("compressed by {name}, which needs the Cargo feature `{name}`"))
}

#[cfg(all(test, feature = "gzip", feature = "zstd"))]
mod tests {
    use std::io::Write as _;

    use flate2::{Compression, write::GzEncoder};
    use ruzstd::encoding::{CompressionLevel, compress_to_vec};

    use super::*;
    use crate::{
        load::{Loaded, Model, hostile::attack},
        scene::Points,
    };

    fn gzipped(bytes: &[u8]) -> Vec<u8> {
        let mut encoder = GzEncoder::new(Vec::new(), Compression::best());
        encoder.write_all(bytes).unwrap();
        encoder.finish().unwrap()
    }

    fn zstd_of(bytes: &[u8]) -> Vec<u8> {
        compress_to_vec(bytes, CompressionLevel::Fastest)
    }

    fn unpack(bytes: &[u8]) -> Result<Vec<u8>, String> {
        let packing = Packing::of(bytes).unwrap();
        packing.unpack(Path::new("a.ply.gz"), bytes, &Limits::DEFAULT).map_err(|e| e.to_string())
    }

    #[test]
    fn both_come_back_and_so_do_several_in_one_file() {
        for pack in [gzipped, zstd_of] {
            let once = pack(b"ply\nformat ascii 1.0\n");
            assert_eq!(unpack(&once).unwrap(), b"ply\nformat ascii 1.0\n");
            let twice = [once, pack(b"more")].concat();
            assert_eq!(unpack(&twice).unwrap(), b"ply\nformat ascii 1.0\nmore");
        }
        let padded = [&gzipped(b"points")[..], &[0; 512]].concat();
        assert_eq!(unpack(&padded).unwrap(), b"points");
        let skipped = |number: u8, size: u8| [number, 0x2a, 0x4d, 0x18, size, 0, 0, 0, 7, 7];
        let pieces = [&skipped(0x50, 2)[..], &zstd_of(b"poi"), &skipped(0x5f, 2), &zstd_of(b"nts")].concat();
        assert_eq!(unpack(&pieces).unwrap(), b"points");
        assert_eq!(Packing::of(&skipped(0x50, 3)), None, "cut");
        assert!(unpack(&[&gzipped(b"points")[..], b"junk"].concat()).unwrap_err().contains("damaged or cut"));
    }

    #[test]
    fn bombs_are_refused_at_their_limit() {
        let zeros = vec![0; 40 << 20];
        for (bytes, name) in [(gzipped(&zeros), "gzip"), (zstd_of(&zeros), "zstd")] {
            let refused = unpack(&bytes).unwrap_err();
            let start = format!("a.ply.gz: {name} of {} bytes expands to more than ", bytes.len());
            assert!(refused.starts_with(&start), "{refused}");
        }
        // A window of 1 << 41 bytes, which the decoder would keep beside its output.
        let window = [0x28, 0xb5, 0x2f, 0xfd, 0x00, 0xf8, 0x01, 0x00, 0x00];
        let refused = unpack(&window).unwrap_err();
        assert!(refused.starts_with("a.ply.gz: zstd with a window of 2199023255552 bytes"), "{refused}");
    }

    #[test]
    fn a_file_expands_to_its_limit_and_not_one_byte_beyond() {
        for bytes in [gzipped(&[7; 500]), zstd_of(&[7; 500])] {
            let packing = Packing::of(&bytes).unwrap();
            let within = |most| {
                let limits = Limits { unpacked_bytes: most, expansion: 0, ..Limits::DEFAULT };
                packing.unpack(Path::new("a"), &bytes, &limits).map_err(|e| e.to_string())
            };
            assert_eq!(within(500).unwrap(), [7; 500]);
            assert!(within(499).unwrap_err().contains("expands to more than 499; unpack it first"));
        }
    }

    #[test]
    fn cut_and_changed_files_are_refused_or_come_back_whole() {
        for pack in [gzipped, zstd_of] {
            let bytes = pack(b"v 0 0 0\nv 1 0 0\n");
            for end in 4..bytes.len() {
                let _ = unpack(&bytes[..end]);
            }
            let refused = unpack(&bytes[..bytes.len() / 2]).unwrap_err();
            assert!(
                refused.starts_with("a.ply.gz: damaged or cut ")
                    && refused.contains(" bytes of what is inside can be read"),
                "{refused}"
            );
            // What is read of them may be anything; its format is not looked at.
            let text: String = (0..60).map(|i| format!("v {} {i} 0\n", i * i % 7)).collect();
            let files = [bytes, pack(text.as_bytes())];
            attack(&files, 20_000, |input| {
                if let Some(packing) = Packing::of(input.bytes) {
                    packing.unpack(input.path, input.bytes, &Limits::DEFAULT)?;
                }
                Ok(Loaded::new(Model::Points(Points::default()), ""))
            });
        }
    }

    #[test]
    fn the_inner_name_tells_the_format() {
        let inner = |name: &str| Packing::Gzip.inner_name(Path::new(name));
        assert_eq!(inner("x/a.PLY.GZ"), Path::new("x/a.PLY"));
        assert_eq!(inner("a.obj"), Path::new("a.obj"));
    }
}
