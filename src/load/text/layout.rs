//! What a file of rows is made of: how its numbers are written, where its rows start and what its columns are.
//!
//! Columns are those that the user gives, or else those that a header names, or else, by their number:
//!
//! | columns | taken as |
//! |---|---|
//! | 3 | x y z |
//! | 4 | x y z, intensity |
//! | 6 | x y z, and red green blue, or a normal if the numbers are of length 1 or below 0 |
//! | 7 | x y z, intensity, red green blue; or a normal of length 1 and what is not read; or red green blue and an alpha that is 1 or 255 in all rows or a label of few values, which is not read |
//! | 8 | x y z, red green blue and two labels, which are not read |
//! | 9 | x y z, red green blue and a normal, in either order |
//! | 10 | x y z, intensity, red green blue and a normal, in either order |
//! | others | x y z; the others are not read |
//!
//! of those that are left by [`by_numbers`]. Lines of `points3D.txt`, as COLMAP writes it, are a number, x y z, red green blue and more.

use super::{
    by_numbers,
    columns::{Column, Columns},
    fields::Writing,
    header::{Found, MOST_TITLES, are_units, header_of, named, names_columns, of_header},
};
use crate::load::{Input, lines::shown, sniff::without_mark, units};

/// What a file of rows is made of.
pub(super) struct Layout {
    pub writing: Writing,
    pub columns: Columns,
    /// x and y are longitude and latitude in degrees.
    pub geographic: bool,
    /// The unit of x, y and z in metres, where a header names it.
    pub metres_per_unit: Option<f64>,
    /// What the columns that are not read are called, or how many there are.
    pub ignored: Vec<String>,
    /// How many lines of words stand above the rows, a header that names columns aside.
    pub titles: u64,
    /// The byte at which the first line of data starts: a row, or a number of rows.
    pub start: usize,
    /// The first line of data is a number of rows.
    pub counted: bool,
    /// What ends a line.
    pub line_end: u8,
}

/// How many rows are looked at to tell what columns are.
const SAMPLES: usize = 1000;

/// A problem, and the byte of the line that it is in.
pub(super) type Fault = (usize, String);

/// The file's layout.
pub(super) fn layout(input: &Input<'_>) -> Result<Layout, Fault> {
    let line_end = if input.bytes.contains(&b'\n') { b'\n' } else { b'\r' };
    let (mut comment, mut count, mut of_colmap) = (None, None, false);
    let mut words: Vec<(usize, &[u8])> = Vec::new();
    let most = input.options.limits.line_bytes;
    let start = input.bytes.len() - without_mark(input.bytes).len();
    for line in (Lines { bytes: input.bytes, at: start, line_end, most }) {
        let (at, line) = line?;
        // What names a unit names no columns.
        if line.is_empty() || units::of_line(line).is_some() {
            continue;
        }
        if let Some(text) = comment_text(line) {
            of_colmap |= text.trim_ascii_start().starts_with(b"POINT3D_ID");
            comment = Some(text);
            continue;
        }
        // How programs of tables tell each other what stands between words.
        if line.get(..4).is_some_and(|start| start.eq_ignore_ascii_case(b"sep=")) && words.is_empty() {
            continue;
        }
        let writing = Writing::of(line);
        let is_alone = writing.fields(line).nth(1).is_none();
        let header = header_of(&words, writing);
        let place =
            if is_alone { 0 } else { first_read(input, header.map(|(_, line)| line), comment, writing) };
        let first = writing.fields(line).nth(place).or(writing.fields(line).next()).unwrap_or_default();
        let rest = Lines { bytes: input.bytes, at, line_end, most };
        let is_row = writing.number(first).is_some() || words.is_empty() && is_row_with_words(writing, rest)?;
        // Behind the names of columns there may be their units, and else rows.
        let names_columns = || words.last().is_some_and(|(_, line)| names_columns(line, writing));
        let is_wrong = !is_row && !are_units(line, writing) && names_columns();
        match (is_row, is_alone) {
            (true, true) if count.is_none() => count = Some((at, line)),
            (true, true) => {
                return Err((at, "a second line of one number; expected rows of x y z".to_owned()));
            }
            (true, false) => {
                let start = count.map_or(at, |(at, _)| at);
                let Found { columns, ignored, geographic, has_header, metres_per_unit } =
                    match of_colmap && input.options.columns.is_none() {
                        true => colmap(),
                        false => columns(input, writing, at, header, comment, rest)?,
                    };
                let counted = count.is_some();
                let titles = words.len() as u64 - u64::from(has_header);
                return Ok(Layout {
                    writing,
                    columns,
                    geographic,
                    metres_per_unit,
                    ignored,
                    titles,
                    start,
                    counted,
                    line_end,
                });
            }
            (false, _) if words.len() < MOST_TITLES && count.is_none() && !is_wrong => words.push((at, line)),
            (false, _) => return Err((at, format!("'{}'; expected a number", shown(first)))),
        }
    }
    match (words.first(), count) {
        (Some(&(at, line)), _) => Err((at, format!("'{}'; expected rows of numbers", shown(line)))),
        (None, Some((at, line))) => Err((at, format!("'{}' and no rows; expected x y z", shown(line)))),
        (None, None) => Err((0, "no rows of numbers; expected x y z".to_owned())),
    }
}

/// Whether a line has words and three numbers or more, and the next line has them in the same places: no header has.
fn is_row_with_words(writing: Writing, lines: Lines<'_>) -> Result<bool, Fault> {
    let mut kinds = Vec::new();
    for line in lines {
        let (_, line) = line?;
        if !line.is_empty() && comment_text(line).is_none() {
            kinds.push(writing.fields(line).map(|word| writing.number(word).is_some()).collect::<Vec<_>>());
        }
        if let [first, second] = &kinds[..] {
            return Ok(first == second && first.iter().filter(|is_number| **is_number).count() >= 3);
        }
    }
    Ok(false)
}

/// The columns of `points3D.txt`, by its description in COLMAP's documentation.
fn colmap() -> Found<Columns> {
    let columns = "-,x,y,z,r,g,b".parse().unwrap_or_else(|_| Columns::default());
    Found { ignored: vec!["errors and tracks".to_owned()], ..Found::of(columns) }
}

fn too_long(most: usize) -> String {
    format!("a line of more than {most} bytes; expected a row of numbers")
}

/// The text of a comment.
pub(super) fn comment_text(line: &[u8]) -> Option<&[u8]> {
    [&b"#"[..], b"//", b"%"].iter().find_map(|mark| line.strip_prefix(*mark))
}

/// The place in a row of the first number that is read; what stands before it, a time or a name, may be anything.
fn first_read(input: &Input<'_>, header: Option<&[u8]>, comment: Option<&[u8]>, writing: Writing) -> usize {
    let named = || match header {
        Some(line) => Some(of_header(line, writing).columns),
        // Not every comment names columns.
        None => {
            comment.map(|text| named(text).columns).filter(|columns| Columns::new(columns.clone()).is_ok())
        }
    };
    let columns = input.options.columns.as_ref().map(|given| given.columns().to_vec()).or_else(named);
    let is_read = |column: &Column| *column != Column::Other;
    columns.and_then(|columns| columns.iter().position(is_read)).unwrap_or(0)
}

fn columns(
    input: &Input<'_>,
    writing: Writing,
    at: usize,
    header: Option<(usize, &[u8])>,
    comment: Option<&[u8]>,
    mut rows: Lines<'_>,
) -> Result<Found<Columns>, Fault> {
    let first = rows.next().transpose()?.map(|(_, line)| line).unwrap_or_default();
    let width = writing.fields(first).count();
    if let Some(given) = &input.options.columns {
        let behind = width.saturating_sub(given.columns().len());
        // Those that the user names `-` are ignored by their own word.
        let ignored = vec![format!("column {}", given.columns().len() + 1); behind.min(1)];
        // A header is, then, no title.
        let has_header = header.is_some();
        return Ok(Found { ignored, has_header, ..Found::of(given.clone()) });
    }
    if let Some((at, line)) = header {
        let Found { columns, ignored, geographic, metres_per_unit, .. } = of_header(line, writing);
        // A line of another number of words, without names of columns, is a title.
        let is_title = columns.len() != width && columns.iter().all(|column| *column == Column::Other);
        if !is_title {
            let columns = Columns::new(columns)
                .map_err(|problem| (at, format!("header: {problem}, or --columns to name them")))?;
            return Ok(Found { columns, ignored, geographic, has_header: true, metres_per_unit });
        }
    }
    if let Some(Found { columns, ignored, geographic, has_header, metres_per_unit }) = comment.map(named)
        && columns.len() == width
        && let Ok(columns) = Columns::new(columns)
    {
        return Ok(Found { columns, ignored, geographic, has_header, metres_per_unit });
    }
    let samples = samples(writing, width, Lines { at, ..rows })?;
    let columns = by_numbers::columns(width, &samples);
    let ignored = (1..).zip(&columns).filter(|(_, column)| **column == Column::Other);
    let ignored = ignored.map(|(i, _)| format!("column {i}")).collect();
    match Columns::new(columns) {
        Ok(columns) => Ok(Found { ignored, ..Found::of(columns) }),
        Err(_) => Err((at, format!("{width} numbers in a row; expected at least 3"))),
    }
}

/// Rows from the start and from all over the file; those that are wrong are left to their reader, but for a line that is
/// too long: it would be looked at again and again.
fn samples(writing: Writing, width: usize, lines: Lines<'_>) -> Result<Vec<Vec<Option<f64>>>, Fault> {
    let row = |line: &[u8]| {
        let row: Vec<Option<f64>> = writing.fields(line).map(|word| writing.number(word)).collect();
        (row.len() == width && comment_text(line).is_none()).then_some(row)
    };
    // A row of more columns has no rule.
    if width > 10 {
        return Ok(Vec::new());
    }
    let mut rows = Vec::new();
    for line in lines.take(SAMPLES / 2) {
        rows.extend(row(line?.1));
    }
    let length = lines.bytes.len() - lines.at;
    for i in 1..SAMPLES / 2 {
        // The line that is there is cut; the next one is whole.
        let mut there = Lines { at: lines.at + length / (SAMPLES / 2) * i, ..lines };
        there.next().transpose()?;
        if let Some((_, line)) = there.next().transpose()? {
            rows.extend(row(line));
        }
    }
    Ok(rows)
}

/// The lines of a file, without blanks around them, and the bytes at which they start. One that is too long, with its
/// blanks, is a fault, and no more of it is looked at.
#[derive(Clone, Copy)]
pub(super) struct Lines<'a> {
    pub bytes: &'a [u8],
    pub at: usize,
    pub line_end: u8,
    /// The most bytes of a line.
    pub most: usize,
}

impl<'a> Iterator for Lines<'a> {
    type Item = Result<(usize, &'a [u8]), Fault>;

    #[inline]
    fn next(&mut self) -> Option<Self::Item> {
        let rest = self.bytes.get(self.at..).filter(|rest| !rest.is_empty())?;
        let at = self.at;
        let window = rest.get(..=self.most).unwrap_or(rest);
        let line = window.split(|b| *b == self.line_end).next().unwrap_or_default();
        self.at += line.len() + 1;
        if line.len() > self.most {
            return Some(Err((at, too_long(self.most))));
        }
        Some(Ok((at, line.trim_ascii())))
    }
}
