//! What all parts are gathered with.

use surfel::{
    Result,
    renderer::Headless,
    report::{Machine, TrustLimits},
    scene::Camera,
};

use super::{
    arguments::ReportArguments,
    comparison::{self, Comparison},
};
use crate::{console::Bars, machine::Watch, scene::Loaded};

/// A device, a scene, and what the command line says.
pub struct Session<'a> {
    /// The device.
    pub headless: &'a mut Headless,
    /// The options.
    pub arguments: &'a ReportArguments,
    /// The scene.
    pub loaded: &'a Loaded,
    /// From where it is seen.
    pub camera: &'a Camera,
    /// Progress.
    pub bars: &'a Bars,
    /// Made when a part asks for it first.
    comparison: Option<Comparison>,
}

impl<'a> Session<'a> {
    /// Nothing is gathered yet.
    pub fn new(
        headless: &'a mut Headless,
        arguments: &'a ReportArguments,
        loaded: &'a Loaded,
        camera: &'a Camera,
        bars: &'a Bars,
    ) -> Self {
        Self { headless, arguments, loaded, camera, bars, comparison: None }
    }

    /// All methods on the scene, with their pictures.
    ///
    /// # Errors
    /// As [`comparison::gather`].
    pub fn comparison(&mut self) -> Result<&mut Comparison> {
        let done = match self.comparison.take() {
            Some(done) => done,
            None => comparison::gather(self)?,
        };
        Ok(self.comparison.insert(done))
    }

    /// Measures something with an eye on the machine: what makes it doubtful comes as sentences.
    ///
    /// # Errors
    /// Those of the work.
    pub fn watched<T>(
        &mut self,
        measure: impl FnOnce(&mut Self) -> Result<T>,
    ) -> Result<(T, Machine, Vec<String>)> {
        let device = self.headless.device().clone();
        let watch = Watch::begin(device.facts());
        let measured = measure(self)?;
        let machine = watch.end(&[]);
        let mut flags = machine.flags(&TrustLimits::default());
        if self.arguments.device.validate {
            flags.push("measured under validation: the times are worthless".to_owned());
        }
        Ok((measured, machine, flags))
    }
}

/// The sentences of a flag that many rows have: all of a few, else the first with how many more there are.
pub fn shortened(flags: Vec<String>) -> Vec<String> {
    const FEW: usize = 3;
    match flags.len() {
        0..=FEW => flags,
        count => {
            let first = flags.into_iter().next().unwrap_or_default();
            vec![format!("{first}; and {} more like this one", count - 1)]
        }
    }
}
