//! Files that are no models of a known format but that people have, by their first bytes, so that messages name
//! them.

/// First bytes, and what they are.
const BY_FIRST_BYTES: [(&[u8], &str); 26] = [
    (b"version https://git-lfs", "a git-lfs pointer, not the file itself (run `git lfs pull`)"),
    (
        b"\x89SURFEL",
        "a .surfel file, which render, view and info take on the command line, and scene files and others do not",
    ),
    (b"PK\x03\x04", "a zip archive (unpack it first)"),
    (b"PK\x05\x06", "an empty zip archive"),
    (b"BZh", "a bzip2 archive (unpack it first)"),
    (b"\xfd7zXZ", "an xz archive (unpack it first)"),
    (b"7z\xbc\xaf", "a 7z archive (unpack it first)"),
    (b"Rar!", "a rar archive (unpack it first)"),
    (b"\x89PNG", "a PNG picture"),
    (b"\xff\xd8\xff", "a JPEG picture"),
    (b"GIF8", "a GIF picture"),
    (b"II*\0", "a TIFF picture"),
    (b"MM\0*", "a TIFF picture"),
    (b"v/1\x01", "an EXR picture"),
    (b"%PDF", "a PDF document"),
    (b"\x89HDF", "an HDF5 file"),
    (b"Kaydara FBX", "an FBX model"),
    (b"BLENDER", "a Blender scene (export a model of it)"),
    (b"DRACO", "a Draco model"),
    (b"#VRML", "a VRML model"),
    (b"# vtk", "a VTK file"),
    (b"ISO-10303-21", "a STEP model (save it as STL or OBJ)"),
    (b"#usda", "a USD scene (export a model of it)"),
    (b"PXR-USDC", "a USD scene (export a model of it)"),
    (b"\xff\xfe", "text in UTF-16 (save it as UTF-8)"),
    (b"\xfe\xff", "text in UTF-16 (save it as UTF-8)"),
];

/// First words of markup, in lower case, and what they are.
const BY_FIRST_WORDS: [(&[u8], &str); 4] = [
    (b"<!doctype html", "an HTML page, perhaps of a download that failed"),
    (b"<html", "an HTML page, perhaps of a download that failed"),
    (b"<?xml", "an XML file"),
    (b"<", "a file of markup"),
];

/// What a file is if not a model that can be read.
pub(super) fn foreign(bytes: &[u8]) -> Option<&'static str> {
    if let Some((_, what)) = BY_FIRST_BYTES.iter().find(|(magic, _)| bytes.starts_with(magic)) {
        return Some(what);
    }
    let text =
        super::words::without_mark(bytes.get(..super::PROBE_BYTES).unwrap_or(bytes)).trim_ascii_start();
    let starts_with = |words: &[u8]| text.get(..words.len()).is_some_and(|t| t.eq_ignore_ascii_case(words));
    if is_dxf(text) {
        return Some("a DXF drawing (save it as STL or OBJ)");
    }
    // The name of an archive's first file ends with zeros.
    if bytes.get(257..262) == Some(b"ustar") {
        return Some("a tar archive (unpack it first)");
    }
    BY_FIRST_WORDS.iter().find(|(words, _)| starts_with(words)).map(|(_, what)| *what)
}

/// A group code 0 and `SECTION`.
fn is_dxf(text: &[u8]) -> bool {
    let mut words = text.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty());
    words.next() == Some(b"0") && words.next() == Some(b"SECTION")
}
