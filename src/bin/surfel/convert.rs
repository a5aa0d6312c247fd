//! `surfel convert`: a model as a file of splats.

use std::path::Path;

use surfel::{
    Error, ErrorKind, Result,
    compose::{resampled, splats_kind},
    load::{Model, Samples, load},
    report::InputReport,
    save,
    scene::{Mesh, Object},
};

use crate::{
    arguments::ConvertArguments,
    console::{self, Bars},
    outputs,
    scene::load_object,
    steps::Steps,
};

/// Runs the subcommand.
///
/// # Errors
/// Whatever goes wrong; what can be known before the long work is found before it.
pub fn run(arguments: &ConvertArguments) -> Result<()> {
    outputs::check_converted(&arguments.input, &arguments.output)?;
    let bars = Bars::new();
    let made = match arguments.resample {
        Some(count) => resampled_file(&arguments.input, count, arguments.seed, &bars),
        None => load_object(&arguments.input, &bars, &mut Steps::default())
            .map(|(object, report)| (object, report.summary)),
    };
    bars.clear();
    let (object, summary) = made?;
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

/// Splats spread evenly over the mesh in a file, and what was done in words.
fn resampled_file(path: &Path, count: u64, seed: u64, bars: &Bars) -> Result<(Object, String)> {
    let mesh = match load(path, bars)? {
        Model::Mesh(mesh) => mesh,
        Model::Splats { .. } => return Err(not_a_mesh(path)),
    };
    resample_mesh(&mesh, path, count, seed, bars).map(|(object, report)| (object, report.summary))
}

/// Why a file of splats can't be resampled.
pub fn not_a_mesh(path: &Path) -> Error {
    let problem = "the file holds splats; expected a mesh, to take samples of its triangles";
    Error::input(path, "", problem)
}

/// Splats spread evenly over the mesh of the file at `path`.
///
/// # Errors
/// As [`resample`].
pub fn resample_mesh(
    mesh: &Mesh,
    path: &Path,
    count: u64,
    seed: u64,
    bars: &Bars,
) -> Result<(Object, InputReport)> {
    let name = path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned();
    resampled(mesh, name, Samples { count, seed }, bars).map_err(|error| match error.kind() {
        // The library knows no file.
        ErrorKind::Input { problem, .. } => Error::input(path, "", problem),
        _ => error,
    })
}
