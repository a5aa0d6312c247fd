//! The pictures that were compared, for people to look at.

use std::{fs, path::Path};

use surfel::{
    Error, Result,
    report::compare::{Method, Surface},
    save,
};

/// White, linear: what the pictures are compared over.
pub const BACKGROUND: [f32; 3] = [1.0; 3];

/// How much differences are magnified, so that they are seen.
pub const MAGNIFIED: u8 = 4;

/// A picture that there is to see while methods are compared.
pub enum Shown<'a> {
    /// The ground truth, once and first.
    Truth(&'a Surface),
    /// A method.
    Method {
        /// Which.
        method: &'a Method,
        /// The device's picture.
        drawn: &'a Surface,
        /// The exact picture.
        oracle: &'a Surface,
        /// The picture that it aims at.
        truth: &'a Surface,
    },
}

/// Does something with it.
pub type Show<'a> = &'a mut dyn FnMut(Shown<'_>) -> Result<()>;

/// Writes what is shown into a folder, which is made where it is missing: the truth; or a method's picture, that of its
/// oracle, and its difference from the truth.
///
/// # Errors
/// As [`save::png`]; a folder that can't be made.
pub fn write(folder: &Path, shown: &Shown<'_>) -> Result<()> {
    fs::create_dir_all(folder).map_err(|e| Error::file(folder, "write", e))?;
    let png = |name: &str, surface: &Surface, pixels: &[[u8; 3]]| {
        let name = name.replace(", ", "-").replace(' ', "-");
        save::png(&folder.join(format!("{name}.png")), surface.size_px, 3, pixels.as_flattened())
    };
    match shown {
        Shown::Truth(truth) => png("truth", truth, &truth.srgb_over(BACKGROUND)),
        Shown::Method { method, drawn, oracle, truth } => {
            let exact = format!("{} {} oracle", method.exact().rasterizer.name(), method.filter);
            let name = method.to_string();
            png(&exact, oracle, &oracle.srgb_over(BACKGROUND))?;
            png(&name, drawn, &drawn.srgb_over(BACKGROUND))?;
            png(&format!("{name} difference"), drawn, &difference(drawn, truth))
        }
    }
}

/// The distance of the bytes of two pictures, [`MAGNIFIED`] times.
pub fn difference(drawn: &Surface, truth: &Surface) -> Vec<[u8; 3]> {
    let [own, expected] = [drawn, truth].map(|surface| surface.srgb_over(BACKGROUND));
    let distance = |(own, expected): (&[u8; 3], &[u8; 3])| {
        [0, 1, 2].map(|c: usize| own[c].abs_diff(expected[c]).saturating_mul(MAGNIFIED))
    };
    own.iter().zip(&expected).map(distance).collect()
}
