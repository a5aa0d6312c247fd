//! A frame's passes against the floor under them, which is made of points, and against the device's limits, in turn, so that a
//! change of the machine's speed meets all.

use surfel::{
    Error, Progress as _, Result,
    graph::execute::{FrameProfile, Profile},
    instruments::{Floor, LimitProbes},
    renderer::{Headless, Wanted},
    report::{
        bench::{FloorReport, FloorRound, FloorRow, drift_flag, spread_flag},
        passes_flag,
    },
    scene::{Rasterizer, Settings},
};

use super::{context::BenchContext, limits::FrameWork};
use crate::{
    camera::CameraChoice,
    inputs::Inputs,
    machine::clock_mhz,
    reports::scene_report,
    scene::{Loaded, load_scene, upload},
    turns,
};

/// Rounds that are not counted: pipelines, transients, caches.
const WARM_UP_ROUNDS: u32 = 3;

/// Measures the model as it is.
pub fn measure(headless: &mut Headless, context: &mut BenchContext<'_>) -> Result<FloorReport> {
    let (arguments, settings, bars) = (context.arguments, &context.settings, &context.bars);
    let inputs: Vec<_> = arguments.model.iter().cloned().collect();
    let loaded = load_scene(&Inputs::splats_of(inputs), bars)?;
    let camera = CameraChoice::none().camera(&loaded, settings.size_px)?;
    let Loaded { scene, inputs, .. } = loaded;
    let prepared = upload(headless, &scene, bars)?;
    drop(scene);
    let points = Settings { rasterizer: Rasterizer::Perspective, ..settings.clone() };
    let mut floor = Floor::new(headless, &prepared, &camera, &points, false)?;
    let mut strict = Floor::new(headless, &prepared, &camera, &points, true)?;
    let mut probes = LimitProbes::new(headless, settings)?;

    let (mut rounds, mut names, mut sums_and_frames_ms) = (Vec::new(), Vec::new(), Vec::new());
    let facts = headless.device().facts().clone();
    let mut draw = turns::frames(&prepared, &camera, settings.clone());
    let last = WARM_UP_ROUNDS + arguments.frames - 1;
    for number in 0..=last {
        bars.step("rounds", number.into(), u64::from(last) + 1);
        let frame_ms = draw(headless, Profile::Frame)?.profile.span_secs.map(|secs| 1e3 * secs);
        let profile = draw(headless, Profile::Times)?.profile;
        let round = FloorRound {
            passes_ms: [
                passes_ms(&profile)?,
                passes_ms(&floor.frame(headless, Profile::Times)?)?,
                passes_ms(&strict.frame(headless, Profile::Times)?)?,
            ],
            limits_ms: probes
                .measure(headless)?
                .into_iter()
                .map(|secs| secs.map(|secs| 1e3 * secs))
                .collect(),
        };
        if number >= WARM_UP_ROUNDS {
            sums_and_frames_ms.extend(frame_ms.map(|frame_ms| (round.passes_ms[0].iter().sum(), frame_ms)));
            rounds.push(round);
        }
        names = profile.passes.into_iter().map(|pass| pass.name).collect();
        if [WARM_UP_ROUNDS, last].contains(&number) {
            context.clocks_mhz.extend(clock_mhz(&facts));
        }
    }
    drop(draw);
    bars.clear();
    let transient_bytes = headless.transient_bytes();
    let wanted = Wanted { profile: Some(Profile::Counts), ..Wanted::default() };
    let frame = headless.render(&prepared, &camera, settings, wanted)?;
    let counted = frame.profile.unwrap_or_default();
    let fragments = [fragments(&counted), fragments(&floor.frame(headless, Profile::Counts)?)];
    let in_use = headless.list_occupancy(&prepared, &camera, settings)?;
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
        limits: work.bounds(&counted, &probes, &rounds),
    };
    let frames: Vec<Vec<f64>> =
        (0..3).map(|kind| rounds.iter().map(|round| round.passes_ms[kind].iter().sum()).collect()).collect();
    context.flags.extend(drift_flag("floor", &frames, &context.limits));
    let costs = passes_flag(sums_and_frames_ms.into_iter());
    context.flags.extend(costs.map(|flag| format!("floor: {flag}")));
    if let Some(frame) = report.rows.last() {
        context.flags.extend(spread_flag("floor, frame", frame.ms.as_ref(), &context.limits));
    }
    context.inputs.extend(inputs);
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
