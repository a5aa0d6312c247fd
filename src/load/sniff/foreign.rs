//! Files that are no models of a known format but that people have, by their first bytes and where these are of no known kind by
//! their names, so that messages name them.

const STEP: &str = "a STEP model (save it as STL or OBJ)";
const IGES: &str = "an IGES model (save it as STL or OBJ)";
const USD: &str = "a USD scene (save it as glTF or OBJ)";
const DXF: &str = "a DXF drawing (save it as STL or OBJ)";
const DWG: &str = "a DWG drawing (save it as STL or OBJ)";
const RHINO: &str = "a Rhino model (save it as STL or OBJ)";
const TAR: &str = "a tar archive (unpack it first)";
const GAUSSIANS: &str = "a viewer's own format of Gaussians (save them as PLY)";

/// Endings of names, in lower case, and what files are that are called so.
const BY_ENDINGS: [(&[&str], &str); 14] = [
    (&["step", "stp", "p21"], STEP),
    (&["iges", "igs"], IGES),
    (&["usd", "usda", "usdc", "usdz"], USD),
    (&["dxf"], DXF),
    (&["dwg"], DWG),
    (&["3dm"], RHINO),
    (&["tar"], TAR),
    (&["spz", "splat", "ksplat", "sog"], GAUSSIANS),
    (&["3mf"], "a 3MF model (save it as STL or OBJ)"),
    (&["blend"], "a Blender scene (export a model of it)"),
    (&["fbx"], "an FBX model (save it as glTF or OBJ)"),
    (&["dae"], "a COLLADA scene (save it as glTF or OBJ)"),
    (&["skp"], "a SketchUp model (save it as glTF or OBJ)"),
    (
        &["rcp", "rcs", "fls", "lsproj", "zfs", "ptg"],
        "a scanner program's own file (export E57 or LAS of it)",
    ),
];

/// First bytes, and what they are.
const BY_FIRST_BYTES: [(&[u8], &str); 30] = [
    (b"version https://git-lfs", "a git-lfs pointer, not the file itself (run `git lfs pull`)"),
    (
        b"\x89SURFEL",
        "a .surfel file, which render, view and info take on the command line and in scene files, and others do not",
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
    (b"ISO-10303-21", STEP),
    (b"#usda", USD),
    (b"PXR-USDC", USD),
    (b"AutoCAD Binary DXF", DXF),
    (b"3D Geometry File Format", RHINO),
    (b"\xd0\xcf\x11\xe0", "a document of an office or CAD program (save it as STL or OBJ)"),
    (b"NGSP", GAUSSIANS),
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

/// What a file is if not a model that can be read. Archives hold models of formats that only the `ending` of the name tells, in lower
/// case.
pub(super) fn foreign(bytes: &[u8], ending: &str) -> Option<&'static str> {
    let text =
        super::words::without_mark(bytes.get(..super::PROBE_BYTES).unwrap_or(bytes)).trim_ascii_start();
    let begins = |start: &[u8]| bytes.starts_with(start) || text.starts_with(start);
    if let Some((magic, what)) = BY_FIRST_BYTES.iter().find(|(magic, _)| begins(magic)) {
        let of_ending = magic.starts_with(b"PK").then(|| by_ending(ending)).flatten();
        return Some(of_ending.unwrap_or(what));
    }
    let starts_with = |words: &[u8]| text.get(..words.len()).is_some_and(|t| t.eq_ignore_ascii_case(words));
    if is_dxf(text) {
        return Some(DXF);
    }
    if is_iges(bytes) {
        return Some(IGES);
    }
    if is_grid(text) {
        return Some("an ESRI grid of heights without places (save it as XYZ or LAS)");
    }
    // The name of an archive's first file ends with zeros.
    if bytes.get(257..262) == Some(b"ustar") {
        return Some(TAR);
    }
    let markup = BY_FIRST_WORDS.iter().find(|(words, _)| starts_with(words)).map(|(_, what)| *what);
    markup.map(|what| by_ending(ending).unwrap_or(what))
}

/// What files are that are called so, of content that tells nothing.
pub(super) fn by_ending(ending: &str) -> Option<&'static str> {
    BY_ENDINGS.iter().find(|(endings, _)| endings.contains(&ending)).map(|(_, what)| *what)
}

/// A group code 0 and `SECTION`, behind comments (999).
fn is_dxf(text: &[u8]) -> bool {
    let mut lines = text.split(|byte| *byte == b'\n').map(<[u8]>::trim_ascii);
    while let (Some(code), Some(value)) = (lines.next(), lines.next()) {
        if code != b"999" {
            return code == b"0" && value == b"SECTION";
        }
    }
    false
}

/// A first line of 80 letters, the 73rd of which is S and then the number 1.
fn is_iges(bytes: &[u8]) -> bool {
    bytes.get(72..80).is_some_and(|tail| tail.starts_with(b"S") && tail[1..].trim_ascii() == b"1")
        && matches!(bytes.get(80), Some(b'\r' | b'\n'))
}

/// The three lines that no grid of ESRI lacks, among the first six. Its rows would pass for rows of places.
fn is_grid(text: &[u8]) -> bool {
    let lines = || text.split(|byte| matches!(byte, b'\n' | b'\r')).filter(|line| !line.is_empty()).take(6);
    let begins = |line: &[u8], name: &[u8]| {
        line.get(..name.len()).is_some_and(|word| word.eq_ignore_ascii_case(name))
            && line.get(name.len()).is_some_and(u8::is_ascii_whitespace)
    };
    [&b"ncols"[..], b"nrows", b"cellsize"].iter().all(|name| lines().any(|line| begins(line, name)))
}
