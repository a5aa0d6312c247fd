//! todo
use super::CompareArguments;
use surfel::{Result, renderer::Headless, scene::Settings};
pub fn run(_: Headless, _: &CompareArguments, _: &Settings) -> Result<()> {
    Ok(())
}
