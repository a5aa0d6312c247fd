//! `surfel info`: what is in files and what would be made of it; or the devices of this machine, and what they lack.

mod devices;
mod files;
mod numbers;
mod octree;

pub use numbers::number;

use clap::Args;
use surfel::{Error, Result};

use crate::{
    camera::CameraArguments,
    console,
    inputs::{INPUTS, InputArguments},
    json::to_json,
};

const EXAMPLES: &str = "Examples:
  surfel info                        the devices of this machine
  surfel info scan.ply               what is in it, and how it would be drawn
  surfel info scan.ply mesh.obj --json
  surfel info scan.ply --strict      exit code 1 if anything of it is not drawn as it says";

/// Tell what is in files and how they would be drawn; without a file, list devices, and what they lack
#[derive(Args)]
#[command(long_about = format!(
    "Tell what is in files and how they would be drawn; no device is needed for that. Without a file, list devices, drivers and \
     limits, and what a device lacks.\n\n{INPUTS}"
))]
#[command(after_help = EXAMPLES)]
pub struct InfoArguments {
    #[command(flatten)]
    input: InputArguments,

    #[command(flatten)]
    camera: CameraArguments,

    /// Print JSON
    #[arg(long, help_heading = "Results")]
    json: bool,
}

/// Runs the subcommand.
///
/// # Errors
/// For files as [`crate::scene::load_scene`]. Without one [`surfel::ErrorKind::NoDevice`] where Vulkan finds no device; those that
/// can't be used are listed.
pub fn run(arguments: &InfoArguments) -> Result<()> {
    if !arguments.input.inputs.is_empty() {
        let info = files::gather(&arguments.input.inputs(), &arguments.camera)?;
        return match arguments.json {
            true => console::print(&to_json(&info)?),
            false => console::print(&files::text(&info)),
        };
    }
    if arguments.input.has_options() || arguments.camera.is_given() {
        return Err(Error::option("surfel info", "options of files or cameras, but no file; expected one"));
    }
    let info = devices::gather()?;
    match arguments.json {
        true => console::print(&to_json(&info)?),
        false => console::print(&devices::text(&info)),
    }
}
