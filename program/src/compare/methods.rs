//! The methods on a scene: how wrong each is, then how long each takes, in turn.

use surfel::{
    Error, Result,
    instruments::counts_of,
    renderer::Headless,
    report::{
        TimedFrames,
        compare::{CompareReport, ErrorFigures, Method, MethodRow, Skipped, Surface, errors},
        picture::{PictureError, picture_error},
    },
    scene::{Camera, Settings},
};

use super::{
    arguments::CompareArguments,
    candidates,
    context::{CompareContext, Drawn},
    pictures::{BACKGROUND, Show, Shown},
};
use crate::{
    console::Bars,
    reports::device_report,
    scene::{Loaded, upload},
    turns::{self, Draw},
};

/// How much larger frames are timed than compared where nothing is said.
const TIME_SCALE: u32 = 4;

/// The size at which frames are timed.
fn time_size(arguments: &CompareArguments) -> Result<[u32; 2]> {
    let size_px = arguments.settings().size_px;
    let [width, height] = size_px;
    let Some(size) = arguments.time_size else {
        return Ok(size_px.map(|side| side.saturating_mul(TIME_SCALE)));
    };
    // Another shape would show another part of the scene.
    if u64::from(size[0]) * u64::from(height) != u64::from(size[1]) * u64::from(width) {
        let problem =
            format!("{}x{}: expected the proportions of --size, {width}x{height}", size[0], size[1]);
        return Err(Error::option("--time-size", problem));
    }
    Ok(size)
}

/// The settings that frames are timed with, but for the method.
///
/// # Errors
/// A size of other proportions than `--size`, or that the device can't draw.
pub fn timed_settings(headless: &Headless, arguments: &CompareArguments) -> Result<Settings> {
    let timed = Settings { size_px: time_size(arguments)?, ..arguments.settings() };
    headless.renderer.check_settings(&timed).map_err(|error| match arguments.time_size {
        None => Error::option("--time-size", format!("4 times --size by default: {error}")),
        // It is this option's size that was checked.
        Some(_) => Error::option("--time-size", error.to_string().trim_start_matches("--size: ")),
    })?;
    Ok(timed)
}

/// Compares the methods on a scene; what is compared is shown on the way.
///
/// # Errors
/// Whatever goes wrong; a method that fails is listed with the reason unless none is left.
pub fn gather(
    headless: &mut Headless,
    arguments: &CompareArguments,
    loaded: &Loaded,
    camera: &Camera,
    bars: &Bars,
    show: Show<'_>,
) -> Result<CompareReport> {
    let base = &arguments.settings();
    let timed = timed_settings(headless, arguments)?;
    let Loaded { scene, inputs, .. } = loaded;
    let prepared = upload(headless, scene, bars)?;

    let selection = arguments.selection();
    let wanted = if arguments.methods.quick { selection.one_at_a_time() } else { selection.product() };
    let (methods, mut skipped) = candidates::split(wanted, base, (scene, camera), &headless.renderer);
    candidates::some_left(methods.len(), &skipped)?;

    let context = CompareContext { scene, prepared: &prepared, camera, base, bars };
    let found = find_errors(headless, &context, arguments.samples, &methods, &mut skipped, show);
    bars.clear();
    let found = found?;
    let frames = |(method, _): &(Method, _)| turns::frames(&prepared, camera, method.settings(&timed));
    let draws: Vec<Draw<'_>> = found.iter().map(frames).collect();
    let task = "frames of all methods";
    let turns = turns::measure_interleaved(headless, draws, arguments.frames, task, bars, &mut || {});
    bars.clear();

    let closed = scene.objects.iter().all(|object| object.closed);
    let mut rows = Vec::new();
    for ((method, (own, truth, picture)), times) in found.into_iter().zip(turns) {
        match times.as_ref().map(TimedFrames::times) {
            Ok(times) => {
                let mut row = MethodRow::new(method, times, own, truth, picture);
                row.set_instructions(&counts_of(&method.settings(base), closed)?);
                rows.push(row);
            }
            Err(error) => skipped.push(Skipped { method, reason: error.to_string() }),
        }
    }
    candidates::some_left(rows.len(), &skipped)?;
    let mut report = CompareReport {
        surfel: env!("CARGO_PKG_VERSION").to_owned(),
        device: device_report(headless.device().facts()),
        settings: candidates::common_options(base.as_options()),
        camera: camera.into(),
        inputs: inputs.clone(),
        splats: prepared.splat_count(),
        error_size_px: base.size_px,
        time_size_px: timed.size_px,
        samples_per_side: arguments.samples,
        timed_frames: arguments.frames,
        methods: rows,
        skipped,
        why: Vec::new(),
        notes: notes(arguments),
    };
    report.judge();
    Ok(report)
}

/// Notes for a reader of the figures.
fn notes(arguments: &CompareArguments) -> Vec<String> {
    let mut notes = vec!["instructions: of disks on a closed surface, none of them large".to_owned()];
    if arguments.device.validate {
        notes.push("timed under validation: the times are worthless".to_owned());
    }
    notes
}

/// The implementation error, the method error, and that of the picture.
type Errors = (ErrorFigures, ErrorFigures, PictureError);

/// The errors of each method, in their order; what fails goes to `skipped`.
fn find_errors(
    headless: &mut Headless,
    context: &CompareContext<'_>,
    samples_per_side: u32,
    methods: &[Method],
    skipped: &mut Vec<Skipped>,
    show: Show<'_>,
) -> Result<Vec<(Method, Errors)>> {
    let ground_truth = context.truth(samples_per_side, "ground truth")?;
    let truth = Surface::of_truth(&ground_truth);
    show(Shown::Truth(&truth))?;
    let mut exact: Vec<Method> = Vec::new();
    for method in methods.iter().map(Method::exact) {
        if !exact.contains(&method) {
            exact.push(method);
        }
    }
    let mut found: Vec<Option<Errors>> = vec![None; methods.len()];
    // One oracle at a time: its pictures are large.
    for (number, of) in exact.iter().enumerate() {
        let task = format!("oracle {} of {}", number + 1, exact.len());
        let oracle = context.oracle(of, &task);
        for (method, figures) in methods.iter().zip(&mut found) {
            if method.exact() != *of {
                continue;
            }
            let mut skip = |reason: &Error| {
                skipped.push(Skipped { method: *method, reason: reason.to_string() });
            };
            let (picture, undecided) = match &oracle {
                Ok(oracle) => oracle,
                Err(error) => {
                    skip(error);
                    continue;
                }
            };
            match context.draw(headless, method) {
                Ok(drawn) => {
                    let Drawn { surface: drawn, rgba } = &drawn;
                    let own = errors(drawn, picture, undecided, BACKGROUND);
                    let from_truth = errors(drawn, &truth, &[], BACKGROUND);
                    *figures = Some((own, from_truth, picture_error(rgba, &ground_truth)));
                    show(Shown::Method { method, drawn, oracle: picture, truth: &truth })?;
                }
                Err(error) => skip(&error),
            }
        }
    }
    Ok(methods.iter().copied().zip(found).filter_map(|(method, figures)| Some((method, figures?))).collect())
}
