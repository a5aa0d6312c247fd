//! What the numbers of colors and intensities mean, which formats leave open: some points tell it for all.

use rayon::prelude::*;

use super::columns::Columns;
use crate::{load::shade, math::srgb::linear_from_srgb, scene::Colors};

/// What they mean.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::load) enum Palette {
    /// There is neither.
    Unknown,
    /// Intensities up to this white are grays: writers that have no colors leave them 0, or the intensities.
    Grays(f32),
    /// The format wants 16 bits; many writers copy 8 into them.
    Bytes,
    Words,
}

impl Palette {
    /// That of some points.
    pub fn of(columns: &Columns) -> Self {
        let largest = columns.colors.par_iter().map(|color| color.iter().copied().max().unwrap_or(0)).max();
        match largest.unwrap_or(0) {
            0 => match shade::range_of(&columns.intensities) {
                [_, 0.0] => Self::Unknown,
                [_, white] => Self::Grays(white),
            },
            1..=255 => Self::Bytes,
            _ => Self::Words,
        }
    }

    /// Colors, a word on them for the format, and how many are beyond white.
    pub fn colors(self, columns: &Columns) -> (Colors, &'static str, u64) {
        let (colors, words) = match self {
            Self::Unknown => (Colors::unknown(), ""),
            Self::Grays(white) => {
                let (grays, beyond) = shade::gray_within(&columns.intensities, [0.0, white]);
                return (Colors::Each(grays), ", intensity as gray", beyond);
            }
            Self::Bytes => {
                let table = shade::Table::new();
                let linear = |value: u16| table.of(value.min(255) as u8);
                (each(&columns.colors, linear), ", 8-bit colors")
            }
            Self::Words => {
                let table: Vec<f32> =
                    (0..=u16::MAX).map(|v| linear_from_srgb(f32::from(v) / 65535.0)).collect();
                let linear = |value: u16| table.get(usize::from(value)).copied().unwrap_or(1.0);
                (each(&columns.colors, linear), ", 16-bit colors")
            }
        };
        (colors, words, 0)
    }
}

fn each(colors: &[[u16; 3]], linear: impl Fn(u16) -> f32 + Sync) -> Colors {
    Colors::Each(colors.par_iter().map(|&[r, g, b]| [linear(r), linear(g), linear(b), 1.0]).collect())
}
