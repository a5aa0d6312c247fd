//! Tables and values of a TOML text that know where they are, so that every fault is told with its line and key.

use std::path::Path;

use toml::{
    Spanned,
    de::{DeTable, DeValue},
};

use super::nearest::suggestion;
use crate::error::{Error, Result};

/// The most letters of a value or key that a message shows.
const MOST_SHOWN: usize = 40;

/// A text and where it comes from.
pub(super) struct Document<'a> {
    /// The file.
    pub path: &'a Path,
    /// All of it.
    pub text: &'a str,
}

impl Document<'_> {
    /// An error at this byte. `place` is an object and a key in words; it may be empty.
    pub(super) fn fault(&self, at: usize, place: &str, problem: &str) -> Error {
        let line = 1 + self.text.bytes().take(at).filter(|byte| *byte == b'\n').count();
        let comma = if place.is_empty() { "" } else { ", " };
        Error::input(self.path, format!("line {line}{comma}{place}"), problem)
    }
}

/// A table all keys of which are known.
pub(super) struct Table<'a> {
    /// Where it is.
    pub document: &'a Document<'a>,
    entries: &'a DeTable<'a>,
    at: usize,
    place: String,
}

impl<'a> Table<'a> {
    /// # Errors
    /// The first key that is not one of `keys`.
    pub(super) fn of(
        document: &'a Document<'a>,
        entries: &'a DeTable<'a>,
        at: usize,
        place: impl Into<String>,
        keys: &'static [&'static str],
    ) -> Result<Self> {
        let table = Self { document, entries, at, place: place.into() };
        let unknown = entries.keys().filter(|key| !keys.contains(&key.get_ref().as_ref()));
        match unknown.min_by_key(|key| key.span().start) {
            None => Ok(table),
            Some(key) => {
                let meant = suggestion(key.get_ref(), keys.iter().copied());
                let problem = format!("unknown key '{}'; expected {meant}", one_line(key.get_ref()));
                Err(document.fault(key.span().start, &table.place, &problem))
            }
        }
    }

    /// An error of the table as a whole.
    pub(super) fn fault(&self, problem: &str) -> Error {
        self.document.fault(self.at, &self.place, problem)
    }

    /// The value of a key, where it is there.
    pub(super) fn get(&self, key: &'static str) -> Option<Value<'a>> {
        let value = self.entries.get(key)?;
        let comma = if self.place.is_empty() { "" } else { ", " };
        Some(Value { document: self.document, value, place: format!("{}{comma}{key}", self.place) })
    }

    /// The table of a key, where it is there.
    ///
    /// # Errors
    /// Another value; an unknown key in it.
    pub(super) fn table(
        &self,
        key: &'static str,
        keys: &'static [&'static str],
    ) -> Result<Option<Table<'a>>> {
        let Some(value) = self.get(key) else { return Ok(None) };
        let place = value.place.clone();
        value.table(place, keys).map(Some)
    }

    /// The tables of a key, none where it is missing.
    ///
    /// # Errors
    /// Other values; unknown keys; more than `most`.
    pub(super) fn tables(
        &self,
        key: &'static str,
        keys: &'static [&'static str],
        most: usize,
    ) -> Result<Vec<Table<'a>>> {
        let Some(value) = self.get(key) else { return Ok(Vec::new()) };
        let Some(array) = value.value.get_ref().as_array() else {
            return Err(value.expected(&format!("tables, each headed [[{key}]]")));
        };
        let mut tables = Vec::new();
        for (i, element) in array.iter().enumerate() {
            let place = format!("{key} {}", i + 1);
            let element = Value { document: self.document, value: element, place: place.clone() };
            if i == most {
                return Err(element.fault(&format!("one too many; expected at most {most}")));
            }
            tables.push(element.table(place, keys)?);
        }
        Ok(tables)
    }

    /// Refuses a key that has no meaning here; `why` goes on from there.
    ///
    /// # Errors
    /// The key is there.
    pub(super) fn refuse(&self, key: &'static str, why: &str) -> Result<()> {
        self.get(key).map_or(Ok(()), |value| Err(value.fault(&format!("has no meaning {why}"))))
    }
}

/// A value, and where it is.
pub(super) struct Value<'a> {
    document: &'a Document<'a>,
    value: &'a Spanned<DeValue<'a>>,
    place: String,
}

impl<'a> Value<'a> {
    /// An error of this value.
    pub(super) fn fault(&self, problem: &str) -> Error {
        self.document.fault(self.value.span().start, &self.place, problem)
    }

    /// It is something else than what was expected.
    pub(super) fn expected(&self, what: &str) -> Error {
        let found = match self.value.get_ref() {
            DeValue::Table(_) => "a table".to_owned(),
            DeValue::Array(_) if self.shown().is_empty() => "an array".to_owned(),
            _ => self.shown(),
        };
        self.fault(&format!("{found}: expected {what}"))
    }

    /// As it stands in the text.
    fn shown(&self) -> String {
        one_line(self.document.text.get(self.value.span()).unwrap_or_default())
    }

    /// A finite number for which `good` holds. Whole numbers are numbers.
    pub(super) fn number(&self, what: &str, good: impl Fn(f64) -> bool) -> Result<f64> {
        self.as_number().filter(|number| good(*number)).ok_or_else(|| self.expected(what))
    }

    fn as_number(&self) -> Option<f64> {
        let number = match self.value.get_ref() {
            DeValue::Float(float) => float.as_str().parse().ok(),
            DeValue::Integer(whole) => {
                i128::from_str_radix(whole.as_str(), whole.radix()).ok().map(|whole| whole as f64)
            }
            _ => None,
        };
        number.filter(|number: &f64| number.is_finite())
    }

    /// A whole number from 0 to `most`, at least `least`.
    pub(super) fn whole(&self, least: u64, most: u64) -> Result<u64> {
        let whole = match self.value.get_ref() {
            DeValue::Integer(whole) => u64::from_str_radix(whole.as_str(), whole.radix()).ok(),
            _ => None,
        };
        let inside = whole.filter(|whole| (least..=most).contains(whole));
        inside.ok_or_else(|| self.expected(&format!("a whole number, {least} to {most}")))
    }

    /// So many finite numbers, for each of which `good` holds.
    pub(super) fn numbers<const N: usize>(&self, what: &str, good: impl Fn(f64) -> bool) -> Result<[f64; N]> {
        let elements = self.elements().unwrap_or_default();
        let numbers: Vec<f64> = elements.iter().filter_map(Value::as_number).filter(|n| good(*n)).collect();
        let all = (numbers.len() == elements.len()).then_some(numbers);
        all.and_then(|numbers| numbers.try_into().ok()).ok_or_else(|| self.expected(what))
    }

    /// The elements of an array; `None` for anything else.
    pub(super) fn elements(&self) -> Option<Vec<Value<'a>>> {
        let array = self.value.get_ref().as_array()?;
        let element = |value| Value { document: self.document, value, place: self.place.clone() };
        Some(array.iter().map(element).collect())
    }

    /// `true` or `false`.
    pub(super) fn yes_or_no(&self) -> Result<bool> {
        self.value.get_ref().as_bool().ok_or_else(|| self.expected("true or false"))
    }

    /// A text.
    pub(super) fn text(&self, what: &str) -> Result<&'a str> {
        self.value.get_ref().as_str().ok_or_else(|| self.expected(what))
    }

    /// One of these names.
    pub(super) fn one_of<T: Copy>(&self, names: &[(&'static str, T)]) -> Result<T> {
        let known = || names.iter().map(|(name, _)| *name);
        let given = self.value.get_ref().as_str().unwrap_or_default();
        let found = names.iter().find(|(name, _)| *name == given).map(|(_, value)| *value);
        found.ok_or_else(|| self.expected(&suggestion(given, known())))
    }

    /// A table all keys of which are known.
    fn table(&self, place: String, keys: &'static [&'static str]) -> Result<Table<'a>> {
        match self.value.get_ref().as_table() {
            Some(table) => Table::of(self.document, table, self.value.span().start, place, keys),
            None => Err(self.expected("a table")),
        }
    }
}

/// A text on one line, and not too long.
pub(super) fn one_line(text: &str) -> String {
    let words: Vec<&str> =
        text.split(|c: char| c.is_control() || c.is_whitespace()).filter(|word| !word.is_empty()).collect();
    let line = words.join(" ");
    match line.char_indices().nth(MOST_SHOWN) {
        Some((end, _)) => format!("{}…", &line[..end]),
        None => line,
    }
}
