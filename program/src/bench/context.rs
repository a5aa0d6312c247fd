//! The options that every table is measured with, and what it gathers on the way.

use surfel::{
    Result,
    prepare::PreparedScene,
    renderer::Headless,
    report::{InputReport, bench::TrustLimits},
    scene::{Scene, Settings},
};

use super::arguments::BenchArguments;
use crate::{console::Bars, scene::upload};

/// The context of every table.
pub struct BenchContext<'a> {
    pub arguments: &'a BenchArguments,
    /// The settings that all methods have in common.
    pub settings: Settings,
    pub bars: Bars,
    /// Beyond which figures are flagged.
    pub limits: TrustLimits,
    /// The inputs of what was drawn so far.
    pub inputs: Vec<InputReport>,
    /// The reasons to doubt figures so far.
    pub flags: Vec<String>,
    /// The clock, whenever the device had just worked.
    pub clocks_mhz: Vec<f64>,
}

impl BenchContext<'_> {
    /// Brings a scene to the device.
    ///
    /// # Errors
    /// Settings that the scene rules out; whatever the allocator or the driver answers.
    pub fn prepare(&self, headless: &Headless, scene: &Scene) -> Result<PreparedScene> {
        self.settings.check_scene(scene)?;
        upload(headless, scene, &self.bars)
    }
}
