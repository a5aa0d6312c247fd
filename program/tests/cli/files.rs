//! Reads back what the program writes.

use std::{collections::BTreeMap, path::Path};

/// A PNG.
pub struct Png {
    pub size: [u32; 2],
    pub channels: usize,
    pub pixels: Vec<u8>,
}

impl Png {
    /// Red, green, blue; `row` counts from the top.
    pub fn at(&self, column: u32, row: u32) -> [u8; 3] {
        let first = (row * self.size[0] + column) as usize * self.channels;
        [self.pixels[first], self.pixels[first + 1], self.pixels[first + 2]]
    }
}

pub fn png(path: &Path) -> Png {
    let image = image::open(path).unwrap();
    Png {
        size: [image.width(), image.height()],
        channels: image.color().channel_count().into(),
        pixels: image.into_bytes(),
    }
}

/// An EXR of 32-bit floats.
pub struct Exr {
    pub size: [usize; 2],
    pub channels: BTreeMap<String, Vec<f32>>,
}

pub fn exr(path: &Path) -> Exr {
    let image = exr::prelude::read_all_flat_layers_from_file(path).unwrap();
    let layer = &image.layer_data[0];
    let channel = |channel: &exr::prelude::AnyChannel<exr::prelude::FlatSamples>| {
        let exr::prelude::FlatSamples::F32(values) = &channel.sample_data else {
            panic!("not 32-bit floats")
        };
        (channel.name.to_string(), values.clone())
    };
    Exr {
        size: [layer.size.0, layer.size.1],
        channels: layer.channel_data.list.iter().map(channel).collect(),
    }
}
