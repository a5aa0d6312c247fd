//! The methods that the papers compare: how a splat becomes fragments, how it is filtered, how its weight is found.

use super::option::named;
use crate::error::{Error, Result};

named! {
    /// How a splat becomes fragments.
    Rasterizer {
        /// `compute` where that is faster and can draw it: but for few splats on a CPU driver; else `perspective`. Never another picture.
        Auto = "auto",
        /// Points, by the inverse projective map, expanded about the projected center (Guennebaud et al. 2006, section 3).
        Perspective = "perspective",
        /// Points, by the same map in the paper's own form, `N (x, y, 1)`: less exact in 32 bits.
        PerspectivePaper = "perspective-paper",
        /// Points; the ray of each fragment meets the splat's plane (Botsch, Hornung, Zwicker, Kobbelt 2005).
        Raycast = "raycast",
        /// As `raycast` with that paper's point size, the radius seen at the center's depth: tilted splats off the axis are chopped.
        RaycastApproximate = "raycast-approximate",
        /// Points, by an affine map that is exact at the center (Guennebaud, Paulin 2003).
        AffineCenter = "affine-center",
        /// Points, by an affine map that keeps the contour (Zwicker, Räsänen, Botsch, Dachsbacher, Pauly 2004).
        AffineContour = "affine-contour",
        /// One triangle around each splat with the kernel upon it (Pajarola, Sainz, Guidotti 2003, section 5.2).
        Triangle = "triangle",
        /// `perspective` with a quad in place of each point.
        Quad = "quad",
        /// `perspective` in compute, a tile of the image at a time, with all sums in registers; splats that are large, or near the eye
        /// plane, as quads beside it.
        Compute = "compute",
    }
}

named! {
    /// The place where splats are left out that face away or lie outside of the view.
    Cull {
        /// The one that was measured to be faster: with `compute` `list`, and `hidden` where the splats are of several objects; `list` where
        /// `--rasterizer auto` draws points on a CPU; else `setup`.
        Auto = "auto",
        /// The set-up of splats: with points, the vertex stage of each pass.
        Setup = "setup",
        /// Compute, before that: a list of the others is what is set up, and what is drawn as points. Where a chunk has nothing to
        /// leave out, there is no list.
        List = "list",
        /// As `list`, and again before sums: what the visible depth hides is left out of them.
        Hidden = "hidden",
    }
}

named! {
    /// The part of a tile of 8×8 pixels, or 8×4, that one invocation draws ([`Rasterizer::Compute`]). The picture is the same; bit by
    /// bit unless sums have another order: where a splat is too large for tiles of one height alone, so that the graphics pipeline
    /// draws it, in images above 4096×4096 pixels, and in bands that differ (`--tile-memory`).
    TileInvocations {
        /// `column` on CPU drivers, `short-column` there where splats are small, else `pixel`.
        Auto = "auto",
        /// A column of 8 pixels, all sums of which it holds. Eight of them are a tile: a CPU's vector is no longer.
        Column = "column",
        /// A column of 4 pixels, of tiles half as high. Of them, small splats cover more; but they lie in more of them.
        ShortColumn = "short-column",
        /// A pixel. 64 of them are a tile, and read its splats from memory that they share: a GPU's vectors are long.
        Pixel = "pixel",
    }
}

named! {
    /// The screen-space low-pass filter (Guennebaud et al. 2006, section 4). Its radius is √2 pixels.
    Filter {
        /// Tangent adjustment after a rotation of the parametrization that makes the projected axes orthogonal, for ellipses too:
        /// splats cover at least a pixel. An axis of length l becomes √(l² + h²), as under the convolution, but for 0.2%.
        Adjust = "adjust",
        /// No filter: a splat that misses every pixel center is not seen.
        None = "none",
        /// Tangent adjustment as the paper has it (equations 8 to 10): for disks alone, and thinner than the filter where the
        /// projected tangents are not orthogonal.
        AdjustPaper = "adjust-paper",
        /// The larger one of kernel and low-pass filter, for each fragment (Botsch et al. 2005). Not for `triangle` or `compute`.
        Max = "max",
        /// The elliptical weighted average: covariances of kernel and low-pass filter added (Zwicker, Pfister, van Baar, Gross
        /// 2001). For Gaussian kernels; it brings its own affine map, and draws with `perspective`, `quad`, `compute` and the affine
        /// rasterizers.
        Ewa = "ewa",
    }
}

named! {
    /// The weight of a splat that tangent adjustment has enlarged. With other filters it means nothing.
    FilterWeight {
        /// Its old area over its new one, on the screen; in 16-bit sums at least a 16th.
        Area = "area",
        /// As much as any other.
        Unit = "unit",
    }
}

named! {
    /// What a pixel shows where a surface ends.
    Edges {
        /// As much of the surface as covers the pixel under the filter, over what is behind it. With filters that widen splats by a
        /// convolution (`adjust`, `adjust-paper`, `ewa`), where splats are drawn by tiles; else as `hard`, of which the program takes 8 samples a
        /// pixel unless it is told how many.
        Coverage = "coverage",
        /// All of the surface, as in the papers: a pixel is covered or not.
        Hard = "hard",
    }
}

named! {
    /// How a fragment's weight is found.
    KernelEval {
        /// Arithmetic.
        Analytic = "analytic",
        /// A texture that a projective fetch reads (Guennebaud et al. 2006, section 3.2). Not for `compute`.
        Texture = "texture",
    }
}

named! {
    /// The precision of the sums of weights, colors and normals.
    Accumulate {
        /// `f32` where the device can blend 32-bit floats, else `f16`, whose weights then have floors that the reference's have not: what is
        /// drawn as points is not held against it there.
        Auto = "auto",
        /// 16-bit floats, half the memory: from about 100 splats in a pixel on colors are off by more than 1/255, and a sum of unit
        /// weights stalls at 2048.
        F16 = "f16",
        /// 32-bit floats.
        F32 = "f32",
    }
}

named! {
    /// The treatment of splats whose normal points away from the eye.
    Backfaces {
        /// `cull` for objects that are closed, opaque, and not cut open by a plane or a box, `flip` for the others.
        Auto = "auto",
        /// Their normal is turned to the eye.
        Flip = "flip",
        /// They are not drawn.
        Cull = "cull",
    }
}

named! {
    /// The treatment of the transparent surfaces behind the last layer but one.
    LastLayer {
        /// As `blend`, with the alpha of several surfaces: as many as their weights are of the layer before.
        Stack = "stack",
        /// They are all blended in the last layer, weighted by alpha and lit a splat at a time (Guennebaud et al. 2006, section 6).
        Blend = "blend",
        /// The last layer is one surface like the others; what is behind it is lost.
        Drop = "drop",
    }
}

named! {
    /// How splats and polygons of one surface meet (Guennebaud et al. 2006, section 5.1).
    Transition {
        /// Their shaded colors are blended by the splats' sum of weights, where a polygon covers the pixel.
        Color = "color",
        /// Their albedos and normals are blended so, and shaded then.
        Attributes = "attributes",
        /// Not at all: where a polygon is seen, it is all that is seen.
        None = "none",
        /// As `color`, with splats shifted toward the viewer everywhere: pixels of splats alone have twice the ε.
        Paper = "paper",
    }
}

named! {
    /// How a surface becomes a color.
    Shading {
        /// Lambert plus `0.2 max(r·v, 0)³²`.
        Phong = "phong",
        /// `albedo (0.1 + 0.9 n·l)`.
        Lambert = "lambert",
        /// The normal as a color: `(n_x, −n_y, −n_z)/2 + ½` of the view-space normal.
        Normals = "normals",
        /// The albedo itself.
        Albedo = "albedo",
        /// Eye-dome lighting: the albedo, darker where what is around it in the picture is nearer. It needs no normals, for clouds whose
        /// normals are not to be trusted; for opaque splats. Sums have 32 bits.
        EyeDome = "edl",
    }
}

/// What a splat weighs at least.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Floors {
    /// The part of its weight that a filter leaves to it.
    pub share: f64,
    /// Of a fragment that covers: above 0, whatever the filter leaves of it.
    pub weight: f64,
}

impl Floors {
    /// In 16-bit sums: the smallest 16-bit float above 0, and a 16th. Normalization by area or determinant would let the smallest
    /// splats fall below what such sums can hold, and lose dark colors long before.
    pub const HALF: Self = Self { share: 1.0 / 16.0, weight: 1.0 / (1 << 24) as f64 };
    /// In 32-bit sums.
    pub const NONE: Self = Self { share: 0.0, weight: 1.0 / (1_u64 << 60) as f64 };
}

impl Accumulate {
    /// Every precision with its name: all values but [`Self::Auto`], which is one of them.
    pub const PRECISIONS: &'static [(&'static str, Self)] = Self::NAMES.split_at(1).1;
}

impl Rasterizer {
    /// All but [`Self::Auto`], which is one of them, each with its name.
    pub const METHODS: &'static [(&'static str, Self)] = Self::NAMES.split_at(1).1;

    /// The one that stands for all that draw the same picture: the exact ones are one family.
    pub fn family(self) -> Self {
        match self {
            Self::RaycastApproximate | Self::AffineCenter | Self::AffineContour => self,
            Self::Auto
            | Self::Perspective
            | Self::PerspectivePaper
            | Self::Raycast
            | Self::Triangle
            | Self::Compute
            | Self::Quad => Self::Perspective,
        }
    }
}

impl Filter {
    /// Whether this filter exists for this rasterizer; what tiles rule out is [`super::Settings::why_not_tiles`].
    ///
    /// # Errors
    /// [`crate::error::ErrorKind::Option`] for `ewa`, whose map is affine, with a rasterizer that stands for another
    /// map, and for what would have to leave a triangle.
    pub(super) fn check(self, rasterizer: Rasterizer) -> Result<()> {
        use Rasterizer::{PerspectivePaper, Raycast, RaycastApproximate, Triangle};
        let problem = match (self, rasterizer) {
            (Self::Ewa, PerspectivePaper | Raycast | RaycastApproximate | Triangle) => {
                "the filter brings its own affine map; expected perspective, quad, affine-center or affine-contour"
            }
            (Self::Max, Triangle) => {
                "the filter reaches beyond the triangle; expected another rasterizer or filter"
            }
            _ => return Ok(()),
        };
        let name = rasterizer.name();
        Err(Error::option("--filter", format!("{} with --rasterizer {name}: {problem}", self.name())))
    }

    /// Whether it is one of the two that adjust tangents.
    pub fn adjusts(self) -> bool {
        matches!(self, Self::Adjust | Self::AdjustPaper)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_value_is_listed_once_and_the_default_comes_first() {
        assert_eq!(Rasterizer::default(), Rasterizer::Auto);
        assert!(Rasterizer::METHODS.iter().all(|(_, value)| *value != Rasterizer::Auto));
        assert_eq!(Filter::default(), Filter::Adjust);
        assert_eq!(FilterWeight::default(), FilterWeight::Area);
        assert_eq!(KernelEval::default(), KernelEval::Analytic);
        assert_eq!(Accumulate::default(), Accumulate::Auto);
        assert!(Accumulate::PRECISIONS.iter().all(|(_, value)| *value != Accumulate::Auto));
        for (name, value) in Rasterizer::NAMES {
            assert_eq!(*name, value.name());
        }
    }

    #[test]
    fn filters_without_meaning_for_a_rasterizer_are_refused() {
        for (_, rasterizer) in Rasterizer::NAMES {
            for (_, filter) in Filter::NAMES {
                let error = filter.check(*rasterizer).err().map(|error| error.to_string());
                let refused = match filter {
                    Filter::Ewa => matches!(
                        rasterizer,
                        Rasterizer::PerspectivePaper
                            | Rasterizer::Raycast
                            | Rasterizer::RaycastApproximate
                            | Rasterizer::Triangle
                    ),
                    Filter::Max => *rasterizer == Rasterizer::Triangle,
                    _ => false,
                };
                assert_eq!(error.is_some(), refused, "{filter:?} with {rasterizer:?}: {error:?}");
            }
        }
    }
}
