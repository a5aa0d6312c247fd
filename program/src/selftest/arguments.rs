//! The options of `surfel selftest`, and its manual.

use std::path::PathBuf;

use clap::Args;
use surfel::selftest::Pattern;

use crate::parse;

/// The options that `--list` has nothing to do with.
const NOT_WITH_LIST: [&str; 8] =
    ["junit", "json", "known", "no_known", "retries", "device", "no_validate", "verbose"];

const HELP: &str = "\
Draw every hard scene with every method and compare it with the oracle in 64 bits, under validation: for those who change \
a driver, a validation layer, or surfel. Files are not needed, the scenes are built in; each is hard in one known way.

A case is a path: the group, the rasterizer, the filter, the scene. The groups: methods, with 32-bit sums; psi-e, \
unit-weight, kernel-texture, sums-16 and combinations of them, with those options (sums of 16 bits are held to what rounding alone may do \
to them; where some hundred splats meet in a pixel that is no bound, and only coverage and finite values are asked for); \
repeat, drawn twice, which may change none either; tile-invocations, tiles by columns, by short ones and by pixels: the same bits, but by short ones of splats that clip curves cut, whose sums have another order; layers, the picture of what is \
transparent, of polygons, of both beside splats and of a scene's own lights; layers-16, the same with sums of 16 bits; \
layers-auto, which has to give the bits of a fixed number of layers. A message of the validation layer \
fails the case during which it comes; device.open and device.close stand for all outside of cases, and are always run.

A case that fails is tried again, --retries times. It ends as pass; fail; known fail, as listed; fixed, which is listed as a \
failure but passes; flake, listed as such, failed at least once; skip, listed, or the device can't do it. The exit code is 3 \
where a case failed or is fixed: lists have to be true. One that fails first and passes later has failed, unless it is \
listed as a flake.

What is known of drivers comes with the program, a list a driver, and from --known. A list is a text; each line says fail, \
flake or skip, a case or a pattern, and why:

  driver llvmpipe Mesa 22.3.*                 as surfel info prints it; without any: all
  fail  methods.triangle.none.edge-on-disks   # vertices are snapped to 1/256 px
  flake repeat.quad                           # all below it
  skip  *.3000-coincident-disks               # takes minutes

Of several that match a case the last counts, and --known counts above what comes along. An entry that matches no case is \
an error.";

const EXAMPLES: &str = "Examples:
  surfel selftest --quick                                  less than a minute on a processor
  surfel selftest --junit selftest.xml --json selftest.json
  surfel selftest --case methods.triangle --case '*.edge-on-disks'
  surfel selftest --known ci/turnip.txt --device adreno
  surfel selftest --verbose 2>&1 | tail -1                 the case in which the driver crashes

Exit codes: 0 fine; 1 an option or a list is at fault; 2 the device is at fault; 3 cases failed, or pass against the list.";

/// Compare every method with the oracle on every hard scene, under validation: for the CI of drivers
#[derive(Args)]
#[command(long_about = HELP, after_help = EXAMPLES)]
pub struct SelftestArguments {
    /// A part: every rasterizer on every scene; every filter and every option with every rasterizer on a sphere of disks; layers
    /// on all their scenes, and with every rasterizer and every filter on one
    #[arg(long)]
    pub quick: bool,

    /// Only these cases: a name, its beginning up to a dot, or either with * for any part; may be given again
    #[arg(long = "case", value_name = "PATTERN", value_parser = Pattern::new)]
    pub cases: Vec<Pattern>,

    /// Print the names of the cases that would be run, and end
    #[arg(long, conflicts_with_all = NOT_WITH_LIST)]
    pub list: bool,

    /// Name each case on the standard error before it is run: the last one is that in which the driver crashed
    #[arg(long)]
    pub verbose: bool,

    /// Try a case that fails again, up to that many times
    #[arg(long, value_name = "N", default_value_t = 2)]
    #[arg(value_parser = parse::whole::<u32>(0..=100), allow_hyphen_values = true)]
    pub retries: u32,

    /// A list of what is known of the driver; may be given again
    #[arg(long, value_name = "FILE", help_heading = "What is known of the driver")]
    pub known: Vec<PathBuf>,

    /// Without the lists that come with the program
    #[arg(long, help_heading = "What is known of the driver")]
    pub no_known: bool,

    /// The device: its number or a part of its name, see `surfel info` [default: the best]
    #[arg(long, value_name = "NAME|INDEX", help_heading = "Device")]
    pub device: Option<String>,

    /// Without the validation layer
    #[arg(long, help_heading = "Device")]
    pub no_validate: bool,

    /// Write all cases as JUnit XML: known fails as skipped, flakes as flaky
    #[arg(long, value_name = "FILE.xml", help_heading = "Results")]
    pub junit: Option<PathBuf>,

    /// Write all cases, with errors and settings, as JSON
    #[arg(long, value_name = "FILE.json", help_heading = "Results")]
    pub json: Option<PathBuf>,
}
