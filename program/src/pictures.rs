//! Pictures and dumps to files.

use std::{fs, path::Path};

use surfel::{
    Error, Result,
    math::srgb::{linear_from_srgb, srgb_from_linear},
    save,
    scene::{CropView, Encoding},
};

use crate::{console, outputs::PictureFormat};

/// The colors of a picture, row by row from the top left.
pub enum Colors<'a> {
    /// 8-bit sRGB, alpha linear.
    Srgb(&'a [[u8; 4]]),
    /// Linear.
    Linear(&'a [[f32; 4]]),
}

/// Writes the picture and says so.
///
/// # Errors
/// As [`save_picture`].
pub fn write_picture(
    path: &Path,
    format: PictureFormat,
    size_px: [u32; 2],
    transparent: bool,
    colors: Colors<'_>,
) -> Result<()> {
    save_picture(path, format, size_px, transparent, colors)?;
    let [width, height] = size_px;
    console::say(&format!("wrote {}, {width}x{height} pixels", path.display()));
    Ok(())
}

/// Writes the picture. PNG has an alpha channel only where something can be transparent.
///
/// # Errors
/// As [`save::png`] and [`save::exr`].
pub fn save_picture(
    path: &Path,
    format: PictureFormat,
    size_px: [u32; 2],
    transparent: bool,
    colors: Colors<'_>,
) -> Result<()> {
    match (format, colors) {
        (PictureFormat::Exr, Colors::Linear(linear)) => {
            save::exr(path, size_px, &["R", "G", "B", "A"], premultiplied(linear).as_flattened())
        }
        (PictureFormat::Exr, Colors::Srgb(_)) => {
            Err(Error::option("picture", "8-bit colors are not written as linear floats"))
        }
        (PictureFormat::Png, Colors::Srgb(srgb)) => write_png(path, size_px, transparent, srgb),
        (PictureFormat::Png, Colors::Linear(linear)) => {
            let srgb: Vec<[u8; 4]> = linear.iter().map(|color| encode(*color)).collect();
            write_png(path, size_px, transparent, &srgb)
        }
    }
}

fn write_png(path: &Path, size_px: [u32; 2], transparent: bool, srgb: &[[u8; 4]]) -> Result<()> {
    match transparent {
        true => save::png(path, size_px, 4, srgb.as_flattened()),
        false => {
            let opaque: Vec<[u8; 3]> =
                srgb.iter().map(|[red, green, blue, _]| [*red, *green, *blue]).collect();
            save::png(path, size_px, 3, opaque.as_flattened())
        }
    }
}

/// With alpha multiplied in, as files of linear light have it.
fn premultiplied(colors: &[[f32; 4]]) -> Vec<[f32; 4]> {
    colors
        .iter()
        .map(|[red, green, blue, alpha]| [red * alpha, green * alpha, blue * alpha, *alpha])
        .collect()
}

/// The nearest 8-bit color, of a linear one.
pub fn encode([red, green, blue, alpha]: [f32; 4]) -> [u8; 4] {
    // The cast saturates, and takes NaN to 0.
    let byte = |value: f32| (255.0 * value + 0.5) as u8;
    let srgb = |linear: f32| byte(srgb_from_linear(linear.clamp(0.0, 1.0)));
    [srgb(red), srgb(green), srgb(blue), byte(alpha)]
}

/// The bytes of what was drawn without a background, as it is shown over one (sRGB), which keeps its color.
pub fn encode_shown(encoding: &Encoding, drawn: &[[f32; 4]], background: Option<[f32; 3]>) -> Vec<[u8; 4]> {
    let shown = drawn.iter().map(|[red, green, blue, alpha]| {
        let [red, green, blue] = encoding.shown([*red, *green, *blue]);
        over([red, green, blue, *alpha], background)
    });
    shown.map(encode).collect()
}

/// A linear color with straight alpha over a background (sRGB).
pub fn over([red, green, blue, alpha]: [f32; 4], background: Option<[f32; 3]>) -> [f32; 4] {
    let Some(background) = background.map(|color| color.map(linear_from_srgb)) else {
        return [red, green, blue, alpha];
    };
    let [red, green, blue] = match alpha {
        1.0 => [red, green, blue],
        _ => [0, 1, 2].map(|c| alpha * [red, green, blue][c] + (1.0 - alpha) * background[c]),
    };
    [red, green, blue, 1.0]
}

/// The normalized surface and the picture of it, linear, row by row from the top left.
pub struct Dump {
    /// Width and height in pixels.
    pub size_px: [u32; 2],
    /// Σ of weights.
    pub weight: Vec<f32>,
    /// Linear red, green, blue.
    pub albedo: Vec<[f32; 3]>,
    /// Unit, view space.
    pub normal: Vec<[f32; 3]>,
    /// View-space z, +∞ where empty.
    pub depth: Vec<f32>,
    /// Linear red, green, blue, alpha.
    pub color: Vec<[f32; 4]>,
}

impl Dump {
    /// The part that is wanted of it.
    #[must_use]
    pub fn cut(self, crop: Option<CropView>) -> Self {
        let Some(view) = crop else { return self };
        Self {
            size_px: view.size_px(),
            weight: view.cut(&self.weight),
            albedo: view.cut(&self.albedo),
            normal: view.cut(&self.normal),
            depth: view.cut(&self.depth),
            color: view.cut(&self.color),
        }
    }

    /// Writes its five files; makes the folder where it is missing.
    ///
    /// # Errors
    /// As [`save::exr`], or a folder that can't be made.
    pub fn write(&self, folder: &Path) -> Result<()> {
        fs::create_dir_all(folder).map_err(|e| Error::file(folder, "write", e))?;
        let write = |name: &str, channels: &[&str], values| {
            save::exr(&folder.join(name), self.size_px, channels, values)
        };
        write("weight.exr", &["Y"], &self.weight)?;
        write("albedo.exr", &["R", "G", "B"], self.albedo.as_flattened())?;
        write("normal.exr", &["X", "Y", "Z"], self.normal.as_flattened())?;
        write("depth.exr", &["Z"], &self.depth)?;
        write("final.exr", &["R", "G", "B", "A"], premultiplied(&self.color).as_flattened())
    }
}

#[cfg(test)]
mod tests {
    use surfel::scene::{Stops, Tonemap};

    use super::*;

    #[test]
    fn colors_are_encoded_to_the_nearest_byte() {
        assert_eq!(encode([0.0, 1.0, 0.215_861, 0.5]), [0, 255, 128, 128]);
        assert_eq!(encode([-1.0, 2.0, f32::NAN, 1.0]), [0, 255, 0, 255]);
    }

    #[test]
    fn the_background_keeps_its_color_whatever_the_curve() {
        let encoding = Encoding { exposure: Stops(-1.0), tonemap: Tonemap::None };
        let drawn = [[1.0, 0.5, 0.0, 1.0], [0.0; 4], [1.0, 1.0, 1.0, 0.5]];
        let over_gray = encode_shown(&encoding, &drawn, Some([0.5; 3]));
        // Half of 0.5, and half of 0.214041, which is 128.
        assert_eq!(over_gray, [[188, 137, 0, 255], [128, 128, 128, 255], [161, 161, 161, 255]]);
        assert_eq!(encode_shown(&encoding, &drawn, None)[1..], [[0, 0, 0, 0], [188, 188, 188, 128]]);
        let aces = Encoding { tonemap: Tonemap::Aces, ..encoding };
        assert_eq!(encode_shown(&aces, &drawn, Some([1.0; 3]))[1], [255; 4]);
    }
}
