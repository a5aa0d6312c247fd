//! `surfel convert`: a model as a file of splats.

use std::path::{Path, PathBuf};

use clap::Args;
use surfel::{
    Result,
    compose::splats_kind,
    load::{LoadOptions, Model, load},
    report::InputReport,
    save,
    scene::Object,
};

use crate::{
    console::{self, Bars},
    outputs, parse,
    scene::{load_object, not_a_mesh, refuse_losses, resample_mesh},
};

const HELP: &str = "Write a model as a file of splats.

Without --resample these are the splats that `surfel render` draws: a disk at each vertex of a mesh or each point, or the splats of \
the file. With --resample they are disks at points spread evenly over a mesh's area, with normals and colors interpolated from \
the vertices, and radii of 1.5 times the mean distance to the 6 nearest neighbors; the same seed gives the same file.

The file is a binary PLY: x y z nx ny nz radius, or su_x ... sv_z (the tangent vectors) for ellipses, and red green blue \
alpha (sRGB) where the model has colors. Positions are 64-bit where 32 bits would move a splat. The header line \"comment \
surfel closed\" tells `surfel render` that the surface is closed, so that splats that face away need not be drawn.";

const EXAMPLES: &str = "Examples:
  surfel convert igea.ply splats.ply                          a disk at each vertex
  surfel convert igea.ply igea-1m.ply --resample 1M           a million disks, evenly spread
  surfel convert fandisk.obj fandisk.ply --resample 50000 --seed 7";

/// Write a model as a file of splats, at a mesh's vertices or anew over its area
#[derive(Args)]
#[command(long_about = HELP, after_help = EXAMPLES)]
pub struct ConvertArguments {
    /// A PLY file (splats, a mesh or points) or an OBJ file (a mesh or points)
    #[arg(value_name = "INPUT")]
    input: PathBuf,

    /// The file of splats, .ply; an old one is replaced
    #[arg(value_name = "OUTPUT")]
    output: PathBuf,

    /// Spread that many disks evenly over the mesh's area; takes about 75 bytes of memory each [default: a disk at each vertex]
    #[arg(long, value_name = "N", value_parser = parse::splats, allow_hyphen_values = true)]
    resample: Option<u64>,

    /// Which samples are taken
    #[arg(long, value_name = "S", default_value_t = 0, requires = "resample")]
    #[arg(value_parser = parse::whole::<u64>(0..=u64::MAX), allow_hyphen_values = true)]
    seed: u64,

    /// Fail where anything of the file is left out, merged, replaced, clamped or ignored
    #[arg(long)]
    strict: bool,
}

/// Runs the subcommand.
///
/// # Errors
/// Whatever goes wrong; what can be known before the long work is found before it.
pub fn run(arguments: &ConvertArguments) -> Result<()> {
    outputs::check_converted(&arguments.input, &arguments.output)?;
    let bars = Bars::new();
    let made = match arguments.resample {
        Some(count) => resampled_file(&arguments.input, count, arguments.seed, &bars),
        None => load_object(&arguments.input, &bars),
    };
    bars.clear();
    let (object, report) = made?;
    if arguments.strict {
        refuse_losses(&report)?;
    }
    let summary = report.summary;
    let written = save::splats(&arguments.output, &object.splats, object.closed, &bars);
    bars.clear();
    let written = written?;
    let kind = splats_kind(&object.splats);
    let positions = if written.double_positions { ", 64-bit positions" } else { "" };
    let closed = if object.closed { ", marked as closed" } else { "" };
    let (count, bytes) = (object.splats.len(), written.bytes);
    let output = arguments.output.display();
    console::print(&format!("{summary} -> {output}: {count} {kind}{positions}{closed}, {bytes} bytes"))
}

/// Splats spread evenly over the mesh in a file, and what was done.
fn resampled_file(path: &Path, count: u64, seed: u64, bars: &Bars) -> Result<(Object, InputReport)> {
    let loaded = load(path, &LoadOptions::default(), bars)?;
    let mesh = match loaded.model {
        Model::Mesh(mesh) => mesh,
        other => return Err(not_a_mesh(path, &other)),
    };
    let (object, mut report) = resample_mesh(&mesh, path, count, seed, bars)?;
    report.notes = [loaded.notes, report.notes].concat();
    Ok((object, report))
}
