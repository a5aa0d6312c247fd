//! Rows of numbers, read in parallel by blocks of lines.

use glam::{DVec3, Vec3};
use rayon::prelude::*;

use super::{
    columns::{Column, SLOTS},
    header::MOST_TITLES,
    layout::{Fault, Layout, Lines, comment_text},
};
use crate::load::{Limits, lines::shown};

/// What rows hold; what is there has one entry a row.
#[derive(Default)]
pub(super) struct Rows {
    pub positions: Vec<DVec3>,
    pub intensities: Vec<f32>,
    pub colors: Vec<[f32; 3]>,
    pub normals: Vec<Vec3>,
    pub radii: Vec<f32>,
    /// How many rows have more numbers than the first.
    pub longer: u64,
    /// Lines of words of which no row is known to follow: sums, and whatever ends a table.
    pub below: Vec<Below>,
    /// Numbers that stand alone in a line: the byte, the number, how many rows stand before it.
    counts: Vec<(usize, f64, u64)>,
}

/// A line that is no row: at which byte, its words, and what is wrong with it.
pub(super) struct Below {
    at: usize,
    pub words: String,
    problem: String,
}

/// About how many bytes are read at once by a thread.
const BLOCK_BYTES: usize = 1 << 20;

/// How many blocks are read between two steps of progress.
const BLOCKS: usize = 64;

/// All rows of a file.
pub(super) fn read(
    bytes: &[u8],
    layout: &Layout,
    limits: &Limits,
    step: impl Fn(usize),
) -> Result<Rows, Fault> {
    let mut rows = Rows::default();
    let mut at = layout.start;
    while at < bytes.len() {
        let mut blocks = Vec::new();
        while at < bytes.len() && blocks.len() < BLOCKS {
            let end = line_end_after(bytes, at.saturating_add(BLOCK_BYTES), layout.line_end);
            blocks.push((at, end));
            at = end;
        }
        let read: Vec<Result<Rows, Fault>> =
            blocks.into_par_iter().map(|(start, end)| block(bytes, start, end, layout, limits)).collect();
        for block in read {
            rows.append(block?)?;
        }
        if rows.positions.len() as u64 > limits.points {
            return Err((layout.start, format!("more than {} rows; expected at most that", limits.points)));
        }
        step(at);
    }
    rows.check_counts()?;
    Ok(rows)
}

/// The first byte behind the line that has the byte `at`.
fn line_end_after(bytes: &[u8], at: usize, line_end: u8) -> usize {
    let rest = bytes.get(at..).unwrap_or_default();
    rest.iter().position(|b| *b == line_end).map_or(bytes.len(), |end| at + end + 1)
}

fn block(bytes: &[u8], start: usize, end: usize, layout: &Layout, limits: &Limits) -> Result<Rows, Fault> {
    let mut rows = Rows::default();
    let slots: Vec<Option<usize>> = layout.columns.columns().iter().map(|column| column.slot()).collect();
    // What the file has before the block keeps the bytes of faults right.
    let bytes = bytes.get(..end).unwrap_or(bytes);
    for line in (Lines { bytes, at: start, line_end: layout.line_end, most: limits.line_bytes }) {
        let (at, line) = line?;
        if line.is_empty() || comment_text(line).is_some() {
            continue;
        }
        match rows.line(at, line, layout, &slots) {
            Ok(()) => rows.refuse_words()?,
            // Rows may end with words, but not with numbers that are too few.
            Err(problem) if is_words(line, layout) && rows.below.len() < MOST_TITLES => {
                rows.below.push(Below { at, words: shown(line), problem });
            }
            Err(problem) => return Err(rows.below.first().map_or((at, problem), Below::fault)),
        }
    }
    Ok(rows)
}

/// Whether a word stands for a number that is not there, as tables have it.
fn is_missing(word: &[u8]) -> bool {
    ["", "\"\"", "NA", "N/A", "null", "none", "-"]
        .iter()
        .any(|name| word.eq_ignore_ascii_case(name.as_bytes()))
}

/// Whether a line starts with a word that is no number, and none that stands for one.
fn is_words(line: &[u8], layout: &Layout) -> bool {
    let first = layout.writing.fields(line).next();
    first.is_some_and(|word| layout.writing.number(word).is_none() && !is_missing(word))
}

impl Below {
    fn fault(&self) -> Fault {
        (self.at, self.problem.clone())
    }
}

impl Rows {
    fn line(
        &mut self,
        at: usize,
        line: &[u8],
        layout: &Layout,
        slots: &[Option<usize>],
    ) -> Result<(), String> {
        let mut values = [0.0; SLOTS];
        let mut fields = layout.writing.fields(line);
        for (i, slot) in slots.iter().enumerate() {
            let Some(word) = fields.next() else {
                let first = layout.writing.fields(line).next().filter(|_| i == 1 && layout.counted);
                if let Some(count) = first.and_then(|word| layout.writing.number(word)) {
                    self.counts.push((at, count, self.positions.len() as u64));
                    return Ok(());
                }
                if i + 1 == slots.len() && layout.writing.ends_empty(line) {
                    if let Some(value) = slot.and_then(|slot| values.get_mut(slot)) {
                        *value = f64::NAN;
                    }
                    break;
                }
                let s = if i == 1 { "" } else { "s" };
                return Err(format!("{i} number{s} in a row; expected {}", slots.len()));
            };
            if let Some(value) = slot.and_then(|slot| values.get_mut(slot)) {
                *value = layout
                    .writing
                    .number(word)
                    .or_else(|| is_missing(word).then_some(f64::NAN))
                    .ok_or_else(|| format!("'{}' in column {}; expected a number", shown(word), i + 1))?;
            }
        }
        self.longer += u64::from(layout.ignored.is_empty() && fields.next().is_some());
        let [x, y, z, intensity, r, g, b, nx, ny, nz, radius] = values;
        self.positions.push(DVec3::new(x, y, z));
        let has = |column| layout.columns.has(column);
        if has(Column::Intensity) {
            self.intensities.push(intensity as f32);
        }
        if has(Column::Color(0)) {
            self.colors.push([r as f32, g as f32, b as f32]);
        }
        if has(Column::Normal(0)) {
            self.normals.push(DVec3::new(nx, ny, nz).as_vec3());
        }
        if has(Column::Radius) {
            self.radii.push(radius as f32);
        }
        Ok(())
    }

    /// Refuses words that rows follow.
    pub fn refuse_words(&self) -> Result<(), Fault> {
        self.below.first().map_or(Ok(()), |words| Err(words.fault()))
    }

    fn append(&mut self, mut next: Self) -> Result<(), Fault> {
        if !next.positions.is_empty() || !next.counts.is_empty() {
            self.refuse_words()?;
        }
        self.below.append(&mut next.below);
        if self.below.len() > MOST_TITLES {
            self.refuse_words()?;
        }
        let before = self.positions.len() as u64;
        self.counts.extend(next.counts.iter().map(|&(at, count, rows)| (at, count, before + rows)));
        self.positions.append(&mut next.positions);
        self.intensities.append(&mut next.intensities);
        self.colors.append(&mut next.colors);
        self.normals.append(&mut next.normals);
        self.radii.append(&mut next.radii);
        self.longer += next.longer;
        Ok(())
    }

    /// Each number that stands alone is how many rows follow it.
    fn check_counts(&self) -> Result<(), Fault> {
        let ends =
            self.counts.iter().skip(1).map(|(_, _, before)| *before).chain([self.positions.len() as u64]);
        for (&(at, count, before), end) in self.counts.iter().zip(ends) {
            let rows = end - before;
            if count != rows as f64 {
                return Err((at, format!("{count} rows are said to follow, but {rows} do")));
            }
        }
        Ok(())
    }
}
