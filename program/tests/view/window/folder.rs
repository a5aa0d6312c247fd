//! A folder in which the program runs, and the files that it reads there.

use std::{
    fs,
    path::{Path, PathBuf},
};

/// A folder that goes away with its content.
pub struct Folder(temp_dir::TempDir);

impl Folder {
    pub fn new() -> Self {
        Self(temp_dir::TempDir::new().unwrap())
    }

    /// Where it is.
    pub fn root(&self) -> &Path {
        self.0.path()
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.root().join(name)
    }

    pub fn write(&self, name: &str, content: &str) {
        fs::write(self.path(name), content).unwrap();
    }

    /// So many disks in colors on a ball, replaced at once.
    pub fn splats(&self, name: &str, count: u32) {
        let properties =
            ["x", "y", "z", "nx", "ny", "nz", "radius"].map(|name| format!("property float {name}\n"));
        let colors = "property uchar red\nproperty uchar green\nproperty uchar blue\n";
        let lines: String = (0..count)
            .map(|i| {
                let z = 1.0 - 2.0 * (f64::from(i) + 0.5) / f64::from(count);
                let (sin, cos) = (2.399_963 * f64::from(i)).sin_cos();
                let ring = (1.0 - z * z).sqrt();
                let (x, y) = (ring * cos, ring * sin);
                let radius = 3.0 / f64::from(count).sqrt();
                let [red, green, blue] = [37, 91, 53].map(|step| i * step % 256);
                format!("{x} {y} {z} {x} {y} {z} {radius} {red} {green} {blue}\n")
            })
            .collect();
        let text = format!(
            "ply\nformat ascii 1.0\nelement vertex {count}\n{}{colors}end_header\n{lines}",
            properties.concat()
        );
        self.write("new", &text);
        fs::rename(self.path("new"), self.path(name)).unwrap();
    }
}
