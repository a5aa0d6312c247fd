//! What all targets do with a file.

use std::{io::Cursor, path::Path};

use surfel::{
    ErrorKind,
    levels_file::LevelsFile,
    load::{LoadOptions, load_bytes},
};

/// Reads it as a file of this name. It may be refused, in one line that names it; the fuzzer sees panics, hangs and
/// memory.
pub fn read(name: &str, bytes: &[u8]) {
    if let Err(error) = load_bytes(Path::new(name), bytes.to_vec(), &LoadOptions::default(), &()) {
        let text = error.to_string();
        let is_input = matches!(error.kind(), ErrorKind::Input { .. });
        assert!(is_input && text.starts_with(name) && !text.contains('\n'), "{text}");
    }
}

/// Panics of other crates' decoders, which `load` makes errors, are no findings.
pub fn forgive_foreign_decoders() {
    let abort = std::panic::take_hook();
    std::panic::set_hook(Box::new(move |panic| {
        if !surfel::load::runs_foreign_decoder() {
            abort(panic);
        }
    }));
}

/// Bytes of a hierarchy's header and of an entry of its table (`docs/format.md`).
const HEADER_BYTES: usize = 256;
const ENTRY_BYTES: usize = 128;

/// Reads it as a hierarchy, with all checksums put right: what is behind them is to be looked at, too. What is refused is refused as in [`read`],
/// and what is read takes no more memory than its bytes account for.
pub fn read_levels(bytes: &[u8]) {
    let mut bytes = bytes.to_vec();
    sign(&mut bytes);
    let read = LevelsFile::new(Path::new("a.surfel"), Cursor::new(&bytes), bytes.len() as u64)
        .and_then(|mut file| file.load(None, u64::MAX, &()));
    match read {
        Ok(chosen) => {
            let held = chosen.object.leaves.bytes() + chosen.object.nodes.bytes();
            assert!(held <= 2 * bytes.len() as u64, "{held} of {}", bytes.len());
        }
        Err(error) => {
            let text = error.to_string();
            let is_input = matches!(error.kind(), ErrorKind::Input { .. });
            assert!(is_input && text.starts_with("a.surfel") && !text.contains('\n'), "{text}");
        }
    }
}

fn sign(bytes: &mut [u8]) {
    if bytes.len() < HEADER_BYTES {
        return;
    }
    let number = |bytes: &[u8], at: usize| u64::from_le_bytes(bytes[at..at + 8].try_into().unwrap_or_default());
    let table = usize::try_from(number(bytes, 32)).unwrap_or(usize::MAX).min(bytes.len());
    for entry in (0..(bytes.len() - table) / ENTRY_BYTES).map(|i| table + i * ENTRY_BYTES) {
        let (at, size) = (number(bytes, entry) as usize, number(bytes, entry + 8) as u32 as usize);
        if let Some(page) = at.checked_add(size).and_then(|end| bytes.get(at..end)) {
            let crc = crc32fast::hash(page);
            bytes[entry + 12..entry + 16].copy_from_slice(&crc.to_le_bytes());
        }
    }
    let crc = crc32fast::hash(&bytes[table..]);
    bytes[44..48].copy_from_slice(&crc.to_le_bytes());
    let crc = crc32fast::hash(&bytes[..HEADER_BYTES - 4]);
    bytes[HEADER_BYTES - 4..HEADER_BYTES].copy_from_slice(&crc.to_le_bytes());
}
