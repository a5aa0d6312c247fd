//! Linear colors of what files hold: sRGB values of any range, and intensities.

use rayon::prelude::*;

use crate::math::srgb::linear_from_srgb;

/// Linear colors of sRGB values from 0 to `scale`, and how many colors are out of that range.
pub(super) fn from_srgb(colors: &[[f32; 3]], scale: f32) -> (Vec<[f32; 4]>, u64) {
    let table = Table::new();
    let linear = |value: f32| match scale == 255.0 && value.fract() == 0.0 {
        true => table.byte(value),
        false => linear_from_srgb(unit(value / scale)),
    };
    let is_outside = |value: &f32| !(0.0..=scale * 1.001).contains(value);
    let outside = colors.par_iter().filter(|color| color.iter().any(is_outside)).count();
    let linear = colors.par_iter().map(|&[r, g, b]| [linear(r), linear(g), linear(b), 1.0]).collect();
    (linear, outside as u64)
}

/// Grays of intensities: black is 0, or the least where it is below 0; white is the largest.
pub(super) fn gray(intensities: &[f32]) -> Vec<[f32; 4]> {
    let finite = intensities.par_iter().copied().filter(|value| value.is_finite());
    let (least, largest) =
        finite.map(|v| (v, v)).reduce(|| (0.0, 0.0), |a: (f32, f32), b| (a.0.min(b.0), a.1.max(b.1)));
    gray_within(intensities, [least, largest])
}

/// The same of intensities between two.
pub(super) fn gray_within(intensities: &[f32], [least, largest]: [f32; 2]) -> Vec<[f32; 4]> {
    let range = if largest > least { largest - least } else { 1.0 };
    let gray = |value: &f32| {
        let gray = linear_from_srgb(unit((value - least) / range));
        [gray, gray, gray, 1.0]
    };
    intensities.par_iter().map(gray).collect()
}

/// The nearest value from 0 to 1; what is no number is 0.
pub(super) fn unit(value: f32) -> f32 {
    if value.is_nan() { 0.0 } else { value.clamp(0.0, 1.0) }
}

/// The linear values of all bytes.
pub(super) struct Table([f32; 256]);

impl Table {
    pub fn new() -> Self {
        Self(std::array::from_fn(|byte| linear_from_srgb(byte as f32 / 255.0)))
    }

    /// The linear value of a whole number from 0 to 255; what is beyond is as the nearest.
    pub fn byte(&self, value: f32) -> f32 {
        // A float becomes the nearest byte.
        self.of(value as u8)
    }

    pub fn of(&self, byte: u8) -> f32 {
        self.0.get(usize::from(byte)).copied().unwrap_or(1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colors_of_each_range_become_the_same_ones() {
        let expected = [linear_from_srgb(0.2), 0.0, 1.0, 1.0];
        for (scale, value) in [(1.0, 0.2), (255.0, 51.0), (65535.0, 13107.0)] {
            let (colors, outside) = from_srgb(&[[value, 0.0, scale]], scale);
            assert_eq!((outside, colors.len()), (0, 1));
            colors[0].iter().zip(expected).for_each(|(a, b)| assert!((a - b).abs() < 1e-6));
        }
        let (colors, outside) = from_srgb(&[[-1.0, 256.0, f32::NAN], [255.0, 1.5, 0.0]], 255.0);
        assert_eq!((colors[0], outside), ([0.0, 1.0, 0.0, 1.0], 1));
    }

    #[test]
    fn intensities_fill_the_range_from_black_to_white() {
        let levels = |values: &[f32]| gray(values).iter().map(|c| c[0]).collect::<Vec<_>>();
        let half = linear_from_srgb(0.5);
        assert_eq!(levels(&[0.0, 2048.0, 4096.0, f32::NAN]), [0.0, half, 1.0, 0.0]);
        assert_eq!(levels(&[-2048.0, 0.0, 2048.0]), [0.0, half, 1.0]);
        assert_eq!(levels(&[0.0, 0.0]), [0.0, 0.0]);
    }
}
