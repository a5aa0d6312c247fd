//! `surfel compare`: methods side by side, each with its speed and its errors.

mod arguments;
mod candidates;
mod pictures;
mod references;
mod turns;
pub mod zoom;

use std::{fmt::Display, path::Path};

use serde::Serialize;
use surfel::{
    Error, Progress as _, Result,
    instruments::counts_of,
    prepare::PreparedScene,
    renderer::{Headless, Wanted},
    report::compare::{CompareReport, ErrorFigures, Method, MethodRow, PictureKey, Skipped, Surface, errors},
    save,
    scene::{Camera, Scene, Settings},
};

pub use arguments::CompareArguments;
pub use pictures::{MAGNIFIED, Shown, difference};

use crate::{
    camera::CameraChoice,
    console::{self, Bars},
    json::to_json,
    outputs,
    reports::device_report,
    scene::{Loaded, load_scene},
    steps::Steps,
};
use pictures::Show;

/// White, linear: what the pictures are compared over.
pub const BACKGROUND: [f32; 3] = [1.0; 3];

/// How much larger frames are timed than compared where nothing is said.
const TIME_SCALE: u32 = 4;

/// Runs the subcommand.
///
/// # Errors
/// Whatever goes wrong; a method that fails is listed with the reason unless none is left.
pub fn run(arguments: &CompareArguments) -> Result<()> {
    let base = arguments.settings();
    base.validate()?;
    check_outputs(arguments)?;
    arguments.device.watch(arguments.device.open()?, |headless| match arguments.zoom {
        true => zoom::run(headless, arguments),
        false => compare(headless, arguments),
    })
}

fn check_outputs(arguments: &CompareArguments) -> Result<()> {
    if let Some(path) = &arguments.plot
        && !path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("svg"))
    {
        return Err(Error::option("--plot", format!("{}: expected a name in .svg", path.display())));
    }
    let files: Vec<&Path> =
        [&arguments.json, &arguments.plot].into_iter().flatten().map(|p| p.as_path()).collect();
    let inputs: Vec<&Path> =
        outputs::paths(&arguments.input.inputs).chain(arguments.camera.camera.as_deref()).collect();
    outputs::check_places(&files, arguments.pictures.as_deref(), &[], &inputs)
}

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

/// All that the methods are tried on.
struct Stage<'a> {
    arguments: &'a CompareArguments,
    scene: &'a Scene,
    prepared: &'a PreparedScene,
    camera: &'a Camera,
    base: &'a Settings,
    bars: &'a Bars,
}

fn compare(mut headless: Headless, arguments: &CompareArguments) -> Result<()> {
    timed_settings(&headless, arguments)?; // before anything takes long
    let choice = CameraChoice::of(&arguments.camera)?;
    let bars = Bars::new();
    let loaded =
        load_scene(&arguments.input.inputs, arguments.input.representation(), &bars, &mut Steps::default())?;
    let camera = choice.camera(&loaded, arguments.settings().size_px)?;
    let mut show = |shown: Shown<'_>| match &arguments.pictures {
        Some(folder) => pictures::write(folder, &shown),
        None => Ok(()),
    };
    let report = gather(&mut headless, arguments, &loaded, &camera, &bars, &mut show)?;
    tell(&headless, arguments, &report, || report.plot_svg())
}

/// Prints what was found, and writes what is asked for.
///
/// # Errors
/// Results that can't be written.
fn tell<R: Display + Serialize>(
    headless: &Headless,
    arguments: &CompareArguments,
    report: &R,
    plot_svg: impl FnOnce() -> Result<String>,
) -> Result<()> {
    console::print(&report.to_string())?;
    if let Some(path) = &arguments.json {
        save::text(path, &to_json(report)?)?;
    }
    if let Some(path) = &arguments.plot {
        save::text(path, &plot_svg()?)?;
    }
    // A lost cache costs the next run some time, that is all.
    let _ = headless.renderer.shaders.save_cache();
    Ok(())
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
    let prepared = headless.prepare(scene, &|done, total| bars.step("upload", done, total));
    bars.clear();
    let prepared = prepared?;

    let selection = arguments.selection();
    let wanted = if arguments.methods.quick { selection.one_at_a_time() } else { selection.product() };
    let (methods, mut skipped) = candidates::split(wanted, base, scene, &headless.renderer);
    candidates::some_left(methods.len(), &skipped)?;

    let stage = Stage { arguments, scene, prepared: &prepared, camera, base, bars };
    let found = find_errors(headless, &stage, &methods, &mut skipped, show);
    bars.clear();
    let found = found?;
    let turns = turns::take(headless, &stage, &timed, &found, arguments.frames);
    bars.clear();

    let closed = scene.objects.iter().all(|object| object.closed);
    let mut rows = Vec::new();
    for ((method, [own, truth]), times) in found.into_iter().zip(turns) {
        match times {
            Ok(times) => {
                let mut row = MethodRow::new(method.names(), times, own, truth);
                row.set_instructions(&counts_of(&method.settings(base), closed)?);
                rows.push(row);
            }
            Err(error) => skipped.push(Skipped { method: method.names(), reason: error.to_string() }),
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
        notes: notes(arguments),
    };
    report.mark_front();
    Ok(report)
}

/// What a reader of the figures has to know.
fn notes(arguments: &CompareArguments) -> Vec<String> {
    let mut notes = vec!["instructions: of disks on a closed surface, none of them large".to_owned()];
    if arguments.device.validate {
        notes.push("timed under validation: the times are worthless".to_owned());
    }
    notes
}

/// The implementation error and the method error of each method, in their order; what fails goes to `skipped`.
fn find_errors(
    headless: &mut Headless,
    stage: &Stage<'_>,
    methods: &[Method],
    skipped: &mut Vec<Skipped>,
    show: Show<'_>,
) -> Result<Vec<(Method, [ErrorFigures; 2])>> {
    let Stage { arguments, scene, camera, base, bars, .. } = *stage;
    let truth = references::truth(scene, camera, base, arguments.samples, "ground truth", bars)?;
    show(Shown::Truth(&truth))?;
    let mut keys: Vec<PictureKey> = Vec::new();
    for key in methods.iter().map(Method::picture_key) {
        if !keys.contains(&key) {
            keys.push(key);
        }
    }
    let mut found: Vec<Option<[ErrorFigures; 2]>> = vec![None; methods.len()];
    // One oracle at a time: its pictures are large.
    for (number, key) in keys.iter().enumerate() {
        let task = format!("oracle {} of {}", number + 1, keys.len());
        let oracle = references::oracle(scene, camera, base, *key, &task, bars);
        for (method, figures) in methods.iter().zip(&mut found) {
            if method.picture_key() != *key {
                continue;
            }
            let drawn = oracle.as_ref().map_err(ToString::to_string).and_then(|oracle| {
                surface(headless, stage, method)
                    .map(|drawn| (oracle, drawn))
                    .map_err(|error| error.to_string())
            });
            match drawn {
                Ok((oracle, drawn)) => {
                    let own = errors(&drawn, &oracle.surface, &oracle.undecided, BACKGROUND);
                    *figures = Some([own, errors(&drawn, &truth, &[], BACKGROUND)]);
                    show(Shown::Method { method, drawn: &drawn, oracle: &oracle.surface, truth: &truth })?;
                }
                Err(reason) => skipped.push(Skipped { method: method.names(), reason }),
            }
        }
    }
    Ok(methods.iter().copied().zip(found).filter_map(|(method, figures)| Some((method, figures?))).collect())
}

/// What a method draws.
fn surface(headless: &mut Headless, stage: &Stage<'_>, method: &Method) -> Result<Surface> {
    let wanted = Wanted { picture: true, linear: true, surface: true, profile: None };
    let settings = method.settings(stage.base);
    let frame = headless.render(stage.prepared, stage.camera, &settings, wanted)?;
    Ok(references::of_frame(&frame))
}
