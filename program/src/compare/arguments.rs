//! The options of `surfel compare`.

use std::path::PathBuf;

use clap::{Arg, Args};
use surfel::{
    report::compare::Selection,
    scene::{Accumulate, Epsilon, Filter, FilterWeight, KernelEval, Rasterizer, Settings, Shading},
};

use crate::{
    camera::{CameraArguments, PARTS},
    device::DeviceArguments,
    inputs::{INPUTS, InputArguments},
    parse,
    settings::{Given, Listed, Taken, chosen, listed},
};

/// The options that `--zoom` decides by itself.
const ZOOM_HAS_ITS_OWN: &str = "inputs representation resample seed strict columns allow_outside time_size camera rasterizer accumulate kernel_eval \
    quick backfaces frames pictures";

const HELP: &str = "\
Every combination of rasterizer, filter, precision of the sums and kernel evaluation draws the same scene. What it costs is \
timed at --time-size, with the methods in turn, so that a change of the machine's speed meets all of them. How wrong it is is \
found at --size, twice: against the oracle of the same method in 64 bits (implementation error), and against the ground \
truth, the continuous surface at many samples a pixel under the filter's Gaussian (method error). All of it takes minutes; \
--quick shows what each option changes by itself. Meshes are disks at their vertices here, unless --representation or --resample \
say otherwise.

The table has a row for each method: milliseconds a frame (median); own, the root of the mean square by which its linear color is \
off the oracle's; then the picture against the ground truth, as the root of the mean square in linear light and as the mean \
of FLIP, which is how much of the difference a person sees (0 to 1), over a white or a black background, whichever is worse: the \
whole of it, what is inside of surfaces, and edges, which are all pixels within 2 of an edge of the ground truth; and how much \
darker than the truth a pixel of an edge is at most, in 255ths of sRGB. A star marks the Pareto front: no other method is at \
least as good in milliseconds a frame and in the whole (equal within 1%) and better in one. A line for each filter says why it \
ranks as it does. --json has everything else: passes, fragments and instructions; PSNR, SSIM, normals and depth; the \
pixels that are covered in one and empty in the other; those left out of own, because rounding alone may turn a rim or the epsilon test there. Two \
runs differ in times, what is told of them, and the stars, in nothing else.

With --zoom, a tilted checkerboard is drawn from many distances in place of a scene, by each filter, against the \
ground truth.";

const EXAMPLES: &str = "Examples:
  surfel compare igea.ply --quick                         each option by itself
  surfel compare igea.ply --json all.json --plot all.svg  every combination
  surfel compare --filter adjust --rasterizer perspective,raycast --frames 50
  surfel compare --zoom --plot zoom.svg                   the filters over distance";

/// Put methods side by side: what each costs, and how far its picture is from the exact one
#[derive(Args)]
#[command(long_about = format!("Put methods side by side.\n\n{HELP}\n\n{INPUTS}"), after_help = EXAMPLES)]
#[command(mut_arg("camera_zoom", |zoom| zoom.long("camera-zoom")))]
pub struct CompareArguments {
    #[command(flatten)]
    pub input: InputArguments,

    #[command(flatten)]
    common: Given<Common>,

    /// Width and height at which frames are timed and fragments counted, of the same proportions [default: 4 times --size]
    #[arg(long, value_name = "WxH", value_parser = parse::size)]
    pub time_size: Option<[u32; 2]>,

    /// Samples along a pixel's side in the ground truth; --zoom takes more where splats are far below a pixel
    #[arg(long, value_name = "N", default_value_t = 16)]
    #[arg(value_parser = parse::whole::<u32>(1..=256), allow_hyphen_values = true)]
    pub samples: u32,

    /// In place of a scene: a checkerboard in perspective, each filter at distances from 0.05 to 50 pixels a splat
    #[arg(long, conflicts_with_all = ZOOM_HAS_ITS_OWN.split(' ').chain(PARTS))]
    pub zoom: bool,

    /// Distances of --zoom [default: 25]
    #[arg(long, value_name = "N", conflicts_with = "inputs", requires = "zoom")]
    #[arg(value_parser = parse::whole::<u32>(2..=1000), allow_hyphen_values = true)]
    pub zoom_steps: Option<u32>,

    /// Splats along the checkerboard's side [default: 600]
    #[arg(long, value_name = "N", conflicts_with = "inputs", requires = "zoom")]
    #[arg(value_parser = parse::whole::<u32>(2..=4000), allow_hyphen_values = true)]
    pub zoom_splats: Option<u32>,

    /// By how many degrees the checkerboard is tilted against the view, 0 to 85 [default: 75]
    #[arg(long, value_name = "DEGREES", conflicts_with = "inputs", requires = "zoom", value_parser = parse::number("degrees", 0.0..=85.0))]
    pub zoom_tilt: Option<f64>,

    #[command(flatten)]
    pub camera: CameraArguments,

    #[command(flatten)]
    pub methods: MethodArguments,

    /// Frames timed of each method, in pairs: the methods take turns, an untimed frame before each pair, and a pair behind
    /// it for the times of their passes
    #[arg(long, value_name = "N", default_value_t = 10, help_heading = "Device and measurement")]
    #[arg(value_parser = parse::whole::<u32>(1..=100_000), allow_hyphen_values = true)]
    pub frames: u32,

    #[command(flatten, next_help_heading = "Device and measurement")]
    pub device: DeviceArguments,

    /// Write all figures and all that explains them as JSON
    #[arg(long, value_name = "FILE.json", help_heading = "Results")]
    pub json: Option<PathBuf>,

    /// Draw speed against error, with the Pareto front; or with --zoom the error over the distance
    #[arg(long, value_name = "FILE.svg", help_heading = "Results")]
    pub plot: Option<PathBuf>,

    /// Write the ground truth, each method's oracle, picture and difference from the truth as PNG into this folder, each file as soon as
    /// it is there: where the program is stopped, those that are whole stay
    #[arg(short = 'o', long, value_name = "DIR", help_heading = "Results")]
    pub pictures: Option<PathBuf>,
}

/// Which methods are compared.
#[derive(Args)]
#[command(next_help_heading = "Methods: lists with commas, or all; every combination that exists")]
pub struct MethodArguments {
    /// How splats become fragments
    #[arg(long, value_name = "LIST", default_value = "all", value_delimiter = ',', value_parser = listed(Rasterizer::METHODS))]
    pub rasterizer: Vec<Listed<Rasterizer>>,

    /// The screen-space low-pass filter
    #[arg(long, value_name = "LIST", default_value = "all", value_delimiter = ',', value_parser = listed(Filter::NAMES))]
    pub filter: Vec<Listed<Filter>>,

    /// What a splat weighs that the filter has enlarged [default: area; with --zoom: all]
    #[arg(long, value_name = "LIST", value_delimiter = ',', value_parser = listed(FilterWeight::NAMES))]
    pub filter_weight: Vec<Listed<FilterWeight>>,

    /// The precision of the sums [default: all; with --zoom: f32]
    #[arg(long, value_name = "LIST", value_delimiter = ',', value_parser = listed(Accumulate::PRECISIONS))]
    pub accumulate: Vec<Listed<Accumulate>>,

    /// How the kernel is evaluated
    #[arg(long, value_name = "LIST", default_value = "all", value_delimiter = ',', value_parser = listed(KernelEval::NAMES))]
    pub kernel_eval: Vec<Listed<KernelEval>>,

    /// Only the combination of all first values, and those that differ from it in one option
    #[arg(long)]
    pub quick: bool,
}

/// The settings that all methods have in common.
struct Common;

impl Taken for Common {
    type Table = Settings;

    fn option(name: &str, option: Arg) -> Option<Arg> {
        let zoom = |option: Arg, defaults: &str| {
            let help = format!("{} [default: {defaults}]", option.get_help().cloned().unwrap_or_default());
            option.default_value(None).help(help)
        };
        let option = match name {
            "size" => {
                let help = "Width and height of the pictures whose errors are found, in pixels; references take long";
                return Some(option.default_value("256x256").help(help));
            }
            "kernel" | "backfaces" => option,
            "epsilon" => zoom(option, "auto; with --zoom: 1000r"),
            "shading" => zoom(option, "phong; with --zoom: albedo"),
            _ => return None,
        };
        Some(option.help_heading("The same for all methods"))
    }
}

impl CompareArguments {
    /// The values to combine.
    pub fn selection(&self) -> Selection {
        let MethodArguments { rasterizer, filter, filter_weight, accumulate, kernel_eval, .. } =
            &self.methods;
        let selection = Selection {
            rasterizers: chosen(rasterizer, &[]),
            filters: chosen(filter, &[]),
            filter_weights: chosen(filter_weight, &[FilterWeight::Area]),
            accumulates: chosen(accumulate, &[Accumulate::F16, Accumulate::F32]),
            kernel_evals: chosen(kernel_eval, &[]),
        };
        match self.zoom {
            false => selection,
            true => Selection {
                rasterizers: vec![Rasterizer::Perspective],
                filter_weights: chosen(filter_weight, &[FilterWeight::Area, FilterWeight::Unit]),
                accumulates: vec![Accumulate::F32],
                kernel_evals: vec![KernelEval::Analytic],
                ..selection
            },
        }
    }

    /// The settings that all methods have in common, at the size of the errors. The background is white.
    pub fn settings(&self) -> Settings {
        let settings = Settings::default();
        self.common.over(match self.zoom {
            false => settings,
            // The board is one surface, all of which a filter may mix; at 1r, splats that it has enlarged to pixels would hide
            // their own neighbors behind them, which is a matter of epsilon and not of the filter.
            true => Settings { shading: Shading::Albedo, epsilon: Epsilon::Radii(1000.0), ..settings },
        })
    }
}

#[cfg(test)]
mod tests {
    use clap::{Command, FromArgMatches as _};

    use super::*;

    fn parsed(words: &[&str]) -> Result<CompareArguments, clap::Error> {
        let command = CompareArguments::augment_args(Command::new("compare").no_binary_name(true));
        CompareArguments::from_arg_matches(&command.try_get_matches_from(words)?)
    }

    fn compare(words: &[&str]) -> CompareArguments {
        parsed(words).unwrap_or_else(|error| panic!("{error}"))
    }

    #[test]
    fn the_default_is_each_method_of_the_issue_and_the_librarys_settings() {
        let arguments = compare(&[]);
        assert_eq!(arguments.selection().product().len(), 9 * 5 * 2 * 2);
        let settings = arguments.settings();
        assert_eq!(settings, Settings { size_px: [256, 256], ..Settings::default() });
    }

    #[test]
    fn lists_keep_their_order_and_name_each_value_once() {
        let words = ["--rasterizer", "quad,perspective,quad", "--filter", "max,all"];
        let selection = compare(&words).selection();
        assert_eq!(selection.rasterizers, [Rasterizer::Quad, Rasterizer::Perspective]);
        assert_eq!((selection.filters.len(), selection.filters[0]), (5, Filter::Max));
        assert_eq!(selection.filter_weights, [FilterWeight::Area]);
        let both = compare(&["--filter-weight", "all"]).selection().filter_weights;
        assert_eq!(both, [FilterWeight::Area, FilterWeight::Unit]);
    }

    #[test]
    fn zoom_compares_filters_alone() {
        let selection = compare(&["--zoom"]).selection();
        assert_eq!(selection.rasterizers, [Rasterizer::Perspective]);
        assert_eq!((selection.filters.len(), selection.filter_weights.len()), (5, 2));
        assert_eq!(selection.accumulates, [Accumulate::F32]);
        let refused = |words: &[&str]| parsed(words).err().unwrap().to_string();
        assert!(refused(&["--zoom", "a.ply"]).contains("cannot be used with"));
        assert!(refused(&["--zoom", "--rasterizer", "quad"]).contains("cannot be used with"));
        assert!(refused(&["--zoom", "--fov", "9"]).contains("cannot be used with"));
        assert!(refused(&["--zoom-steps", "30"]).contains("--zoom"));
        assert!(refused(&["--zoom-steps", "30", "a.ply"]).contains("cannot be used with"));
        assert!(refused(&["--zoom", "--zoom-tilt", "86"]).contains("0 to 85"));
    }
}
