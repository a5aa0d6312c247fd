//! Samples of each pixel: their mean, in linear light.

use super::{Picture, View, render_view};
use crate::error::Result;
use crate::scene::{Camera, Samples, Scene, Settings};

/// The picture of one sample in the middle, with the colors of the mean of all. Each sample is filtered by what N of them leave of the
/// filter: variances add up, so that they share it out as an Nth each, and a radius is the root of that.
pub(super) fn render(
    scene: &Scene,
    camera: &Camera,
    settings: &Settings,
    progress: &(dyn Fn(u64, u64) + Sync),
) -> Result<Picture> {
    let one = Settings { samples: Samples(1), ..settings.clone() };
    let mut picture = render_view(
        scene,
        View::of(scene, camera, settings.size_px).cut_by(scene, settings),
        &one,
        false,
        progress,
    )?;
    let offsets_px = settings.samples.offsets_px(settings.kernel);
    let count = offsets_px.len() as f64;
    let mut sums = vec![[0.0; 4]; picture.pixels.len()];
    for offset_px in offsets_px {
        let view = View::of(scene, &camera.sample(offset_px), settings.size_px).cut_by(scene, settings);
        let view = View { filter_px: view.filter_px / count.sqrt(), ..view };
        let drawn = render_view(scene, view, &one, false, progress)?;
        for (sum, pixel) in sums.iter_mut().zip(&drawn.pixels) {
            let [red, green, blue, alpha] = pixel.color;
            let light = [alpha * red, alpha * green, alpha * blue, alpha];
            (0..4).for_each(|i| sum[i] += light[i]);
        }
    }
    for (pixel, [red, green, blue, alpha]) in picture.pixels.iter_mut().zip(sums) {
        let straight = |light: f64| if alpha > 0.0 { light / alpha } else { 0.0 };
        pixel.color = [straight(red), straight(green), straight(blue), alpha / count];
    }
    Ok(picture)
}
