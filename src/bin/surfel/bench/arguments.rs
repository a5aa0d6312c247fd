//! The options of `surfel bench`.

use std::{collections::HashSet, path::PathBuf};

use clap::Args;
use surfel::{
    report::PAPER_SPLATS,
    scene::{Accumulate, Filter, KernelEval, Settings},
};

use crate::{counts::CountsArguments, parse, picture_arguments::choice};

/// Options of `surfel bench`.
#[derive(Debug, Args)]
pub struct BenchArguments {
    /// What is measured
    #[arg(value_name = "NAME")]
    pub table: Bench,

    /// A PLY or OBJ file; for table1 and slides a mesh, which is resampled evenly over its area; for transition a mesh, half of
    /// which is; layers has its own [default: the built-in model, for transition the built-in sphere]
    #[arg(long, value_name = "FILE")]
    pub model: Option<PathBuf>,

    /// Numbers of splats of table1, with commas between, such as 154k,1.4M; slides takes the first; by itself layers takes it
    /// for each of its 27 balls, and transition for the whole model [default: the paper's; 2000 a ball; 40k]
    #[arg(long, value_name = "LIST", value_delimiter = ',', value_parser = parse::splats)]
    pub splats: Vec<u64>,

    /// Width and height in pixels
    #[arg(long, value_name = "WxH", default_value = "1024x1024", value_parser = parse::size)]
    pub size: [u32; 2],

    /// The filter of all but slides, which has each method's own
    #[arg(long, value_name = "FILTER", default_value = "adjust", value_parser = choice(Filter::NAMES))]
    pub filter: Filter,

    /// How the kernel is evaluated
    #[arg(long, value_name = "HOW", default_value = "analytic", value_parser = choice(KernelEval::NAMES))]
    pub kernel_eval: KernelEval,

    /// The precision of the sums
    #[arg(long, value_name = "TYPE", default_value = "f16", value_parser = choice(Accumulate::NAMES))]
    pub accumulate: Accumulate,

    /// Frames timed of each method, in turn with the floor: in pairs after an untimed one, but for floor, which has as many
    /// rounds of single frames
    #[arg(long, value_name = "N", default_value_t = 20, help_heading = "Device and measurement")]
    #[arg(value_parser = parse::whole::<u32>(1..=100_000), allow_hyphen_values = true)]
    pub frames: u32,

    /// The device: its number or a part of its name, see `surfel info` [default: the best]
    #[arg(long, value_name = "NAME|INDEX", help_heading = "Device and measurement")]
    pub device: Option<String>,

    /// How uncertain a median may be without a note: half its 95% interval, in percent; three times that ends a gate
    #[arg(long, value_name = "PERCENT", default_value_t = 5.0, help_heading = "Device and measurement")]
    #[arg(value_parser = parse::percent, allow_hyphen_values = true)]
    pub max_spread: f64,

    /// Refuse doubtful figures: any note makes the exit code 2
    #[arg(long, help_heading = "Device and measurement")]
    pub strict: bool,

    /// Have the Vulkan validation layer watch, which makes the times worthless; any message makes the exit code 3
    #[arg(long, help_heading = "Device and measurement")]
    pub validate: bool,

    /// The JSON of an earlier run: any figure that became worse makes the exit code 3; takes 12 frames at least
    #[arg(long, value_name = "FILE.json", help_heading = "Gate")]
    pub baseline: Option<PathBuf>,

    /// By how much a time over the floor may grow beside the uncertainty of both runs, in percent
    #[arg(long, value_name = "PERCENT", default_value_t = 3.0, requires = "baseline", help_heading = "Gate")]
    #[arg(value_parser = parse::percent, allow_hyphen_values = true)]
    pub tolerance: f64,

    /// Write the tables and all that explains them as JSON
    #[arg(long, value_name = "FILE.json", help_heading = "Results")]
    pub json: Option<PathBuf>,

    /// Write the tables as Markdown
    #[arg(long, value_name = "FILE.md", help_heading = "Results")]
    pub markdown: Option<PathBuf>,

    /// Write each table as CSV into this folder
    #[arg(long, value_name = "DIR", help_heading = "Results")]
    pub csv: Option<PathBuf>,

    /// Draw milliseconds over numbers of splats (table1)
    #[arg(long, value_name = "FILE.svg", help_heading = "Results")]
    pub plot: Option<PathBuf>,

    /// Of `bench counts`.
    #[command(flatten)]
    pub counts: CountsArguments,
}

/// What can be measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum Bench {
    /// The passes against a floor, the same points and formats with nothing computed; and against the device's own limits
    Floor,
    /// Throughput of perspective splatting and of ray casting from 154k to 5M splats, beside the paper's table 1
    Table1,
    /// The five methods of the paper's slides side by side
    Slides,
    /// Transparent layers on 27 balls: 6, 3, 3 with the rest blended, and as many as the view has, beside the paper's figure 6;
    /// what an empty layer costs, and what layers cost an opaque scene
    Layers,
    /// A mesh half as polygons and half as splats: every transition beside none, and the whole as either
    Transition,
    /// Instructions of every pipeline: as in programs of 2006, scalar, and as drivers' compilers have them
    Counts,
    /// All of them
    All,
}

/// Which tables a name stands for.
#[derive(Clone, Copy, Debug)]
pub struct Tables {
    pub floor: bool,
    pub table1: bool,
    pub slides: bool,
    pub layers: bool,
    pub transition: bool,
    pub counts: bool,
}

impl Bench {
    /// The tables of this name.
    pub fn tables(self) -> Tables {
        let is = |one| self == one || self == Self::All;
        Tables {
            floor: is(Self::Floor),
            table1: is(Self::Table1),
            slides: is(Self::Slides),
            layers: is(Self::Layers),
            transition: is(Self::Transition),
            counts: is(Self::Counts),
        }
    }

    /// As it is written on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Floor => "floor",
            Self::Table1 => "table1",
            Self::Slides => "slides",
            Self::Layers => "layers",
            Self::Transition => "transition",
            Self::Counts => "counts",
            Self::All => "all",
        }
    }
}

impl Tables {
    /// Any whose contestants take turns of pairs of frames.
    pub fn take_turns(self) -> bool {
        self.table1 || self.slides || self.layers || self.transition
    }

    /// Any whose figures are times.
    pub fn are_timed(self) -> bool {
        self.floor || self.take_turns()
    }
}

impl BenchArguments {
    /// What all methods have in common.
    pub fn settings(&self) -> Settings {
        Settings {
            size_px: self.size,
            filter: self.filter,
            kernel_eval: self.kernel_eval,
            accumulate: self.accumulate,
            ..Settings::default()
        }
    }

    /// The number of splats that this table is given: with all others the numbers are those of table1.
    pub fn splats_of(&self, table: Bench) -> Option<u64> {
        self.splats.first().copied().filter(|_| self.table == table)
    }

    /// The numbers of splats of table1.
    pub fn splat_counts(&self) -> Vec<u64> {
        let mut counts = if self.splats.is_empty() { PAPER_SPLATS.to_vec() } else { self.splats.clone() };
        let mut seen = HashSet::new();
        counts.retain(|count| seen.insert(*count));
        counts
    }
}
