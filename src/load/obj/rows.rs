//! Rows `v` and `vn` as the crate `tobj` reads them: many at once.
//!
//! The crate gives only what faces use: so one polygon has them all as its corners, in their order. It moves colors that only
//! some vertices have to others: so rows with colors and rows without are not read together. It names no line: so where
//! it refuses some rows, it is asked row by row.

use std::{
    fmt::Write as _,
    io::{BufRead, Read as _},
    path::Path,
};

use tobj::{LoadError, LoadOptions, Mesh};

use super::lines::shown;

/// How many rows are read at once.
const MOST: usize = 512;

/// What the crate finds in rows `v`, `vn` and `f`.
pub(super) fn mesh(mut rows: impl BufRead) -> Result<Mesh, LoadError> {
    let no_materials = |_: &Path| Err(LoadError::OpenFileFailed);
    let (models, _) = tobj::load_obj_buf(&mut rows, &LoadOptions::default(), no_materials)?;
    models.into_iter().next().map(|model| model.mesh).ok_or(LoadError::GenericFailure)
}

/// Rows one after the other: either all of the vertices have colors, or none.
#[derive(Default)]
pub(super) struct Rows {
    text: String,
    /// Where each row begins in the file.
    lines: Vec<u64>,
    /// How many are `v`, and how many `vn`.
    pub counts: [usize; 2],
    have_colors: bool,
}

impl Rows {
    /// Whether they must be read before a row `v` is added.
    pub(super) fn differ_from(&self, row: &str) -> bool {
        self.counts[0] > 0 && has_color(row) != self.have_colors
    }

    pub(super) fn is_full(&self) -> bool {
        self.lines.len() >= MOST
    }

    /// Adds a row `v`.
    pub(super) fn vertex(&mut self, row: &str, line: u64) {
        self.have_colors = has_color(row);
        self.text.extend(["v ", row, "\n"]);
        self.lines.push(line);
        self.counts[0] += 1;
    }

    /// Adds a row `vn`.
    pub(super) fn normal(&mut self, row: &str, line: u64) {
        self.text.extend(["vn ", row, "\n"]);
        self.lines.push(line);
        self.counts[1] += 1;
    }

    /// Positions, normals and colors of the rows, which are none then.
    ///
    /// # Errors
    /// The line, and what is wrong there.
    pub(super) fn read(&mut self) -> Result<Mesh, (u64, String)> {
        let mesh = of(&self.text, self.counts).map_err(|error| self.fault(error))?;
        self.text.clear();
        self.lines.clear();
        self.counts = [0; 2];
        Ok(mesh)
    }

    /// The first row that the crate refuses by itself.
    fn fault(&self, error: LoadError) -> (u64, String) {
        for (row, &line) in self.text.lines().zip(&self.lines) {
            let (counts, expected) = match row.starts_with("vn") {
                true => ([0, 1], "vn x y z"),
                false => ([1, 0], "v x y z, with nothing, w, or r g b after it"),
            };
            if let Err(error) = of(row, counts) {
                return (line, format!("'{}': {error}; expected {expected}", shown(row)));
            }
        }
        (self.lines.first().copied().unwrap_or_default(), error.to_string())
    }
}

fn has_color(row: &str) -> bool {
    row.split_whitespace().nth(4).is_some()
}

/// What rows `v` and `vn` say, of which there are so many.
fn of(rows: &str, [vertices, normals]: [usize; 2]) -> Result<Mesh, LoadError> {
    // A corner needs a vertex.
    let first = if vertices == 0 { "v 0 0 0\n" } else { "" };
    let mut polygon = "\nf".to_owned();
    for corner in 1..=vertices.max(normals) {
        let vertex = corner.min(vertices.max(1));
        let _ = match normals {
            0 => write!(polygon, " {vertex}"),
            _ => write!(polygon, " {vertex}//{}", corner.min(normals)),
        };
    }
    let mut mesh = mesh(first.as_bytes().chain(rows.as_bytes()).chain(polygon.as_bytes()))?;
    mesh.positions.truncate(3 * vertices);
    Ok(mesh)
}
