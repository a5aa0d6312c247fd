//! Which pixels are a silhouette's, and which are inside.

use crate::reference::{Edge, GroundTruth};

/// How far a silhouette reaches from a pixel through which an edge passes, in pixels between centers. The next pixel's center is 2.5
/// pixels from the edge at least, where 2e-4 of the truth's filter is beyond it: its standard deviation is √½ pixels by default.
pub const BAND_PX: f64 = 2.0;

/// Where a pixel is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Region {
    /// No silhouette is near, and at least half of the truth's filter sees a surface.
    Inside,
    /// Within [`BAND_PX`] of an edge's pixel.
    Silhouette,
    /// All others.
    Outside,
}

/// The region of each pixel. It is the truth's alone, so that all pictures are judged over the same pixels.
pub fn regions(truth: &GroundTruth) -> Vec<Region> {
    let [width, height] = truth.size_px.map(i64::from);
    let reach = BAND_PX.floor() as i64;
    let mut regions: Vec<Region> = truth
        .pixels
        .iter()
        .map(|pixel| if pixel.coverage >= 0.5 { Region::Inside } else { Region::Outside })
        .collect();
    for (i, pixel) in truth.pixels.iter().enumerate() {
        if pixel.edge == Edge::None {
            continue;
        }
        let (x, y) = (i as i64 % width, i as i64 / width);
        for row in (y - reach).max(0)..(y + reach + 1).min(height) {
            for column in (x - reach).max(0)..(x + reach + 1).min(width) {
                if ((row - y).pow(2) + (column - x).pow(2)) as f64 <= BAND_PX * BAND_PX {
                    regions[(row * width + column) as usize] = Region::Silhouette;
                }
            }
        }
    }
    regions
}
