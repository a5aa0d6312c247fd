//! `surfel convert`: a model as a file of splats.

mod made;

use std::{
    fs,
    path::{Path, PathBuf},
};

use clap::Args;
use surfel::{
    Error, Progress as _, Result,
    compose::splats_kind,
    levels_file::{self, LEAST_MEMORY, Written},
    load::{SplatRows, file_name},
    notes::counted,
    save,
};

use crate::{
    allocator,
    console::{self, Bars},
    inputs::ReadingArguments,
    outputs, parse,
};
use made::Made;

const HELP: &str = "Write a model as a file of splats.

Without --resample these are the splats that `surfel render` draws: a disk at each vertex of a mesh (an ellipse for \
each side of an edge there, where the mesh bends by more than 40 degrees or ends) or each point, or the splats of the file. With \
--resample they are disks at points spread evenly over a mesh's area, with normals and colors interpolated from the vertices, and \
radii of 1.5 times the mean distance to the 6 nearest neighbors; the same seed gives the same file.

With --splats or --max-error they are ellipses through the corners of the triangles of a simplified mesh, cut off at its ridges: edges \
over which it bends by 30 degrees or more, and its border. Splats on both sides of a ridge are clipped by one curve. Vertices stay \
where they are or vanish; a triangle that more than two curves cross becomes several splats. Triangles that are turned around against \
their neighbors are turned back; an edge of more than two triangles is a ridge of each, at which its splats end.

A splat has one color, the mean of the surface that it stands for. So where colors of vertices vary, triangles stay small, those of the file are \
split where they are too large and N or E asks for more splats, and splats end where a color steps. A color that is off by d (linear light, root mean \
square) over the area A that a splat stands for counts as a distance of d times the root of A, of which E allows as much as of others; a d below 0.001 \
counts as none. Normals of the file are not kept: those of splats are of their planes, and ridges are where triangles bend.

The file is a binary PLY: x y z nx ny nz radius, or su_x ... sv_z (the tangent vectors) for ellipses, and red green blue \
alpha (sRGB) where the model has colors. Parts of ellipses are cut off by clip_a1 clip_a3 clip_u clip_v clip_w, the same with \
clip2_, and clip_mode (0: either removes, 1: both must): a rational Bezier curve in the plane of the splat from angle a1 \
of its rim to a3 (radians, from su toward sv), with (u, v) its middle control point and w the weight of that; what is to the right \
of the way is removed, and NaN is no curve. Positions are 64-bit where 32 bits would move a splat. The header line \"comment \
surfel closed\" tells `surfel render` that the surface is closed, so that splats that face away need not be drawn, \"comment surfel up 0 0 1\" which \
direction is up where the input, its format or its shape tells it.

A file that is named .surfel holds the splats and their levels of detail in pages, of which `surfel render --lod 1px` reads those that its \
view needs (docs/format.md).";

const EXAMPLES: &str = "Examples:
  surfel convert igea.ply splats.ply                          a disk at each vertex
  surfel convert igea.ply igea-1m.ply --resample 1M           a million disks, evenly spread
  surfel convert fandisk.obj fandisk.ply --resample 50000 --seed 7
  surfel convert part.obj part.ply --splats 2500              few splats with sharp edges
  surfel convert part.obj part.ply --max-error 0.01           as few as are nowhere off by more than 0.01, about
  surfel convert igea-1m.ply igea-1m.surfel           with levels of detail, of which a view reads what it needs";

/// Write a model as a file of splats, at a mesh's vertices or anew over its area
#[derive(Args)]
#[command(long_about = HELP, after_help = EXAMPLES)]
pub struct ConvertArguments {
    /// A model or scan: any file that `surfel info` reads but a scene file, - for standard input
    #[arg(value_name = "INPUT")]
    input: PathBuf,

    /// The file of splats, .ply, or .surfel with levels of detail; an old one is replaced
    #[arg(value_name = "OUTPUT")]
    output: PathBuf,

    /// Spread that many disks evenly over the mesh's area; takes about 75 bytes of memory each [default: a disk at each vertex]
    #[arg(long, value_name = "N", value_parser = parse::splats, allow_hyphen_values = true)]
    resample: Option<u64>,

    /// Which samples are taken
    #[arg(long, value_name = "S", default_value_t = 0, requires = "resample")]
    #[arg(value_parser = parse::whole::<u64>(0..=u64::MAX), allow_hyphen_values = true)]
    seed: u64,

    /// Simplify the mesh to that many splats, clipped where it has sharp edges; more where no edge can collapse, or --max-error lets none
    #[arg(long, value_name = "N", value_parser = parse::splats, allow_hyphen_values = true, conflicts_with = "resample")]
    splats: Option<u64>,

    /// Simplify the mesh to splats, clipped where it has sharp edges, while no collapse of an edge is off by more than E in units of the file: the
    /// root mean square distance to the planes of the triangles at a vertex, the distance of a curve from its ridge, and how far an ellipse comes to
    /// stand off the triangles beside its own, where those of the file don't; and how far the color of a splat is
    /// off, times the root of the area that it stands for
    #[arg(long, value_name = "E", allow_hyphen_values = true, conflicts_with = "resample")]
    #[arg(value_parser = parse::number("a length above 0", f64::MIN_POSITIVE..=f64::MAX))]
    max_error: Option<f64>,

    /// So much memory for a .surfel file, such as 512MB: of a binary PLY file of splats that does not fit, it is built part by part, with as much
    /// room beside OUTPUT as INPUT has bytes; other files are refused then [default: 2GB for these, and no limit for others]
    #[arg(long, value_name = "BYTES", value_parser = parse::bytes(LEAST_MEMORY), allow_hyphen_values = true)]
    memory: Option<u64>,

    #[command(flatten)]
    reading: ReadingArguments,
}

/// Runs the subcommand.
///
/// # Errors
/// Whatever goes wrong; what can be known before the long work is found before it.
pub fn run(arguments: &ConvertArguments) -> Result<()> {
    outputs::check_converted(&arguments.input, &arguments.output)?;
    let bars = Bars::new();
    if let Some(rows) = larger_than_memory(arguments)? {
        return convert_in_parts(arguments, rows, &bars);
    }
    let made = bars.held(|| made::made(arguments, &bars));
    bars.clear();
    let Made { object, report, up, hint } = made?;
    let summary = report.summary;
    if is_hierarchy(&arguments.output) {
        let written = levels_file::write_object(&arguments.output, &object, up, &bars);
        bars.clear();
        return say_written(&summary, &arguments.output, &written?, ["", &hint]);
    }
    let written = save::splats(&arguments.output, &object.splats, object.closed, up, &bars);
    bars.clear();
    let written = written?;
    let kind = splats_kind(&object.splats);
    let positions = if written.double_positions { ", 64-bit positions" } else { "" };
    let closed = if object.closed { ", marked as closed" } else { "" };
    let (count, bytes) = (counted(object.splats.len() as u64, kind), written.bytes);
    let output = arguments.output.display();
    console::print(&format!("{summary} -> {output}: {count}{positions}{closed}, {bytes} bytes{hint}"))
}

/// Whether a file is to have levels of detail, by its name.
fn is_hierarchy(output: &Path) -> bool {
    output.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("surfel"))
}

/// The most memory for a file of splats where none is given.
const DEFAULT_MEMORY: u64 = 2_000_000_000;

/// By how much more memory at least a file takes that is not read row by row.
const BYTES_A_BYTE: u64 = 8;

/// The rows of a file that is to have levels of detail, and is too large for them to be made in one go.
///
/// # Errors
/// A file that is too large and has no such rows; `--memory` where it means nothing.
fn larger_than_memory(arguments: &ConvertArguments) -> Result<Option<SplatRows>> {
    let ConvertArguments { input, output, memory, .. } = arguments;
    match memory {
        Some(_) if !is_hierarchy(output) => {
            return Err(Error::option("--memory", "only for an OUTPUT that is named .surfel"));
        }
        None if !is_hierarchy(output) => return Ok(None),
        _ => {}
    }
    let is_anew = arguments.resample.is_some() || arguments.splats.is_some() || arguments.max_error.is_some();
    let rows = match !is_anew && input.is_file() {
        true => SplatRows::open(input, &arguments.reading.options())?,
        false => None,
    };
    match (rows, *memory) {
        (Some(rows), memory) => {
            let fits = levels_file::fits(rows.count(), memory.unwrap_or(DEFAULT_MEMORY));
            Ok((!fits).then_some(rows))
        }
        (None, Some(memory)) => {
            let bytes = fs::metadata(input).map_or(0, |metadata| metadata.len()).saturating_mul(BYTES_A_BYTE);
            if bytes <= memory {
                return Ok(None);
            }
            let problem = format!(
                "{memory} bytes; {} takes more than {bytes}; expected a binary PLY file of splats, which is read in parts (surfel convert {} \
                 splats.ply)",
                input.display(),
                input.display()
            );
            Err(Error::option("--memory", problem))
        }
        (None, None) => Ok(None),
    }
}

/// Writes splats with levels of detail, part by part.
fn convert_in_parts(arguments: &ConvertArguments, rows: SplatRows, bars: &Bars) -> Result<()> {
    let name = file_name(&arguments.input);
    let (count, memory) = (rows.count(), arguments.memory.unwrap_or(DEFAULT_MEMORY));
    if let Some(note) = arguments.reading.options().columns_unused() {
        bars.note(&format!("{name}: {note}"));
    }
    allocator::begin_peak();
    let written =
        levels_file::convert_splats(rows, &arguments.output, memory, arguments.reading.strict, bars);
    bars.clear();
    let (written, defects) = written?;
    let peak_bytes = allocator::peak_bytes();
    let left_out = match defects.total() {
        0 => String::new(),
        total => format!("; {} left out: {defects}", counted(total as u64, "splats")),
    };
    let parts = format!(", built in {} parts within {peak_bytes} bytes of memory", written.parts);
    let count = counted(count, "splats");
    say_written(&format!("{name}: {count}{left_out}"), &arguments.output, &written, [&parts, ""])
}

/// Tells what was written, and how; `hint` goes on from it.
fn say_written(summary: &str, output: &Path, written: &Written, [how, hint]: [&str; 2]) -> Result<()> {
    let header = &written.header;
    let kind = if header.ellipses { "ellipses" } else { "disks" };
    let output = output.display();
    console::print(&format!(
        "{summary} -> {output}: {} {kind} below {} nodes in {} pages{how}, {} bytes{hint}",
        header.splats,
        header.nodes,
        header.pages,
        header.file_bytes()
    ))
}
