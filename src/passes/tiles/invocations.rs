//! What an invocation draws of a tile, and how it comes by the tile's splats.

use crate::{scene::TileInvocations, vk::Limits};

/// Texels of a buffer below which lists are rather read as words: Vulkan promises 65536. Where there are more entries than texels,
/// large splats are left to the graphics pipeline.
const LEAST_TEXELS: u32 = 1 << 24;

/// The two together, as the permutations of `glsl/tile_splat.comp.glsl` and `tile_layers.comp.glsl` have them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Invocations {
    /// A column of pixels; they load splats for each other.
    Columns,
    /// A column of pixels; each loads every splat, where the device can't hand values on or has small texel buffers.
    ColumnsAlone,
    /// A pixel; they load splats for each other.
    Pixels,
}

impl Invocations {
    /// What was asked for, as this device can do it.
    pub fn of(wanted: TileInvocations, limits: &Limits) -> Self {
        let pixels = match wanted {
            TileInvocations::Auto => !limits.is_cpu,
            TileInvocations::Column => false,
            TileInvocations::Pixel => true,
        };
        match (pixels, limits.shuffles && limits.max_texels >= LEAST_TEXELS) {
            (true, _) => Self::Pixels,
            (false, true) => Self::Columns,
            (false, false) => Self::ColumnsAlone,
        }
    }

    /// Whether records and lists are read as texel buffers, not as storage buffers. Of a storage buffer, llvmpipe reads each component
    /// for the 8 lanes of a vector by a loop over them; a texel, by 8 loads without a branch.
    pub fn fetch_texels(self) -> bool {
        self == Self::Columns
    }

    /// Splats of one step of a shader's loops: `BATCH` of `glsl/inc/tile_batch.glsl`.
    pub fn batch(self) -> u32 {
        match self {
            Self::Columns | Self::Pixels => 8,
            Self::ColumnsAlone => 1,
        }
    }

    /// The word of the permutation.
    pub fn word(self) -> Option<&'static str> {
        match self {
            Self::Columns => None,
            Self::ColumnsAlone => Some("direct"),
            Self::Pixels => Some("pixels"),
        }
    }

    /// In words, what an invocation draws.
    pub fn draws(self) -> &'static str {
        match self {
            Self::Columns | Self::ColumnsAlone => "a column of pixels",
            Self::Pixels => "a pixel",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cpus_draw_columns_and_gpus_pixels_unless_asked_otherwise() {
        use TileInvocations::{Auto, Column, Pixel};
        let gpu = Limits { shuffles: true, max_texels: LEAST_TEXELS, ..Limits::for_tests() };
        let cpu = Limits { is_cpu: true, ..gpu };
        assert_eq!(Invocations::of(Auto, &cpu), Invocations::Columns);
        assert_eq!(Invocations::of(Auto, &gpu), Invocations::Pixels);
        assert_eq!(Invocations::of(Column, &gpu), Invocations::Columns);
        let without = [Limits { shuffles: false, ..cpu }, Limits { max_texels: LEAST_TEXELS - 1, ..cpu }];
        for limits in [cpu, without[0], without[1]] {
            assert_eq!(Invocations::of(Pixel, &limits), Invocations::Pixels);
        }
        for limits in without {
            assert_eq!(Invocations::of(Auto, &limits), Invocations::ColumnsAlone);
        }
    }
}
