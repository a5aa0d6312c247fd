//! The colors of materials, from the files that `mtllib` rows name.
//!
//! Such a file is opened only if it lies in the model's folder or below, links followed, unless the user allows more: a
//! model from elsewhere can't make the program read what its sender may not see.

use std::{
    collections::{HashMap, HashSet},
    fs,
    path::{Path, PathBuf},
};

use super::lines::Lines;
use crate::{error::Result, load::Input, math::srgb::linear_from_srgb};

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
        if folder.join(names).exists() {
            return self.read_file(input, folder, names);
        }
        for name in names.split_ascii_whitespace().take(MOST_LIBRARIES as usize) {
            self.read_file(input, folder, name);
        }
    }

    fn read_file(&mut self, input: &Input<'_>, folder: &Path, name: &str) {
        let is_below = |path: &Path| fs::canonicalize(folder).is_ok_and(|folder| path.starts_with(folder));
        let leads_out = Path::new(name).is_absolute() || Path::new(name).has_root();
        match fs::canonicalize(folder.join(name)) {
            Ok(path) if input.options.allow_outside || !leads_out && is_below(&path) => {
                if self.read.insert(path.clone()) {
                    self.unreadable += u64::from(self.read_path(input, &path).is_none());
                }
            }
            Ok(_) => self.outside += 1,
            // Whether there is a file elsewhere is nobody's business.
            Err(_) if leads_out || name.contains("..") => self.outside += 1,
            Err(_) => self.unreadable += 1,
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
