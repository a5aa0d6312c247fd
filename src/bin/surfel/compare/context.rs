//! The scene that methods are tried on, and the pictures that they are compared with.

use surfel::{
    Progress as _, Result,
    prepare::PreparedScene,
    reference,
    renderer::{Headless, Wanted},
    report::compare::{Method, Surface},
    scene::{Camera, Scene, Settings},
};

use crate::console::Bars;

/// A scene and from where it is seen.
pub struct CompareContext<'a> {
    pub scene: &'a Scene,
    /// The scene on the device.
    pub prepared: &'a PreparedScene,
    pub camera: &'a Camera,
    /// The settings that all methods have in common.
    pub base: &'a Settings,
    pub bars: &'a Bars,
}

impl CompareContext<'_> {
    /// The picture of a method by the device.
    pub fn draw(&self, headless: &mut Headless, method: &Method) -> Result<Surface> {
        let wanted = Wanted { picture: true, linear: true, surface: true, profile: None };
        let frame = headless.render(self.prepared, self.camera, &method.settings(self.base), wanted)?;
        let three = |values: &[[f32; 4]]| values.iter().map(|[x, y, z, _]| [*x, *y, *z]).collect();
        Ok(Surface {
            size_px: frame.size_px,
            coverage: frame.weight.iter().map(|weight| f32::from(u8::from(*weight > 0.0))).collect(),
            normal: three(&frame.normal),
            color: three(&frame.linear),
            depth: frame.depth,
        })
    }

    /// The exact picture of a method, and which pixels rounding may turn.
    pub fn oracle(&self, method: &Method, task: &str) -> Result<(Surface, Vec<bool>)> {
        let progress = |done, total| self.bars.step(task, done, total);
        let picture = reference::render(self.scene, self.camera, &method.settings(self.base), &progress)?;
        Ok((Surface::of(&picture), Surface::undecided(&picture)))
    }

    /// The picture that every filter aims at.
    pub fn truth(&self, samples_per_side: u32, task: &str) -> Result<Surface> {
        let progress = |done, total| self.bars.step(task, done, total);
        reference::ground_truth(self.scene, self.camera, self.base, samples_per_side, &progress)
            .map(|truth| Surface::of_truth(&truth))
    }
}
