//! `surfel view`: a scene in a window. One file a part: what keys do (`keys`), how the camera moves (`navigation`), how coarse a moving
//! picture is (`pace`), the thread that reads files (`loading`, `opening`, `told`), the window's device (`device`, `gpu` and the files it names; `warm`, `ahead`), what lies over the
//! picture (`ui`, `panel`, `state`, `popups`, `compared`), and the window itself (`app`, `viewer`, `news`, `redraw`, `steps`, `meanwhile`, `costs`, `refine`, `hidden`, `recover`, `input`, `files`, `changes`, `reasons`, `things`, `picking`, `anchor`, `path`, `capture`).

mod ahead;
mod anchor;
mod app;
mod bars;
mod capture;
mod changes;
mod compared;
mod costs;
mod cuts;
mod device;
mod display;
mod document;
mod edited_files;
mod edits;
mod extents;
mod files;
mod frame;
mod frame_desc;
mod gpu;
mod hidden;
mod history;
mod input;
mod keys;
#[cfg(feature = "live-shaders")]
mod live;
mod loading;
mod meanwhile;
mod memory;
mod navigation;
mod news;
mod on_device;
mod opening;
mod options;
mod overlay;
mod pace;
mod panel;
mod path;
mod picking;
mod picture;
mod popups;
mod printed;
mod reasons;
mod recover;
mod redraw;
mod refine;
mod show;
mod state;
mod steps;
mod things;
mod tidy;
mod told;
mod ui;
mod values;
mod viewer;
mod warm;
mod writing;

use std::path::PathBuf;

use clap::Args;
use surfel::{
    ErrorKind, Result,
    scene::{Encoding, Light, OptionValue as _, Settings, Storage},
};
use winit::event_loop::EventLoop;

use crate::{
    camera::{CameraArguments, CameraChoice},
    device::{DeviceArguments, conclude},
    inputs::{INPUTS, InputArguments},
    parse,
    settings::Given,
};

const EXAMPLES: &str = "Examples:
  surfel view
  surfel view scan.ply
  surfel view a.ply b.obj --view iso --shading normals
  surfel view scene.toml --samples 16 --background none      i writes a picture: 16 samples a pixel, transparent";

/// Look at a scene in a window
#[derive(Args)]
#[command(long_about = format!("Look at a scene in a window.\n\n{INPUTS}\n\nOpaque .surfel files, on the command line and in scene files, are read in the background, coarser pages first, as the camera needs them; transparent ones, and what is made transparent, are read whole. Files that change on disk are read again; \
files that are dropped on the window take the place of the scene."))]
#[command(after_help = format!("{}\n\n{EXAMPLES}", manual_of_keys()))]
pub struct ViewArguments {
    #[command(flatten)]
    input: InputArguments,

    #[command(flatten)]
    camera: CameraArguments,

    /// A path of cameras, as of surfel render --path, for the keys that play it and go on with it; one that is dropped on the window is such a path, too
    #[arg(long, value_name = "FILE")]
    path: Option<PathBuf>,

    /// A light in place of those of scene files, and of the one at the eye, as of surfel render; once for each light
    #[arg(long = "light", value_name = "LIGHT", value_parser = Light::parse, allow_hyphen_values = true, help_heading = "Method")]
    lights: Vec<Light>,

    /// The size of pictures that the key i writes, which may be larger than the window [default: the window's]
    #[arg(long, value_name = "WxH", value_parser = <[u32; 2]>::parse)]
    picture_size: Option<[u32; 2]>,

    /// So much device memory for all .surfel files together, such as 256MB, of which pages come as the camera needs them: what is drawn is coarser where it does not suffice
    /// [default: 2GB]
    #[arg(long, value_name = "BYTES", value_parser = parse::bytes(1 << 20), allow_hyphen_values = true)]
    budget_memory: Option<u64>,

    /// Print a line for each frame of the scene: its size, its time on the device, and how long after its input it was done; and, once it rests, one of the memory in use
    #[arg(long, help_heading = "Device")]
    print_frames: bool,

    #[command(flatten)]
    settings: Given<Settings>,

    #[command(flatten)]
    encoding: Given<Encoding>,

    #[command(flatten, next_help_heading = "Device")]
    device: DeviceArguments,

    #[command(flatten)]
    storage: Given<Storage>,
}

impl ViewArguments {
    /// The names of all that the user gave of how things are drawn.
    fn said(&self) -> Vec<&'static str> {
        let memory = self.budget_memory.map(|_| "budget-memory");
        self.settings.said().chain(self.storage.said()).chain(memory).collect()
    }
}

/// Keys and mouse, as help has them.
fn manual_of_keys() -> String {
    let line = |(key, help): (&str, &str)| format!("  {key:<24} {help}");
    let keys = keys::BINDINGS.iter().map(|binding| (binding.key, binding.help));
    let lines: Vec<String> = keys::MOUSE.iter().copied().chain(keys).map(line).collect();
    format!("Mouse and keys:\n{}", lines.join("\n"))
}

/// Runs the subcommand.
///
/// # Errors
/// [`ErrorKind::NoWindow`] without a display; whatever is wrong with options, the first files or the device; with `--validate`, messages
/// of the layer.
pub fn run(arguments: &ViewArguments) -> Result<()> {
    let settings = arguments.settings.over(Settings::default());
    settings.validate()?;
    let camera = CameraChoice::of(&arguments.camera)?;
    let path = arguments.path.as_deref().map(path::Path::read).transpose()?.unwrap_or_default();
    display::check()?;
    let events = EventLoop::<told::News>::with_user_event()
        .build()
        .map_err(|error| ErrorKind::NoWindow { reason: display::explain(&error.to_string()) })?;
    let mut app = app::App::new(arguments, settings, (camera, path), events.create_proxy());
    let ran = events.run_app(&mut app);
    let done = app.end();
    let said = match (&done.messages, arguments.device.validate) {
        (Some(messages), true) => conclude(messages),
        _ => Ok(()),
    };
    if let Some(error) = done.failure {
        return Err(error);
    }
    ran.map_err(|error| ErrorKind::NoWindow { reason: error.to_string() })?;
    said
}
