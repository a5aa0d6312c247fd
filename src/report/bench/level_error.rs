//! How far what a level of detail shows is from what the splats themselves do.

use serde::Serialize;

use crate::{math::srgb::srgb_from_linear, report::picture::flip};

/// The error of a picture of some level.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct LevelError {
    /// The root of the mean square over white, of all components of pixels that either picture covers, in 255ths of sRGB.
    pub rms: f64,
    /// The mean over white of the differences that are seen there ([`flip`]), in 255ths of the largest.
    pub flip: f64,
    /// Pixels that one of both covers by half or more, and the other does not.
    pub silhouette_px: u64,
}

impl LevelError {
    /// That of a picture, linear red, green, blue and straight alpha, beside another one of as many columns.
    ///
    /// # Panics
    /// If the pictures differ in length or are not whole rows.
    pub fn of(picture: &[[f32; 4]], whole: &[[f32; 4]], width: usize) -> Self {
        let over_white = |[red, green, blue, alpha]: &[f32; 4]| {
            [red, green, blue].map(|color| 1.0 + f64::from(*alpha) * (f64::from(*color) - 1.0))
        };
        let [own, expected] =
            [picture, whole].map(|picture| picture.iter().map(over_white).collect::<Vec<[f64; 3]>>());
        let seen = flip(&own, &expected, width);
        let touched = |i: &usize| picture[*i][3] > 0.0 || whole[*i][3] > 0.0;
        let (mut count, mut squares, mut sum) = (0_u32, 0.0, 0.0);
        for i in (0..picture.len()).filter(touched) {
            count += 1;
            let encoded = |linear: f64| f64::from(srgb_from_linear(linear.clamp(0.0, 1.0) as f32));
            let of = |j: usize| 255.0 * (encoded(own[i][j]) - encoded(expected[i][j]));
            squares += (0..3).map(|j| of(j).powi(2)).sum::<f64>() / 3.0;
            sum += 255.0 * seen[i];
        }
        let changed = picture.iter().zip(whole).filter(|(a, b)| (a[3] >= 0.5) != (b[3] >= 0.5));
        let count = f64::from(count.max(1));
        Self { rms: (squares / count).sqrt(), flip: sum / count, silhouette_px: changed.count() as u64 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_are_of_what_is_covered() {
        let nothing = [0.0; 4];
        let whole = vec![[1.0, 1.0, 1.0, 1.0], [0.0, 0.0, 0.0, 1.0], nothing, nothing];
        assert_eq!(LevelError::of(&whole, &whole, 2), LevelError::default());
        // Black where it was white: one of two pixels, wholly wrong.
        let mut other = whole.clone();
        other[0] = [0.0, 0.0, 0.0, 1.0];
        let error = LevelError::of(&other, &whole, 2);
        assert!((error.rms - 255.0 * 0.5_f64.sqrt()).abs() < 1e-3 && error.flip > 50.0, "{error:?}");
        assert_eq!(error.silhouette_px, 0);
        // White over white is seen by its coverage alone.
        other.clone_from(&whole);
        other[2] = [1.0, 1.0, 1.0, 0.6];
        let error = LevelError::of(&other, &whole, 2);
        assert!((error.rms, error.silhouette_px) == (0.0, 1), "{error:?}");
    }
}
