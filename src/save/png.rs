//! PNG pictures.

use std::{
    io::{self, Write as _},
    path::Path,
};

use image::{ExtendedColorType, ImageEncoder as _, codecs::png::PngEncoder};

use super::{check_size, whole};
use crate::error::{Error, Result};

/// Writes an 8-bit PNG. `pixels` are sRGB bytes row by row from the top left: red, green, blue where `channels` is 3, and
/// straight alpha where it is 4.
///
/// # Errors
/// [`crate::ErrorKind::Option`] for another number of channels or bytes; [`crate::ErrorKind::File`] if the file can't be written,
/// nothing is left behind then.
pub fn png(path: &Path, size_px: [u32; 2], channels: usize, pixels: &[u8]) -> Result<()> {
    let bytes = png_bytes(size_px, channels, pixels)?;
    whole::write(path, |file| file.write_all(&bytes))
}

/// An 8-bit PNG as the bytes of a file, for a picture within something else.
///
/// # Errors
/// [`crate::ErrorKind::Option`] for another number of channels or bytes.
pub fn png_bytes(size_px: [u32; 2], channels: usize, pixels: &[u8]) -> Result<Vec<u8>> {
    check_size(size_px, channels, pixels.len())?;
    let color = match channels {
        3 => ExtendedColorType::Rgb8,
        4 => ExtendedColorType::Rgba8,
        _ => return Err(Error::option("picture", format!("{channels} channels, expected 3 or 4"))),
    };
    let mut bytes = Vec::new();
    let encoder = PngEncoder::new(&mut bytes);
    let done = encoder.write_image(pixels, size_px[0], size_px[1], color);
    done.map_err(|e| Error::file("PNG", "write", io::Error::other(e)))?;
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_written_is_read_back() {
        let folder = temp_dir::TempDir::new().unwrap();
        let path = folder.path().join("a.png");
        let bytes: Vec<u8> = (0..=255).cycle().take(5 * 3 * 4).collect();
        png(&path, [5, 3], 4, &bytes).unwrap();
        let read = image::open(&path).unwrap();
        assert_eq!((read.width(), read.height(), read.as_bytes()), (5, 3, bytes.as_slice()));
        png(&path, [5, 4], 3, &bytes).unwrap();
        let read = image::open(&path).unwrap();
        assert_eq!((read.color().channel_count(), read.as_bytes()), (3, bytes.as_slice()));
    }

    #[test]
    fn wrong_sizes_are_refused() {
        let path = Path::new("never-written.png");
        assert!(png(path, [5, 3], 4, &[0; 59]).is_err());
        assert!(png(path, [0, 3], 4, &[]).is_err());
        assert!(png(path, [5, 3], 2, &[0; 30]).is_err());
        assert!(!path.exists());
    }
}
