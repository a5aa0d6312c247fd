//! Splats so few that lists and tiles gain little.

use super::draws::Draw;
use crate::scene::Settings;

/// Pixels of the image for each splat above which tiles are not taken on a CPU. Where they begin to lose was measured to lie between 870 and 2600
/// at 512x512, 1050 and 3500 at 1024x1024, 4200 and 14 000 at 2048x2048 (`benches/README.md`).
const MOST_PIXELS_A_SPLAT: u64 = 1000;

/// Whether splats are so few that tiles gain little.
pub(crate) fn are_few(splats: &[Draw<'_>], settings: &Settings) -> bool {
    is_few(splats.iter().map(|draw| u64::from(draw.chunk.count)).sum(), settings)
}

pub(crate) fn is_few(splats: u64, settings: &Settings) -> bool {
    let [width, height] = settings.size_px.map(u64::from);
    splats * MOST_PIXELS_A_SPLAT < width * height
}
