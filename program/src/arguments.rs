//! The subcommands: each has its options and its manual beside what it does.

use clap::{Parser, Subcommand};
use surfel::Result;

use crate::{
    bench::{self, BenchArguments},
    compare::{self, CompareArguments},
    convert::{self, ConvertArguments},
    figure::{self, FigureArguments},
    info::{self, InfoArguments},
    reference::{self, ReferenceArguments},
    render::{self, RenderArguments},
    report::{self, ReportArguments},
    selftest::{self, SelftestArguments},
    view::{self, ViewArguments},
};

/// Draws surfaces made of splats (oriented disks, surfels) with Vulkan.
#[derive(Parser)]
#[command(name = "surfel", version, arg_required_else_help = true)]
#[command(after_help = "Start here:
  surfel view scan.ply                 a window with a file
  surfel render                        a picture of the built-in model, surfel.png
  surfel render scan.ply -o scan.png   a picture of a file
  surfel convert scan.obj splats.ply   a file of splats
  surfel info scan.ply                 what is in a file, and what would be drawn
  surfel info                          the devices of this machine

Exit codes: 0 fine; 1 the input or an option is at fault; 2 the device is at fault; 3 validation messages or a \
failed check.")]
pub struct Arguments {
    #[command(subcommand)]
    pub command: Command,
}

/// The subcommands, in the order of the manual.
#[derive(Subcommand)]
pub enum Command {
    View(ViewArguments),
    Render(RenderArguments),
    Reference(ReferenceArguments),
    Compare(CompareArguments),
    Convert(ConvertArguments),
    Figure(FigureArguments),
    Bench(BenchArguments),
    Selftest(SelftestArguments),
    Report(ReportArguments),
    Info(InfoArguments),
}

impl Command {
    /// Runs it.
    pub fn run(&self) -> Result<()> {
        match self {
            Self::View(arguments) => view::run(arguments),
            Self::Render(arguments) => render::run(arguments),
            Self::Reference(arguments) => reference::run(arguments),
            Self::Compare(arguments) => compare::run(arguments),
            Self::Convert(arguments) => convert::run(arguments),
            Self::Figure(arguments) => figure::run(arguments),
            Self::Bench(arguments) => bench::run(arguments),
            Self::Selftest(arguments) => selftest::run(arguments),
            Self::Report(arguments) => report::run(arguments),
            Self::Info(arguments) => info::run(arguments),
        }
    }
}
