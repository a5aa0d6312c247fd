//! Lines above the rows that name their columns, and what else may stand there.

use super::{
    columns::{Column, Columns},
    fields::{Between, Writing},
};
use crate::load::{lines::shown, units};

/// The most lines of words above the rows: titles, names of columns, their units.
pub(super) const MOST_TITLES: usize = 8;

/// Of the lines of words the last that names x, y and z; else the last.
pub(super) fn header_of<'a>(words: &[(usize, &'a [u8])], writing: Writing) -> Option<(usize, &'a [u8])> {
    words.iter().rev().find(|(_, line)| names_columns(line, writing)).or(words.last()).copied()
}

pub(super) fn names_columns(line: &[u8], writing: Writing) -> bool {
    Columns::new(of_header(line, writing).columns).is_ok()
}

/// Whether the words of a line are units, in brackets or not.
pub(super) fn are_units(line: &[u8], writing: Writing) -> bool {
    let is_unit = |word: &[u8]| {
        let text = word.trim_ascii();
        is_bracketed(text) || UNITS.iter().any(|unit| text.eq_ignore_ascii_case(unit))
    };
    writing.fields(line).all(is_unit)
}

fn is_bracketed(word: &[u8]) -> bool {
    matches!((word.first(), word.last()), (Some(b'['), Some(b']')) | (Some(b'('), Some(b')')))
}

const UNITS: [&[u8]; 8] = [b"m", b"cm", b"mm", b"km", b"ft", b"in", b"-", b""];

/// The columns `C`, what those are called that are not read, and whether x and y are degrees.
pub(super) struct Found<C> {
    pub columns: C,
    pub ignored: Vec<String>,
    pub geographic: bool,
    /// A line in front of the rows tells it.
    pub has_header: bool,
    /// The unit of x, y and z in metres, where each of them names the same.
    pub metres_per_unit: Option<f64>,
}

impl<C> Found<C> {
    /// Columns, and nothing else.
    pub fn of(columns: C) -> Self {
        Self { columns, ignored: Vec::new(), geographic: false, has_header: false, metres_per_unit: None }
    }
}

/// What a line names.
pub(super) fn named(line: &[u8]) -> Found<Vec<Column>> {
    let text = String::from_utf8_lossy(line);
    let names = || text.split([',', ';', '\t', ' ']).map(str::trim).filter(|name| !name.is_empty());
    let mut columns: Vec<Column> = names().map(Column::of_header).collect();
    let has = |axis| columns.contains(&Column::Position(axis));
    let of_degrees = || names().map(Column::of_geographic_header);
    let geographic = !has(0) && !has(1) && of_degrees().flatten().count() == 2;
    if geographic {
        columns = columns.iter().zip(of_degrees()).map(|(other, found)| found.unwrap_or(*other)).collect();
    }
    let others = columns.iter().zip(names()).filter(|(column, _)| **column == Column::Other);
    let ignored = others.map(|(_, name)| format!("column '{}'", shown(name.as_bytes()))).collect();
    let of_places = columns.iter().zip(names()).filter(|(column, _)| matches!(column, Column::Position(_)));
    let mut units = of_places.map(|(_, name)| metres_of(name));
    let first = units.next().flatten();
    let metres_per_unit = first.filter(|_| !geographic && units.all(|unit| unit == first));
    Found { columns, ignored, geographic, has_header: false, metres_per_unit }
}

/// The unit in brackets behind a name, in metres.
fn metres_of(name: &str) -> Option<f64> {
    let (_, unit) = name.split_once(['[', '('])?;
    let unit = unit.split([']', ')']).next()?.trim_matches(['_', ' ']).to_ascii_lowercase();
    units::metres(&unit)
}

/// As [`named`], of a header: blanks may be part of names where something else stands between them.
pub(super) fn of_header(line: &[u8], writing: Writing) -> Found<Vec<Column>> {
    let mut words: Vec<Vec<u8>> = Vec::new();
    for name in (Writing { decimal_comma: false, ..writing }).fields(line) {
        // A name that is empty is one, as that of the row's number in tables of pandas.
        let name = if name.is_empty() { b"-" } else { name };
        let mut word: Vec<u8> = name.iter().map(|b| if *b == b' ' { b'_' } else { *b }).collect();
        match words.last_mut() {
            // Between blanks a unit is no name of its own.
            Some(last) if writing.between == Between::Blanks && is_bracketed(name) => last.append(&mut word),
            _ => words.push(word),
        }
    }
    named(&words.join(&b' '))
}
