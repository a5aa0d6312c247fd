//! A frame's passes against the floor under them, which is made of points, and against the device's limits, in turn, so that a
//! change of the machine's speed meets all.

use surfel::{
    Error, Progress as _, Result,
    graph::execute::{FrameProfile, Profile},
    instruments::Floor,
    load::Representation,
    renderer::{Headless, Wanted},
    report::{FloorReport, FloorRow, drift_flag, passes_flag, spread_flag},
    scene::{Rasterizer, Settings},
};

use super::{
    Stage,
    limits::{FrameWork, Limits},
};
use crate::{
    camera::CameraChoice,
    machine::clock_mhz,
    reports::scene_report,
    scene::{Loaded, load_scene},
    steps::Steps,
};

/// Rounds that are not counted: pipelines, transients, caches.
const WARM_UP_ROUNDS: u32 = 3;

/// Measures the model as it is.
///
/// # Errors
/// Whatever goes wrong.
pub fn measure(headless: &mut Headless, stage: &mut Stage<'_>) -> Result<FloorReport> {
    let (arguments, settings, bars) = (stage.arguments, &stage.settings, &stage.bars);
    let inputs: Vec<_> = arguments.model.iter().cloned().collect();
    let loaded = load_scene(&inputs, Representation::Splats, bars, &mut Steps::default())?;
    let camera = CameraChoice::none().camera(&loaded, settings.size_px)?;
    let Loaded { scene, inputs, .. } = loaded;
    let prepared = headless.prepare(&scene, &|done, total| bars.step("upload", done, total))?;
    drop(scene);
    let points = Settings { rasterizer: Rasterizer::Perspective, ..settings.clone() };
    let mut floor = Floor::new(headless, &prepared, &camera, &points, false)?;
    let mut strict = Floor::new(headless, &prepared, &camera, &points, true)?;
    let mut limits = Limits::new(headless, settings)?;

    let mut rounds = Vec::new();
    let mut names = Vec::new();
    let mut sums_and_frames_ms = Vec::new();
    let facts = headless.device().facts().clone();
    for round in 0..WARM_UP_ROUNDS + arguments.frames {
        bars.step("rounds", round.into(), (WARM_UP_ROUNDS + arguments.frames).into());
        let mut measured = |profile| -> Result<FrameProfile> {
            let wanted = Wanted { profile: Some(profile), ..Wanted::default() };
            let frame = headless.render(&prepared, &camera, settings, wanted)?;
            Ok(frame.profile.unwrap_or_default())
        };
        let frame_ms = measured(Profile::Frame)?.span_secs.map(|secs| 1e3 * secs);
        let profile = measured(Profile::Times)?;
        let times = [
            passes_ms(&profile)?,
            passes_ms(&floor.frame(headless, Profile::Times)?)?,
            passes_ms(&strict.frame(headless, Profile::Times)?)?,
        ];
        limits.round(headless, (round >= WARM_UP_ROUNDS).then_some(&times[0]))?;
        if round >= WARM_UP_ROUNDS {
            sums_and_frames_ms.extend(frame_ms.map(|frame_ms| (times[0].iter().sum(), frame_ms)));
            rounds.push(times);
        }
        names = profile.passes.into_iter().map(|pass| pass.name).collect();
        if round == WARM_UP_ROUNDS || round + 1 == WARM_UP_ROUNDS + arguments.frames {
            stage.clocks_mhz.extend(clock_mhz(&facts));
        }
    }
    bars.clear();
    let transient_bytes = headless.transient_bytes();
    let wanted = Wanted { profile: Some(Profile::Counts), ..Wanted::default() };
    let frame = headless.render(&prepared, &camera, settings, wanted)?;
    let counted = frame.profile.unwrap_or_default();
    let fragments = [fragments(&counted), fragments(&floor.frame(headless, Profile::Counts)?)];
    let in_use = headless.lists_in_use(&prepared, &camera, settings)?;
    // Others have other points, or none.
    let as_points = matches!(settings.rasterizer, Rasterizer::Perspective | Rasterizer::Auto);
    let drawn_points = as_points.then(|| strict.count());
    let work = FrameWork { plan: &frame.plan, scene: &prepared, drawn_points, in_use: &in_use };
    let report = FloorReport {
        camera: (&camera).into(),
        scene: scene_report(inputs.clone(), &prepared, transient_bytes),
        floor_points: floor.count(),
        strict_points: strict.count(),
        rounds: arguments.frames,
        rows: FloorRow::rows(&names, &rounds, [&fragments[0], &fragments[1]]),
        limits: limits.report(&work, &counted),
    };
    let frames: Vec<Vec<f64>> =
        (0..3).map(|kind| rounds.iter().map(|round| round[kind].iter().sum()).collect()).collect();
    stage.flags.extend(drift_flag("floor", &frames, &stage.limits));
    let costs = passes_flag(sums_and_frames_ms.into_iter());
    stage.flags.extend(costs.map(|flag| format!("floor: {flag}")));
    if let Some(frame) = report.rows.last() {
        stage.flags.extend(spread_flag("floor, frame", frame.ms.as_ref(), &stage.limits));
    }
    stage.inputs.extend(inputs);
    Ok(report)
}

/// Milliseconds of each pass.
fn passes_ms(profile: &FrameProfile) -> Result<Vec<f64>> {
    let ms: Option<Vec<f64>> = profile.passes.iter().map(|pass| pass.secs.map(|secs| 1e3 * secs)).collect();
    ms.ok_or_else(|| Error::option("bench floor", "the device's queue has no timestamps"))
}

fn fragments(profile: &FrameProfile) -> Vec<Option<u64>> {
    profile.passes.iter().map(|pass| pass.counts.map(|counts| counts.fragments)).collect()
}
