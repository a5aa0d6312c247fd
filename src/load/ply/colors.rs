//! Colors as files have them, and as linear light.

use glam::DVec3;
use rayon::prelude::*;

use super::schema::Scalar;
use crate::{load::shade, math::srgb::linear_from_srgb, scene::UNKNOWN_SRGB};

/// Colors with the numbers of the file; what is white among them shows when all are known.
pub(super) struct FileColors {
    values: Vec<[f32; 4]>,
    white: [White; 4],
    /// The linear value of each byte: bytes are the common case, and a power costs more than the rest.
    of_byte: [f32; 256],
    /// All is known of their white: the values are linear.
    are_bytes: bool,
}

/// What a channel's largest possible light is written as.
#[derive(Clone, Copy, Debug)]
pub(super) struct White {
    meaning: Meaning,
    scalar: Scalar,
    /// The largest value in the file that is finite.
    largest: f32,
}

/// What a channel is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Meaning {
    /// 0 to 1, whatever the values.
    Unit,
    /// Red, green, blue or alpha, of the whole range of their type.
    Exact,
    /// Red, green, blue or alpha as programs write them.
    Color,
    /// Of no known range.
    Intensity,
}

impl White {
    pub(super) const UNIT: Self = Self::new(Meaning::Unit, Scalar::Float);

    pub(super) const fn new(meaning: Meaning, scalar: Scalar) -> Self {
        Self { meaning, scalar, largest: 0.0 }
    }

    /// Bytes have one meaning. Files put bytes into wider integers, too, and into floats, whose range should be 0 to 1:
    /// no color is whiter than white by more than some rounding and light, so that 2 already speaks for bytes. What is
    /// wider than 16 bits has its type's largest value. An intensity beyond bytes has the range that it has.
    fn value(self) -> f32 {
        let is_float = self.scalar.range().is_none();
        match (self.meaning, self.scalar) {
            (Meaning::Unit, _) => 1.0,
            (_, Scalar::UChar | Scalar::Char) => 255.0,
            (Meaning::Exact, Scalar::UShort) => 65_535.0,
            (Meaning::Exact, Scalar::Float | Scalar::Double) => 1.0,
            (Meaning::Color, _) if is_float && self.largest <= 2.0 => 1.0,
            (Meaning::Intensity, _) if is_float && self.largest <= 1.0 => 1.0,
            _ if self.largest <= 255.0 => 255.0,
            (Meaning::Intensity, _) => self.largest,
            // Of 12 bits, as some scanners have them: white of 16 bits would leave a picture nearly black.
            (Meaning::Color, _) if self.largest <= 4095.0 => 4095.0,
            (_, Scalar::Short) => f32::from(i16::MAX),
            _ if self.largest <= 65_535.0 => 65_535.0,
            (_, Scalar::Int) => i32::MAX as f32,
            (_, Scalar::UInt) => u32::MAX as f32,
            (_, Scalar::Long) => i64::MAX as f32,
            (_, Scalar::ULong) => u64::MAX as f32,
            _ => self.largest,
        }
    }
}

impl FileColors {
    /// No colors yet, but room for `count`; with the white of each channel.
    pub(super) fn new(white: [White; 4], count: usize) -> Self {
        let [rgb @ .., alpha] = white;
        let is_byte = |white: &White| white.meaning != Meaning::Unit && white.scalar == Scalar::UChar;
        Self {
            values: Vec::with_capacity(count),
            white,
            of_byte: std::array::from_fn(|byte| linear_from_srgb(byte as f32 / 255.0)),
            are_bytes: rgb.iter().all(is_byte) && (is_byte(&alpha) || alpha.meaning == Meaning::Unit),
        }
    }

    /// Whether a color's light depends on no other: on the type of its numbers alone.
    pub(super) fn stand_alone(&self) -> bool {
        let exact = |white: &White| match (white.meaning, white.scalar) {
            (Meaning::Unit, _) => true,
            (Meaning::Exact, scalar) => matches!(scalar, Scalar::UShort | Scalar::Float | Scalar::Double),
            _ => false,
        };
        let is_byte = |white: &White| white.meaning != Meaning::Unit && white.scalar == Scalar::UChar;
        self.are_bytes || self.white.iter().all(|white| exact(white) || is_byte(white))
    }

    /// Adds colors of the file's numbers, without alpha where it has none.
    pub(super) fn extend(&mut self, rgb: impl Iterator<Item = DVec3>, alpha: impl Iterator<Item = f64>) {
        if self.are_bytes {
            let alpha_white = self.white[3].value();
            let linear = |byte: f64| self.of_byte[usize::from(byte as u8)];
            self.values.extend(rgb.zip(alpha).map(|(rgb, alpha)| {
                [linear(rgb.x), linear(rgb.y), linear(rgb.z), alpha as f32 / alpha_white]
            }));
            return;
        }
        let (mut largest, mut largest_alpha) = (DVec3::ZERO, 0.0_f64);
        // A point whose intensity is no number is there all the same.
        let is_intensity = self.white[0].meaning == Meaning::Intensity;
        let rgb = rgb.map(|rgb| if is_intensity && rgb.is_nan() { DVec3::ZERO } else { rgb });
        self.values.extend(rgb.zip(alpha).map(|(rgb, alpha)| {
            if rgb.is_finite() {
                largest = largest.max(rgb);
            }
            if alpha.is_finite() {
                largest_alpha = largest_alpha.max(alpha);
            }
            [rgb.x as f32, rgb.y as f32, rgb.z as f32, alpha as f32]
        }));
        let largest = [largest.x, largest.y, largest.z, largest_alpha];
        for (white, largest) in self.white.iter_mut().zip(largest) {
            white.largest = white.largest.max(largest as f32);
        }
    }

    /// Linear light and alpha, 0 to 1, and how many were beyond. NaN stays NaN, so that the vertex is counted as
    /// defective.
    pub(super) fn finish(self) -> (Vec<[f32; 4]>, u64) {
        let Self { mut values, white, of_byte, are_bytes } = self;
        if are_bytes {
            return (values, 0);
        }
        let [red, green, blue, alpha] = white;
        // Channels of one color have one range.
        let of_type = |scalar: Scalar| {
            let same = [red, green, blue].into_iter().filter(|white| white.scalar == scalar);
            same.map(|white| white.largest).fold(0.0, f32::max)
        };
        let shared = |white: White| White { largest: of_type(white.scalar), ..white }.value();
        let [r, g, b] = match (red.meaning, shared(red)) {
            // Beyond bytes the values themselves have the range.
            (Meaning::Intensity, white) if white > 255.0 => {
                let intensities: Vec<f32> = values.par_iter().map(|color| color[0]).collect();
                [shade::range_of(&intensities)[1]; 3]
            }
            _ => [red, green, blue].map(shared),
        };
        let full = [r, g, b, alpha.value()];
        let is_signed_byte = white.map(|white| white.scalar == Scalar::Char);
        let beyond = values
            .par_iter_mut()
            .with_min_len(1 << 14)
            .map(|color| {
                let mut is_beyond = false;
                let channels = color.iter_mut().zip(full).zip(is_signed_byte);
                for (i, ((value, full), is_signed_byte)) in channels.enumerate() {
                    // Who writes a byte as `char` writes its bits.
                    let raw = if is_signed_byte && *value < 0.0 { *value + 256.0 } else { *value };
                    let encoded = (raw / full).clamp(0.0, 1.0);
                    is_beyond |= raw < 0.0 || raw > full;
                    let byte = raw as u8;
                    *value = match i {
                        3 => encoded,
                        _ if full == 255.0 && f32::from(byte) == raw => {
                            of_byte.get(usize::from(byte)).copied().unwrap_or(encoded)
                        }
                        _ => linear_from_srgb(encoded),
                    };
                }
                u64::from(is_beyond)
            })
            .sum();
        (values, beyond)
    }
}

/// The color of vertices that have only an alpha.
pub(super) fn unknown() -> impl Iterator<Item = DVec3> {
    std::iter::repeat(DVec3::splat(f64::from(UNKNOWN_SRGB)))
}
