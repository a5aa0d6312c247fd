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
    /// Up to this white: some scanners' 12 bits are copied, too.
    Words(u16),
}

/// The largest number of 12 bits. Where it is white in all of 16 bits, the picture is nearly black.
pub(in crate::load) const MOST_OF_12_BITS: u16 = 4095;

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
            256..=MOST_OF_12_BITS => Self::Words(MOST_OF_12_BITS),
            _ => Self::Words(u16::MAX),
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
            Self::Words(white) => {
                let table: Vec<f32> =
                    (0..=white).map(|v| linear_from_srgb(f32::from(v) / f32::from(white))).collect();
                let linear = |value: u16| table.get(usize::from(value)).copied().unwrap_or(1.0);
                let words = if white == u16::MAX { ", 16-bit colors" } else { ", 12-bit colors" };
                (each(&columns.colors, linear), words)
            }
        };
        (colors, words, 0)
    }
}

fn each(colors: &[[u16; 3]], linear: impl Fn(u16) -> f32 + Sync) -> Colors {
    Colors::Each(colors.par_iter().map(|&[r, g, b]| [linear(r), linear(g), linear(b), 1.0]).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colors_of_8_12_and_16_bits_have_their_white() {
        for (white, words) in [(255, ", 8-bit colors"), (4095, ", 12-bit colors"), (4096, ", 16-bit colors")]
        {
            let columns = Columns { colors: vec![[white, 0, 7]], ..Columns::default() };
            let (colors, told, beyond) = Palette::of(&columns).colors(&columns);
            assert_eq!((told, beyond), (words, 0));
            assert_eq!(colors.get(0).map(|color| color[0] > 0.99), Some(white < 4096), "{white}");
        }
    }
}
