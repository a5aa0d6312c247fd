//! What the oracle hands out: one record a pixel.

use crate::scene::DefectCounts;

/// A reference picture and what was left out of it.
#[derive(Clone, Debug)]
pub struct Picture {
    /// Width and height in pixels.
    pub size_px: [u32; 2],
    /// Row by row, the top left pixel first; `width · height` entries.
    pub pixels: Vec<Pixel>,
    /// The splats that can't be drawn, by reason; they are not in the picture.
    pub defects: DefectCounts,
}

/// One pixel: the normalized surface, its color, and how close the pixel is to a decision that rounding can turn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pixel {
    /// `Σw` over the fragments of the nearest surface; 0 where the pixel is empty.
    pub weight: f64,
    /// How many fragments these are.
    pub fragments: u32,
    /// `Σw·albedo / Σw`, linear red, green, blue; 0 where empty.
    pub albedo: [f64; 3],
    /// `Σw·n` normalized, in view space: a surface that faces the eye has z < 0. `(0, 0, −1)` where the sum
    /// vanishes, 0 where the pixel is empty.
    pub normal: [f64; 3],
    /// `|Σw·n| / Σw`: 1 where all normals agree, near 0 where they cancel; 0 where the pixel is empty.
    pub normal_length: f64,
    /// `Σw·z / Σw`, view-space z in world units; +∞ where empty.
    pub depth: f64,
    /// The shaded color, linear red, green, blue, and alpha: 1 where covered; where empty the background with
    /// alpha 1, or all 0 without one.
    pub color: [f64; 4],
    /// `Σw·α / Σw` of the splats' own alpha, 0–1; 0 where empty.
    pub alpha: f64,
    /// The smallest `|z − z*| / z*` over the covering fragments, with z* the nearest shifted depth: how close one
    /// is to being taken for another surface. The fragment that z* itself belongs to is left out, because it
    /// passes whatever the precision. +∞ where there is no other fragment.
    pub epsilon_margin: f64,
    /// Some splat that is not hidden has its rim here: its `r²` is within `max(1e-3, 16·2⁻²⁴·|x|/b)` of the largest
    /// `r²` that covers, with |x| the distance from the middle of the image and b its semi-minor axis, both in
    /// pixels, of the splat as drawn (for a splat that reaches the near plane, b is that of the affine map at the
    /// fragment). With the filter `max` also the border of the low-pass filter, where it lies outside the splat.
    /// With the rasterizer `raycast-approximate` also the border of its square, to 1e-3 px + 16·2⁻²⁴·|x|. Hidden is
    /// a splat whose depth here is beyond z* by more than that margin, relative: present or not, it changes
    /// nothing.
    pub rim: bool,
}

impl Pixel {
    /// An empty pixel on a background (linear color and alpha).
    pub(super) fn empty(background: [f64; 4]) -> Self {
        Self {
            weight: 0.0,
            fragments: 0,
            albedo: [0.0; 3],
            normal: [0.0; 3],
            normal_length: 0.0,
            depth: f64::INFINITY,
            color: background,
            alpha: 0.0,
            epsilon_margin: f64::INFINITY,
            rim: false,
        }
    }

    /// Whether some splat covers it.
    pub fn is_covered(&self) -> bool {
        self.weight > 0.0
    }
}

impl Picture {
    /// The pixel in `column` (from the left) and `row` (from the top); `None` outside the picture.
    pub fn pixel(&self, column: u32, row: u32) -> Option<&Pixel> {
        let [width, height] = self.size_px;
        if column >= width || row >= height {
            return None;
        }
        self.pixels.get(row as usize * width as usize + column as usize)
    }
}
