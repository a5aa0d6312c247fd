//! The colors of materials, from the files that `mtllib` rows name.

use std::{
    collections::{HashMap, HashSet},
    fs,
    path::{Path, PathBuf},
};

use super::lines::Lines;
use crate::{
    error::Result,
    load::{
        Input,
        beside::{self, Refusal},
    },
    math::srgb::linear_from_srgb,
};

/// How many `mtllib` rows are followed, and how long the files may be.
const MOST_LIBRARIES: u64 = 64;
const MOST_LIBRARY_BYTES: u64 = 16 << 20;

/// How many bytes of rows are parsed at once, up to the end of a material.
const BLOCK_BYTES: usize = 1 << 16;

/// What is drawn of a material.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Material {
    /// `Kd`, linear.
    pub color: Option<[f32; 4]>,
    /// It has a `map_Kd`.
    pub has_texture: bool,
    /// `d` or `Tr` make it transparent.
    pub is_transparent: bool,
}

/// All materials that a file names, and what could not be read of them.
#[derive(Debug, Default)]
pub(super) struct Materials {
    named: HashMap<String, Material>,
    /// The files that were read.
    read: HashSet<PathBuf>,
    rows: u64,
    /// Files in other folders.
    pub outside: u64,
    /// Files that are not there, are too long, are too many or are no text.
    pub unreadable: u64,
    /// `Kd` rows that are no three numbers.
    pub strange_colors: u64,
}

impl Materials {
    pub(super) fn get(&self, name: &str) -> Option<&Material> {
        self.named.get(name)
    }

    /// Reads the file of a `mtllib` row, or the files: names may have blanks, and a row may have several names.
    pub(super) fn read_library(&mut self, input: &Input<'_>, names: &str) {
        self.rows += 1;
        let Some(folder) = input.folder.filter(|_| self.rows <= MOST_LIBRARIES) else {
            self.unreadable += 1;
            return;
        };
        let find = |name: &str| beside::find(folder, name, input.options.allow_outside);
        match find(names) {
            Ok(path) => self.read_file(input, path),
            Err(_) => {
                for name in names.split_ascii_whitespace().take(MOST_LIBRARIES as usize) {
                    match find(name) {
                        Ok(path) => self.read_file(input, path),
                        Err(Refusal::Missing(..)) => self.unreadable += 1,
                        Err(Refusal::Rooted | Refusal::Outside) => self.outside += 1,
                    }
                }
            }
        }
    }

    fn read_file(&mut self, input: &Input<'_>, path: PathBuf) {
        if !self.read.contains(&path) {
            self.unreadable += u64::from(self.read_path(input, &path).is_none());
            self.read.insert(path);
        }
    }

    /// `None` where the file can't be read whole.
    fn read_path(&mut self, input: &Input<'_>, path: &Path) -> Option<()> {
        let metadata = fs::metadata(path).ok()?;
        if !metadata.is_file() || metadata.len() > MOST_LIBRARY_BYTES {
            return None;
        }
        let bytes = fs::read(path).ok()?;
        self.read_bytes(&Input { path, bytes: &bytes, ..*input }).ok()
    }

    /// The rows of a file that tell colors.
    ///
    /// The crate that parses them refuses a file for one row, panics where a `Kd` has two numbers, and holds half a
    /// kilobyte for a material: what it gets is sound, and a block at a time.
    pub(super) fn read_bytes(&mut self, input: &Input<'_>) -> Result<()> {
        let mut lines = Lines::new(input);
        let (mut block, mut has_name) = (String::new(), false);
        while let Some(line) = lines.next()? {
            let rest = line.rest().map_err(|problem| lines.fault(problem))?;
            match line.keyword() {
                b"newmtl" => {
                    if block.len() >= BLOCK_BYTES {
                        self.add(input, &block)?;
                        block.clear();
                    }
                    has_name = !rest.is_empty();
                    if has_name {
                        block.extend(["newmtl ", rest, "\n"]);
                    }
                }
                _ if !has_name => {}
                b"Kd" => match color(rest) {
                    Some([r, g, b]) => block.extend(["Kd ", r, " ", g, " ", b, "\n"]),
                    None => self.strange_colors += 1,
                },
                b"map_Kd" if !rest.is_empty() => block.extend(["map_Kd ", rest, "\n"]),
                b"d" if is_number(rest) => block.extend(["d ", rest, "\n"]),
                b"Tr" if is_number(rest) => block.extend(["Tr ", rest, "\n"]),
                _ => {}
            }
        }
        self.add(input, &block)
    }

    /// Adds the materials of sound rows.
    fn add(&mut self, input: &Input<'_>, rows: &str) -> Result<()> {
        let (materials, _) =
            tobj::load_mtl_buf(&mut rows.as_bytes()).map_err(|e| input.fault("", e.to_string()))?;
        for tobj::Material { name, diffuse, dissolve, diffuse_texture, unknown_param, .. } in materials {
            // The crate knows no `Tr`.
            let transparency: Option<f64> = unknown_param.get("Tr").and_then(|tr| tr.parse().ok());
            let linear = |value: f64| linear_from_srgb(value.clamp(0.0, 1.0) as f32);
            let material = Material {
                color: diffuse.map(|[r, g, b]| [linear(r), linear(g), linear(b), 1.0]),
                has_texture: diffuse_texture.is_some(),
                is_transparent: dissolve.is_some_and(|d| d < 1.0) || transparency.is_some_and(|tr| tr > 0.0),
            };
            self.named.insert(name, material);
        }
        Ok(())
    }
}

/// `r g b`, or one number for all: sRGB values, as the programs show them that write these files.
fn color(row: &str) -> Option<[&str; 3]> {
    let words: Vec<&str> = row.split_ascii_whitespace().take(4).collect();
    let color = match *words.as_slice() {
        [gray] => [gray; 3],
        [r, g, b] => [r, g, b],
        _ => return None,
    };
    color.into_iter().all(is_number).then_some(color)
}

fn is_number(word: &str) -> bool {
    word.parse().is_ok_and(f64::is_finite)
}
