//! Pictures, splats and texts to files. A file appears whole or not at all.

mod exr;
mod png;
mod splats;
mod whole;

pub use exr::exr;
pub use png::{png, png_bytes};
pub use splats::{WrittenSplats, splats};

pub(crate) use whole::{Scratch, create};
pub use whole::{check_place, remove_unfinished};

use std::{io::Write as _, path::Path};

use crate::error::{Error, Result};

/// Writes a text.
///
/// # Errors
/// [`crate::ErrorKind::File`] if the file can't be written; nothing is left behind then.
pub fn text(path: &Path, text: &str) -> Result<()> {
    whole::write(path, |file| file.write_all(text.as_bytes()))
}

/// Refuses a picture whose number of values does not fit its size.
fn check_size(size_px: [u32; 2], channels: usize, values: usize) -> Result<()> {
    let [width, height] = size_px;
    let expected = u64::from(width) * u64::from(height) * channels as u64;
    if width == 0 || height == 0 || expected != values as u64 {
        let problem = format!("{values} values for {width}x{height} pixels of {channels} channels");
        return Err(Error::option("picture", problem));
    }
    Ok(())
}
