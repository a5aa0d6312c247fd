//! How a scene is rendered: the table of settings, and the combinations that have no picture.

use glam::DVec4;

use crate::inline_vec::InlineVec;

use super::{
    Budget, ClipBox, ClipPlanes, Layers, Lod, LodSteps, MOST_PLANES, Outlines, Samples, TileMemory,
    methods::{
        Accumulate, Backfaces, Cull, Edges, Filter, FilterWeight, Floors, KernelEval, LastLayer, Rasterizer,
        Shading, TileInvocations, Transition,
    },
    option::{OptionTable as _, settings},
    values::{Epsilon, Kernel},
};
use crate::error::{Error, Result};

settings! {
    /// Every choice that changes the picture, apart from scene and camera.
    ///
    /// ```
    /// use surfel::scene::{Edges, Epsilon, Settings};
    ///
    /// let settings = Settings { size_px: [640, 480], edges: Edges::Hard, ..Settings::default() };
    /// assert!(settings.validate().is_ok());
    /// let too_large = Settings { size_px: [70_000, 480], epsilon: Epsilon::Radii(1.0), ..settings };
    /// assert!(too_large.validate().unwrap_err().to_string().contains("--size"));
    /// ```
    #[derive(Clone, Debug, PartialEq)]
    Settings {
        /// Width and height in pixels.
        "size" "WxH" size_px: [u32; 2] = [1024, 1024],
        /// The number of samples of each pixel, 1 to 256: so many pictures are drawn, moved by parts of a pixel and filtered the less, and
        /// their mean is taken in linear light. A device that cannot add in 32 bits refuses more than one. `render` takes 8 of scenes with polygons, where
        /// nobody says otherwise and edges are covered: outlines are half as far from what there is as in one.
        "samples" "N" samples: Samples,
        /// How splats become fragments. All draw the same picture but `raycast-approximate` and the affine ones.
        "rasterizer" "NAME" rasterizer: Rasterizer,
        /// The part of a tile of 8x8 pixels that one invocation draws where splats are drawn by tiles (`--rasterizer compute`).
        /// The picture is the same, and the reference's too.
        "tile-invocations" "WHAT" tile_invocations: TileInvocations,
        /// The most memory that lists of splats by tile take, in megabytes: where all of the image would take more, it is drawn in
        /// up to 16 bands of rows, one after the other; `auto` is what makes splats and lists one and a half times the model's size
        /// in memory, but 16 in any case. The picture is the same but for rounding.
        "tile-memory" "MB" tile_memory: TileMemory,
        /// The screen-space low-pass filter.
        "filter" "NAME" filter: Filter,
        /// The weight of a splat that tangent adjustment has enlarged.
        "filter-weight" "HOW" filter_weight: FilterWeight,
        /// What a pixel shows where a surface ends.
        "edges" "HOW" edges: Edges,
        /// The weight within a splat: `gaussian:S` (S in radii) or `psi_e:A,B,N`, whose small weights are not for `--accumulate f16`:
        /// sums of 16 bits lose the colors at its rim.
        "kernel" "KERNEL" kernel: Kernel,
        /// How the kernel is evaluated; the reference computes whatever is given here.
        "kernel-eval" "HOW" kernel_eval: KernelEval,
        /// The place where splats are left out that face away or lie outside of the view. Lists are for points and for `compute`.
        /// The picture is the same, by `compute` but for the rounding of sums.
        "cull" "WHERE" cull: Cull,
        /// The precision of the sums; the reference sums in 64 bits whatever is given here.
        "accumulate" "TYPE" accumulate: Accumulate,
        /// The largest size on the screen of a splat that stands for those below it in a hierarchy, which is made of each object then: pixels, such
        /// as 1px, or percent of the picture; 0 draws the scene itself. One pixel is as far as the filter spreads what it sees. `auto` is 1px of what has a
        /// hierarchy already (.surfel), and else the scene itself. For `render`, by `compute` and as points; what else draws all splats. The reference draws the
        /// scene itself.
        "lod" "auto|PX|PERCENT%" lod: Lod,
        /// How nodes take the place of those below them, as a camera moves away.
        "lod-steps" "HOW" lod_steps: LodSteps,
        /// The most splats that are drawn of objects in levels of detail, such as 250k, of which about 99% are used; never finer than a `lod` that is given.
        "budget" "N|none" budget: Budget,
        /// How far behind the nearest splat others belong to the same surface: multiples of a splat's radius, such as 1r, or a
        /// length; `auto` is 1r, of what is transparent 2r, and less where the other side of something thin is near, and of splats with clip curves, which
        /// are as large as the faces of a part.
        "epsilon" "auto|1r|LENGTH" epsilon: Epsilon = Epsilon::Auto,
        /// The treatment of splats that face away.
        "backfaces" "WHAT" backfaces: Backfaces,
        /// The number of layers in which transparent things are drawn, the nearest first; `auto:MAX` is as many as the view needs.
        /// Without transparent things there is none.
        "layers" "N|auto:MAX" layers: Layers = Layers::Fixed(4),
        /// The treatment of what is behind the last layer but one.
        "last-layer" "WHAT" last_layer: LastLayer,
        /// How splats and polygons of one surface meet.
        "transition" "HOW" transition: Transition,
        /// The box outside of which nothing is seen, by the smallest and the largest coordinates of the world: splats are cut at its sides pixel by pixel.
        "clip-box" "X,Y,Z,X,Y,Z|none" clip_box: ClipBox,
        /// A plane that cuts what is seen: a x + b y + c z >= d is left, in the world. Up to 6 with those of the box, each by an option of its own.
        "clip-plane" "A,B,C,D|none" clip_planes: ClipPlanes,
        /// How the surface is colored, with one light at the eye where a scene file has none.
        "shading" "NAME" shading: Shading,
        /// What is drawn over splats. The reference has none.
        "outlines" "WHAT" outlines: Outlines,
        /// The color of empty pixels, sRGB from 0 to 1; none leaves them transparent (and black).
        "background" "R,G,B|none" background: Option<[f32; 3]> = Some([1.0; 3]),
    }
}

impl Settings {
    /// Refuses settings that have no picture.
    ///
    /// # Errors
    /// [`crate::error::ErrorKind::Option`] for a side outside 1–65536 pixels, kernel parameters that are not finite and
    /// above 0, an ε that is not finite and at least 0, layers outside 1–256, a background outside 0–1; for a filter or an
    /// evaluation of the kernel that the rasterizer or the kernel rules out.
    pub fn validate(&self) -> Result<()> {
        for option in Self::OPTIONS {
            (option.check)(self).map_err(|problem| Error::option(format!("--{}", option.name), problem))?;
        }
        let planes = self.clip_box.planes().chain(self.clip_planes.planes()).count();
        if planes > MOST_PLANES {
            let problem = format!("{planes} planes with those of --clip-box; expected at most {MOST_PLANES}");
            return Err(Error::option("--clip-plane", problem));
        }
        self.filter.check(self.rasterizer)?;
        if let (Rasterizer::Compute, Some((option, reason))) = (self.rasterizer, self.why_not_tiles()) {
            let problem = format!("{reason}; expected another value, or a --rasterizer other than compute");
            return Err(Error::option(option, problem));
        }
        if self.filter == Filter::Max && self.samples.0 > 1 {
            let problem = "max: its disk is of one size, which samples cannot share out; expected another filter, or --samples 1";
            return Err(Error::option("--filter", problem));
        }
        if self.filter == Filter::Ewa && !matches!(self.kernel, Kernel::Gaussian { .. }) {
            let problem = "ewa: adds covariances, which psi_e has none of; expected --kernel gaussian:S";
            return Err(Error::option("--filter", problem));
        }
        Ok(())
    }

    /// The option that rules out tiles (`--rasterizer compute`), and why it does, as a part of a sentence.
    pub fn why_not_tiles(&self) -> Option<(&'static str, &'static str)> {
        if self.filter == Filter::Max {
            let reason = "the filter max has a second kernel, which records of tiles have no room for";
            return Some(("--filter", reason));
        }
        if self.kernel_eval == KernelEval::Texture {
            let reason = "the texture of kernels is not for tiles, which find them by arithmetic";
            return Some(("--kernel-eval", reason));
        }
        None
    }

    /// The planes that cut what is seen, in world space: unit normals toward what is left, and by how much the origin is on that side.
    pub(crate) fn clip(&self) -> InlineVec<DVec4, MOST_PLANES> {
        // No more than `validate` lets through.
        self.clip_box.planes().chain(self.clip_planes.planes()).take(MOST_PLANES).collect()
    }

    /// The same without planes that cut.
    pub(crate) fn uncut(&self) -> Self {
        Self { clip_box: ClipBox::default(), clip_planes: ClipPlanes::default(), ..self.clone() }
    }

    /// Whether what faces away is not drawn of an object that is closed and opaque, or is not so. What is cut open is seen from inside.
    pub fn culls(&self, closed: bool) -> bool {
        match self.backfaces {
            Backfaces::Auto => closed && self.clip().is_empty(),
            Backfaces::Flip => false,
            Backfaces::Cull => true,
        }
    }

    /// Whether the filter gives splats weights of their own.
    pub fn weighs_splats(&self) -> bool {
        let by_area = self.filter.adjusts() && self.filter_weight == FilterWeight::Area;
        self.filter == Filter::Ewa || by_area
    }

    /// Whether surfaces cover pixels in part where they end, as far as settings tell. A frame has hard edges all the same where tiles
    /// leave sums in place of shading: beside splats that are large.
    pub fn covers_in_part(&self) -> bool {
        let by_tiles = matches!(self.rasterizer, Rasterizer::Auto | Rasterizer::Compute);
        let widens = self.filter.adjusts() || self.filter == Filter::Ewa;
        let blends_colors = matches!(self.transition, Transition::Color | Transition::None);
        let shades = self.shading != Shading::EyeDome; // which is of depths
        let asked = self.edges == Edges::Coverage && self.why_not_tiles().is_none();
        asked && by_tiles && widens && blends_colors && shades
    }

    /// What a splat weighs at least: something in sums of 16 bits that were asked for, of a rasterizer that has them. Tiles sum in 32 bits
    /// where splats have weights of their own, whatever `accumulate` says, so that `--rasterizer auto` has none here; nor has `--accumulate
    /// auto`, which has 16 bits only on a device that can't blend 32. Where points have 16-bit sums after all, `--explain` says so.
    pub fn floors(&self) -> Floors {
        if self.shading == Shading::EyeDome {
            return Floors::NONE; // Its sums have 32 bits.
        }
        let by_tiles = matches!(self.rasterizer, Rasterizer::Auto | Rasterizer::Compute);
        if self.accumulate == Accumulate::F16 && !by_tiles { Floors::HALF } else { Floors::NONE }
    }
}

/// Each of the things with each of the values, the values of one thing after the other.
pub fn with_each<T: Clone, V: Copy>(all: Vec<T>, values: &[V], set: fn(&mut T, V)) -> Vec<T> {
    let mut product = Vec::new();
    for thing in all {
        product.extend(values.iter().map(|value| {
            let mut thing = thing.clone();
            set(&mut thing, *value);
            thing
        }));
    }
    product
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_defaults_and_the_ends_of_the_ranges_are_accepted() {
        Settings::default().validate().unwrap();
        let ends = Settings {
            size_px: [1, 65_536],
            epsilon: Epsilon::Length(0.0),
            kernel: Kernel::PsiE { a: 1e-30, b: 1e30, n: 1.0 },
            background: Some([0.0, 0.5, 1.0]),
            ..Settings::default()
        };
        ends.validate().unwrap();
        Settings { background: None, ..ends }.validate().unwrap();
    }

    #[test]
    fn each_value_out_of_range_is_refused_under_its_options_name() {
        let good = Settings::default;
        let gaussian = |sigma| Settings { kernel: Kernel::Gaussian { sigma }, ..good() };
        let psi_e = |a, b, n| Settings { kernel: Kernel::PsiE { a, b, n }, ..good() };
        let background = |blue| Settings { background: Some([0.0, 1.0, blue]), ..good() };
        let textured_tiles =
            Settings { kernel_eval: KernelEval::Texture, rasterizer: Rasterizer::Compute, ..good() };
        let cases = [
            ("--size", Settings { size_px: [0, 5], ..good() }),
            ("--size", Settings { size_px: [5, 65_537], ..good() }),
            ("--kernel", gaussian(0.0)),
            ("--kernel", gaussian(-1.0)),
            ("--kernel", gaussian(f32::NAN)),
            ("--kernel", psi_e(f32::INFINITY, 1.0, 1.0)),
            ("--kernel", psi_e(1.0, 0.0, 1.0)),
            ("--kernel", psi_e(1.0, 1.0, f32::NAN)),
            ("--filter", Settings { filter: Filter::Ewa, ..psi_e(6.0, 1.5, 3.0) }),
            ("--filter", Settings { filter: Filter::Ewa, rasterizer: Rasterizer::Raycast, ..good() }),
            ("--filter", Settings { filter: Filter::Max, rasterizer: Rasterizer::Compute, ..good() }),
            ("--kernel-eval", textured_tiles),
            ("--samples", Settings { samples: Samples(0), ..good() }),
            ("--samples", Settings { samples: Samples(257), ..good() }),
            ("--filter", Settings { filter: Filter::Max, samples: Samples(2), ..good() }),
            ("--epsilon", Settings { epsilon: Epsilon::Radii(-1e-9), ..good() }),
            ("--epsilon", Settings { epsilon: Epsilon::Length(f64::NAN), ..good() }),
            ("--epsilon", Settings { epsilon: Epsilon::Length(f64::INFINITY), ..good() }),
            ("--layers", Settings { layers: Layers::Fixed(0), ..good() }),
            ("--layers", Settings { layers: Layers::Auto(257), ..good() }),
            ("--background", background(1.1)),
            ("--background", background(-0.1)),
            ("--background", background(f32::NAN)),
        ];
        for (option, settings) in cases {
            let error = settings.validate().expect_err(option);
            assert_eq!(error.exit_code(), 1);
            assert!(error.to_string().starts_with(option), "{error}");
        }
    }
}
