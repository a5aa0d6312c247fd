//! The subcommands and their options: this text is the manual.

use std::path::PathBuf;

use clap::{
    Args, Parser, Subcommand,
    builder::{PossibleValuesParser, TypedValueParser},
};
use surfel::scene::{Accumulate, Backfaces, Epsilon, Filter, Kernel, Settings, Shading};

use crate::parse::{self, Background};

/// Draws surfaces made of splats (oriented disks, surfels) with Vulkan.
#[derive(Debug, Parser)]
#[command(name = "surfel", version, arg_required_else_help = true)]
#[command(after_help = "Start here:
  surfel render                        a picture of the built-in model, surfel.png
  surfel render scan.ply -o scan.png   a picture of a file
  surfel info                          the devices of this machine

Exit codes: 0 fine; 1 the input or an option is at fault; 2 the device is at fault; 3 validation messages.")]
pub struct Arguments {
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
}

/// The subcommands.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Draw a scene on a Vulkan device
    #[command(long_about = format!("Draw a scene on a Vulkan device.\n\n{SCENE_HELP}"))]
    #[command(after_help = RENDER_EXAMPLES)]
    Render(RenderArguments),
    /// Draw the same with the reference: in 64 bits on the processor, slow and obvious
    #[command(long_about = format!("Draw the same with the reference. {REFERENCE_HELP}\n\n{SCENE_HELP}"))]
    #[command(after_help = REFERENCE_EXAMPLES)]
    Reference(ReferenceArguments),
    /// Measure: tables of what things cost
    #[command(after_help = BENCH_EXAMPLES)]
    Bench(BenchArguments),
    /// List devices, drivers and limits, and what a device lacks
    Info(InfoArguments),
}

const SCENE_HELP: &str = "Inputs are PLY files (splats or meshes) and OBJ files (meshes); a mesh becomes disks at its \
vertices. Several inputs are one scene; none is the built-in model. Lengths are in the files' own unit; +y is up unless \
--up says otherwise. The camera looks along -z at the whole scene unless told otherwise.";

const REFERENCE_HELP: &str =
    "It computes in 64 bits on the processor, slow and obvious, and needs no Vulkan.";

const RENDER_EXAMPLES: &str = "Examples:
  surfel render
  surfel render igea.ply -o igea.png --size 1920x1080
  surfel render a.ply b.obj --eye 0,1,4 --target 0,0,0 --fov 60
  surfel render igea.ply --shading normals --background none -o normals.exr
  surfel render igea.ply --frames 20 --timings igea.json
  surfel render igea.ply --accumulate f32 --dump buffers --validate

A camera file: {\"eye\":[0,1,4], \"target\":[0,0,0], \"up\":[0,1,0], \"fov_deg\":45, \"near\":0.01}; near may be left out.";

const REFERENCE_EXAMPLES: &str = "Examples:
  surfel reference igea.ply -o igea.png --size 256x256
  surfel reference igea.ply --size 256x256 --dump oracle     to compare with: surfel render ... --dump buffers";

const BENCH_EXAMPLES: &str = "Examples:
  surfel bench floor                      the built-in model
  surfel bench floor --model igea.ply --json floor.json";

/// Options of `surfel render`.
#[derive(Debug, Args)]
pub struct RenderArguments {
    /// What is drawn, and how.
    #[command(flatten)]
    pub picture: PictureArguments,

    /// The device: its number or a part of its name, see `surfel info` [default: the best]
    #[arg(long, value_name = "NAME|INDEX", help_heading = "Device and measurement")]
    pub device: Option<String>,

    /// Time that many frames, after two to warm up, and print a table [default: 10 with --timings, else none]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=100_000))]
    #[arg(help_heading = "Device and measurement")]
    pub frames: Option<u32>,

    /// Write what the passes cost, in milliseconds, and all that explains it, as JSON
    #[arg(long, value_name = "FILE.json", help_heading = "Device and measurement")]
    pub timings: Option<PathBuf>,

    /// Print why this scene got the passes, pipelines and bytes that it got
    #[arg(long, help_heading = "Device and measurement")]
    pub explain: bool,

    /// Have the Vulkan validation layer watch; any message makes the exit code 3
    #[arg(long, help_heading = "Device and measurement")]
    pub validate: bool,
}

/// Options of `surfel reference`.
#[derive(Debug, Args)]
pub struct ReferenceArguments {
    /// What is drawn, and how.
    #[command(flatten)]
    pub picture: PictureArguments,
}

/// Options of `surfel bench`.
#[derive(Debug, Args)]
pub struct BenchArguments {
    /// What is measured
    #[arg(value_name = "NAME")]
    pub table: Bench,

    /// A PLY or OBJ file [default: the built-in model]
    #[arg(long, value_name = "FILE")]
    pub model: Option<PathBuf>,

    /// Width and height in pixels
    #[arg(long, value_name = "WxH", default_value = "1024x1024", value_parser = parse::size)]
    pub size: [u32; 2],

    /// The precision of the sums
    #[arg(long, value_name = "TYPE", default_value = "f16", value_parser = choice(ACCUMULATES))]
    pub accumulate: Accumulate,

    /// Rounds that are counted, after three to warm up
    #[arg(long, value_name = "N", default_value_t = 20)]
    #[arg(value_parser = clap::value_parser!(u32).range(1..=100_000))]
    pub frames: u32,

    /// The device: its number or a part of its name, see `surfel info` [default: the best]
    #[arg(long, value_name = "NAME|INDEX")]
    pub device: Option<String>,

    /// Write the table and all that explains it as JSON
    #[arg(long, value_name = "FILE.json")]
    pub json: Option<PathBuf>,

    /// Have the Vulkan validation layer watch, which makes the times worthless
    #[arg(long)]
    pub validate: bool,
}

/// What can be measured.
#[derive(Clone, Copy, Debug, clap::ValueEnum)]
pub enum Bench {
    /// The three passes against a floor: the same points and formats with nothing computed
    Floor,
}

/// Options of `surfel info`.
#[derive(Debug, Args)]
pub struct InfoArguments {
    /// Print JSON
    #[arg(long)]
    pub json: bool,
}

/// What is drawn, from where and how: the same for every way of drawing.
#[derive(Debug, Args)]
pub struct PictureArguments {
    /// PLY or OBJ files; none is the built-in model
    #[arg(value_name = "INPUT")]
    pub inputs: Vec<PathBuf>,

    /// The picture: .png is 8-bit sRGB, .exr is linear 32-bit floats
    #[arg(short, long, value_name = "FILE", default_value = "surfel.png")]
    pub output: PathBuf,

    /// Also write weight, albedo, normal, depth and final .exr into this folder, linear 32-bit floats
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
    /// How splats become fragments: perspective-correct, at the exact depth
    #[arg(long, value_name = "NAME", default_value = "perspective", value_parser = ["perspective"])]
    pub rasterizer: String,

    /// The screen-space low-pass filter: tangent adjustment (splats cover at least a pixel), or none
    #[arg(long, value_name = "NAME", default_value = "adjust", value_parser = choice(FILTERS))]
    pub filter: Filter,

    /// The weight within a splat: gaussian:S (S in radii) or psi_e:A,B,N
    #[arg(long, value_name = "KERNEL", default_value = "gaussian:0.5", value_parser = parse::kernel)]
    pub kernel: Kernel,

    /// The precision of the sums; the reference sums in 64 bits whatever is given here
    #[arg(long, value_name = "TYPE", default_value = "f16", value_parser = choice(ACCUMULATES))]
    pub accumulate: Accumulate,

    /// How far behind the nearest splat others belong to the same surface: multiples of a splat's radius, such as 1r,
    /// or a length
    #[arg(long, value_name = "1r|LENGTH", default_value = "1r", value_parser = parse::epsilon)]
    #[arg(allow_hyphen_values = true)]
    pub epsilon: Epsilon,

    /// Splats that face away: auto leaves them out where the surface is closed and turns them elsewhere
    #[arg(long, value_name = "WHAT", default_value = "auto", value_parser = choice(BACKFACES))]
    pub backfaces: Backfaces,

    /// How the surface is colored, with one light at the eye
    #[arg(long, value_name = "NAME", default_value = "phong", value_parser = choice(SHADINGS))]
    pub shading: Shading,

    /// The color of empty pixels, sRGB from 0 to 1; none leaves them transparent
    #[arg(long, value_name = "R,G,B|none", default_value = "1,1,1", value_parser = parse::background)]
    #[arg(allow_hyphen_values = true)]
    pub background: Background,
}

const FILTERS: &[(&str, Filter)] = &[("adjust", Filter::Adjust), ("none", Filter::None)];
const ACCUMULATES: &[(&str, Accumulate)] = &[("f16", Accumulate::F16), ("f32", Accumulate::F32)];
const BACKFACES: &[(&str, Backfaces)] =
    &[("auto", Backfaces::Auto), ("flip", Backfaces::Flip), ("cull", Backfaces::Cull)];
const SHADINGS: &[(&str, Shading)] = &[
    ("phong", Shading::Phong),
    ("lambert", Shading::Lambert),
    ("normals", Shading::Normals),
    ("albedo", Shading::Albedo),
];

/// Takes one of these names.
fn choice<T: Copy + Send + Sync + 'static>(
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
            filter: style.filter,
            kernel: style.kernel,
            accumulate: style.accumulate,
            epsilon: style.epsilon,
            backfaces: style.backfaces,
            shading: style.shading,
            background: style.background.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
            filter: Filter::None,
            kernel: Kernel::PsiE { a: 6.0, b: 1.5, n: 3.0 },
            accumulate: Accumulate::F32,
            epsilon: Epsilon::Length(0.25),
            backfaces: Backfaces::Cull,
            shading: Shading::Normals,
            background: None,
        };
        let others = Settings {
            backfaces: Backfaces::Flip,
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
