//! Opens the device that the command line names.

use surfel::{
    Result,
    renderer::{Headless, HeadlessOptions},
    vk::Validation,
};

use crate::cache;

/// A host on the device asked for, or the best, with what was compiled in runs before.
///
/// # Errors
/// As [`Headless::new`].
pub fn open(asked: Option<&str>, validate: bool) -> Result<Headless> {
    Headless::new(&HeadlessOptions {
        validation: if validate { Validation::On } else { Validation::Off },
        device: asked.map(str::to_owned),
        cache_folder: cache::folder(),
    })
}
