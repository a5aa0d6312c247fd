//! A picture as the comparison takes it: plain arrays, whoever has drawn it.

use crate::reference::{GroundTruth, Picture};

/// How near to the ε-threshold a fragment makes its pixel a matter of rounding, relative to the depth.
const EPSILON_MARGIN: f64 = 1e-4;

/// A normalized surface and its color, row by row from the top left.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Surface {
    /// Width and height in pixels.
    pub size_px: [u32; 2],
    /// The part of each pixel that is covered, 0–1. Only a filtered surface has values between.
    pub coverage: Vec<f32>,
    /// Unit normal in view space, where covered.
    pub normal: Vec<[f32; 3]>,
    /// View-space z in world units, where covered.
    pub depth: Vec<f32>,
    /// Linear red, green, blue of the surface alone, where covered.
    pub color: Vec<[f32; 3]>,
}

impl Surface {
    /// Whether at least half of a pixel is covered.
    pub fn covers(&self, pixel: usize) -> bool {
        self.coverage[pixel] >= 0.5
    }

    /// The surface of a reference picture.
    pub fn of(picture: &Picture) -> Self {
        let pixels = &picture.pixels;
        Self {
            size_px: picture.size_px,
            coverage: pixels.iter().map(|pixel| f32::from(u8::from(pixel.is_covered()))).collect(),
            normal: pixels.iter().map(|pixel| pixel.normal.map(|component| component as f32)).collect(),
            depth: pixels.iter().map(|pixel| pixel.depth as f32).collect(),
            color: pixels
                .iter()
                .map(|pixel| {
                    [pixel.color[0], pixel.color[1], pixel.color[2]].map(|component| component as f32)
                })
                .collect(),
        }
    }

    /// The surface of the ground truth.
    pub fn of_truth(truth: &GroundTruth) -> Self {
        let pixels = &truth.pixels;
        Self {
            size_px: truth.size_px,
            coverage: pixels.iter().map(|pixel| pixel.coverage as f32).collect(),
            normal: pixels.iter().map(|pixel| pixel.normal.map(|component| component as f32)).collect(),
            depth: pixels.iter().map(|pixel| pixel.depth as f32).collect(),
            color: pixels.iter().map(|pixel| pixel.color.map(|component| component as f32)).collect(),
        }
    }

    /// Which pixels of a reference picture rounding may turn: a rim passes through the center, or a fragment lies
    /// within 1e-4 of the ε-threshold.
    pub fn undecided(picture: &Picture) -> Vec<bool> {
        let undecided = |pixel: &crate::reference::Pixel| pixel.rim || pixel.epsilon_margin < EPSILON_MARGIN;
        picture.pixels.iter().map(undecided).collect()
    }

    /// A pixel over a background, linear.
    pub(super) fn over(&self, i: usize, background: [f32; 3]) -> [f32; 3] {
        let (share, color) = (self.coverage[i], self.color[i]);
        [0, 1, 2].map(|c| match share {
            0.0 => background[c],
            _ => background[c] + share * (color[c] - background[c]),
        })
    }

    /// The picture over a background (linear), 8-bit sRGB.
    pub fn srgb_over(&self, background: [f32; 3]) -> Vec<[u8; 3]> {
        let byte = |linear: f32| {
            // The cast saturates, and takes NaN to 0.
            (255.0 * crate::math::srgb::srgb_from_linear(linear.clamp(0.0, 1.0)) + 0.5) as u8
        };
        (0..self.coverage.len()).map(|i| self.over(i, background).map(byte)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_picture_lies_over_its_background_by_its_coverage() {
        let surface = Surface {
            size_px: [4, 1],
            coverage: vec![0.0, 1.0, 0.5, 1.0],
            color: vec![[f32::NAN; 3], [1.0, 0.0, 0.215_861], [0.0; 3], [f32::NAN, 2.0, -1.0]],
            ..Surface::default()
        };
        let srgb = surface.srgb_over([1.0; 3]);
        // Half black over white is 0.5 in linear light, 188 of 255 in sRGB.
        assert_eq!(srgb, [[255; 3], [255, 0, 128], [188; 3], [0, 255, 0]]);
    }
}
