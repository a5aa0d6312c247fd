//! Eye-dome lighting (Boucheny 2009): the surface is darker where what is around it in the image is nearer to the eye.
//!
//! `color = albedo · exp(−s · m)`, with `s = 0.7` and m the mean over eight pixels, a knight's move away each, of `max(0, ln z − ln z')`
//! per angle between the two: `√5 / focal`. On a plane that is tilted by θ that is tan θ times the mean of the positive part of
//! a cosine: so the strength belongs to slopes, neither to the unit of lengths nor to the size of the picture.

use super::picture::Pixel;
use super::view::View;

/// What a slope of 1 all around makes darker, as an exponent.
const STRENGTH: f64 = 0.7;

/// To the pixels that are looked at.
const KNIGHTS_MOVES: [[i64; 2]; 8] = [[1, 2], [2, 1], [2, -1], [1, -2], [-1, -2], [-2, -1], [-2, 1], [-1, 2]];

/// Colors the pixels of opaque splats, which have their albedo as color. A decision that rounding can turn at a pixel that is
/// looked at is one of its own.
pub(super) fn shade(view: &View, pixels: &mut [Pixel]) {
    let before = pixels.to_vec();
    let [width, height] = view.size_px.map(i64::from);
    for (i, pixel) in pixels.iter_mut().enumerate() {
        let (column, row) = (i as i64 % width, i as i64 / width);
        let mut sum = 0.0;
        for [right, down] in KNIGHTS_MOVES {
            let (column, row) = (column + right, row + down);
            if !(0..width).contains(&column) || !(0..height).contains(&row) {
                continue;
            }
            let other = &before[(row * width + column) as usize];
            pixel.rim |= other.rim;
            pixel.note_margin(other.epsilon_margin);
            if other.is_covered() {
                sum += (pixel.depth.ln() - other.depth.ln()).max(0.0);
            }
        }
        if pixel.is_covered() {
            let slope = sum / 8.0 * view.focal_px / 5.0_f64.sqrt();
            let [red, green, blue] = pixel.albedo.map(|component| component * (-STRENGTH * slope).exp());
            pixel.color = [red, green, blue, 1.0];
        }
    }
}
