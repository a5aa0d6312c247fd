//! A frame's time and memory against the number of splats and of pixels, every rasterizer in turn at each.

use surfel::{
    Error, Result, Wanted,
    renderer::Headless,
    report::{
        InputReport,
        bench::{GrowthPoint, GrowthRate, GrowthReport},
    },
    scene::{Camera, Settings},
};

use super::{
    contest::{self, Entry},
    context::BenchContext,
    model::Source,
};
use crate::{allocator, scene::Loaded};

/// Measures both curves. What does not fit is left out, and said so.
///
/// # Errors
/// Whatever goes wrong with the first number of splats; a model that is not closed.
pub fn measure(headless: &mut Headless, context: &mut BenchContext<'_>) -> Result<GrowthReport> {
    let size_px = context.settings.size_px;
    for settings in methods(context, size_px) {
        headless.renderer.check_settings(&settings)?;
    }
    let source = Source::open(context)?;
    let mut report = GrowthReport::default();
    for splats in context.arguments.growth_splats() {
        match point(headless, context, &source, splats, size_px) {
            Ok((point, inputs)) => {
                report.over_splats.push(point);
                context.inputs.extend(inputs);
            }
            // What was measured before is not lost; what is larger does not fit either.
            Err(error) if !report.over_splats.is_empty() => {
                report.left_out.push(format!("{splats} splats and more: {error}"));
                break;
            }
            Err(error) => return Err(error),
        }
    }
    let splats = context.arguments.middle_splats();
    for size_px in context.arguments.growth_sizes() {
        let [width, height] = size_px;
        match point(headless, context, &source, splats, size_px) {
            Ok((point, _)) => report.over_pixels.push(point),
            Err(error) => report.left_out.push(format!("{width}x{height} pixels: {error}")),
        }
    }
    context.bars.clear();
    context.flags.extend(report.left_out.iter().map(|what| format!("growth: left out: {what}")));
    Ok(report)
}

/// The settings of every rasterizer.
fn methods(context: &BenchContext<'_>, size_px: [u32; 2]) -> Vec<Settings> {
    let with = |rasterizer| Settings { rasterizer, size_px, ..context.settings.clone() };
    context.arguments.rasterizers().into_iter().map(with).collect()
}

/// A point of either curve, and what its splats were made from. The memory of the host is watched from there to the first frame.
fn point(
    headless: &mut Headless,
    context: &mut BenchContext<'_>,
    source: &Source,
    splats: u64,
    size_px: [u32; 2],
) -> Result<(GrowthPoint, Vec<InputReport>)> {
    let before = allocator::begin_peak();
    let Loaded { scene, ball, inputs, .. } = source.scene(splats, context)?;
    if !scene.objects.iter().all(|object| object.closed) {
        let problem = "the surface is not closed, so that splats that face away are drawn too and figures of models would \
                       not compare: choose a closed mesh";
        return Err(Error::option("--model", problem));
    }
    let methods = methods(context, size_px);
    for settings in &methods {
        settings.check_scene(&scene)?;
    }
    let prepared = context.prepare(headless, &scene)?;
    drop(scene);
    let camera = Camera::fit(&ball, size_px, Camera::DEFAULT_FOV_Y_RAD);
    // The first frame; those that are timed keep what they measure.
    if let Some(settings) = methods.first() {
        headless.render(&prepared, &camera, settings, Wanted::default())?;
    }
    let host_peak_bytes = allocator::peak_bytes().saturating_sub(before) as u64;
    let entry = |settings: Settings| {
        headless.renderer.check(&camera, &settings)?;
        let name = settings.rasterizer.name().to_owned();
        Ok(Entry { name, scene: &prepared, settings, subject: GrowthRate::default() })
    };
    let entries = methods.into_iter().map(entry).collect::<Result<_>>()?;
    let what = format!("{splats} splats, {}x{}", size_px[0], size_px[1]);
    let (methods, _) = contest::measure(headless, context, &what, &camera, entries, None)?;
    Ok((GrowthPoint::of((splats, size_px), methods, prepared.bytes(), host_peak_bytes), inputs))
}
