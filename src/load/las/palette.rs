//! What the numbers of colors and intensities mean, which formats leave open: some points tell it for all.

use rayon::prelude::*;

use super::columns::Columns;
use crate::{load::shade, math::srgb::linear_from_srgb, scene::Colors};

/// What they mean.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::load) enum Palette {
    /// There is neither.
    Unknown,
    /// Intensities up to this one are grays: writers that have no colors leave them 0, or the intensities.
    Grays(u16),
    /// The format wants 16 bits; many writers copy 8 into them.
    Bytes,
    Words,
}

impl Palette {
    /// That of some points.
    pub fn of(columns: &Columns) -> Self {
        let largest = columns.colors.par_iter().map(|color| color.iter().copied().max().unwrap_or(0)).max();
        let intensities = || columns.intensities.par_iter().copied().max().unwrap_or(0);
        match (largest.unwrap_or(0), intensities) {
            (0, intensities) if intensities() == 0 => Self::Unknown,
            (0, intensities) => Self::Grays(intensities()),
            (1..=255, _) => Self::Bytes,
            _ => Self::Words,
        }
    }

    /// Colors, and a word on them for the format.
    pub fn colors(self, columns: &Columns) -> (Colors, &'static str) {
        match self {
            Self::Unknown => (Colors::unknown(), ""),
            Self::Grays(largest) => {
                let intensities: Vec<f32> =
                    columns.intensities.par_iter().map(|value| f32::from(*value)).collect();
                let grays = shade::gray_within(&intensities, [0.0, f32::from(largest)]);
                (Colors::Each(grays), ", intensity as gray")
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
        }
    }
}

fn each(colors: &[[u16; 3]], linear: impl Fn(u16) -> f32 + Sync) -> Colors {
    Colors::Each(colors.par_iter().map(|&[r, g, b]| [linear(r), linear(g), linear(b), 1.0]).collect())
}
