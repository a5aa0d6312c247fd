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

/// Grays of intensities from black to white, see [`range_of`], and how many are beyond.
pub(super) fn gray(intensities: &[f32]) -> (Vec<[f32; 4]>, u64) {
    gray_within(intensities, range_of(intensities))
}

/// The same of intensities from any black to any white.
pub(super) fn gray_within<T>(intensities: &[T], [black, white]: [f32; 2]) -> (Vec<[f32; 4]>, u64)
where
    T: Copy + Into<f32> + Sync,
{
    let range = if white > black { white - black } else { 1.0 };
    let gray = |value: &T| {
        let gray = linear_from_srgb(unit(((*value).into() - black) / range));
        [gray, gray, gray, 1.0]
    };
    let is_beyond = |value: &&T| !(black..=white).contains(&(**value).into());
    let beyond = intensities.par_iter().filter(is_beyond).count();
    (intensities.par_iter().map(gray).collect(), beyond as u64)
}

/// What is black and what white among intensities: 0, or the least where it is below 0, and the largest. Where an end is further from the
/// middle 80% than those from each other (a mirror, a mark for no value), the end of those is taken instead.
pub(super) fn range_of<T>(intensities: &[T]) -> [f32; 2]
where
    T: Copy + Into<f32> + Sync,
{
    let finite = |value: &T| Some((*value).into()).filter(|value: &f32| value.is_finite());
    let ends = intensities.par_iter().filter_map(finite).map(|value| [value; 2]);
    let [least, largest] = ends.reduce(|| [0.0; 2], |a, b| [a[0].min(b[0]), a[1].max(b[1])]);
    // Of very many, some tell as much.
    let step = intensities.len() / MOST_SORTED + 1;
    let mut sorted: Vec<f32> = intensities.iter().step_by(step).filter_map(finite).collect();
    sorted.sort_unstable_by(f32::total_cmp);
    let last = sorted.len().saturating_sub(1);
    let at = |i: usize| sorted.get(i).copied().unwrap_or_default();
    let [low, high] = [at(last / 10).min(0.0), at(last - last / 10)];
    let range = high - low;
    let is_far = |by: f32| range > 0.0 && by > range;
    [if is_far(low - least) { low } else { least }, if is_far(largest - high) { high } else { largest }]
}

/// The most intensities of which the usual range is found.
const MOST_SORTED: usize = 1 << 20;

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
        let levels = |values: &[f32]| gray(values).0.iter().map(|c| c[0]).collect::<Vec<_>>();
        let half = linear_from_srgb(0.5);
        assert_eq!(levels(&[0.0, 2048.0, 4096.0, f32::NAN]), [0.0, half, 1.0, 0.0]);
        assert_eq!(levels(&[-2048.0, 0.0, 2048.0]), [0.0, half, 1.0]);
        assert_eq!(levels(&[0.0, 0.0]), [0.0, 0.0]);
    }

    #[test]
    fn a_few_intensities_far_from_all_others_don_t_set_the_range() {
        let ramp = || (0..=2000).map(|i| i as f32);
        let with = |few: &[f32]| range_of(&ramp().chain(few.iter().copied()).collect::<Vec<f32>>());
        assert_eq!(with(&[]), [0.0, 2000.0]);
        assert_eq!(with(&[65_535.0]), [0.0, 1801.0]);
        assert_eq!(with(&[3000.0, f32::INFINITY]), [0.0, 3000.0], "as far as a bright thing is");
        assert_eq!(with(&[-9999.0, 65_535.0]), [0.0, 1801.0]);
        assert_eq!(with(&[-300.0]), [-300.0, 2000.0]);
        let [mut mirrors, mut dark] = [vec![65_535.0_f32; 300], vec![0.0_f32; 5000]];
        mirrors.extend(ramp());
        assert_eq!(range_of(&mirrors), [0.0, 65_535.0], "an eighth is a part of the scene");
        dark.push(9.0);
        assert_eq!(range_of(&dark), [0.0, 9.0]);
        assert_eq!(gray(&[[0.0, 1.0].repeat(500), vec![500.0]].concat()).1, 1);
        assert_eq!(range_of::<f32>(&[]), [0.0; 2]);
    }
}
