//! The subcommands and their options: this text is the manual.

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand};
use surfel::scene::{Order, SplatFormat};

use crate::{
    bench::BenchArguments,
    compare::CompareArguments,
    figure::FigureArguments,
    parse,
    picture_arguments::{PictureArguments, choice},
    report::ReportArguments,
    scene_file_keys::KEYS,
    selftest::{self, SelftestArguments},
};

/// Draws surfaces made of splats (oriented disks, surfels) with Vulkan.
#[derive(Debug, Parser)]
#[command(name = "surfel", version, arg_required_else_help = true)]
#[command(after_help = "Start here:
  surfel render                        a picture of the built-in model, surfel.png
  surfel render scan.ply -o scan.png   a picture of a file
  surfel convert scan.obj splats.ply   a file of splats
  surfel info                          the devices of this machine

Exit codes: 0 fine; 1 the input or an option is at fault; 2 the device is at fault; 3 validation messages or a \
failed check.")]
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
    #[command(after_help = RENDER_EXAMPLES, after_long_help = format!("{RENDER_EXAMPLES}\n\n{KEYS}"))]
    Render(RenderArguments),
    /// Draw the same with the reference: in 64 bits on the processor, slow and obvious
    #[command(long_about = format!("Draw the same with the reference. {REFERENCE_HELP}\n\n{SCENE_HELP}"))]
    #[command(after_help = REFERENCE_EXAMPLES)]
    Reference(ReferenceArguments),
    /// Put methods side by side: what each costs, and how far its picture is from the exact one
    #[command(long_about = format!("Put methods side by side.\n\n{COMPARE_HELP}\n\n{SCENE_HELP}"))]
    #[command(after_help = COMPARE_EXAMPLES)]
    Compare(Box<CompareArguments>),
    /// Write a model as a file of splats, at a mesh's vertices or anew over its area
    #[command(long_about = CONVERT_HELP, after_help = CONVERT_EXAMPLES)]
    Convert(ConvertArguments),
    /// Draw the papers' figures as labeled pictures
    #[command(long_about = FIGURE_HELP, after_help = FIGURE_EXAMPLES)]
    Figure(FigureArguments),
    /// Measure: tables of what things cost
    #[command(long_about = BENCH_HELP, after_help = BENCH_EXAMPLES)]
    Bench(Box<BenchArguments>),
    /// Compare every method with the oracle on every hard scene, under validation: for the CI of drivers
    #[command(long_about = selftest::HELP, after_help = selftest::EXAMPLES)]
    Selftest(SelftestArguments),
    /// All of it as one page: pictures, tables, and plots of speed against error
    #[command(long_about = REPORT_HELP, after_help = REPORT_EXAMPLES)]
    Report(ReportArguments),
    /// List devices, drivers and limits, and what a device lacks
    Info(InfoArguments),
}

const SCENE_HELP: &str = "Inputs are PLY files (splats or meshes), OBJ files (meshes), and scene files (.toml: objects, each \
with its place and looks, lights and a camera; `surfel render --help` has their keys); a mesh becomes disks at its \
vertices. Several inputs are one scene; none is the built-in model. Lengths are in the files' own unit; +y is up unless \
--up says otherwise. The camera looks along -z at the whole scene unless told otherwise.";

const REFERENCE_HELP: &str =
    "It computes in 64 bits on the processor, slow and obvious, and needs no Vulkan.";

const COMPARE_HELP: &str = "\
Every combination of rasterizer, filter, precision of the sums and kernel evaluation draws the same scene. What it costs is \
timed at --time-size, with the methods in turn, so that a change of the machine's speed meets all of them. How wrong it is is \
found at --size, twice: against the oracle of the same method in 64 bits (implementation error), and against the ground \
truth, the continuous surface at many samples a pixel under the filter's Gaussian (method error). All of it takes minutes; \
--quick shows what each option changes by itself.

Columns: milliseconds a pass and a frame (median, smallest, largest); fragments a pass; linear color, where white is 1 (largest \
and root mean square) over the pixels that both pictures cover; PSNR in decibels below white; SSIM, 1 for equal pictures; \
pixels that only one of them covers; image, the root mean square over all that either picture touches, over white; normals \
in degrees; depth relative to itself; out, the share of pixels left out of the implementation error, because rounding alone \
may turn a rim or the epsilon test there (their error is in the JSON). A star marks the Pareto front: no other \
method is at least as good in milliseconds a frame and in image (equal within 1%) and better in one. Two runs differ \
in times, what is told of them, and the stars, in nothing else.

With --zoom, a tilted checkerboard is drawn from many distances in place of a scene, by each filter, against the \
ground truth.";

const RENDER_EXAMPLES: &str = "Examples:
  surfel render
  surfel render igea.ply -o igea.png --size 1920x1080
  surfel render a.ply b.obj --eye 0,1,4 --target 0,0,0 --fov 60
  surfel render scene.toml              all keys of scene files: surfel render --help
  surfel render igea.ply --shading normals --background none -o normals.exr
  surfel render igea.ply --frames 20 --timings igea.json
  surfel render igea.ply --accumulate f32 --dump buffers --validate

A camera file: {\"eye\":[0,1,4], \"target\":[0,0,0], \"up\":[0,1,0], \"fov_deg\":45, \"near\":0.01}; near may be left out.";

const REFERENCE_EXAMPLES: &str = "Examples:
  surfel reference igea.ply -o igea.png --size 256x256
  surfel reference igea.ply --size 256x256 --dump oracle     to compare with: surfel render ... --dump buffers";

const COMPARE_EXAMPLES: &str = "Examples:
  surfel compare igea.ply --quick                         each option by itself
  surfel compare igea.ply --json all.json --plot all.svg  every combination
  surfel compare --filter adjust --rasterizer perspective,raycast --frames 50
  surfel compare --zoom --plot zoom.svg                   the filters over distance";

const CONVERT_HELP: &str = "Write a model as a file of splats.

Without --resample these are the splats that `surfel render` draws: a disk at each vertex of a mesh, or the splats of the \
file. With --resample they are disks at points spread evenly over a mesh's area, with normals and colors interpolated from \
the vertices, and radii of 1.5 times the mean distance to the 6 nearest neighbors; the same seed gives the same file.

The file is a binary PLY: x y z nx ny nz radius, or su_x ... sv_z (the tangent vectors) for ellipses, and red green blue \
alpha (sRGB) where the model has colors. Positions are 64-bit where 32 bits would move a splat. The header line \"comment \
surfel closed\" tells `surfel render` that the surface is closed, so that splats that face away need not be drawn.";

const CONVERT_EXAMPLES: &str = "Examples:
  surfel convert igea.ply splats.ply                          a disk at each vertex
  surfel convert igea.ply igea-1m.ply --resample 1000000      a million disks, evenly spread
  surfel convert fandisk.obj fandisk.ply --resample 50000 --seed 7";

const FIGURE_HELP: &str = "\
Draw a figure of the papers as a labeled picture: comparisons as PNG, curves as SVG. G is Guennebaud, Barthe, Paulin, \
\"Splat/Mesh Blending, Perspective Rasterization and Transparency for Point-Based Rendering\", 2006; P is Pajarola, Sainz, \
Guidotti, \"Object-Space Blending and Splatting of Points\", 2003. Everything shown was drawn by the device. Without a name, \
the figures are listed.";

const FIGURE_EXAMPLES: &str = "Examples:
  surfel figure                            what there is
  surfel figure g3                         g3.png in the current folder
  surfel figure p10 -o kernels.svg
  surfel figure p19 --model igea.ply --size 600x600";

const BENCH_HELP: &str = "\
Measure what things cost, in figures that can be trusted or say that they can't be.

What is compared takes turns, frame pair by frame pair, so that a change of the machine's speed meets all of it alike; \
ratios are taken within each round. The floor draws the same points through the same fixed-function stages into the same \
formats with nothing computed: `x floor` is how many times its time a method takes; `x bound`, \
of bench floor, how many times what the device's own limits alone would take. A median comes with an interval that holds the true one with 95% confidence, whatever the distribution. Notes say when a median is too uncertain (--max-spread), \
the machine's speed drifted, its clock moved, or other processes took the processor; with --strict they end in exit code 2.

As a gate: `--json now.json` keeps a run, `--baseline now.json` judges a later one by it. Times are judged by x floor, so \
that the two runs need not be on an equally fast machine: worse is what is beyond both intervals and --tolerance. Counts of \
fragments, vertices and bytes may grow by a thousandth. Anything worse ends in exit code 3. growth has no floor, and is judged by its counts.";

const BENCH_EXAMPLES: &str = "Examples:
  surfel bench floor                      the built-in model
  surfel bench table1 --model igea.ply --markdown table1.md --plot table1.svg
  surfel bench slides --model igea.ply
  surfel bench table1 --splats 154k,460k --json before.json
  surfel bench table1 --splats 154k,460k --baseline before.json
  surfel bench layers --markdown layers.md
  surfel bench transition --model igea.ply
  surfel bench growth --model igea.ply --rasterizer perspective,raycast --plot growth.svg
  surfel bench counts --isa NAVI21,VEGA10 --csv tables   instructions of every pipeline
  surfel bench all --csv tables --json all.json";

const REPORT_HELP: &str = "\
Make a page of what this device can do: the model in pictures; every method's speed against its error; the filters over \
distance; the papers' figures; what frames cost beside the least that the same pixels can cost; what transparent layers \
cost, and transitions from splats to polygons; numerical stability. It says first what makes its times doubtful, and last \
what to type for each part by itself.

The page is one file that loads nothing: it opens offline, on a phone and on paper, and can be sent as it is. It holds \
no date: two runs differ in times, and what is told of them, alone. It takes many minutes; --quick, one or two. Nothing is \
written before all is done.";

const REPORT_EXAMPLES: &str = "Examples:
  surfel report --quick                      surfel-report/index.html, of the built-in model
  surfel report --model igea.ply -o igea     of a scan, every method
  surfel report --device 1 --frames 50 -o b  of another device, with more frames";

/// Options of `surfel render`.
#[derive(Debug, Args)]
pub struct RenderArguments {
    /// What is drawn, and how.
    #[command(flatten)]
    pub picture: PictureArguments,

    /// The device: its number or a part of its name, see `surfel info` [default: the best]
    #[arg(long, value_name = "NAME|INDEX", help_heading = "Device and measurement")]
    pub device: Option<String>,

    /// In which order splats lie on the device and are drawn: along a curve that keeps neighbors together, which is faster,
    /// or as the input has them; the picture is the same but for the rounding of sums
    #[arg(long, value_name = "ORDER", default_value = "morton", value_parser = choice(Order::NAMES))]
    #[arg(help_heading = "Device and measurement")]
    pub order: Order,

    /// In how many bytes splats lie on the device: disks in 32 and colors in 8, or in 16 and 4, which turns normals by 0.0037
    /// degrees at most and rounds colors to 8 bits; ellipses stay exact, and so does what has stray points
    #[arg(long, value_name = "FORMAT", default_value = "exact", value_parser = choice(SplatFormat::NAMES))]
    #[arg(help_heading = "Device and measurement")]
    pub splat_format: SplatFormat,

    /// Time that many frames, after two to warm up, and the passes of as many more, and print a table [default: 10 with
    /// --timings, else none]
    #[arg(long, value_name = "N", value_parser = parse::whole::<u32>(1..=100_000), allow_hyphen_values = true)]
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

/// Options of `surfel convert`.
#[derive(Debug, Args)]
pub struct ConvertArguments {
    /// A PLY file (splats or a mesh) or an OBJ file (a mesh)
    #[arg(value_name = "INPUT")]
    pub input: PathBuf,

    /// The file of splats, .ply; an old one is replaced
    #[arg(value_name = "OUTPUT")]
    pub output: PathBuf,

    /// Spread that many disks evenly over the mesh's area; takes about 75 bytes of memory each [default: a disk at each vertex]
    #[arg(long, value_name = "N", value_parser = parse::whole::<u64>(1..=4_294_967_295), allow_hyphen_values = true)]
    pub resample: Option<u64>,

    /// Which samples are taken
    #[arg(long, value_name = "S", default_value_t = 0, requires = "resample")]
    #[arg(value_parser = parse::whole::<u64>(0..=u64::MAX), allow_hyphen_values = true)]
    pub seed: u64,
}

/// Options of `surfel info`.
#[derive(Debug, Args)]
pub struct InfoArguments {
    /// Print JSON
    #[arg(long)]
    pub json: bool,
}
