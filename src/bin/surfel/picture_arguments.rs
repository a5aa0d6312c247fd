//! The options that say what is drawn, from where and how: the same for every way of drawing.

use std::path::PathBuf;

use clap::{
    Args,
    builder::{PossibleValuesParser, TypedValueParser},
};
use surfel::{
    load::Representation,
    scene::{
        Accumulate, Backfaces, Cull, Epsilon, Filter, FilterWeight, Kernel, KernelEval, LastLayer, Layers,
        Rasterizer, Settings, Shading, TileInvocations, TileMemory, Transition,
    },
};

use crate::parse::{self, Background};

/// What is drawn, from where and how: the same for every way of drawing.
#[derive(Debug, Args)]
pub struct PictureArguments {
    /// PLY, OBJ or scene files (.toml); none is the built-in model
    #[arg(value_name = "INPUT")]
    pub inputs: Vec<PathBuf>,

    /// As what inputs are drawn that are no scene files: as splats, a mesh with a disk at each vertex, or as the triangles
    /// of a mesh
    #[arg(long, value_name = "WHAT", default_value = "splats", value_parser = choice(REPRESENTATIONS))]
    pub representation: Representation,

    /// The picture: .png is 8-bit sRGB, .exr is linear 32-bit floats
    #[arg(short, long, value_name = "FILE", default_value = "surfel.png")]
    pub output: PathBuf,

    /// Also write weight, albedo, normal and depth of the opaque splats' surface, and the final picture, as .exr into this
    /// folder, linear 32-bit floats
    #[arg(long, value_name = "DIR")]
    pub dump: Option<PathBuf>,

    /// Width and height in pixels
    #[arg(long, value_name = "WxH", default_value = "1024x1024", value_parser = parse::size)]
    pub size: [u32; 2],

    /// From where.
    #[command(flatten)]
    pub camera: CameraArguments,

    /// How.
    #[command(flatten)]
    pub style: StyleArguments,
}

/// From where.
#[derive(Debug, Args)]
#[command(next_help_heading = "Camera")]
pub struct CameraArguments {
    /// Read the camera from this file
    #[arg(long, value_name = "FILE.json", conflicts_with_all = ["eye", "target", "up", "fov"])]
    pub camera: Option<PathBuf>,

    /// Where the eye is [default: on +z from the target, so far that the scene fits]
    #[arg(long, value_name = "X,Y,Z", value_parser = parse::triple, allow_hyphen_values = true)]
    pub eye: Option<[f64; 3]>,

    /// What the middle of the picture shows [default: the middle of the scene]
    #[arg(long, value_name = "X,Y,Z", value_parser = parse::triple, allow_hyphen_values = true)]
    pub target: Option<[f64; 3]>,

    /// What is up [default: 0,1,0]
    #[arg(long, value_name = "X,Y,Z", value_parser = parse::triple, allow_hyphen_values = true)]
    pub up: Option<[f64; 3]>,

    /// The vertical field of view in degrees [default: 45]
    #[arg(long, value_name = "DEG", allow_negative_numbers = true)]
    pub fov: Option<f64>,
}

/// How a surface is drawn.
#[derive(Debug, Args)]
#[command(next_help_heading = "Method")]
pub struct StyleArguments {
    /// How splats become fragments: perspective-correct at the exact depth (as points, in the paper's form, by ray
    /// casting, with ray casting's approximate point size, as triangles, as quads), or by an affine map that is exact at
    /// the center or at the contour
    #[arg(long, value_name = "NAME", default_value = "auto", value_parser = choice(Rasterizer::NAMES))]
    pub rasterizer: Rasterizer,

    /// What an invocation draws of a tile of 8x8 pixels where splats are drawn by tiles (--rasterizer compute): a column of
    /// it, as suits the short vectors of CPUs; a short column, of tiles of 8x4, for small splats; a pixel, for the long
    /// vectors of GPUs; auto is the one for the device and the splats. The picture is the same, and the reference's too
    #[arg(long, value_name = "WHAT", default_value = "auto", value_parser = choice(TileInvocations::NAMES))]
    pub tile_invocations: TileInvocations,

    /// The most memory that lists of splats by tile take, in megabytes: where all of the image would take more, it is drawn in up to
    /// 16 bands of rows, one after the other; auto is what makes splats and lists one and a half times the model's size in
    /// memory, but 16 in any case. The picture is the same but for rounding
    #[arg(long, value_name = "MB", default_value = "auto")]
    pub tile_memory: TileMemory,

    /// The screen-space low-pass filter: tangent adjustment (splats cover at least a pixel), none, the paper's adjustment
    /// (disks only), the maximum of kernel and low-pass filter (not for triangle), or full EWA (Gaussian kernels; with
    /// perspective, quad and the affine rasterizers)
    #[arg(long, value_name = "NAME", default_value = "adjust", value_parser = choice(Filter::NAMES))]
    pub filter: Filter,

    /// What a splat weighs that tangent adjustment has enlarged: its old area over its new one, or as much as any
    #[arg(long, value_name = "HOW", default_value = "area", value_parser = choice(FilterWeight::NAMES))]
    pub filter_weight: FilterWeight,

    /// The weight within a splat: gaussian:S (S in radii) or psi_e:A,B,N, whose small weights are for --accumulate f32: sums
    /// of 16 bits lose the colors at its rim
    #[arg(long, value_name = "KERNEL", default_value = "gaussian:0.5", value_parser = parse::kernel)]
    pub kernel: Kernel,

    /// How the kernel is evaluated: by arithmetic, or from a texture; the reference computes whatever is given here
    #[arg(long, value_name = "HOW", default_value = "analytic", value_parser = choice(KernelEval::NAMES))]
    pub kernel_eval: KernelEval,

    /// Where splats are left out that face away or lie outside of the view: by whatever sets them up (with points, the vertex
    /// stage of each pass), or before, by a list made in compute; hidden: and again before they are summed, where visible ones
    /// hide them; auto: what is faster. Lists are for points and for compute. The picture is the same, by compute but for the
    /// rounding of sums
    #[arg(long, value_name = "WHERE", default_value = "auto", value_parser = choice(Cull::NAMES))]
    pub cull: Cull,

    /// The precision of the sums; the reference sums in 64 bits whatever is given here
    #[arg(long, value_name = "TYPE", default_value = "f16", value_parser = choice(Accumulate::NAMES))]
    pub accumulate: Accumulate,

    /// How far behind the nearest splat others belong to the same surface: multiples of a splat's radius, such as 1r,
    /// or a length
    #[arg(long, value_name = "1r|LENGTH", default_value = "1r", value_parser = parse::epsilon)]
    #[arg(allow_hyphen_values = true)]
    pub epsilon: Epsilon,

    /// Splats that face away: auto leaves them out where the surface is closed and turns them elsewhere
    #[arg(long, value_name = "WHAT", default_value = "auto", value_parser = choice(BACKFACES))]
    pub backfaces: Backfaces,

    /// In how many layers transparent things are drawn, the nearest first: a number, or auto:MAX for as many as the view
    /// needs. Without transparent things there is none
    #[arg(long, value_name = "N|auto:MAX", default_value = "4", value_parser = parse::layers)]
    pub layers: Layers,

    /// What is behind the last layer but one: all blended in the last layer, with the alpha of as many surfaces as their
    /// weights tell, or of one (the paper's); or one more surface, and the rest lost
    #[arg(long, value_name = "WHAT", default_value = "stack", value_parser = choice(LastLayer::NAMES))]
    pub last_layer: LastLayer,

    /// How splats and polygons of one surface meet: their colors or their attributes blended by the splats' weights, not
    /// at all, or as the paper has it (twice the epsilon where there are splats alone)
    #[arg(long, value_name = "HOW", default_value = "color", value_parser = choice(Transition::NAMES))]
    pub transition: Transition,

    /// How the surface is colored, with one light at the eye where a scene file has none
    #[arg(long, value_name = "NAME", default_value = "phong", value_parser = choice(SHADINGS))]
    pub shading: Shading,

    /// The color of empty pixels, sRGB from 0 to 1; none leaves them transparent
    #[arg(long, value_name = "R,G,B|none", default_value = "1,1,1", value_parser = parse::background)]
    #[arg(allow_hyphen_values = true)]
    pub background: Background,
}

/// The values of `--representation`.
pub const REPRESENTATIONS: &[(&str, Representation)] =
    &[("splats", Representation::Splats), ("mesh", Representation::Mesh)];
/// The values of switches.
/// The values of `--backfaces`.
pub const BACKFACES: &[(&str, Backfaces)] =
    &[("auto", Backfaces::Auto), ("flip", Backfaces::Flip), ("cull", Backfaces::Cull)];
/// The values of `--shading`.
pub const SHADINGS: &[(&str, Shading)] = &[
    ("phong", Shading::Phong),
    ("lambert", Shading::Lambert),
    ("normals", Shading::Normals),
    ("albedo", Shading::Albedo),
];

/// Takes one of these names.
pub fn choice<T: Copy + Send + Sync + 'static>(
    values: &'static [(&'static str, T)],
) -> impl TypedValueParser<Value = T> {
    PossibleValuesParser::new(values.iter().map(|(name, _)| *name)).try_map(move |given| {
        let found = values.iter().find(|(name, _)| *name == given);
        found.map(|(_, value)| *value).ok_or("none of the possible values")
    })
}

impl PictureArguments {
    /// The settings, not yet checked.
    pub fn settings(&self) -> Settings {
        let style = &self.style;
        Settings {
            size_px: self.size,
            rasterizer: style.rasterizer,
            tile_invocations: style.tile_invocations,
            tile_memory: style.tile_memory,
            filter: style.filter,
            filter_weight: style.filter_weight,
            kernel: style.kernel,
            kernel_eval: style.kernel_eval,
            cull: style.cull,
            accumulate: style.accumulate,
            epsilon: style.epsilon,
            backfaces: style.backfaces,
            layers: style.layers,
            last_layer: style.last_layer,
            transition: style.transition,
            shading: style.shading,
            background: style.background.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arguments::{Arguments, Command};
    use clap::Parser as _;

    fn render(words: &[&str]) -> PictureArguments {
        let words = ["surfel", "render"].iter().chain(words);
        match Arguments::try_parse_from(words).unwrap().command {
            Command::Render(arguments) => arguments.picture,
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn the_defaults_of_the_command_line_are_those_of_the_library() {
        assert_eq!(render(&[]).settings(), Settings::default());
    }

    #[test]
    fn what_a_report_prints_can_be_given_again() {
        let settings = Settings {
            size_px: [7, 9],
            rasterizer: Rasterizer::AffineContour,
            tile_invocations: TileInvocations::Pixel,
            tile_memory: TileMemory::Most(12_500_000),
            filter: Filter::AdjustPaper,
            filter_weight: FilterWeight::Unit,
            kernel: Kernel::PsiE { a: 6.0, b: 1.5, n: 3.0 },
            kernel_eval: KernelEval::Texture,
            cull: Cull::List,
            accumulate: Accumulate::F32,
            epsilon: Epsilon::Length(0.25),
            backfaces: Backfaces::Cull,
            layers: Layers::Fixed(7),
            last_layer: LastLayer::Drop,
            transition: Transition::Attributes,
            shading: Shading::Normals,
            background: None,
        };
        let others = Settings {
            backfaces: Backfaces::Flip,
            layers: Layers::Auto(16),
            shading: Shading::Albedo,
            background: Some([0.5, 0.25, 0.0]),
            ..settings.clone()
        };
        let lambert = Settings { shading: Shading::Lambert, ..Settings::default() };
        for settings in [settings, others, lambert] {
            let words: Vec<String> = surfel::report::settings_as_options(&settings)
                .into_iter()
                .flat_map(|(name, value)| [format!("--{name}"), value])
                .collect();
            let words: Vec<&str> = words.iter().map(String::as_str).collect();
            assert_eq!(render(&words).settings(), settings);
        }
    }

    #[test]
    fn negative_coordinates_are_no_options() {
        let camera = render(&["--eye", "-1,2,-3", "--up", "-0.5,0,1"]).camera;
        assert_eq!((camera.eye, camera.up), (Some([-1.0, 2.0, -3.0]), Some([-0.5, 0.0, 1.0])));
    }
}
