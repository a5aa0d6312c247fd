//! What the command line says, for later.

use surfel::scene::Settings;

use super::ViewArguments;
use crate::{device::DeviceArguments, inputs::Inputs, settings::Given};

/// What pages of a file take on the device at most, unless told otherwise.
const MOST_PAGED_BYTES: u64 = 2_000_000_000;

/// What the command line says, for later.
pub struct Options {
    pub device: DeviceArguments,
    pub said: Box<dyn Fn(Settings) -> Settings>,
    /// The files, and how they are read.
    pub inputs: Inputs,
    pub picture_size: Option<[u32; 2]>,
    /// It says how many samples a pixel has.
    pub says_samples: bool,
    pub prints_frames: bool,
    /// Of device memory, for pages of a file.
    pub most_paged_bytes: u64,
}

impl Options {
    /// Those of a command line.
    pub fn of(arguments: &ViewArguments) -> Self {
        let said: Given<Settings> = arguments.settings.clone();
        Self {
            device: arguments.device.clone(),
            said: Box::new(move |settings| said.said_over(settings)),
            inputs: arguments.input.inputs(),
            picture_size: arguments.picture_size,
            says_samples: arguments.settings.says("samples"),
            prints_frames: arguments.print_frames,
            most_paged_bytes: arguments.budget_memory.unwrap_or(MOST_PAGED_BYTES),
        }
    }
}
