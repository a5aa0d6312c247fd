//! Text formats by their first words.

use super::Format;

/// First words of lines of OBJ files.
const OBJ_WORDS: [&[u8]; 15] = [
    b"v", b"vn", b"vt", b"vp", b"f", b"l", b"p", b"o", b"g", b"s", b"mtllib", b"usemtl", b"mg", b"cstype",
    b"deg",
];

/// First words of lines of PCD headers.
const PCD_WORDS: [&[u8]; 3] = [b"VERSION", b"FIELDS", b"COLUMNS"];

/// The format that the first words tell. `probe` is the start of the text.
pub(super) fn by_words(probe: &[u8]) -> Option<Format> {
    let text = without_mark(probe).trim_ascii_start();
    if text.starts_with(b"# .PCD") {
        return Some(Format::Pcd);
    }
    if text.starts_with(b"{") {
        return contains(text, b"\"asset\"").then_some(Format::Gltf);
    }
    let is_solid = text.get(..5).is_some_and(|word| word.eq_ignore_ascii_case(b"solid"));
    let lower = || text.to_ascii_lowercase();
    if is_solid && (contains(&lower(), b"facet") || contains(&lower(), b"endsolid")) {
        return Some(Format::Stl);
    }
    let mut lines = text.split(|&b| b == b'\n' || b == b'\r').map(<[u8]>::trim_ascii);
    let is_data = |line: &&[u8]| !line.is_empty() && !line.starts_with(b"#") && !line.starts_with(b"//");
    let first = lines.by_ref().find(is_data)?;
    let first_word = first_word(first);
    if PCD_WORDS.contains(&first_word) {
        return Some(Format::Pcd);
    }
    if is_off(first_word) {
        return Some(Format::Off);
    }
    if OBJ_WORDS.contains(&first_word) {
        return Some(Format::Obj);
    }
    // A header of words, or a number of rows, may stand before them.
    let is_row = |line: &[u8]| numbers(line) >= 3;
    let second = lines.find(is_data);
    // In PTX files two numbers and a place.
    let is_number = |line: &[u8]| numbers(line) == 1;
    let begins_scan =
        is_number(first) && second.is_some_and(is_number) && lines.find(is_data).is_some_and(is_row);
    (is_row(first) || second.is_some_and(is_row) || begins_scan).then_some(Format::Rows)
}

/// Without the mark that some editors write before UTF-8.
pub(in crate::load) fn without_mark(bytes: &[u8]) -> &[u8] {
    bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes)
}

/// `OFF`, and before it what vertices have: texture coordinates, colors, normals, a fourth coordinate, their number.
fn is_off(word: &[u8]) -> bool {
    let digits = word.iter().rev().take_while(|byte| byte.is_ascii_digit()).count();
    let word = word.get(..word.len() - digits).unwrap_or(word);
    word.strip_suffix(b"OFF")
        .or(word.strip_suffix(b"off"))
        .is_some_and(|prefix| prefix.len() <= 6 && prefix.iter().all(|b| b"STCN4n".contains(b)))
}

fn first_word(line: &[u8]) -> &[u8] {
    line.split(|b| b.is_ascii_whitespace()).next().unwrap_or_default()
}

fn contains(text: &[u8], word: &[u8]) -> bool {
    text.windows(word.len()).any(|window| window == word)
}

/// How many numbers a line starts with.
fn numbers(line: &[u8]) -> usize {
    let parts = line.split(|&b| b.is_ascii_whitespace() || b == b',' || b == b';').filter(|p| !p.is_empty());
    let is_number = |part: &&[u8]| str::from_utf8(part).is_ok_and(|text| text.parse::<f64>().is_ok());
    parts.map(|part| part.trim_ascii()).take_while(is_number).count()
}
