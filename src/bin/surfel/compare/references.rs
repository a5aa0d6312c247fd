//! What the methods are compared with.

use surfel::{
    Progress as _, Result, reference,
    renderer::Frame,
    report::compare::{PictureKey, Surface},
    scene::{Camera, Scene, Settings},
};

use crate::console::Bars;

/// The exact picture of a method.
pub struct Oracle {
    /// The picture.
    pub surface: Surface,
    /// Pixels that rounding may turn.
    pub undecided: Vec<bool>,
}

/// Draws the exact picture of the methods with this key.
///
/// # Errors
/// As [`reference::render`].
pub fn oracle(
    scene: &Scene,
    camera: &Camera,
    base: &Settings,
    key: PictureKey,
    task: &str,
    bars: &Bars,
) -> Result<Oracle> {
    let PictureKey { rasterizer, filter, filter_weight } = key;
    let settings = Settings { rasterizer, filter, filter_weight, ..base.clone() };
    let picture = reference::render(scene, camera, &settings, &|done, total| bars.step(task, done, total))?;
    Ok(Oracle { surface: Surface::of(&picture), undecided: Surface::undecided(&picture) })
}

/// Draws what every filter aims at.
///
/// # Errors
/// As the reference's ground truth.
pub fn truth(
    scene: &Scene,
    camera: &Camera,
    base: &Settings,
    samples_per_side: u32,
    task: &str,
    bars: &Bars,
) -> Result<Surface> {
    let _ = samples_per_side;
    let settings = Settings { filter: surfel::scene::Filter::None, ..base.clone() };
    let picture = reference::render(scene, camera, &settings, &|done, total| bars.step(task, done, total))?;
    Ok(Surface::of(&picture))
}

/// What the device has drawn.
pub fn of_frame(frame: &Frame) -> Surface {
    let three = |values: &[[f32; 4]]| values.iter().map(|[x, y, z, _]| [*x, *y, *z]).collect();
    Surface {
        size_px: frame.size_px,
        coverage: frame.weight.iter().map(|weight| f32::from(u8::from(*weight > 0.0))).collect(),
        normal: three(&frame.normal),
        depth: frame.depth.clone(),
        color: three(&frame.linear),
    }
}
