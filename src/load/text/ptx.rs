//! PTX, as Leica's programs write it: scans one behind the other, each with numbers of columns and rows, the scanner's place and axes, the matrix
//! that takes its points to the place of all, and a row a ray: x, y, z, an intensity from 0 to 1, and red, green and blue where it has colors. A ray that met
//! nothing has zeros.

use glam::{DMat4, DVec3, DVec4};

use super::{
    columns::Columns,
    fields::{Between, Writing},
    layout::{Fault, Layout, Lines},
    rows::{self, Rows},
};
use crate::{
    error::Result,
    load::{Input, Loaded, Model, lines::shown, shade},
    notes::{Deed, counted},
    scene::{Colors, Points, Viewpoint},
};

/// The numbers in the lines of a scan's header.
const HEADER: [usize; 10] = [1, 1, 3, 3, 3, 3, 4, 4, 4, 4];

const WRITING: Writing = Writing { between: Between::Blanks, decimal_comma: false };

/// Whether a file begins with two counts and a place, which no other rows do.
pub(super) fn is_ptx(bytes: &[u8], most: usize) -> bool {
    let mut lines = lines(bytes, 0, most);
    HEADER.iter().take(3).all(|width| {
        let Some(Ok((_, line))) = lines.next() else { return false };
        let mut words = 0;
        WRITING.fields(line).all(|word| {
            words += 1;
            WRITING.number(word).is_some()
        }) && words == *width
    })
}

pub(super) fn parse(input: &Input<'_>) -> Result<Loaded> {
    let fault = |(at, problem): Fault| input.fault(input.line(at), problem);
    let mut scans = Scans::default();
    let (mut at, mut count) = (0, 0);
    while let Some(begin) = next_line(input.bytes, at) {
        at = scans.add(input, begin).map_err(fault)?;
        count += 1;
    }
    Ok(scans.loaded(count))
}

/// The byte of the next line that is not empty.
fn next_line(bytes: &[u8], at: usize) -> Option<usize> {
    let rest = bytes.get(at..)?;
    rest.iter().position(|byte| !byte.is_ascii_whitespace()).map(|blanks| at + blanks)
}

fn lines(bytes: &[u8], at: usize, most: usize) -> Lines<'_> {
    Lines { bytes, at, line_end: b'\n', most }
}

/// All that was read.
#[derive(Default)]
struct Scans {
    positions: Vec<DVec3>,
    viewpoints: Vec<Viewpoint>,
    intensities: Vec<f32>,
    colors: Vec<[f32; 3]>,
    /// Some scan has no colors.
    lacks_colors: bool,
    nothing_met: u64,
}

impl Scans {
    /// Adds the scan that begins at a byte; returns the byte behind it.
    fn add(&mut self, input: &Input<'_>, begin: usize) -> std::result::Result<usize, Fault> {
        let limits = &input.options.limits;
        let mut all = lines(input.bytes, begin, limits.line_bytes);
        let mut numbers = [[0.0; 4]; HEADER.len()];
        for (row, width) in numbers.iter_mut().zip(HEADER) {
            let Some(line) = all.next() else {
                return Err((begin, "the file ends within a scan's header of 10 lines".to_owned()));
            };
            let (at, line) = line?;
            let mut words = WRITING.fields(line);
            for number in row.iter_mut().take(width) {
                let word = words.next().unwrap_or_default();
                let found = WRITING.number(word).filter(|number| number.is_finite());
                let expected = || format!("'{}' in a scan's header; expected {width} numbers", shown(word));
                *number = found.ok_or_else(|| (at, expected()))?;
            }
        }
        let [[columns, ..], [rows, ..], _, _, _, _, matrix @ ..] = numbers;
        let is_count = |number: f64| number >= 0.0 && number.fract() == 0.0;
        let count = columns * rows;
        if !is_count(columns) || !is_count(rows) || count > limits.points as f64 {
            let most = limits.points;
            return Err((begin, format!("a scan of {columns} by {rows} points; expected {most} at most")));
        }
        let start = all.at;
        let end = behind_lines(input.bytes, start, count as u64).map_err(|found| {
            let lines = counted(found, "lines");
            (begin, format!("{count} points are said to follow, but the file has {lines} for them"))
        })?;
        let first = lines(input.bytes, start, limits.line_bytes).next().transpose()?.map(|(_, line)| line);
        let width = first.map_or(4, |line| WRITING.fields(line).count());
        let names = if width >= 7 { "x,y,z,i,r,g,b" } else { "x,y,z,i" };
        let layout = Layout {
            writing: WRITING,
            columns: names.parse().unwrap_or_else(|_| Columns::default()),
            geographic: false,
            metres_per_unit: None,
            ignored: Vec::new(),
            titles: 0,
            start,
            counted: false,
            line_end: b'\n',
        };
        let bytes = input.bytes.get(..end).unwrap_or(input.bytes);
        let found = rows::read(bytes, &layout, limits, |done| input.step(done))?;
        found.refuse_words()?;
        self.place(&found, DMat4::from_cols_array_2d(&matrix));
        if self.positions.len() as u64 > limits.points {
            return Err((begin, format!("more than {} points; expected at most that", limits.points)));
        }
        Ok(end)
    }

    /// Adds the points of a scan. The matrix stands row by row, for points that are rows before it.
    fn place(&mut self, rows: &Rows, world_from_scan: DMat4) {
        self.lacks_colors |= rows.colors.is_empty() && !rows.positions.is_empty();
        for (i, position) in rows.positions.iter().enumerate() {
            if *position == DVec3::ZERO {
                self.nothing_met += 1;
                continue;
            }
            self.positions.push((world_from_scan * position.extend(1.0)).truncate());
            self.intensities.extend(rows.intensities.get(i));
            self.colors.extend(rows.colors.get(i));
        }
        let place = (world_from_scan * DVec4::W).truncate();
        self.viewpoints.push(Viewpoint { end: self.positions.len(), place });
    }

    fn loaded(self, count: usize) -> Loaded {
        let has_colors = !self.lacks_colors && !self.colors.is_empty();
        let ((colors, outside), what) = match has_colors {
            true => (shade::from_srgb(&self.colors, 255.0), ""),
            false => (shade::gray(&self.intensities), ", intensity as gray"),
        };
        let s = if count == 1 { "" } else { "s" };
        let mut loaded = Loaded::new(
            Model::Points(Points {
                positions: self.positions,
                normals: None,
                radii: None,
                radii_in_doubt: false,
                colors: Colors::Each(colors),
                viewpoints: self.viewpoints,
            }),
            format!("PTX, {count} scan{s}{what}"),
        );
        loaded.up = Some(DVec3::Z);
        // Leica's description says so.
        loaded.metres_per_unit = Some(1.0);
        loaded.note(Deed::Dropped, self.nothing_met, "rays that met nothing");
        loaded.note(Deed::Clamped, outside, "points with a color out of its range");
        let unused = if has_colors { 0 } else { self.colors.len() as u64 };
        loaded.note(Deed::Ignored, unused, "colors of scans beside others that have none");
        loaded
    }
}

/// The byte behind so many lines that are not empty, or how many there are.
fn behind_lines(bytes: &[u8], mut at: usize, count: u64) -> std::result::Result<usize, u64> {
    for found in 0..count {
        at = next_line(bytes, at).ok_or(found)?;
        let rest = bytes.get(at..).unwrap_or_default();
        at += rest.iter().position(|byte| *byte == b'\n').map_or(rest.len(), |end| end + 1);
    }
    Ok(at)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::load::{hostile::attack, input::of_bytes, text};

    /// A scan of so many columns and two rows, turned by 90° about z and moved.
    fn scan(columns: usize, of_all: &str, rows: &[&str]) -> String {
        let header = "2\n1 2 3\n0 1 0\n-1 0 0\n0 0 1\n0 1 0 0\n-1 0 0 0\n0 0 1 0\n1 2 3 1\n";
        let rows: Vec<String> = rows.iter().map(|row| format!("{row}{of_all}\n")).collect();
        format!("{columns}\n{header}{}", rows.concat())
    }

    fn read(text: &str) -> Result<Loaded> {
        of_bytes("a.ptx", text.as_bytes(), text::parse)
    }

    const ROWS: [&str; 4] = ["1 0 0 0.5", "0 0 0 0.5", "0 2 0 1", "0 0 4 0"];

    #[test]
    fn scans_lie_where_their_matrices_put_them() {
        let text = format!("{}{}", scan(2, " 255 0 0", &ROWS), scan(1, " 0 255 0", &ROWS[2..]));
        for text in [text.clone(), text.replace('\n', "\r\n"), text.replace("\n1\n2\n", "\n\n1\n2\n")] {
            let loaded = read(&text).unwrap();
            assert_eq!((loaded.format.as_str(), loaded.up), ("PTX, 2 scans", Some(DVec3::Z)));
            assert_eq!(loaded.notes[0].to_string(), "1 ray that met nothing left out");
            let Model::Points(points) = loaded.model else { panic!("no points") };
            let expected = [[1, 3, 3], [-1, 2, 3], [1, 2, 7], [-1, 2, 3], [1, 2, 7]];
            assert_eq!(points.positions, expected.map(|at| DVec3::from(at.map(f64::from))));
            let place = DVec3::new(1.0, 2.0, 3.0);
            assert_eq!(points.viewpoints, [Viewpoint { end: 3, place }, Viewpoint { end: 5, place }]);
            assert_eq!(points.colors.get(4), Some([0.0, 1.0, 0.0, 1.0]));
        }
    }

    #[test]
    fn intensities_are_grays_where_a_scan_has_no_colors() {
        let loaded = read(&format!("{}{}", scan(2, " 255 0 0", &ROWS), scan(2, "", &ROWS))).unwrap();
        assert_eq!(loaded.format, "PTX, 2 scans, intensity as gray");
        let told: Vec<String> = loaded.notes.iter().map(ToString::to_string).collect();
        assert_eq!(
            told,
            ["2 rays that met nothing left out", "3 colors of scans beside others that have none ignored"]
        );
    }

    #[test]
    fn what_is_no_scan_is_told_by_its_line() {
        let whole = scan(2, "", &ROWS);
        let refuses = |text: &str, expected: &str| {
            assert_eq!(read(text).unwrap_err().to_string(), format!("a.ptx: {expected}"));
        };
        refuses(
            &scan(3, "", &ROWS),
            "line 1: 6 points are said to follow, but the file has 4 lines for them",
        );
        refuses(
            &scan(3, "", &ROWS[..1]),
            "line 1: 6 points are said to follow, but the file has 1 line for them",
        );
        refuses(&whole.replace("0 0 4 0", "0 0 x 0"), "line 14: 'x' in column 3; expected a number");
        refuses(&format!("{whole}2\n1\n"), "line 15: the file ends within a scan's header of 10 lines");
        refuses(
            &whole.replace("-1 0 0 0\n", "-1 0 0\n"),
            "line 8: '' in a scan's header; expected 4 numbers",
        );
        refuses(
            &whole.replacen("2\n2\n", "4000000000\n4000000000\n", 1),
            "line 1: a scan of 4000000000 by 4000000000 points; expected 4294967295 at most",
        );
        refuses(
            &whole.replacen("2\n", "-2\n", 1),
            "line 1: a scan of -2 by 2 points; expected 4294967295 at most",
        );
        attack(&[whole.into_bytes(), scan(1, " 0 255 0", &ROWS[2..]).into_bytes()], 20_000, text::parse);
    }
}
