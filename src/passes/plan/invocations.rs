//! What an invocation draws of a tile, and how it comes by the tile's splats.

use crate::{
    scene::{Edges, TileInvocations},
    shaders::Shader,
    vk::Limits,
};

/// Texels of a buffer below which lists are rather read as words: Vulkan promises 65536. Where there are more entries than texels,
/// large splats are left to the graphics pipeline.
const LEAST_TEXELS: u32 = 1 << 24;

/// The two together, as `glsl/tile/lanes.glsl` has them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Invocations {
    /// A column of pixels; they load splats for each other.
    Columns,
    /// The same of tiles half as high.
    ShortColumns,
    /// A pixel; they load splats for each other.
    Pixels,
}

/// Pixels below which the mean of splats' boxes is where tiles are half as high. Such splats cover less of a tile's pixels, all of which are computed; larger ones lie in so many tiles more that
/// lists take what that gains, and their memory. Where edges cover pixels in part a pixel takes longer, and its splats' boxes are wider.
fn small_below_px(edges: Edges) -> f64 {
    match edges {
        Edges::Hard => 13.0,
        Edges::Coverage => 24.0,
    }
}

/// Up to so many pixels all of them are then.
const LARGEST_SMALL_PX: f64 = 32.0;

/// Whether splats with such boxes, how many with how many pixels along a side at most, are small for a tile.
pub(crate) fn are_small(boxes: impl Iterator<Item = (u32, f64)>, edges: Edges) -> bool {
    let (mut count, mut sum_px, mut largest_px) = (0.0, 0.0, 0.0_f64);
    for (more, px) in boxes {
        count += f64::from(more);
        sum_px += f64::from(more) * px;
        largest_px = largest_px.max(px);
    }
    sum_px < small_below_px(edges) * count && largest_px <= LARGEST_SMALL_PX
}

impl Invocations {
    /// Whether an invocation can draw a column of pixels on this device.
    pub fn has_columns(limits: &Limits) -> bool {
        limits.shuffles && limits.max_texels >= LEAST_TEXELS
    }

    /// What was asked for, as this device can do it; `small`: the splats are.
    pub fn of(wanted: TileInvocations, limits: &Limits, small: bool) -> Self {
        let columns = |short| match (Self::has_columns(limits), short) {
            // A column alone would load every splat by itself.
            (false, _) => Self::Pixels,
            (true, false) => Self::Columns,
            (true, true) => Self::ShortColumns,
        };
        match wanted {
            TileInvocations::Auto if limits.is_cpu => columns(small),
            TileInvocations::Auto | TileInvocations::Pixel => Self::Pixels,
            TileInvocations::Column => columns(false),
            TileInvocations::ShortColumn => columns(true),
        }
    }

    /// The same of tiles that are not half as high.
    pub fn of_full_height(self) -> Self {
        if self == Self::ShortColumns { Self::Columns } else { self }
    }

    /// Pixels of a tile's column.
    pub fn tile_height(self) -> u32 {
        match self {
            Self::ShortColumns => 4,
            Self::Columns | Self::Pixels => 8,
        }
    }

    /// Whether records and lists are read as texel buffers, not as storage buffers. Of a storage buffer, llvmpipe reads each component
    /// for the 8 lanes of a vector by a loop over them; a texel, by 8 loads without a branch.
    pub fn fetch_texels(self) -> bool {
        matches!(self, Self::Columns | Self::ShortColumns)
    }

    /// Whether those of a workgroup go over splats together to list them by tile, or each by itself.
    pub fn walk_together(self) -> bool {
        self == Self::Pixels
    }

    /// The shader of a pass: by columns, or by pixels.
    pub(crate) fn shader(self, [column, pixel]: [&'static Shader; 2]) -> &'static Shader {
        if self == Self::Pixels { pixel } else { column }
    }

    /// In words, what an invocation draws.
    pub fn draws(self) -> &'static str {
        match self {
            Self::Columns | Self::ShortColumns => "a column of pixels",
            Self::Pixels => "a pixel",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cpus_draw_columns_and_gpus_pixels_unless_asked_otherwise() {
        use TileInvocations::{Auto, Column, Pixel, ShortColumn};
        let gpu = Limits { shuffles: true, max_texels: LEAST_TEXELS, ..Limits::plain() };
        let cpu = Limits { is_cpu: true, ..gpu };
        let of = |wanted, limits: &Limits| Invocations::of(wanted, limits, false);
        assert_eq!(of(Auto, &cpu), Invocations::Columns);
        assert_eq!(of(Auto, &gpu), Invocations::Pixels);
        assert_eq!(of(Column, &gpu), Invocations::Columns);
        assert_eq!(of(ShortColumn, &gpu), Invocations::ShortColumns);
        let without = [Limits { shuffles: false, ..cpu }, Limits { max_texels: LEAST_TEXELS - 1, ..cpu }];
        for limits in [cpu, without[0], without[1]] {
            assert_eq!(of(Pixel, &limits), Invocations::Pixels);
        }
        for limits in without {
            assert_eq!([of(Auto, &limits), of(ShortColumn, &limits)], [Invocations::Pixels; 2]);
        }
    }

    #[test]
    fn tiles_are_half_as_high_for_small_splats_on_cpus_unless_asked_otherwise() {
        use TileInvocations::{Auto, Column, ShortColumn};
        let gpu = Limits { shuffles: true, max_texels: LEAST_TEXELS, ..Limits::plain() };
        let cpu = Limits { is_cpu: true, ..gpu };
        let height = |wanted, limits: &Limits, small| Invocations::of(wanted, limits, small).tile_height();
        assert_eq!([height(Auto, &cpu, true), height(Auto, &cpu, false)], [4, 8]);
        assert_eq!([height(Column, &cpu, true), height(ShortColumn, &cpu, false)], [8, 4]);
        assert_eq!(height(Auto, &gpu, true), 8);
    }

    #[test]
    fn splats_are_small_where_most_are_and_none_is_large() {
        for (edges, small_px, large_px) in [(Edges::Hard, 11.0, 14.0), (Edges::Coverage, 22.0, 25.0)] {
            let small = |boxes: &[(u32, f64)]| are_small(boxes.iter().copied(), edges);
            assert!(small(&[(1000, small_px), (10, 32.0)]));
            assert!(!small(&[(1000, large_px)]) && !small(&[(1000, 5.0), (1, 33.0)]));
            // Such as no box bounds, and none at all.
            assert!(!small(&[(1000, 5.0), (1, f64::INFINITY)]) && !small(&[(1000, f64::NAN)]));
            assert!(!small(&[]));
        }
    }
}
