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
    pub(super) fn read_bytes(&mut self, input: &Input<'_>) -> Result<()> {
        let mut lines = Lines::new(input);
        let mut current: Option<(String, Material)> = None;
        while let Some(line) = lines.next()? {
            let rest = line.rest().map_err(|problem| lines.fault(problem))?;
            let material = current.as_mut().map(|(_, material)| material);
            match (line.keyword(), material) {
                (b"newmtl", _) => {
                    let last = current.replace((rest.to_owned(), Material::default()));
                    self.named.extend(last);
                }
                (b"Kd", Some(material)) => match color(rest) {
                    Some(color) => material.color = Some(color),
                    None => self.strange_colors += 1,
                },
                (b"map_Kd", Some(material)) => material.has_texture = true,
                (b"d", Some(material)) => {
                    material.is_transparent = rest.parse::<f64>().is_ok_and(|d| d < 1.0)
                }
                (b"Tr", Some(material)) => {
                    material.is_transparent = rest.parse::<f64>().is_ok_and(|tr| tr > 0.0);
                }
                _ => {}
            }
        }
        self.named.extend(current);
        Ok(())
    }
}

/// `r g b`, or one number for all: sRGB values, as the programs show them that write these files.
fn color(row: &str) -> Option<[f32; 4]> {
    let numbers: Option<Vec<f32>> =
        row.split_ascii_whitespace().take(4).map(|word| word.parse().ok()).collect();
    let (r, g, b) = match numbers?.as_slice() {
        [gray] => (*gray, *gray, *gray),
        [r, g, b] => (*r, *g, *b),
        _ => return None,
    };
    let linear = |value: f32| linear_from_srgb(value.clamp(0.0, 1.0));
    [r, g, b].iter().all(|value| value.is_finite()).then_some([linear(r), linear(g), linear(b), 1.0])
}
