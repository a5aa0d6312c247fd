//! Rows `f` as the crate `tobj` reads them: many at once, over vertices and normals whose coordinates are their numbers.
//!
//! The crate gives only the vertices that faces use, in the order of their use, copies of them for each group and material,
//! and takes the normal before where a corner names none, or fails where it names one that is not there. So it is given
//! rows `v` that say which vertex of the file they are, and each corner names a normal that is there, if only that of none.

use std::{fmt::Write as _, io::Read as _, mem};

use glam::DVec3;
use tobj::{LoadError, Mesh};

use super::{lines::shown, rows, vertices::Vertices};

/// The length of a row in [`Block::numbered`].
const NUMBERED_BYTES: usize = "v 4294967295 0 0\n".len();

/// So many corners are read at once, at least.
const CORNERS: usize = 1 << 16;

/// A row `f`.
pub(super) struct Row {
    pub line: u64,
    /// The color of its material.
    pub paint: u32,
    /// It names a normal that is zero, not finite or not there.
    pub has_unusable_normal: bool,
    /// Rows `v` before it.
    vertices: usize,
}

/// Rows `f` one after the other, and the rows `v` between them.
pub(super) struct Block<'a> {
    file: &'a Vertices,
    /// A row `v` for each vertex of the file, whose x is its number.
    numbered: String,
    /// The same of normals, and one more for corners without.
    normals: String,
    text: String,
    pub rows: Vec<Row>,
    corners: usize,
    /// Rows `v` and `vn` so far, from which negative numbers count back.
    so_far: [usize; 2],
}

impl<'a> Block<'a> {
    pub(super) fn new(file: &'a Vertices) -> Self {
        let mut numbered = String::with_capacity(NUMBERED_BYTES * file.positions.len());
        for number in 0..file.positions.len() {
            let _ = writeln!(numbered, "v {number:010} 0 0");
        }
        let mut normals = String::new();
        for number in 0..file.normals.len() + usize::from(!file.normals.is_empty()) {
            let _ = writeln!(normals, "vn {number} 0 0");
        }
        Self { file, numbered, normals, text: String::new(), rows: Vec::new(), corners: 0, so_far: [0; 2] }
    }

    /// A row `v` of the file.
    pub(super) fn vertex(&mut self) {
        let [vertices, _] = self.so_far;
        if !self.rows.is_empty() {
            self.text.push_str(between(&self.numbered, vertices, vertices + 1));
        }
        self.so_far[0] += 1;
    }

    /// A row `vn` of the file.
    pub(super) fn normal(&mut self) {
        self.so_far[1] += 1;
    }

    /// A row `f` of the file: corners `v`, `v/vt`, `v//vn` or `v/vt/vn`.
    ///
    /// # Errors
    /// In words; nothing was added then.
    pub(super) fn face(&mut self, row: &str, line: u64, paint: u32, most: usize) -> Result<(), String> {
        let before = self.text.len();
        let added = self.add(row, line, paint, most);
        if added.is_err() {
            self.text.truncate(before);
        }
        added
    }

    fn add(&mut self, row: &str, line: u64, paint: u32, most: usize) -> Result<(), String> {
        let [vertices, _] = self.so_far;
        let mut face = Row { line, paint, has_unusable_normal: false, vertices };
        self.text.push('f');
        let mut corners = 0;
        for word in row.split_ascii_whitespace() {
            if corners >= most {
                return Err(format!("more than {corners} corners; expected at most that many"));
            }
            corners += 1;
            let mut parts = word.split('/');
            let vertex = parts.next().unwrap_or_default();
            let normal = match (parts.next(), parts.next(), parts.next()) {
                (_, None | Some(""), None) => None,
                (_, Some(normal), None) => {
                    let usable = self.usable(whole("normal", normal)?);
                    face.has_unusable_normal |= usable.is_none();
                    usable
                }
                _ => return Err(format!("a corner '{}'; expected v/vt/vn", shown(word))),
            };
            let _ = if self.file.normals.is_empty() {
                write!(self.text, " {vertex}")
            } else {
                write!(self.text, " {vertex}//{}", normal.unwrap_or(self.file.normals.len()) + 1)
            };
        }
        if corners == 0 {
            return Err("a face without corners; expected 3 or more".to_owned());
        }
        self.text.push('\n');
        self.corners += corners;
        self.rows.push(face);
        Ok(())
    }

    /// Whether it is time to read them. All vertices are read with each block: so there are few blocks where those are many.
    pub(super) fn is_full(&self) -> bool {
        self.corners >= CORNERS.max(self.file.positions.len() + self.file.normals.len())
    }

    /// The number of a normal from 0, if it has a direction.
    fn usable(&self, number: i64) -> Option<usize> {
        let [_, so_far] = self.so_far;
        let usable = |&index: &usize| {
            self.file.normals.get(index).is_some_and(|normal| normal.as_dvec3().try_normalize().is_some())
        };
        counted(number, so_far).filter(usable)
    }

    /// Reads the rows, and is empty then.
    ///
    /// # Errors
    /// The line, and what is wrong there.
    pub(super) fn read(&mut self) -> Result<(Vec<Row>, Corners<'a>), (u64, String)> {
        let [so_far, _] = self.so_far;
        // Without a face no vertex is needed.
        let [before, after] = match self.rows.first() {
            Some(row) => [row.vertices, so_far],
            None => [0, self.file.positions.len()],
        };
        let parts = [
            self.normals.as_str(),
            between(&self.numbered, 0, before),
            &self.text,
            between(&self.numbered, after, self.file.positions.len()),
        ];
        let [normals, before, text, after] = parts.map(str::as_bytes);
        let rows = normals.chain(before).chain(text).chain(after);
        let mesh = rows::mesh(rows).map_err(|error| self.fault(error))?;
        self.text.clear();
        self.corners = 0;
        Ok((mem::take(&mut self.rows), Corners { file: self.file, mesh, next: 0 }))
    }

    /// The first row with a number of a vertex that is none, and what it is.
    fn fault(&self, error: LoadError) -> (u64, String) {
        let total = self.file.positions.len();
        let faces = self.text.lines().filter(|text| text.starts_with('f'));
        for (text, row) in faces.zip(&self.rows) {
            for word in text.split_ascii_whitespace().skip(1) {
                let vertex = match whole("vertex", word.split('/').next().unwrap_or_default()) {
                    Ok(vertex) => vertex,
                    Err(problem) => return (row.line, problem),
                };
                if counted(vertex, row.vertices).is_some_and(|index| index < total) {
                    continue;
                }
                let problem = match total {
                    0 => format!("vertex {vertex}, but the file has none"),
                    _ => format!("vertex {vertex}; expected 1 to {total}, or -{} to -1", row.vertices),
                };
                return (row.line, problem);
            }
        }
        (self.rows.first().map_or(0, |row| row.line), format!("{error}; expected faces"))
    }
}

/// The corners of faces as the crate read them, one face after the other.
pub(super) struct Corners<'a> {
    file: &'a Vertices,
    mesh: Mesh,
    next: usize,
}

impl Corners<'_> {
    /// How many corners the faces have.
    pub(super) fn counts(&self, rows: usize) -> Vec<u32> {
        // The crate says nothing of triangles alone.
        if self.mesh.face_arities.is_empty() { vec![3; rows] } else { self.mesh.face_arities.clone() }
    }

    /// The file's vertex, and the normal of length 1, if the corner has one.
    pub(super) fn next(&mut self) -> Option<(u32, Option<DVec3>)> {
        let number = |indices: &[u32], numbered: &[f64]| {
            numbered.get(3 * *indices.get(self.next)? as usize).map(|number| *number as usize)
        };
        let vertex = number(&self.mesh.indices, &self.mesh.positions)?;
        let normal = number(&self.mesh.normal_indices, &self.mesh.normals);
        let normal = normal.and_then(|normal| self.file.normals.get(normal)?.as_dvec3().try_normalize());
        self.next += 1;
        Some((vertex as u32, normal))
    }
}

/// Some of the rows of [`Block::numbered`].
fn between(numbered: &str, from: usize, to: usize) -> &str {
    numbered.get(NUMBERED_BYTES * from..NUMBERED_BYTES * to).unwrap_or_default()
}

fn whole(what: &str, word: &str) -> Result<i64, String> {
    word.parse().map_err(|_| format!("a corner with {what} '{}'; expected a whole number", shown(word)))
}

/// A number from 1, or counted back from the last of `so_far`, as one from 0.
fn counted(number: i64, so_far: usize) -> Option<usize> {
    match usize::try_from(number) {
        Ok(number) => number.checked_sub(1),
        Err(_) => so_far.checked_sub(usize::try_from(number.unsigned_abs()).ok()?),
    }
}
