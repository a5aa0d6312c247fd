//! The oracle's picture: one record a pixel.

use crate::scene::DefectCounts;

/// A reference picture and what was left out of it.
#[derive(Clone, Debug)]
pub struct Picture {
    /// Width and height in pixels.
    pub size_px: [u32; 2],
    /// Row by row, the top left pixel first; `width · height` entries.
    pub pixels: Vec<Pixel>,
    /// The splats that can't be drawn, by reason; they are not in the picture. Nor are triangles without area, or with a
    /// corner that is missing or not finite: those are not counted.
    pub defects: DefectCounts,
}

/// One pixel: the normalized surface of the opaque splats, the color of all that is seen, and how close the pixel is to a
/// decision that rounding can turn.
///
/// Weight, fragments, albedo, normal, depth and alpha are of the opaque splats that count, where a polygon is seen too.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pixel {
    /// `Σw` over the fragments of the nearest surface; 0 where the pixel is empty: where no opaque splat counts.
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
    /// The color of all that is seen, linear red, green, blue, not multiplied by alpha; and alpha: 1 where something opaque
    /// is seen or there is a background, else that of the transparent layers together, `1 − Π(1 − α)`. All 0 where
    /// nothing is seen.
    pub color: [f64; 4],
    /// `Σw·α / Σw` of the opaque splats' own alpha: 1; 0 where empty.
    pub alpha: f64,
    /// An opaque polygon is seen here: the nearest one, not behind the nearest shifted depth of splats.
    pub polygon: bool,
    /// How many transparent layers there are before what is opaque, whatever number is drawn.
    pub layers: u32,
    /// The smallest `|z − z*| / z*` over the covering fragments, with z* the nearest shifted depth: how close one
    /// is to being taken for another surface. The fragment that z* itself belongs to is left out, because it
    /// passes whatever the precision. +∞ where there is no other fragment.
    ///
    /// With polygons or layers it is the smallest over all comparisons of depths, each relative to its second term: of the
    /// polygon and z*; of the nearest polygon and the next one, where it is seen; of a splat, shifted toward the eye,
    /// and the polygon (of two conditions that both fail the larger margin, of two of which one fails that one's); of
    /// what is transparent and what hides it; of what remains behind a layer that is drawn, and the layer's own
    /// shifted depth, its owner left out; of polygons and the near plane. Splats that leave the near plane have no margin.
    pub epsilon_margin: f64,
    /// Some splat that is not hidden has its rim here: its `r²` is within `max(1e-3, 16·2⁻²⁴·|x|/b)` of the largest
    /// `r²` that covers, with |x| the distance from the middle of the image and b its semi-minor axis, both in
    /// pixels, of the splat as drawn (for a splat that reaches the near plane, b is that of the affine map at the
    /// fragment). With the filter `max` also the border of the low-pass filter, where it lies outside the splat.
    /// With the rasterizer `raycast-approximate` also the border of its square, to 1e-3 px + 16·2⁻²⁴·|x|. Hidden is
    /// a splat whose depth here is beyond z* by more than that margin, relative: present or not, it changes
    /// nothing. Of a transparent splat, or where an opaque polygon is seen, z* is what hides the splat.
    ///
    /// Also where [`Self::border_px`] is at most 1/256 + 16·2⁻²⁴·|x|: what a grid of 1/256 pixel for vertices, and the
    /// rounding of places, move an edge.
    pub rim: bool,
    /// How far the pixel's center is from the nearest border of a polygon that is not hidden, inside or outside, if it is at
    /// most 1/16 pixel; +∞ otherwise. A border is an edge beyond which no other triangle of the object goes on, between
    /// the same vertices and with the same side to the eye. It is taken to reach 1/16 pixel beyond its ends.
    pub border_px: f64,
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
            polygon: false,
            layers: 0,
            epsilon_margin: f64::INFINITY,
            rim: false,
            border_px: f64::INFINITY,
        }
    }

    /// Takes the margin of one more decision into account.
    pub(super) fn note_margin(&mut self, margin: f64) {
        self.epsilon_margin = self.epsilon_margin.min(margin);
    }

    /// Whether some opaque splat covers it, and is not hidden by a polygon.
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
