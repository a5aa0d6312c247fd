//! The options of `surfel bench`.

use std::path::PathBuf;

use clap::{Arg, Args, ValueEnum};
use surfel::{
    Error, Result,
    report::bench::{PAPER_HIERARCHIES, PAPER_SPLATS},
    scene::{Lod, Rasterizer, Settings},
};

use super::counts::CountsArguments;
use crate::{
    device::DeviceArguments,
    parse,
    settings::{Given, Taken, once, one_of},
};

const HELP: &str = "\
Measure what things cost, in figures that can be trusted or say that they can't be.

What is compared takes turns, frame pair by frame pair, so that a change of the machine's speed meets all of it alike; \
ratios are taken within each round. The floor draws the same points through the same fixed-function stages into the same \
formats with nothing computed: `x floor` is how many times its time a method takes; `x bound`, \
of bench floor, how many times what the device's own limits alone would take. A median comes with an interval that holds the true one with 95% confidence, whatever the distribution. Notes say when a median is too uncertain (--max-spread), \
the machine's speed drifted, its clock moved, or other processes took the processor; with --strict they end in exit code 2.

As a gate: `--json now.json` keeps a run, `--baseline now.json` judges a later one by it. Times are judged by x floor, so \
that the two runs need not be on an equally fast machine: worse is what is beyond both intervals and --tolerance. Counts of \
fragments, vertices and bytes may grow by a thousandth. Anything worse ends in exit code 3. growth has no floor, and is judged by its counts.";

const EXAMPLES: &str = "Examples:
  surfel bench floor                      the built-in model
  surfel bench table1 --model igea.ply --markdown table1.md --plot table1.svg
  surfel bench slides --model igea.ply
  surfel bench table1 --splats 154k,460k --json before.json
  surfel bench table1 --splats 154k,460k --baseline before.json
  surfel bench layers --markdown layers.md
  surfel bench transition --model igea.ply
  surfel bench growth --model igea.ply --rasterizer perspective,raycast --plot growth.svg
  surfel bench p1 --splats 100k,1M,10M --markdown p1.md
  surfel bench p2 --model igea.ply --splats 1M
  surfel bench hybrid --model igea.ply --markdown hybrid.md
  surfel bench counts --isa NAVI21,VEGA10 --csv tables   instructions of every pipeline
  surfel bench all --csv tables --json all.json";

/// Measure: tables of what things cost
#[derive(Args)]
#[command(long_about = HELP, after_help = EXAMPLES)]
pub struct BenchArguments {
    /// The table
    #[arg(value_name = "NAME")]
    pub table: Bench,

    /// A model of any kind that `surfel render` reads; for table1, slides, growth, p1, p2 and hybrid a mesh, which is resampled evenly over its area and for growth must be
    /// closed; for i1 to i3 a mesh with sharp edges; for transition a mesh, half of which is; layers has its own [default: the built-in model, for transition and hybrid the built-in sphere]
    #[arg(long, value_name = "FILE")]
    pub model: Option<PathBuf>,

    /// Numbers of splats of table1, with commas between, such as 154k,1.4M; slides, p2, i2 and i3 take the first; by itself layers takes it
    /// for each of its 27 balls, and transition for the whole model; by itself hybrid takes the first; growth, p1 and i1 take all, growth the middle one over sizes
    /// [default: the paper's; 2000 a ball; 40k; for growth 10k to 5M, for p1 137k to 5M, for p2 1M, for hybrid one a vertex, for i1 2500, 5000 and one a triangle, for i2 and i3 2500]
    #[arg(long, value_name = "LIST", value_delimiter = ',', value_parser = parse::splats)]
    pub splats: Vec<u64>,

    #[command(flatten)]
    settings: Given<Common>,

    /// Sizes of growth over pixels, with commas between; a number alone is a square [default: 256 to 4096]
    #[arg(long, value_name = "LIST", value_delimiter = ',', value_parser = parse::square_or_size)]
    pub sizes: Vec<[u32; 2]>,

    /// Tolerances of p2, with commas between, in pixels or percent of the picture; the first is what the others are set beside [default: 0 to 2px,
    /// and the paper's]
    #[arg(long, value_name = "LIST", value_delimiter = ',', value_parser = parse::tolerance)]
    pub tolerances: Vec<Lod>,

    /// The rasterizer of floor; of growth several, with commas between, in turn and beside the first [default: perspective]
    #[arg(long, value_name = "LIST", value_delimiter = ',', value_parser = one_of(Rasterizer::NAMES))]
    pub rasterizer: Vec<Rasterizer>,

    /// Frames timed of each method, in turn with the floor: in pairs after an untimed one, and as many again for the times
    /// of their passes; floor has as many rounds of single frames
    #[arg(long, value_name = "N", default_value_t = Self::FRAMES, help_heading = "Device and measurement")]
    #[arg(value_parser = parse::whole::<u32>(1..=100_000), allow_hyphen_values = true)]
    pub frames: u32,

    #[command(flatten, next_help_heading = "Device and measurement")]
    pub device: DeviceArguments,

    /// How uncertain a median may be without a note: half its 95% interval, in percent; three times that ends a gate
    #[arg(long, value_name = "PERCENT", default_value_t = 5.0, help_heading = "Device and measurement")]
    #[arg(value_parser = parse::number("percent", 0.0..=1000.0), allow_hyphen_values = true)]
    pub max_spread: f64,

    /// Refuse doubtful figures: any note makes the exit code 2
    #[arg(long, help_heading = "Device and measurement")]
    pub strict: bool,

    /// The JSON of an earlier run: any figure that became worse makes the exit code 3; takes 12 frames at least
    #[arg(long, value_name = "FILE.json", help_heading = "Gate")]
    pub baseline: Option<PathBuf>,

    /// By how much a time over the floor may grow beside the uncertainty of both runs, in percent
    #[arg(long, value_name = "PERCENT", default_value_t = 3.0, requires = "baseline", help_heading = "Gate")]
    #[arg(value_parser = parse::number("percent", 0.0..=1000.0), allow_hyphen_values = true)]
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

    /// Draw milliseconds over numbers of splats (table1), and over pixels too (growth), or seconds over triangles (i3)
    #[arg(long, value_name = "FILE.svg", help_heading = "Results")]
    pub plot: Option<PathBuf>,

    #[command(flatten)]
    pub counts: CountsArguments,
}

/// A table, or all of them.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
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
    /// Levels of detail in the making: the octree and the ellipses of its nodes, beside the table 1 of Pajarola et al. 2003
    P1,
    /// Levels of detail drawn: splats and times over tolerances, beside the table 2 of Pajarola et al. 2003
    P2,
    /// A mesh from afar to near: polygons, polygons and splats as the view has it, splats in levels of detail
    Hybrid,
    /// What clip curves cost over numbers of splats: nothing cut, lines, curves, beside the table 1 of Ivo et al. 2012
    I1,
    /// The same over how much of the image splats cover, beside their table 2
    I2,
    /// Clipped splats in the making: seconds over triangles of a mesh
    I3,
    /// Instructions of every pipeline: as in programs of 2006, scalar, and as drivers' compilers have them
    Counts,
    /// All of them but growth, p1, p2, hybrid and i1 to i3
    All,
}

impl Bench {
    /// Whether this name stands for `table`.
    pub fn has(self, table: Self) -> bool {
        let alone = matches!(
            table,
            Self::Growth | Self::P1 | Self::P2 | Self::Hybrid | Self::I1 | Self::I2 | Self::I3
        );
        self == table || self == Self::All && !alone
    }

    /// Whether any of its figures are times of a device: instructions are counted without one, and hierarchies and splats made.
    pub fn needs_device(self) -> bool {
        !matches!(self, Self::Counts | Self::P1 | Self::I3)
    }

    /// Whether any of its contestants take turns of pairs of frames.
    pub fn takes_turns(self) -> bool {
        self.needs_device() && self != Self::Floor
    }

    /// Its word on the command line.
    pub fn name(self) -> String {
        self.to_possible_value().map(|value| value.get_name().to_owned()).unwrap_or_default()
    }
}

/// The numbers of splats of growth: the paper's, and others around them.
const GROWTH_SPLATS: [u64; 10] =
    [10_000, 30_000, 100_000, 154_000, 300_000, 460_000, 1_000_000, 1_400_000, 3_000_000, 5_000_000];

/// The settings that all methods have in common.
struct Common;

impl Taken for Common {
    type Table = Settings;

    fn option(name: &str, option: Arg) -> Option<Arg> {
        match name {
            "size" => Some(option.help("Width and height in pixels; for growth over splats; i1 and i2 have 800x800 where none is given")),
            "filter" => Some(option.help("The filter of all but slides, which has each method's own")),
            "kernel-eval" | "accumulate" => Some(option),
            "lod" | "lod-steps" | "budget" => Some(option.help_heading("growth, p2")),
            _ => None,
        }
    }
}

impl BenchArguments {
    /// Frames where nobody says how many.
    pub const FRAMES: u32 = 20;

    /// The settings that all methods have in common.
    pub fn settings(&self) -> Settings {
        if matches!(self.table, Bench::I1 | Bench::I2) {
            // The paper's size.
            return self.settings.said_over(Settings { size_px: [800, 800], ..Settings::default() });
        }
        self.settings.over(Settings {
            // Other tables have their own, or are set beside the floor, which is made of points.
            rasterizer: match (self.table, self.rasterizer.as_slice()) {
                (Bench::Floor, [rasterizer]) => *rasterizer,
                _ => Rasterizer::Perspective,
            },
            ..Settings::default()
        })
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
            _ if self.table != Bench::P2 && !self.tolerances.is_empty() => {
                refused("--tolerances", "has none: only p2 has")
            }
            Bench::Growth => Ok(()),
            _ if self.settings().wants_levels() => {
                refused("--lod, --budget", "draws the model itself: only growth draws levels of detail")
            }
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

    /// The numbers of splats of p1: the paper's, and more.
    pub fn hierarchy_splats(&self) -> Vec<u64> {
        let paper = PAPER_HIERARCHIES.map(|(splats, ..)| splats);
        once(&self.splats, &[&paper[..], &[1_000_000, 5_000_000]].concat())
    }

    /// The rasterizers of growth, each once; the first is what the others are set beside.
    pub fn rasterizers(&self) -> Vec<Rasterizer> {
        once(&self.rasterizer, &[Rasterizer::default()])
    }
}
