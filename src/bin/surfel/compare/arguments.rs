//! The options of `surfel compare`.

use std::path::PathBuf;

use clap::{
    Args,
    builder::{PossibleValuesParser, TypedValueParser},
};
use surfel::{
    load::Representation,
    report::compare::Selection,
    scene::{
        Accumulate, Backfaces, Epsilon, Filter, FilterWeight, Kernel, KernelEval, Rasterizer, Settings,
        Shading,
    },
};

use crate::{
    parse,
    picture_arguments::{BACKFACES, CameraArguments, REPRESENTATIONS, SHADINGS, choice},
};

/// What `--zoom` decides by itself.
const ZOOM_HAS_ITS_OWN: [&str; 15] = [
    "inputs",
    "representation",
    "time_size",
    "camera",
    "eye",
    "target",
    "up",
    "fov",
    "rasterizer",
    "accumulate",
    "kernel_eval",
    "quick",
    "backfaces",
    "frames",
    "pictures",
];

/// Options of `surfel compare`.
#[derive(Debug, Args)]
pub struct CompareArguments {
    /// PLY, OBJ or scene files (.toml); none is the built-in model
    #[arg(value_name = "INPUT")]
    pub inputs: Vec<PathBuf>,

    /// As what inputs are drawn that are no scene files: as splats, a mesh with a disk at each vertex, or as the triangles
    /// of a mesh
    #[arg(long, value_name = "WHAT", default_value = "splats", value_parser = choice(REPRESENTATIONS))]
    pub representation: Representation,

    /// Width and height of the pictures whose errors are found, in pixels; references take long
    #[arg(long, value_name = "WxH", default_value = "256x256", value_parser = parse::size)]
    pub size: [u32; 2],

    /// Width and height at which frames are timed and fragments counted, of the same proportions [default: 4 times --size]
    #[arg(long, value_name = "WxH", value_parser = parse::size)]
    pub time_size: Option<[u32; 2]>,

    /// Samples along a pixel's side in the ground truth; --zoom takes more where splats are far below a pixel
    #[arg(long, value_name = "N", default_value_t = 16)]
    #[arg(value_parser = parse::whole::<u32>(1..=256), allow_hyphen_values = true)]
    pub samples: u32,

    /// In place of a scene: a checkerboard in perspective, each filter at distances from 0.05 to 50 pixels a splat
    #[arg(long, conflicts_with_all = ZOOM_HAS_ITS_OWN)]
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
    #[arg(long, value_name = "DEGREES", conflicts_with = "inputs", requires = "zoom", value_parser = parse::tilt)]
    pub zoom_tilt: Option<f64>,

    /// From where.
    #[command(flatten)]
    pub camera: CameraArguments,

    /// Which methods.
    #[command(flatten)]
    pub methods: MethodArguments,

    /// What they have in common.
    #[command(flatten)]
    pub common: CommonArguments,

    /// Frames timed of each method, in pairs: the methods take turns, an untimed frame before each pair, and a pair behind
    /// it for the times of their passes
    #[arg(long, value_name = "N", default_value_t = 10, help_heading = "Device and measurement")]
    #[arg(value_parser = parse::whole::<u32>(1..=100_000), allow_hyphen_values = true)]
    pub frames: u32,

    /// The device: its number or a part of its name, see `surfel info` [default: the best]
    #[arg(long, value_name = "NAME|INDEX", help_heading = "Device and measurement")]
    pub device: Option<String>,

    /// Have the Vulkan validation layer watch, which makes the times worthless; any message makes the exit code 3
    #[arg(long, help_heading = "Device and measurement")]
    pub validate: bool,

    /// Write all figures and all that explains them as JSON
    #[arg(long, value_name = "FILE.json", help_heading = "Results")]
    pub json: Option<PathBuf>,

    /// Draw speed against error, with the Pareto front; or with --zoom the error over the distance
    #[arg(long, value_name = "FILE.svg", help_heading = "Results")]
    pub plot: Option<PathBuf>,

    /// Write the ground truth, each method's oracle, picture and difference from the truth as PNG into this folder
    #[arg(short = 'o', long, value_name = "DIR", help_heading = "Results")]
    pub pictures: Option<PathBuf>,
}

/// Which methods are compared.
#[derive(Debug, Args)]
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
    #[arg(long, value_name = "LIST", value_delimiter = ',', value_parser = listed(Accumulate::NAMES))]
    pub accumulate: Vec<Listed<Accumulate>>,

    /// How the kernel is evaluated
    #[arg(long, value_name = "LIST", default_value = "all", value_delimiter = ',', value_parser = listed(KernelEval::NAMES))]
    pub kernel_eval: Vec<Listed<KernelEval>>,

    /// Only the combination of all first values, and those that differ from it in one option
    #[arg(long)]
    pub quick: bool,
}

/// What all methods have in common.
#[derive(Debug, Args)]
#[command(next_help_heading = "The same for all methods")]
pub struct CommonArguments {
    /// The weight within a splat: gaussian:S (S in radii) or psi_e:A,B,N
    #[arg(long, value_name = "KERNEL", default_value = "gaussian:0.5", value_parser = parse::kernel)]
    pub kernel: Kernel,

    /// How far behind the nearest splat others belong to the same surface: multiples of a splat's radius, such as 1r,
    /// or a length [default: 1r; with --zoom: 1000r]
    #[arg(long, value_name = "1r|LENGTH", value_parser = parse::epsilon)]
    #[arg(allow_hyphen_values = true)]
    pub epsilon: Option<Epsilon>,

    /// Splats that face away: auto leaves them out where the surface is closed and turns them elsewhere
    #[arg(long, value_name = "WHAT", default_value = "auto", value_parser = choice(BACKFACES))]
    pub backfaces: Backfaces,

    /// How the surface is colored, with one light at the eye [default: phong; with --zoom: albedo]
    #[arg(long, value_name = "NAME", value_parser = choice(SHADINGS))]
    pub shading: Option<Shading>,
}

/// A value of a list, or all of them.
#[derive(Clone, Copy, Debug)]
pub struct Listed<T>(Option<T>);

/// Takes one of these names, or `all`.
fn listed<T: Copy + Send + Sync + 'static>(
    values: &'static [(&'static str, T)],
) -> impl TypedValueParser<Value = Listed<T>> {
    let names = values.iter().map(|(name, _)| *name).chain(["all"]);
    PossibleValuesParser::new(names).try_map(move |given| {
        let found = values.iter().find(|(name, _)| *name == given).map(|(_, value)| *value);
        (found.is_some() || given == "all").then_some(Listed(found)).ok_or("none of the possible values")
    })
}

/// Every value that is listed, once, in the order of the list; `default` where there is no list.
fn values<T: Copy + PartialEq>(list: &[Listed<T>], names: &[(&str, T)], default: &[T]) -> Vec<T> {
    let all: Vec<T> = names.iter().map(|(_, value)| *value).collect();
    let mut chosen: Vec<T> = Vec::new();
    let given = list.iter().flat_map(|listed| match listed.0 {
        Some(value) => vec![value],
        None => all.clone(),
    });
    for value in given.chain(if list.is_empty() { default.to_vec() } else { Vec::new() }) {
        if !chosen.contains(&value) {
            chosen.push(value);
        }
    }
    chosen
}

impl CompareArguments {
    /// The values to combine.
    pub fn selection(&self) -> Selection {
        let MethodArguments { rasterizer, filter, filter_weight, accumulate, kernel_eval, .. } =
            &self.methods;
        let both_weights = [FilterWeight::Area, FilterWeight::Unit];
        let (weights, sums): (&[_], &[_]) = match self.zoom {
            false => (&both_weights[..1], &[Accumulate::F16, Accumulate::F32]),
            true => (&both_weights, &[Accumulate::F32]),
        };
        if self.zoom {
            return Selection {
                rasterizers: vec![Rasterizer::Perspective],
                filters: values(filter, Filter::NAMES, &[]),
                filter_weights: values(filter_weight, FilterWeight::NAMES, weights),
                accumulates: sums.to_vec(),
                kernel_evals: vec![KernelEval::default()],
            };
        }
        Selection {
            rasterizers: values(rasterizer, Rasterizer::METHODS, &[]),
            filters: values(filter, Filter::NAMES, &[]),
            filter_weights: values(filter_weight, FilterWeight::NAMES, weights),
            accumulates: values(accumulate, Accumulate::NAMES, sums),
            kernel_evals: values(kernel_eval, KernelEval::NAMES, &[]),
        }
    }

    /// What all methods have in common, at the size of the errors. The background is white.
    pub fn settings(&self) -> Settings {
        // The board is one surface, all of which a filter may mix; at 1r, splats that it has enlarged to pixels would hide
        // their own neighbors behind them, which is a matter of epsilon and not of the filter.
        let (shading, epsilon) = match self.zoom {
            true => (Shading::Albedo, Epsilon::Radii(1000.0)),
            false => (Shading::Phong, Settings::default().epsilon),
        };
        Settings {
            size_px: self.size,
            kernel: self.common.kernel,
            epsilon: self.common.epsilon.unwrap_or(epsilon),
            backfaces: self.common.backfaces,
            shading: self.common.shading.unwrap_or(shading),
            ..Settings::default()
        }
    }
}

#[cfg(test)]
mod tests {
    use clap::Parser as _;

    use super::*;
    use crate::arguments::{Arguments, Command};

    fn compare(words: &[&str]) -> CompareArguments {
        match Arguments::try_parse_from(["surfel", "compare"].iter().chain(words)).unwrap().command {
            Command::Compare(arguments) => *arguments,
            other => panic!("{other:?}"),
        }
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
        let refused = |words: &[&str]| {
            Arguments::try_parse_from(["surfel", "compare"].iter().chain(words)).unwrap_err().to_string()
        };
        assert!(refused(&["--zoom", "a.ply"]).contains("cannot be used with"));
        assert!(refused(&["--zoom", "--rasterizer", "quad"]).contains("cannot be used with"));
        assert!(refused(&["--zoom", "--fov", "9"]).contains("cannot be used with"));
        assert!(refused(&["--zoom-steps", "30"]).contains("--zoom"));
        assert!(refused(&["--zoom-steps", "30", "a.ply"]).contains("cannot be used with"));
        assert!(refused(&["--zoom", "--zoom-tilt", "86"]).contains("0 to 85"));
    }
}
