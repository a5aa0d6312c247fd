//! The scene that methods are tried on, and the pictures that they are compared with.

use surfel::{
    Progress as _, Result,
    prepare::PreparedScene,
    reference::{self, GroundTruth},
    renderer::{Headless, Wanted},
    report::compare::{Method, Surface},
    scene::{Camera, Edges, Scene, Settings},
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

/// A picture by the device.
pub struct Drawn {
    pub surface: Surface,
    /// Linear, with straight alpha; without a background.
    pub rgba: Vec<[f32; 4]>,
}

impl CompareContext<'_> {
    /// The picture of a method by the device.
    pub fn draw(&self, headless: &mut Headless, method: &Method) -> Result<Drawn> {
        let wanted = Wanted { picture: true, linear: true, surface: true, profile: None };
        // What is missing of a pixel is the alpha's to say.
        let settings = Settings { background: None, ..method.settings(self.base) };
        // The surface as data has hard edges, and so has the picture beside it.
        let frame = headless.render(self.prepared, self.camera, &settings, wanted)?;
        let rgba = match settings.covers_in_part() {
            true => {
                let wanted = Wanted { surface: false, ..wanted };
                headless.render(self.prepared, self.camera, &settings, wanted)?.linear
            }
            false => frame.linear.clone(),
        };
        let three = |values: &[[f32; 4]]| values.iter().map(|[x, y, z, _]| [*x, *y, *z]).collect();
        let surface = Surface {
            size_px: frame.size_px,
            coverage: frame
                .weight
                .iter()
                .zip(&frame.linear)
                .map(|(weight, [_, _, _, alpha])| if *weight > 0.0 { *alpha } else { 0.0 })
                .collect(),
            normal: three(&frame.normal),
            color: three(&frame.linear),
            depth: frame.depth,
        };
        Ok(Drawn { surface, rgba })
    }

    /// The exact picture of a method, and which pixels rounding may turn.
    pub fn oracle(&self, method: &Method, task: &str) -> Result<(Surface, Vec<bool>)> {
        let progress = |done, total| self.bars.step(task, done, total);
        let settings = Settings { edges: Edges::Hard, ..method.settings(self.base) };
        let picture = reference::render(self.scene, self.camera, &settings, &progress)?;
        Ok((Surface::of(&picture), Surface::undecided(&picture)))
    }

    /// The picture that every filter aims at.
    pub fn truth(&self, samples_per_side: u32, task: &str) -> Result<GroundTruth> {
        let progress = |done, total| self.bars.step(task, done, total);
        reference::ground_truth(self.scene, self.camera, self.base, samples_per_side, &progress)
    }
}
