//! How far a drawn picture is from the ground truth, told apart by place: inside of surfaces, where filters matter, and at
//! silhouettes, where coverage does.

mod flip;
mod flip_color;
mod flip_filter;
mod region;
#[cfg(test)]
mod tests;

use serde::Serialize;

pub use flip::flip;
pub use region::{BAND_PX, Region, regions};

use crate::{
    math::srgb::srgb_from_linear,
    reference::{Edge, GroundTruth},
};

/// What the whole picture is compared over: white, and black. What is too dark shows over one, what is too bright over the other.
const BACKGROUNDS: [f64; 2] = [1.0, 0.0];

/// How far a picture is from the ground truth.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct PictureError {
    /// Over the silhouettes, the inside, and all further pixels in which picture or truth have anything.
    pub whole: RegionError,
    /// Where the truth covers at least half of the pixel and no silhouette is near.
    pub inside: RegionError,
    /// Within [`BAND_PX`] of a pixel through which an edge of the truth passes, see [`Edge`].
    pub silhouette: RegionError,
    /// The darkest fringe: the largest by which a component of a silhouette's pixel is darker than the truth over white, in
    /// 255ths of sRGB. 0 where none is.
    pub dark_fringe: f64,
    /// The brightest fringe: the largest by which it is brighter over black, likewise.
    pub bright_fringe: f64,
    /// How many pixels too wide what is drawn is along the outline: the area by which it covers more than the truth in the silhouette
    /// band, for each pixel that an outline passes through; below 0 where it is too narrow. `None` without an outline.
    pub wider_px: Option<f64>,
    /// Pixels of the silhouette band that are covered in part, by the picture: an alpha between 1/255 and 254/255.
    pub partial_px: u64,
}

/// The error of one region.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct RegionError {
    /// Its pixels.
    pub px: u64,
    /// Over white; `None` where there is no pixel.
    pub over_white: Option<Figures>,
    /// Over black.
    pub over_black: Option<Figures>,
}

/// The error of one region over one background.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Figures {
    /// The root of the mean square over its pixels and their three components, in linear light; white is 1.
    pub rms: f64,
    /// The mean of the differences that are seen ([`flip`]), 0–1.
    pub flip: f64,
}

impl RegionError {
    /// The larger one of both backgrounds; `None` where there is no pixel.
    pub fn rms(&self) -> Option<f64> {
        Some(self.over_white?.rms.max(self.over_black?.rms))
    }

    /// The larger one of both backgrounds; `None` where there is no pixel.
    pub fn flip(&self) -> Option<f64> {
        Some(self.over_white?.flip.max(self.over_black?.flip))
    }
}

/// Compares a picture, linear red, green, blue and straight alpha of each pixel, drawn without a background
/// ([`crate::scene::Settings::background`] is `None`), with the truth. A component that is not finite has an infinite error.
///
/// # Panics
/// If the picture does not have the truth's size.
pub fn picture_error(picture: &[[f32; 4]], truth: &GroundTruth) -> PictureError {
    assert_eq!(picture.len(), truth.pixels.len(), "pictures of two sizes");
    let regions = regions(truth);
    let touched: Vec<bool> = (0..picture.len())
        .map(|i| regions[i] != Region::Outside || truth.pixels[i].coverage > 0.0 || picture[i][3] != 0.0)
        .collect();
    let over = BACKGROUNDS.map(|background| Over::of(picture, truth, background));
    let region = |inside: &dyn Fn(usize) -> bool| {
        let pixels: Vec<usize> = (0..picture.len()).filter(|i| inside(*i)).collect();
        let [over_white, over_black] = [0, 1].map(|i| over[i].figures(&pixels));
        RegionError { px: pixels.len() as u64, over_white, over_black }
    };
    let band: Vec<usize> = (0..picture.len()).filter(|i| regions[*i] == Region::Silhouette).collect();
    let fringe = |over: &Over, sign: f64| {
        let all = band.iter().flat_map(|i| over.levels(*i));
        all.map(|level| if level.is_nan() { f64::INFINITY } else { sign * level }).fold(0.0, f64::max)
    };
    let outlines = truth.pixels.iter().filter(|pixel| pixel.edge == Edge::Outline).count();
    let more = |i: &usize| f64::from(picture[*i][3]) - truth.pixels[*i].coverage;
    let partial = |i: &&usize| (1.0 / 255.0..=254.0 / 255.0).contains(&picture[**i][3]);
    PictureError {
        whole: region(&|i| touched[i]),
        inside: region(&|i| regions[i] == Region::Inside),
        silhouette: region(&|i| regions[i] == Region::Silhouette),
        dark_fringe: fringe(&over[0], -1.0),
        bright_fringe: fringe(&over[1], 1.0),
        wider_px: (outlines > 0).then(|| band.iter().map(more).sum::<f64>() / outlines as f64),
        partial_px: band.iter().filter(partial).count() as u64,
    }
}

/// Both pictures over one background.
struct Over {
    own: Vec<[f64; 3]>,
    expected: Vec<[f64; 3]>,
    seen: Vec<f64>,
}

impl Over {
    fn of(picture: &[[f32; 4]], truth: &GroundTruth, background: f64) -> Self {
        let blend = |color: [f64; 3], share: f64| match share {
            0.0 => [background; 3],
            _ => color.map(|component| background + share * (component - background)),
        };
        let own: Vec<[f64; 3]> = picture
            .iter()
            .map(|[red, green, blue, alpha]| blend([*red, *green, *blue].map(f64::from), f64::from(*alpha)))
            .collect();
        let expected: Vec<[f64; 3]> =
            truth.pixels.iter().map(|pixel| blend(pixel.color, pixel.coverage)).collect();
        let seen = flip(&own, &expected, truth.size_px[0] as usize);
        Self { own, expected, seen }
    }

    fn figures(&self, pixels: &[usize]) -> Option<Figures> {
        let square = |i: &usize| -> f64 {
            let difference = |c: usize| (self.own[*i][c] - self.expected[*i][c]).powi(2);
            [0, 1, 2].map(difference).iter().sum()
        };
        let count = pixels.len() as f64;
        let squares: f64 = pixels.iter().map(square).sum();
        let rms = (squares / (3.0 * count)).sqrt();
        let flip = pixels.iter().map(|i| self.seen[*i]).sum::<f64>() / count;
        (count > 0.0).then_some(Figures { rms: if rms.is_nan() { f64::INFINITY } else { rms }, flip })
    }

    /// How much brighter the picture is, in 255ths of sRGB.
    fn levels(&self, i: usize) -> [f64; 3] {
        let srgb = |linear: f64| 255.0 * f64::from(srgb_from_linear(linear.clamp(0.0, 1.0) as f32));
        [0, 1, 2].map(|c| srgb(self.own[i][c]) - srgb(self.expected[i][c]))
    }
}
