//! A part of a picture that is drawn alone, as if it were cut out of the whole.

use super::{Camera, OptionValue, Shading, Window};
use crate::error::{Error, Result};

/// A rectangle of whole pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Crop {
    /// Its top left corner, from the whole picture's.
    pub corner_px: [u32; 2],
    /// Its width and height.
    pub size_px: [u32; 2],
}

/// The image that is drawn for a [`Crop`]: it begins with a tile of the whole picture, so that each pixel has its bits; and what
/// is cut out of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CropView {
    /// The size that is drawn.
    pub drawn_px: [u32; 2],
    /// From where.
    pub camera: Camera,
    /// The crop in what is drawn.
    cut: Crop,
}

/// Tiles count rows from a multiple of this (`glsl/tile/work.glsl`), and blocks of pixels of rasterizers divide it.
const ALIGNED_PX: u32 = 8;

/// So far are the neighbors of a pixel whose depths eye-dome lighting compares: a knight's move (`glsl/eye_dome.frag.glsl`).
const EYE_DOME_REACH_PX: u32 = 2;

impl Crop {
    /// How to draw this part of a picture of that size.
    ///
    /// # Errors
    /// [`crate::error::ErrorKind::Option`] where it is not within the picture.
    pub fn view(self, whole_px: [u32; 2], camera: &Camera) -> Result<CropView> {
        self.view_shaded(whole_px, camera, Shading::default())
    }

    /// The same, of a picture that is shaded so.
    ///
    /// # Errors
    /// As [`Self::view`].
    pub fn view_shaded(self, whole_px: [u32; 2], camera: &Camera, shading: Shading) -> Result<CropView> {
        let end_px = |i: usize| u64::from(self.corner_px[i]) + u64::from(self.size_px[i]);
        let within = |i: usize| self.size_px[i] > 0 && end_px(i) <= u64::from(whole_px[i]);
        if !(within(0) && within(1)) {
            let [width, height] = whole_px;
            let problem = format!("{}: expected a part of {width}x{height} pixels (--size)", self.word());
            return Err(Error::option("--crop", problem));
        }
        // What pixels depend on is drawn, too.
        let border_px = if shading == Shading::EyeDome { EYE_DOME_REACH_PX } else { 0 };
        let first_px = self.corner_px.map(|at| at.saturating_sub(border_px) / ALIGNED_PX * ALIGNED_PX);
        let inside_px = [0, 1].map(|i| self.corner_px[i] - first_px[i]);
        let last_px = [0, 1].map(|i| (end_px(i) + u64::from(border_px)).min(whole_px[i].into()) as u32);
        Ok(CropView {
            drawn_px: [0, 1].map(|i| last_px[i] - first_px[i]),
            camera: Camera {
                window: Window { whole_px: Some(whole_px), corner_px: first_px.map(f64::from) },
                ..*camera
            },
            cut: Self { corner_px: inside_px, ..self },
        })
    }
}

impl CropView {
    /// Width and height of what [`Self::cut`] leaves.
    pub fn size_px(&self) -> [u32; 2] {
        self.cut.size_px
    }

    /// The drawn pixel that is this one of what [`Self::cut`] leaves.
    pub fn drawn_pixel(&self, pixel: [u32; 2]) -> [u32; 2] {
        [0, 1].map(|i| self.cut.corner_px[i].saturating_add(pixel[i]))
    }

    /// Of all drawn pixels, row by row, those of the crop; nothing of nothing.
    pub fn cut<T: Clone>(&self, drawn: &[T]) -> Vec<T> {
        let [[left, top], [width, height]] =
            [self.cut.corner_px, self.cut.size_px].map(|pair| pair.map(|side| side as usize));
        let rows = drawn.chunks_exact(self.drawn_px[0] as usize).skip(top).take(height);
        rows.flat_map(|row| row[left..left + width].iter().cloned()).collect()
    }
}

impl OptionValue for Crop {
    fn word(&self) -> String {
        let ([x, y], [width, height]) = (self.corner_px, self.size_px);
        format!("{x},{y},{width},{height}")
    }

    fn parse(word: &str) -> std::result::Result<Self, String> {
        let numbers: Option<Vec<u32>> = word.split(',').map(|part| part.trim().parse().ok()).collect();
        match numbers.as_deref() {
            Some(&[x, y, width, height]) if width > 0 && height > 0 => {
                Ok(Self { corner_px: [x, y], size_px: [width, height] })
            }
            _ => Err("expected left, top, width, height in whole pixels, such as 200,0,640,480".to_owned()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_crop_is_cut_out_of_an_image_that_begins_with_a_tile() {
        let crop = Crop::parse("11,16,2,3").unwrap();
        assert_eq!(Crop::parse(&crop.word()), Ok(crop));
        let view = crop.view([20, 19], &Camera::default()).unwrap();
        assert_eq!((view.drawn_px, view.size_px()), ([5, 3], [2, 3]));
        assert_eq!(view.camera.window.corner_px, [8.0, 16.0]);
        assert_eq!(view.camera.middle_px(view.drawn_px), [2.0, -6.5]);
        let drawn: Vec<u32> = (0..15).collect();
        assert_eq!(view.cut(&drawn), [3, 4, 8, 9, 13, 14]);
        // With what is two pixels away, as far as there is some.
        let view = crop.view_shaded([20, 20], &Camera::default(), Shading::EyeDome).unwrap();
        assert_eq!((view.drawn_px, view.size_px()), ([7, 12], [2, 3]));
        assert_eq!(view.camera.window.corner_px, [8.0, 8.0]);
        let drawn: Vec<u32> = (0..84).collect();
        assert_eq!(view.cut(&drawn), [59, 60, 66, 67, 73, 74]);
        assert!(view.cut::<u8>(&[]).is_empty());
        for outside in ["19,0,2,1", "0,17,1,3", "4294967295,0,1,1"] {
            let error = Crop::parse(outside).unwrap().view([20, 19], &Camera::default()).unwrap_err();
            assert_eq!(
                error.to_string(),
                format!("--crop: {outside}: expected a part of 20x19 pixels (--size)")
            );
        }
        for word in ["", "1,2,3", "1,2,3,0", "1,2,0,3", "-1,2,3,4", "1,2,3,4,5", "1.5,2,3,4"] {
            assert!(Crop::parse(word).is_err(), "{word}");
        }
    }
}
