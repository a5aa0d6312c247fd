//! How near pictures of several samples are to the ground truth.

use surfel::{
    Error, Progress as _, Result,
    load::builtin,
    reference::{TruePixel, ground_truth},
    renderer::Wanted,
    report::{Axis, Plot},
    scene::{Camera, Filter, Samples, Scene, Settings},
};

use super::context::FigureContext;

/// Numbers of samples of a pixel.
const COUNTS: [u32; 9] = [1, 2, 4, 8, 16, 32, 64, 128, 256];

/// Width and height of the pictures that are compared: small, for the ground truth takes long.
const PICTURE_PX: [u32; 2] = [128, 128];

/// Of the ground truth, along a pixel's side.
const SAMPLES_PER_SIDE: u32 = 24;

/// Splats of the built-in model, some of them as large as a pixel.
const SPLATS: usize = 20_000;

/// Coverage above which a pixel lies inside of the surface.
const INSIDE: f64 = 0.999;

/// The error of pictures over their samples, with a filter that samples share out, and without.
pub fn draw(context: &mut FigureContext<'_>) -> Result<Plot> {
    let scene = Scene::from(builtin::relief(SPLATS));
    let ball = scene.ball().ok_or_else(|| Error::option("scene", "nothing to see"))?;
    let camera = Camera::fit(&ball, PICTURE_PX, Camera::DEFAULT_FOV_Y_RAD);
    let base = Settings { size_px: PICTURE_PX, background: None, ..Settings::default() };
    let bars = context.bars;
    let progress = |done, total| bars.step("ground truth, row by row", done, total);
    let truth = ground_truth(&scene, &camera, &base, SAMPLES_PER_SIDE, &progress)?.pixels;
    bars.clear();
    let prepared = context.prepare(&scene)?;
    let mut curves = Vec::new();
    for filter in [Filter::Adjust, Filter::None] {
        let (mut all, mut inside) = (Vec::new(), Vec::new());
        for count in COUNTS {
            let settings = Settings { filter, samples: Samples(count), ..base.clone() };
            let wanted = Wanted { picture: true, linear: true, ..Wanted::default() };
            let drawn = context.headless.render(&prepared, &camera, &settings, wanted)?;
            all.push((count.into(), rms(&drawn.linear, &truth, |_| true)));
            inside.push((count.into(), rms(&drawn.linear, &truth, |pixel| pixel.coverage > INSIDE)));
        }
        curves.push((format!("{}, all pixels", filter.name()), all));
        curves.push((format!("{}, inside", filter.name()), inside));
    }
    let values = || curves.iter().flat_map(|(_, points): &(String, Vec<(f64, f64)>)| points);
    let axes = [
        Axis::logarithmic("samples of a pixel", values().map(|(count, _)| *count)),
        Axis::logarithmic("RMS of linear color times alpha", values().map(|(_, error)| *error)),
    ];
    let [width, height] = PICTURE_PX;
    let title = vec![
        "Supersampling: the error against the ground truth over samples".to_owned(),
        format!(
            "Built-in model, {SPLATS} splats, {width}x{height}; truth of {SAMPLES_PER_SIDE}² samples; inside: covered by {INSIDE}"
        ),
        "Of N samples each has a filter of the radius h / √N, and they lie as a Gaussian of the variance that this leaves".to_owned(),
    ];
    Ok(Plot::of_curves(title, axes, curves))
}

/// Of the pixels that are taken.
fn rms(drawn: &[[f32; 4]], truth: &[TruePixel], takes: impl Fn(&TruePixel) -> bool) -> f64 {
    let taken = || drawn.iter().zip(truth).filter(|(_, pixel)| takes(pixel));
    let square = |(color, pixel): (&[f32; 4], &TruePixel)| {
        let error = |i: usize| f64::from(color[i] * color[3]) - pixel.coverage * pixel.color[i];
        (0..3).map(|i| error(i).powi(2)).sum::<f64>() / 3.0
    };
    (taken().map(square).sum::<f64>() / taken().count().max(1) as f64).sqrt()
}
