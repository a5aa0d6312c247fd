//! The unit of lengths that a file names in words: `# units: mm`, `Units: feet`, `comment 1 unit = 0.1 m`.

use super::sniff::{Format, without_mark};

/// Names of units of length, and those in metres.
const METRES: [(&[&str], f64); 9] = [
    (&["m", "meter", "meters", "metre", "metres"], 1.0),
    (&["dm", "decimeter", "decimeters", "decimetre", "decimetres"], 0.1),
    (&["cm", "centimeter", "centimeters", "centimetre", "centimetres"], 0.01),
    (&["mm", "millimeter", "millimeters", "millimetre", "millimetres"], 0.001),
    (&["um", "µm", "micron", "microns", "micrometer", "micrometers", "micrometre", "micrometres"], 1e-6),
    (&["km", "kilometer", "kilometers", "kilometre", "kilometres"], 1000.0),
    (&["ft", "foot", "feet"], 0.3048),
    (&["in", "inch", "inches"], 0.0254),
    (&["yd", "yard", "yards"], 0.9144),
];

/// That of surveyors in the United States.
const SURVEY_FOOT: f64 = 1200.0 / 3937.0;

/// Words that may stand between `units` and the name of one.
const BETWEEN: [&str; 11] =
    ["is", "are", "in", "of", "the", "for", "length", "lengths", "coordinates", "xyz", "file"];

/// Of a file, what is looked at.
const PROBE_BYTES: usize = 1 << 16;

/// The length of a unit of this name, in lower case, in metres.
pub(super) fn metres(name: &str) -> Option<f64> {
    METRES.iter().find(|(names, _)| names.contains(&name)).map(|(_, metres)| *metres)
}

/// The unit that a line of words names, in metres.
pub(super) fn of_line(line: &[u8]) -> Option<f64> {
    // Rows of numbers are many, and have no such word.
    let has_word = line.windows(4).any(|word| word.eq_ignore_ascii_case(b"unit"));
    let text = has_word.then(|| String::from_utf8_lossy(line).to_lowercase())?;
    let mut rest = text.as_str();
    while let Some(at) = rest.find("unit") {
        let (before, word) = rest.split_at(at);
        let end = word.find(|c: char| !c.is_alphanumeric()).unwrap_or(word.len());
        let (word, behind) = word.split_at(end);
        rest = behind;
        let is_whole = !before.ends_with(char::is_alphanumeric) && matches!(word, "unit" | "units");
        if let Some(metres) = is_whole.then(|| named_behind(behind)).flatten() {
            return Some(metres);
        }
    }
    None
}

/// The unit that the words behind `units` begin with, and so many of it.
fn named_behind(text: &str) -> Option<f64> {
    let is_part = |c: char| c.is_alphanumeric() || c == '.' || c == '-';
    let mut words = text.split(|c: char| !is_part(c)).filter(|word| !word.is_empty());
    let mut word = words.find(|word| !BETWEEN.contains(word) || is_last(text, word))?;
    let mut count = 1.0;
    if let Ok(number) = word.parse::<f64>() {
        (count, word) = (number, words.next()?);
    }
    let of_survey = matches!(word, "us-ft" | "ft-us" | "usft" | "ftus")
        || matches!(word, "us" | "u.s." | "survey") && text.contains("survey");
    let unit = if of_survey { SURVEY_FOOT } else { metres(word.trim_end_matches(['.', '-']))? };
    // Such as m/s.
    let behind = text.get(text.rfind(word)? + word.len()..)?;
    let is_length = !behind.trim_start().starts_with(['/', '^', '*', '²', '³']);
    let metres = count * unit;
    (is_length && metres.is_normal() && (1e-9..=1e9).contains(&metres)).then_some(metres)
}

/// Whether a text ends with this word, as that of inches: "units: in".
fn is_last(text: &str, word: &str) -> bool {
    text.trim_end_matches(|c: char| !c.is_alphanumeric()).ends_with(word)
}

/// The unit that the comments of a file, or lines of words above its rows, name; `None` where two of them differ.
pub(super) fn told(format: Format, bytes: &[u8]) -> Option<f64> {
    let head = without_mark(bytes.get(..PROBE_BYTES).unwrap_or(bytes));
    let comments: &[&[u8]] = match format {
        Format::Obj | Format::Off | Format::Pcd => &[b"#"],
        Format::Ply => &[b"comment", b"obj_info"],
        Format::Rows => &[b""],
        // What follows may be binary.
        Format::Stl => return of_line(head.get(..80).unwrap_or(head).split(|b| *b == b'\n').next()?),
        Format::Gltf | Format::Las | Format::E57 | Format::Potree => return None,
    };
    let lines = head.split(|byte| matches!(byte, b'\n' | b'\r')).map(<[u8]>::trim_ascii);
    let header = lines.take_while(|line| format != Format::Ply || *line != b"end_header");
    let words = header.filter(|line| comments.iter().any(|comment| line.starts_with(comment)));
    let mut units = words.filter_map(of_line);
    let first = units.next()?;
    units.all(|unit| unit == first).then_some(first)
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use crate::load::{LoadOptions, load_bytes};

    #[test]
    fn a_line_names_its_unit() {
        for (line, metres) in [
            ("units: mm", 0.001),
            ("Units: feet", 0.3048),
            ("unit = m", 1.0),
            ("UNITS=Inches.", 0.0254),
            ("units: in", 0.0254),
            ("Units are in cm", 0.01),
            ("File units = centimeters", 0.01),
            ("unit of length: metres", 1.0),
            ("units (mm)", 0.001),
            ("1 unit = 0.1 m", 0.1),
            ("1 unit = 2 inches", 0.0508),
            ("units: US survey feet", 1200.0 / 3937.0),
            ("units: US-ft", 1200.0 / 3937.0),
            ("time unit: s, length unit: km", 1000.0),
            ("units\tµm", 1e-6),
        ] {
            let found = of_line(line.as_bytes()).unwrap_or(f64::NAN);
            assert!((found / metres - 1.0).abs() < 1e-12, "{line}: {found}");
        }
        for line in [
            "",
            "mm",
            "units",
            "units: degrees",
            "unit: m/s",
            "units: m^2",
            "unity 5 m",
            "community: m",
            "unit normals in m",
            "1 unit = 0 m",
            "1 unit = -1 m",
            "1 unit = NaN m",
            "units: 1e300 km",
            "unit unit unit",
            "units \u{130}",
        ] {
            assert_eq!(of_line(line.as_bytes()), None, "{line}");
        }
    }

    #[test]
    fn files_of_text_name_their_unit_where_they_have_comments() {
        let ply = "ply\nformat ascii 1.0\ncomment units: mm\nelement vertex 1\nproperty float x\nproperty float y\n\
            property float z\nend_header\n1 2 3\n";
        let pcd = "# units: mm\nVERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH 1\nHEIGHT 1\nDATA ascii\n1 2 3\n";
        let stl = "solid part, units = mm\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n\
            endloop\nendfacet\nendsolid\n";
        for (name, text, metres) in [
            ("a.xyz", "# units: mm\n1 2 3\n4 5 6\n", Some(0.001)),
            ("a.xyz", "Units: feet\n1 2 3\n4 5 6\n", Some(0.3048)),
            ("a.pts", "// unit: cm\n2\n1 2 3\n4 5 6\n", Some(0.01)),
            ("a.csv", "x,y,z\nUnits: feet\n1,2,3\n4,5,6\n", Some(0.3048)),
            ("a.csv", "units: mm\nx,y,z\n1,2,3\n4,5,6\n", Some(0.001)),
            ("a.csv", "# units: mm\nx [m],y [m],z [m]\n1,2,3\n", Some(1.0)),
            ("a.xyz", "# units: mm\n# units: m\n1 2 3\n", None),
            ("a.xyz", "1 2 3\n4 5 6\n", None),
            ("a.obj", "# Units: inches\nv 1 2 3\nv 4 5 6\n", Some(0.0254)),
            ("a.obj", "o units mm\nv 1 2 3\n", None),
            ("a.ply", ply, Some(0.001)),
            ("a.pcd", pcd, Some(0.001)),
            ("a.stl", stl, Some(0.001)),
            ("a.off", "OFF\n# units: mm\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", Some(0.001)),
        ] {
            let loaded = load_bytes(Path::new(name), text.into(), &LoadOptions::default(), &()).unwrap();
            assert_eq!(loaded.metres_per_unit, metres, "{name}: {text}");
            assert_eq!(loaded.notes, [], "{name}: {text}");
        }
    }

    #[test]
    fn a_comment_with_a_unit_hides_no_names_of_columns() {
        let text = "# intensity x y z\n# units: mm\n0.5 1 2 3\n0.25 4 5 6\n";
        let loaded = load_bytes(Path::new("a.xyz"), text.into(), &LoadOptions::default(), &()).unwrap();
        assert!(loaded.format.starts_with("rows of i x y z"), "{}", loaded.format);
    }
}
