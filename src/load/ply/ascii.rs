//! Elements of ascii bodies: one a line, values between blanks.

use std::{fmt::Display, str::FromStr};

use ply_rs_bw::ply::{ElementDef, PropertyAccess, PropertyAccessResult, PropertyType, ScalarType};

/// The element on this line, or what is wrong with it.
pub(super) fn element<E: PropertyAccess>(line: &[u8], def: &ElementDef) -> Result<E, String> {
    let line = str::from_utf8(line).map_err(|_| "not ascii text".to_owned())?;
    let mut words = line.split_ascii_whitespace();
    let mut element = E::new();
    for (name, property) in &def.properties {
        let result = match &property.data_type {
            PropertyType::Scalar(scalar) => set_scalar(&mut element, name, scalar, &mut words)?,
            PropertyType::List(_, item) => {
                let length: usize = value(name, "list length", words.next())?;
                set_list(&mut element, name, item, length, &mut words)?
            }
        };
        if result == PropertyAccessResult::UnsupportedType {
            return Err(format!("{name} has a type that is not supported"));
        }
    }
    let extra = words.count();
    if extra > 0 { Err(format!("{extra} value(s) more than the header declares")) } else { Ok(element) }
}

fn set_scalar<'a, E: PropertyAccess>(
    element: &mut E,
    name: &str,
    scalar: &ScalarType,
    words: &mut impl Iterator<Item = &'a str>,
) -> Result<PropertyAccessResult, String> {
    let word = words.next();
    Ok(match scalar {
        ScalarType::Char => element.set_char(name, value(name, "char", word)?),
        ScalarType::UChar => element.set_uchar(name, value(name, "uchar", word)?),
        ScalarType::Short => element.set_short(name, value(name, "short", word)?),
        ScalarType::UShort => element.set_ushort(name, value(name, "ushort", word)?),
        ScalarType::Int => element.set_int(name, value(name, "int", word)?),
        ScalarType::UInt => element.set_uint(name, value(name, "uint", word)?),
        ScalarType::Float => element.set_float(name, value(name, "float", word)?),
        ScalarType::Double => element.set_double(name, value(name, "double", word)?),
    })
}

fn set_list<'a, E: PropertyAccess>(
    element: &mut E,
    name: &str,
    item: &ScalarType,
    length: usize,
    words: &mut impl Iterator<Item = &'a str>,
) -> Result<PropertyAccessResult, String> {
    Ok(match item {
        ScalarType::Char => element.set_list_char(name, list(name, "char", length, words)?),
        ScalarType::UChar => element.set_list_uchar(name, list(name, "uchar", length, words)?),
        ScalarType::Short => element.set_list_short(name, list(name, "short", length, words)?),
        ScalarType::UShort => element.set_list_ushort(name, list(name, "ushort", length, words)?),
        ScalarType::Int => element.set_list_int(name, list(name, "int", length, words)?),
        ScalarType::UInt => element.set_list_uint(name, list(name, "uint", length, words)?),
        ScalarType::Float => element.set_list_float(name, list(name, "float", length, words)?),
        ScalarType::Double => element.set_list_double(name, list(name, "double", length, words)?),
    })
}

/// Grows with the values that are there: the length is only the file's word.
fn list<'a, T: FromStr>(
    name: &str,
    type_name: &str,
    length: usize,
    words: &mut impl Iterator<Item = &'a str>,
) -> Result<Vec<T>, String> {
    let mut values = Vec::new();
    for _ in 0..length {
        values.push(value(name, type_name, words.next())?);
    }
    Ok(values)
}

fn value<T: FromStr>(name: &str, type_name: impl Display, word: Option<&str>) -> Result<T, String> {
    let Some(word) = word else { return Err(format!("{name} is missing")) };
    word.parse().map_err(|_| {
        let short: String = word.chars().take(40).collect();
        format!("{name} is '{}', expected a {type_name}", short.escape_debug())
    })
}
