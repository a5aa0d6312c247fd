//! The device, scene and options that all parts are gathered with.

use surfel::{Result, renderer::Headless, scene::Camera};

use super::{
    arguments::ReportArguments,
    comparison::{self, Comparison},
};
use crate::{console::Bars, scene::Loaded};

/// A device, a scene, and what the command line says.
pub struct Session<'a> {
    pub headless: &'a mut Headless,
    pub arguments: &'a ReportArguments,
    pub loaded: &'a Loaded,
    /// From where it is seen.
    pub camera: &'a Camera,
    pub bars: &'a Bars,
    /// The methods side by side; nothing until a part asks for it first.
    pub comparison: Option<Comparison>,
}

impl Session<'_> {
    /// All methods on the scene, with their pictures.
    pub fn comparison(&mut self) -> Result<&mut Comparison> {
        let done = match self.comparison.take() {
            Some(done) => done,
            None => comparison::gather(self.headless, self.arguments, (self.loaded, self.camera), self.bars)?,
        };
        Ok(self.comparison.insert(done))
    }
}
