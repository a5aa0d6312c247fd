//! The unit of a file's coordinates, which it tells by keys of GeoTIFF (LAS 1.4, section 2.6.1) or by well-known text (2112).

use las::raw::Vlr;

/// What x and y are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::load) enum Coordinates {
    /// Nothing is said of them, or nothing that is known here.
    Unknown,
    /// Lengths, of a unit of so many metres.
    Lengths(f64),
    /// Longitude and latitude in degrees.
    Degrees,
}

/// The user of the records, and the numbers of two of them.
const USER: &[u8] = b"LASF_Projection";
const KEYS: u16 = 34_735;
const TEXT: u16 = 2112;

/// Keys of GeoTIFF: the kind of model, the projected system by number, and its unit.
const MODEL: u16 = 1024;
const PROJECTED: u16 = 3072;
const UNIT: u16 = 3076;

/// The foot, and the one of surveyors in the United States.
const FOOT: f64 = 0.3048;
const SURVEY_FOOT: f64 = 1200.0 / 3937.0;

impl Coordinates {
    /// As these say, of which later ones that know something come first: text stands for keys where there are both.
    pub fn or(self, record: &Vlr) -> Self {
        if !record.user_id.starts_with(USER) {
            return self;
        }
        let found = match record.record_id {
            KEYS => of_keys(&record.data),
            TEXT => of_text(&String::from_utf8_lossy(&record.data)),
            _ => Self::Unknown,
        };
        if found == Self::Unknown { self } else { found }
    }
}

/// Four numbers of 16 bits a key behind four others: its own, where its value is, how many, and the value.
fn of_keys(data: &[u8]) -> Coordinates {
    let numbers: Vec<u16> =
        data.chunks_exact(2).map(|pair| u16::from_le_bytes(pair.try_into().unwrap_or_default())).collect();
    let value = |wanted: u16| {
        numbers.chunks_exact(4).skip(1).find_map(|entry| match *entry {
            [key, 0, 1, value] if key == wanted => Some(value),
            _ => None,
        })
    };
    match (value(MODEL), value(UNIT), value(PROJECTED)) {
        (Some(2), ..) => Coordinates::Degrees,
        (_, Some(9001), _) => Coordinates::Lengths(1.0),
        (_, Some(9002), _) => Coordinates::Lengths(FOOT),
        (_, Some(9003), _) => Coordinates::Lengths(SURVEY_FOOT),
        // UTM, of WGS 84 and of ETRS89.
        (_, None, Some(32_601..=32_660 | 32_701..=32_760 | 25_828..=25_838)) => Coordinates::Lengths(1.0),
        _ => Coordinates::Unknown,
    }
}

/// A projected system has its unit last; in the newer form it has one an axis.
fn of_text(text: &str) -> Coordinates {
    let start = |names: [&str; 2]| names.iter().filter_map(|name| text.find(name)).min();
    let Some(at) = start(["PROJCS[", "PROJCRS["]) else {
        let is_geographic = start(["GEOGCS[", "GEOGCRS["]).or(start(["GEODCRS[", "GEODETICCRS["])).is_some();
        return if is_geographic { Coordinates::Degrees } else { Coordinates::Unknown };
    };
    let inside = within_brackets(text.get(at..).unwrap_or_default());
    let is_unit = |at: usize| {
        let before = inside.get(..at).unwrap_or_default();
        before.ends_with("LENGTH") || !before.ends_with(|c: char| c.is_ascii_alphabetic())
    };
    let last = inside.rmatch_indices("UNIT[").map(|(at, _)| at).find(|at| is_unit(*at));
    let of_name = last.and_then(|at| inside.get(at..)?.split(',').nth(1));
    let metres = of_name.and_then(|text| text.split([']', ',']).next()?.trim().parse().ok());
    match metres {
        Some(metres) if (1e-6..=1e6).contains(&metres) => Coordinates::Lengths(metres),
        _ => Coordinates::Unknown,
    }
}

/// The text up to the bracket that closes its first one.
fn within_brackets(text: &str) -> &str {
    let (mut depth, mut quoted) = (0_usize, false);
    for (at, c) in text.char_indices() {
        match c {
            '"' => quoted = !quoted,
            '[' if !quoted => depth += 1,
            ']' if !quoted => depth = depth.saturating_sub(1),
            _ => continue,
        }
        if c == ']' && !quoted && depth == 0 {
            return text.get(..at).unwrap_or(text);
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    fn keys(keys: &[[u16; 4]]) -> Coordinates {
        let header = [1, 1, 0, keys.len() as u16];
        let data = std::iter::once(&header).chain(keys).flatten().flat_map(|v| v.to_le_bytes()).collect();
        let mut user_id = [0; 16];
        user_id[..15].copy_from_slice(USER);
        let record = Vlr { user_id, record_id: KEYS, data, ..Vlr::default() };
        Coordinates::Unknown.or(&record)
    }

    #[test]
    fn keys_tell_the_unit() {
        for (unit, metres) in [(9001, 1.0), (9002, 0.3048), (9003, 0.304_800_609_601_219)] {
            let Coordinates::Lengths(found) = keys(&[[1024, 0, 1, 1], [3076, 0, 1, unit]]) else { panic!() };
            assert!((found - metres).abs() < 1e-12, "{unit}");
        }
        assert_eq!(keys(&[[1024, 0, 1, 2], [2048, 0, 1, 4326]]), Coordinates::Degrees);
        assert_eq!(keys(&[[3072, 0, 1, 32_633]]), Coordinates::Lengths(1.0));
        assert_eq!(keys(&[[3072, 0, 1, 2285]]), Coordinates::Unknown);
        assert_eq!(keys(&[[3076, 0, 1, 9999], [3072, 0, 1, 32_633]]), Coordinates::Unknown);
        assert_eq!(keys(&[]), Coordinates::Unknown);
    }

    #[test]
    fn text_tells_the_unit() {
        let geographic =
            r#"GEOGCS["a ] b",DATUM["d",SPHEROID["s",6378137,298.2]],UNIT["degree",0.0174532925]]"#;
        assert_eq!(of_text(geographic), Coordinates::Degrees);
        let projected =
            |unit: &str| format!(r#"PROJCS["p",{geographic},PARAMETER["m",9],UNIT[{unit}],AXIS["E",EAST]]"#);
        assert_eq!(of_text(&projected(r#""metre",1"#)), Coordinates::Lengths(1.0));
        let foot = projected(r#""US survey foot",0.3048006096,AUTHORITY["EPSG","9003"]"#);
        assert_eq!(of_text(&foot), Coordinates::Lengths(0.304_800_609_6));
        let with_heights = format!(r#"COMPD_CS["c",{foot},VERT_CS["v",UNIT["metre",1.0]]]"#);
        assert_eq!(of_text(&with_heights), Coordinates::Lengths(0.304_800_609_6), "heights have their own");
        let newer = r#"PROJCRS["p",BASEGEOGCRS["b",UNIT["degree",0.01]],CS[Cartesian,2],
            AXIS["(E)",east,LENGTHUNIT["foot",0.3048]],AXIS["(N)",north,LENGTHUNIT["foot",0.3048]],ANGLEUNIT["degree",0.01]]"#;
        assert_eq!(of_text(newer), Coordinates::Lengths(0.3048));
        for text in
            ["", "PROJCS[", "PROJCS[\"p\"]", "PROJCS[\"p\",UNIT[\"a\"]]", "PROJCS[UNIT[\"a\",0]]", "]["]
        {
            assert_eq!(of_text(text), Coordinates::Unknown, "{text}");
        }
    }
}
