//! The pictures that were compared, for people to look at.

use std::{
    fs,
    path::{Path, PathBuf},
};

use surfel::{
    Error, Result,
    report::compare::{Method, Surface},
    save,
};

/// How much differences are magnified, so that they are seen.
const MAGNIFIED: u8 = 4;

/// A folder of pictures over one background.
pub struct Pictures {
    folder: PathBuf,
    background: [f32; 3],
}

impl Pictures {
    /// Makes the folder where it is missing.
    ///
    /// # Errors
    /// A folder that can't be made.
    pub fn new(folder: &Path, background: [f32; 3]) -> Result<Self> {
        fs::create_dir_all(folder).map_err(|e| Error::file(folder, "write", e))?;
        Ok(Self { folder: folder.to_owned(), background })
    }

    /// Writes one picture.
    ///
    /// # Errors
    /// As [`save::png`].
    pub fn write(&self, name: &str, surface: &Surface) -> Result<()> {
        self.png(name, surface.size_px, &surface.srgb_over(self.background))
    }

    /// Writes a method's picture, that of its oracle, and its difference from the truth: the bytes' distance, four times.
    ///
    /// # Errors
    /// As [`save::png`].
    pub fn write_method(
        &self,
        method: &Method,
        drawn: &Surface,
        oracle: &Surface,
        truth: &Surface,
    ) -> Result<()> {
        let names = method.names();
        let filter = names.filter_and_weight();
        let exact = format!("{} {filter} oracle", method.picture_key().rasterizer.name());
        let name = names.line();
        let [own, expected] = [drawn, truth].map(|surface| surface.srgb_over(self.background));
        let distance = |(own, expected): (&[u8; 3], &[u8; 3])| {
            [0, 1, 2].map(|c: usize| own[c].abs_diff(expected[c]).saturating_mul(MAGNIFIED))
        };
        let difference: Vec<[u8; 3]> = own.iter().zip(&expected).map(distance).collect();
        self.write(&exact, oracle)?;
        self.png(&name, drawn.size_px, &own)?;
        self.png(&format!("{name} difference"), drawn.size_px, &difference)
    }

    fn png(&self, name: &str, size_px: [u32; 2], pixels: &[[u8; 3]]) -> Result<()> {
        let name = name.replace(", ", "-").replace(' ', "-");
        save::png(&self.folder.join(format!("{name}.png")), size_px, 3, pixels.as_flattened())
    }
}
