//! `surfel bench`: tables of what things cost.

use surfel::{
    Error, Progress as _, Result,
    graph::execute::{FrameProfile, Profile},
    renderer::{Floor, Headless, HeadlessOptions, Wanted},
    report::{FloorReport, FloorRow, settings_as_options},
    save,
    scene::{Camera, Settings},
    vk::Validation,
};

use crate::{
    arguments::{Bench, BenchArguments},
    cache,
    console::{self, Bars},
    json::to_json,
    outputs,
    reports::{device_report, scene_report},
    scene::{Loaded, load_scene},
    steps::Steps,
    validation,
};

/// Rounds that are not counted: pipelines, transients, caches.
const WARM_UP_ROUNDS: u32 = 3;

/// Runs the subcommand.
///
/// # Errors
/// Whatever goes wrong.
pub fn run(arguments: &BenchArguments) -> Result<()> {
    match arguments.table {
        Bench::Floor => floor(arguments),
    }
}

/// The three passes against the floor under them, in turn, so that a change of the machine's speed meets both.
fn floor(arguments: &BenchArguments) -> Result<()> {
    let settings =
        Settings { size_px: arguments.size, accumulate: arguments.accumulate, ..Settings::default() };
    settings.validate()?;
    arguments.json.as_deref().map(outputs::check_file).transpose()?;
    let mut headless = Headless::new(&HeadlessOptions {
        validation: if arguments.validate { Validation::On } else { Validation::Off },
        device: arguments.device.clone(),
        cache_folder: cache::folder(),
    })?;
    let bars = Bars::new();
    let inputs: Vec<_> = arguments.model.iter().cloned().collect();
    let Loaded { scene, ball, inputs } = load_scene(&inputs, &bars, &mut Steps::default())?;
    let camera = Camera::fit(&ball, settings.size_px, Camera::DEFAULT_FOV_Y_RAD);
    let prepared = headless.prepare(&scene, &|done, total| bars.step("upload", done, total))?;
    let mut floor = Floor::new(&headless, &prepared, &camera, &settings, false)?;
    let mut strict = Floor::new(&headless, &prepared, &camera, &settings, true)?;

    let mut rounds = Vec::new();
    let mut names = Vec::new();
    for round in 0..WARM_UP_ROUNDS + arguments.frames {
        bars.step("rounds", round.into(), (WARM_UP_ROUNDS + arguments.frames).into());
        let wanted = Wanted { profile: Some(Profile::Times), ..Wanted::default() };
        let frame = headless.render(&prepared, &camera, &settings, wanted)?;
        let profile = frame.profile.unwrap_or_default();
        let times = [
            passes_ms(&profile)?,
            passes_ms(&floor.frame(&headless, Profile::Times)?)?,
            passes_ms(&strict.frame(&headless, Profile::Times)?)?,
        ];
        if round >= WARM_UP_ROUNDS {
            rounds.push(times);
        }
        names = profile.passes.into_iter().map(|pass| pass.name).collect();
    }
    bars.clear();
    let transient_bytes = headless.transient_bytes();
    let wanted = Wanted { profile: Some(Profile::Counts), ..Wanted::default() };
    let counted = headless.render(&prepared, &camera, &settings, wanted)?.profile.unwrap_or_default();
    let fragments = [fragments(&counted), fragments(&floor.frame(&headless, Profile::Counts)?)];
    let report = FloorReport {
        surfel: env!("CARGO_PKG_VERSION").to_owned(),
        device: device_report(headless.device().facts()),
        settings: settings_as_options(&settings),
        camera: (&camera).into(),
        scene: scene_report(inputs, &prepared, transient_bytes),
        floor_points: floor.count(),
        strict_points: strict.count(),
        rounds: arguments.frames,
        rows: FloorRow::rows(&names, &rounds, [&fragments[0], &fragments[1]]),
    };
    console::print(&report.to_string())?;
    if let Some(path) = &arguments.json {
        save::text(path, &to_json(&report)?)?;
    }
    match arguments.validate {
        true => validation::conclude(&headless.device().instance().messages()),
        false => Ok(()),
    }
}

/// Milliseconds of each pass.
fn passes_ms(profile: &FrameProfile) -> Result<Vec<f64>> {
    let ms: Option<Vec<f64>> = profile.passes.iter().map(|pass| pass.secs.map(|secs| 1e3 * secs)).collect();
    ms.ok_or_else(|| Error::option("bench floor", "the device's queue has no timestamps"))
}

fn fragments(profile: &FrameProfile) -> Vec<Option<u64>> {
    profile.passes.iter().map(|pass| pass.counts.map(|counts| counts.fragments)).collect()
}
