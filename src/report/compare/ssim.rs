//! Structural similarity (Wang, Bovik, Sheikh, Simoncelli 2004) by a library.

use image::{DynamicImage, RgbImage};
use image_compare::{Algorithm, gray_similarity_structure};

use super::Surface;

/// The mean structural similarity of two pictures of one size over one background (linear): of their gray 8-bit sRGB
/// values, over windows of 8×8 pixels that do not overlap. 1 for equal ones. `None` for pictures without a pixel.
pub fn ssim(a: &Surface, b: &Surface, background: [f32; 3]) -> Option<f64> {
    let [width, height] = a.size_px;
    let gray = |surface: &Surface| {
        let bytes = surface.srgb_over(background).into_flattened();
        RgbImage::from_raw(width, height, bytes).map(|image| DynamicImage::ImageRgb8(image).into_luma8())
    };
    let similarity = gray_similarity_structure(&Algorithm::MSSIMSimple, &gray(a)?, &gray(b)?).ok()?;
    similarity.score.is_finite().then_some(similarity.score)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn gray(value: impl Fn(usize) -> f32) -> Surface {
        Surface {
            size_px: [8, 8],
            coverage: vec![1.0; 64],
            color: (0..64).map(|i| [value(i); 3]).collect(),
            ..Surface::default()
        }
    }

    #[test]
    fn two_flat_pictures_differ_by_the_papers_luminance_term_alone() {
        // 188 and 128 of 255: (2·188·128 + C1) / (188² + 128² + C1), C1 = (0.01·255)².
        let c1 = 6.5025;
        let expected = (2.0 * 188.0 * 128.0 + c1) / (188.0_f64.powi(2) + 128.0_f64.powi(2) + c1);
        let got = ssim(&gray(|_| 0.502_886), &gray(|_| 0.215_861), [0.0; 3]).unwrap();
        assert!((got - expected).abs() < 1e-9, "{got} {expected}");
    }

    #[test]
    fn structure_counts_and_equal_pictures_have_one() {
        let stripes = |shift: usize| gray(move |i| if (i + shift).is_multiple_of(2) { 1.0 } else { 0.0 });
        let same = ssim(&stripes(0), &stripes(0), [0.0; 3]).unwrap();
        assert!((same - 1.0).abs() < 1e-12, "{same}");
        // Black for white and white for black.
        assert!(ssim(&stripes(0), &stripes(1), [0.0; 3]).unwrap() < -0.9);
    }

    #[test]
    fn the_background_is_part_of_the_picture() {
        let empty = Surface { coverage: vec![0.0; 64], ..gray(|_| 0.0) };
        let white = gray(|_| 1.0);
        assert!((ssim(&empty, &white, [1.0; 3]).unwrap() - 1.0).abs() < 1e-12);
        assert!(ssim(&empty, &white, [0.0; 3]).unwrap() < 0.1);
    }
}
