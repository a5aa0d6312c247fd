//! The options of `surfel bench`.

use std::{collections::HashSet, hash::Hash, path::PathBuf};

use clap::Args;
use surfel::{
    Error, Result,
    report::PAPER_SPLATS,
    scene::{Accumulate, Filter, KernelEval, Rasterizer, Settings},
};

use crate::{counts::CountsArguments, parse, picture_arguments::choice};

/// Options of `surfel bench`.
#[derive(Debug, Args)]
pub struct BenchArguments {
    /// What is measured
    #[arg(value_name = "NAME")]
    pub table: Bench,

    /// A PLY or OBJ file; for table1, slides and growth a mesh, which is resampled evenly over its area and for growth must be
    /// closed; for transition a mesh, half of which is; layers has its own [default: the built-in model, for transition the built-in sphere]
    #[arg(long, value_name = "FILE")]
    pub model: Option<PathBuf>,

    /// Numbers of splats of table1, with commas between, such as 154k,1.4M; slides takes the first; by itself layers takes it
    /// for each of its 27 balls, and transition for the whole model; growth takes all, and the middle one over sizes [default:
    /// the paper's; 2000 a ball; 40k; for growth 10k to 5M]
    #[arg(long, value_name = "LIST", value_delimiter = ',', value_parser = parse::splats)]
    pub splats: Vec<u64>,

    /// Width and height in pixels; for growth over splats
    #[arg(long, value_name = "WxH", default_value = "1024x1024", value_parser = parse::size)]
    pub size: [u32; 2],

    /// Sizes of growth over pixels, with commas between; a number alone is a square [default: 256 to 4096]
    #[arg(long, value_name = "LIST", value_delimiter = ',', value_parser = parse::square_or_size)]
    pub sizes: Vec<[u32; 2]>,

    /// The rasterizer of floor; of growth several, with commas between, in turn and beside the first [default: perspective]
    #[arg(long, value_name = "LIST", value_delimiter = ',', value_parser = choice(Rasterizer::NAMES))]
    pub rasterizer: Vec<Rasterizer>,

    /// The filter of all but slides, which has each method's own
    #[arg(long, value_name = "FILTER", default_value = "adjust", value_parser = choice(Filter::NAMES))]
    pub filter: Filter,

    /// How the kernel is evaluated
    #[arg(long, value_name = "HOW", default_value = "analytic", value_parser = choice(KernelEval::NAMES))]
    pub kernel_eval: KernelEval,

    /// The precision of the sums
    #[arg(long, value_name = "TYPE", default_value = "f16", value_parser = choice(Accumulate::NAMES))]
    pub accumulate: Accumulate,

    /// Frames timed of each method, in turn with the floor: in pairs after an untimed one, and as many again for the times
    /// of their passes; floor has as many rounds of single frames
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

    /// Draw milliseconds over numbers of splats (table1), and over pixels too (growth)
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
    /// A frame's time and memory over numbers of splats, and over sizes
    Growth,
    /// Instructions of every pipeline: as in programs of 2006, scalar, and as drivers' compilers have them
    Counts,
    /// All of them but growth
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
    pub growth: bool,
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
            growth: self == Self::Growth,
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
            Self::Growth => "growth",
            Self::Counts => "counts",
            Self::All => "all",
        }
    }
}

impl Tables {
    /// Any whose contestants take turns of pairs of frames.
    pub fn take_turns(self) -> bool {
        self.table1 || self.slides || self.layers || self.transition || self.growth
    }

    /// Any whose figures are times.
    pub fn are_timed(self) -> bool {
        self.floor || self.take_turns()
    }
}

/// The numbers of splats of growth: the paper's, and others around them.
const GROWTH_SPLATS: [u64; 10] =
    [10_000, 30_000, 100_000, 154_000, 300_000, 460_000, 1_000_000, 1_400_000, 3_000_000, 5_000_000];

/// What is listed, each once; the default where nothing is.
fn once<T: Copy + Eq + Hash>(listed: &[T], default: &[T]) -> Vec<T> {
    let mut all = if listed.is_empty() { default.to_vec() } else { listed.to_vec() };
    let mut seen = HashSet::new();
    all.retain(|value| seen.insert(*value));
    all
}

impl BenchArguments {
    /// What all methods have in common.
    pub fn settings(&self) -> Settings {
        Settings {
            size_px: self.size,
            filter: self.filter,
            kernel_eval: self.kernel_eval,
            accumulate: self.accumulate,
            // Other tables have their own, or are set beside the floor, which is made of points.
            rasterizer: match (self.table, self.rasterizer.as_slice()) {
                (Bench::Floor, [rasterizer]) => *rasterizer,
                _ => Rasterizer::Perspective,
            },
            ..Settings::default()
        }
    }

    /// Refuses lists that the table does not take.
    ///
    /// # Errors
    /// [`surfel::error::ErrorKind::Option`].
    pub fn check_lists(&self) -> Result<()> {
        let refused = |option, problem: &str| {
            Err(Error::option(option, format!("bench {} {problem}", self.table.name())))
        };
        match self.table {
            Bench::Growth => Ok(()),
            _ if !self.sizes.is_empty() => refused("--sizes", "has one, by --size: only growth has several"),
            Bench::Floor if self.rasterizer.len() > 1 => {
                refused("--rasterizer", "takes one: only growth takes several")
            }
            Bench::Floor => Ok(()),
            _ if !self.rasterizer.is_empty() => {
                refused("--rasterizer", "has its own: only floor and growth take one")
            }
            _ => Ok(()),
        }
    }

    /// The number of splats that this table is given: with all others the numbers are those of table1.
    pub fn splats_of(&self, table: Bench) -> Option<u64> {
        self.splats.first().copied().filter(|_| self.table == table)
    }

    /// The numbers of splats of table1.
    pub fn splat_counts(&self) -> Vec<u64> {
        once(&self.splats, &PAPER_SPLATS)
    }

    /// The numbers of splats of growth, from few to many.
    pub fn growth_splats(&self) -> Vec<u64> {
        let mut counts = once(&self.splats, &GROWTH_SPLATS);
        counts.sort_unstable();
        counts
    }

    /// The number of splats of growth over pixels: the middle one, of an even number the lesser.
    pub fn middle_splats(&self) -> u64 {
        let counts = self.growth_splats();
        counts[(counts.len() - 1) / 2]
    }

    /// The sizes of growth over pixels, from few to many.
    pub fn growth_sizes(&self) -> Vec<[u32; 2]> {
        let mut sizes = once(&self.sizes, &[256, 512, 1024, 2048, 4096].map(|side| [side; 2]));
        sizes.sort_unstable_by_key(|[width, height]| u64::from(*width) * u64::from(*height));
        sizes
    }

    /// The rasterizers of growth, each once; the first is what the others are set beside.
    pub fn rasterizers(&self) -> Vec<Rasterizer> {
        once(&self.rasterizer, &[Rasterizer::default()])
    }
}
