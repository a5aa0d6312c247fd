//! OpenEXR pictures.

use std::{io, path::Path};

use exr::{
    image::{AnyChannel, AnyChannels, Encoding, FlatSamples, Image, Layer, write::WritableImage as _},
    meta::{attribute::Text, header::LayerAttributes},
};

use super::{check_size, whole};
use crate::error::{Error, Result};

/// Writes 32-bit floats, without loss. `values` has all channels of a pixel together, row by row from the top left;
/// `channels` names them in that order: `["Y"]`, `["R", "G", "B", "A"]`, `["X", "Y", "Z"]`. NaN and Inf are kept.
///
/// # Errors
/// [`crate::ErrorKind::Option`] if there is no channel, a name is not ascii or comes twice, or the number of values does not
/// fit; [`crate::ErrorKind::File`] if the file can't be written, nothing is left behind then.
pub fn exr(path: &Path, size_px: [u32; 2], channels: &[&str], values: &[f32]) -> Result<()> {
    check_size(size_px, channels.len(), values.len())?;
    let mut list = Vec::with_capacity(channels.len());
    for (i, &name) in channels.iter().enumerate() {
        let text = Text::new_or_none(name).filter(|_| !name.is_empty() && !channels[..i].contains(&name));
        let Some(text) = text else {
            return Err(Error::option("picture", format!("'{name}' can't be the name of a channel")));
        };
        let samples = values.iter().skip(i).step_by(channels.len()).copied().collect();
        list.push(AnyChannel::new(text, FlatSamples::F32(samples)));
    }
    let size = (size_px[0] as usize, size_px[1] as usize);
    let channels = AnyChannels::sort(list.into());
    let layer = Layer::new(size, LayerAttributes::default(), Encoding::SMALL_LOSSLESS, channels);
    let image = Image::from_layer(layer);
    whole::write(path, |file| {
        image.write().to_buffered(file).map_err(|e| match e {
            exr::error::Error::Io(e) => e,
            other => io::Error::other(other),
        })
    })
}

#[cfg(test)]
mod tests {
    use exr::prelude::{ReadChannels as _, ReadLayers as _};

    use super::*;

    #[test]
    fn what_is_written_is_read_back_bit_by_bit() {
        let folder = temp_dir::TempDir::new().unwrap();
        let path = folder.path().join("a.exr");
        let special = [0.0, -0.0, 1.0, f32::INFINITY, f32::NEG_INFINITY, f32::NAN, 1e-42, f32::MAX, 0.1];
        for channels in [&["Y"][..], &["X", "Y", "Z"], &["R", "G", "B", "A"]] {
            let values: Vec<f32> = special.iter().copied().cycle().take(7 * 5 * channels.len()).collect();
            exr(&path, [7, 5], channels, &values).unwrap();
            let image = exr::prelude::read()
                .no_deep_data()
                .largest_resolution_level()
                .all_channels()
                .first_valid_layer()
                .all_attributes()
                .from_file(&path)
                .unwrap();
            assert_eq!(image.layer_data.size, exr::math::Vec2(7, 5));
            assert_eq!(image.layer_data.channel_data.list.len(), channels.len());
            for channel in &image.layer_data.channel_data.list {
                let i = channels.iter().position(|&c| channel.name == *c).unwrap();
                let FlatSamples::F32(read) = &channel.sample_data else { panic!("not f32") };
                let written = values.iter().skip(i).step_by(channels.len());
                assert!(
                    read.iter().map(|v| v.to_bits()).eq(written.map(|v| v.to_bits())),
                    "{}",
                    channel.name
                );
            }
        }
    }

    #[test]
    fn wrong_names_and_sizes_are_refused() {
        let path = Path::new("never-written.exr");
        assert!(exr(path, [2, 1], &["Y"], &[0.0]).is_err());
        assert!(exr(path, [2, 1], &[], &[]).is_err());
        assert!(exr(path, [1, 1], &["Y", "Y"], &[0.0; 2]).is_err());
        assert!(exr(path, [1, 1], &[""], &[0.0]).is_err());
        assert!(!path.exists());
    }
}
