//! A frame's time and memory against the number of splats and of pixels, every rasterizer in turn at each.

use std::cell::Cell;

use surfel::{
    Error, Progress as _, Result,
    prepare::PreparedScene,
    renderer::Headless,
    report::{GrowthPoint, GrowthReport, InputReport, Measured, drift_flag, spread_flag},
    scene::{Camera, Settings},
};

use super::{
    Stage,
    contest::{Entry, measured, noting},
    model::Source,
};
use crate::{
    allocator,
    machine::clock_mhz,
    scene::Loaded,
    turns::{self, Draw},
};

/// A model on the device.
struct Placed {
    splats: u64,
    prepared: PreparedScene,
    ball: surfel::scene::Ball,
    inputs: Vec<InputReport>,
}

/// Measures both curves. What does not fit is left out, and said so.
///
/// # Errors
/// Whatever goes wrong with the first number of splats; a model that is not closed.
pub fn measure(headless: &mut Headless, stage: &mut Stage<'_>) -> Result<GrowthReport> {
    for settings in methods(stage, stage.settings.size_px) {
        headless.renderer.check_settings(&settings)?;
    }
    let source = Source::open(stage)?;
    let mut report = GrowthReport { over_splats: Vec::new(), over_pixels: Vec::new(), left_out: Vec::new() };
    for splats in stage.arguments.growth_splats() {
        match point(headless, stage, &source, splats, stage.settings.size_px) {
            Ok((point, inputs)) => {
                report.over_splats.push(point);
                stage.inputs.extend(inputs);
            }
            // What was measured before is not lost; what is larger does not fit either.
            Err(error) if !report.over_splats.is_empty() => {
                report.left_out.push(format!("{splats} splats and more: {error}"));
                break;
            }
            Err(error) => return Err(error),
        }
    }
    let splats = stage.arguments.middle_splats();
    for size_px in stage.arguments.growth_sizes() {
        let [width, height] = size_px;
        match point(headless, stage, &source, splats, size_px) {
            Ok((point, _)) => report.over_pixels.push(point),
            Err(error) => report.left_out.push(format!("{width}x{height} pixels: {error}")),
        }
    }
    stage.bars.clear();
    stage.flags.extend(report.left_out.iter().map(|what| format!("growth: left out: {what}")));
    Ok(report)
}

/// The settings of every rasterizer.
fn methods(stage: &Stage<'_>, size_px: [u32; 2]) -> Vec<Settings> {
    let rasterizers = stage.arguments.rasterizers();
    let with = |rasterizer| Settings { rasterizer, size_px, ..stage.settings.clone() };
    rasterizers.into_iter().map(with).collect()
}

/// A point of either curve, and what its splats were made from. The memory of the host is watched from there to the first frame.
fn point(
    headless: &mut Headless,
    stage: &mut Stage<'_>,
    source: &Source,
    splats: u64,
    size_px: [u32; 2],
) -> Result<(GrowthPoint, Vec<InputReport>)> {
    let before = allocator::begin_peak();
    let placed = place(headless, stage, source, splats)?;
    // The first frame; those that are timed keep what they measure.
    if let Some(settings) = methods(stage, size_px).first() {
        let camera = Camera::fit(&placed.ball, size_px, Camera::DEFAULT_FOV_Y_RAD);
        headless.render(&placed.prepared, &camera, settings, surfel::Wanted::default())?;
    }
    let host_peak_bytes = allocator::peak_bytes().saturating_sub(before) as u64;
    let point = timed(headless, stage, &placed, size_px, host_peak_bytes)?;
    Ok((point, placed.inputs))
}

/// Brings the model with so many splats to the device.
fn place(headless: &Headless, stage: &Stage<'_>, source: &Source, splats: u64) -> Result<Placed> {
    let Loaded { scene, ball, inputs, .. } = source.scene(splats, stage)?;
    if !scene.objects.iter().all(|object| object.closed) {
        let problem = "the surface is not closed, so that splats that face away are drawn too and figures of models would \
                       not compare: choose a closed mesh";
        return Err(Error::option("--model", problem));
    }
    for settings in methods(stage, stage.settings.size_px) {
        settings.check_scene(&scene)?;
    }
    let prepared = headless.prepare(&scene, &|done, total| stage.bars.step("upload", done, total))?;
    Ok(Placed { splats, prepared, ball, inputs })
}

/// Times all rasterizers in turn.
fn timed(
    headless: &mut Headless,
    stage: &mut Stage<'_>,
    placed: &Placed,
    size_px: [u32; 2],
    host_peak_bytes: u64,
) -> Result<GrowthPoint> {
    let camera = Camera::fit(&placed.ball, size_px, Camera::DEFAULT_FOV_Y_RAD);
    let methods = methods(stage, size_px);
    for settings in &methods {
        headless.renderer.check(&camera, settings)?;
    }
    let names: Vec<&str> = methods.iter().map(|settings| settings.rasterizer.name()).collect();
    let bytes: Vec<Cell<u64>> = methods.iter().map(|_| Cell::new(0)).collect();
    let entry = |settings: &Settings| Entry {
        name: settings.rasterizer.name().to_owned(),
        scene: &placed.prepared,
        settings: settings.clone(),
    };
    let contestants: Vec<Draw<'_>> =
        methods.iter().zip(&bytes).map(|(settings, bytes)| noting(bytes, entry(settings), &camera)).collect();
    let what = format!("{} splats, {}x{}", placed.splats, size_px[0], size_px[1]);
    let facts = headless.device().facts().clone();
    let (frames, clocks) = (stage.arguments.frames, &mut stage.clocks_mhz);
    let timed = turns::take(headless, contestants, frames, &what, &stage.bars, &mut || {
        clocks.extend(clock_mhz(&facts));
    });
    let timed: Vec<turns::Timed> = timed.into_iter().collect::<Result<_>>()?;
    let all: Vec<Measured<'_>> =
        names.iter().zip(&timed).map(|(name, timed)| measured(name, timed)).collect();
    let transient_bytes: Vec<u64> = bytes.iter().map(Cell::get).collect();
    let place = (placed.splats, size_px);
    let point = GrowthPoint::of(place, &all, &transient_bytes, placed.prepared.bytes(), host_peak_bytes);
    let rounds: Vec<Vec<f64>> = all.iter().map(Measured::frame_ms).collect();
    stage.flags.extend(drift_flag(&what, &rounds, &stage.limits));
    for method in &point.methods {
        let what = format!("{what}, {}", method.name);
        stage.flags.extend(spread_flag(&what, method.frames.frame_ms.as_ref(), &stage.limits));
        stage.flags.extend(method.frames.flags.iter().map(|flag| format!("{what}: {flag}")));
    }
    Ok(point)
}
