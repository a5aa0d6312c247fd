//! Elements of ascii bodies: one a line, values between blanks.

use super::{Field, Items};
use crate::load::{
    number::{self, of_no_number},
    ply::schema::{Element, Kind, Scalar},
};

/// Reads the element on this line, and tells how many words are left behind it. Values that are not wanted need not be
/// numbers.
pub(super) fn element<'a>(
    line: &'a [u8],
    def: &'a Element,
    is_wanted: &[bool],
    take: &mut dyn FnMut(usize, Field<'a>),
) -> Result<usize, String> {
    let line = str::from_utf8(line).map_err(|_| "not ascii text".to_owned())?;
    let mut words = line.split_ascii_whitespace();
    for (i, property) in def.properties.iter().enumerate() {
        let name = property.name.as_str();
        let is_wanted = is_wanted.get(i).copied().unwrap_or(false);
        match property.kind {
            Kind::One(scalar) if is_wanted => take(i, Field::One(number(name, scalar, words.next())?)),
            Kind::One(_) => drop(words.next().ok_or_else(|| missing(name))?),
            Kind::List { item, .. } => {
                let word = words.next().ok_or_else(|| missing(name))?;
                let length: usize = word
                    .parse()
                    .map_err(|_| format!("{name} is '{}', expected a list length", shown(word)))?;
                let items = Items::Words { words: words.clone(), left: length, name, item };
                if length > 0 && words.nth(length - 1).is_none() {
                    return Err(missing(name));
                }
                if is_wanted {
                    take(i, Field::List(items));
                }
            }
        }
    }
    Ok(words.count())
}

/// A word as a value of this type. C programs write `nan`, `inf`, `1.` and `+1`; some write integers as `255.0`.
pub(super) fn number(name: &str, scalar: Scalar, word: Option<&str>) -> Result<f64, String> {
    let word = word.ok_or_else(|| missing(name))?;
    let refuse = || format!("{name} is '{}', expected a {}", shown(word), scalar.word());
    let Some((least, most)) = scalar.range() else {
        // Rounded once, to the type that the header names.
        return match scalar {
            Scalar::Float => {
                word.parse::<f32>().map(f64::from).ok().or_else(|| of_no_number(word)).ok_or_else(refuse)
            }
            _ => number::read(word).ok_or_else(refuse),
        };
    };
    let value: f64 = match word.parse::<i128>() {
        Ok(whole) if (least..=most).contains(&whole) => return Ok(whole as f64),
        Ok(_) => return Err(refuse()),
        Err(_) => word.parse().map_err(|_| refuse())?,
    };
    let is_in = value.fract() == 0.0 && value >= least as f64 && value <= most as f64;
    if is_in { Ok(value) } else { Err(refuse()) }
}

fn missing(name: &str) -> String {
    format!("{name} is missing")
}

/// A word for a message: short and printable.
fn shown(word: &str) -> String {
    word.chars().take(40).collect::<String>().escape_debug().to_string()
}
