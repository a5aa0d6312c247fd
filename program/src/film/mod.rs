//! Films: a picture for each of many cameras, of a scene that is loaded once.

mod arguments;
mod encode;
mod fingerprint;
mod journal;
mod names;

use std::{
    fs,
    path::{Path, PathBuf},
};

use surfel::{
    Error, Progress as _, Result,
    load::PointOctree,
    renderer::Headless,
    scene::{Camera, CameraPath, OptionTable as _, OptionValue as _, Settings},
};

use arguments::FPS;
pub use arguments::FilmArguments;

use crate::{
    camera::read_path,
    console::{self, Bars},
    drawing::{self, Ready},
    hierarchies::HierarchyArguments,
    measure::View,
    outputs::{self, PictureFormat},
    picture::{Drawn, PictureArguments},
    pictures,
    scene::Loaded,
    steps::Steps,
};
use fingerprint::Fingerprint;
use journal::Journal;
use names::Names;

/// The most pictures of a film.
const MOST_FRAMES: f64 = 1e6;

/// Where a film goes.
pub struct Output {
    names: Names,
    format: PictureFormat,
    /// The film itself, where one is asked for, and the folder of its pictures.
    film: Option<(PathBuf, PathBuf)>,
}

impl Output {
    /// The place of the pictures, and of the film.
    ///
    /// # Errors
    /// A name without a number; a place that can't be written to, or is an input.
    pub fn of(picture: &PictureArguments, film: &FilmArguments) -> Result<Self> {
        let output = picture.output.clone().unwrap_or_else(|| "frame%04d.png".into());
        let has = |ending: &str| output.extension().is_some_and(|own| own.eq_ignore_ascii_case(ending));
        let of_film = has("mp4").then(|| (output.clone(), output.with_extension("frames")));
        let pattern = match &of_film {
            Some((_, folder)) => folder.join("%05d.png"),
            None => {
                outputs::check_name("--output", &output, &["png", "exr", "mp4"])?;
                output.clone()
            }
        };
        let format = if has("exr") { PictureFormat::Exr } else { PictureFormat::Png };
        let names = Names::parse(&pattern)?;
        let inputs = picture.input.inputs.iter().chain(&picture.camera.camera).chain(&film.path);
        match &of_film {
            Some((film, folder)) => outputs::check_places([film], Some(folder), &[], inputs)?,
            None => outputs::check_places([&names.of(0), &names.journal()], None, &[], inputs)?,
        }
        Ok(Self { names, format, film: of_film })
    }
}

/// Whether a name is that of a film or of its pictures, and not of a picture.
pub fn is_name_of_film(output: &Path) -> bool {
    output.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("mp4"))
        || Names::parse(output).is_ok()
}

/// The path of the cameras, where a file has it.
///
/// # Errors
/// A file that can't be read, or is no path.
pub fn path(arguments: &FilmArguments) -> Result<Option<CameraPath>> {
    arguments.path.as_deref().map(read_path).transpose()
}

/// Pictures a second: so many that the film takes its time, where somebody says only how many there are.
pub fn fps(arguments: &FilmArguments, path: Option<&CameraPath>, frames: Option<u32>) -> f64 {
    let (secs, steps) = match path {
        // Both ends are shown.
        Some(path) => (path.times()[1] - path.times()[0], frames.map(|frames| frames.saturating_sub(1))),
        None => (arguments.turntable.unwrap_or_default(), frames),
    };
    let fitting = steps.map(|steps| f64::from(steps) / secs).filter(|fps| fps.is_finite() && *fps > 0.0);
    arguments.fps.or(fitting).unwrap_or(FPS)
}

/// The cameras of a film, on its path. `base` is that of a picture, which a turntable carries around where there is none.
///
/// # Errors
/// As `base`; more pictures than a film has.
pub fn shots(
    arguments: &FilmArguments,
    path: Option<&CameraPath>,
    frames: Option<u32>,
    base: impl FnOnce() -> Result<Camera>,
) -> Result<Vec<Camera>> {
    let fps = arguments.fps.unwrap_or(FPS);
    let count = |secs: f64, more: f64| match frames {
        Some(frames) => Ok(u64::from(frames)),
        None if secs * fps + more > MOST_FRAMES => {
            Err(Error::option("--fps", format!("{fps}: more than a million pictures in {secs} seconds")))
        }
        None => Ok(((secs * fps).round() + more).max(1.0) as u64),
    };
    if let Some(path) = path {
        let [start, end] = path.times();
        let count = count(end - start, 1.0)?;
        // Both ends are shown.
        let time = |i: u64| start + (end - start) * (i as f64 / (count - 1).max(1) as f64);
        let shots: Vec<Camera> = (0..count).map(|i| path.at(time(i))).collect();
        let bad = |(i, camera): (usize, &Camera)| camera.validate().err().map(|error| (i, error));
        return match shots.iter().enumerate().find_map(bad) {
            Some((i, error)) => Err(Error::option("--path", format!("picture {i}: {error}"))),
            None => Ok(shots),
        };
    }
    let base = base()?;
    let count = count(arguments.turntable.unwrap_or_default(), 0.0)?;
    // The last one is before the first one again.
    let angle_rad = |i: u64| std::f64::consts::TAU * (i as f64 / count as f64);
    Ok((0..count).map(|i| base.turned(angle_rad(i))).collect())
}

/// How pictures are made of a scene.
pub struct Making<'a> {
    pub picture: &'a PictureArguments,
    pub hierarchies: &'a HierarchyArguments,
    pub part: &'a Drawn,
    pub output: &'a Output,
    pub fps: f64,
}

/// Draws the pictures that are not there yet, and makes a film of them where one is asked for.
///
/// # Errors
/// Whatever files, device and ffmpeg answer.
pub fn make(
    headless: &mut Headless,
    mut loaded: Loaded,
    settings: &Settings,
    shots: &[Camera],
    making: &Making<'_>,
    bars: &Bars,
) -> Result<()> {
    let Making { picture, hierarchies, part, output, fps } = making;
    let Output { names, format, film } = output;
    let encoding = picture.encoding();
    if let Some((_, folder)) = film {
        fs::create_dir_all(folder).map_err(|e| Error::file(folder, "write", e))?;
    }
    let job = job(headless, &loaded, settings, making)?;
    let mut journal = Journal::open(names.journal())?;
    let mut ready: Option<Ready> = None;
    let total = shots.len() as u64;
    let (mut drawn, mut is_told) = (0_u64, false);
    for (number, shot) in (0..total).zip(shots) {
        let place = names.of(number);
        let mut made_of = job.clone();
        made_of.add(shot);
        let made_of = made_of.number();
        if !journal.has(number, made_of, &place) {
            let (camera, crop) = part.view(*shot)?;
            // What a view reads of files is its own.
            let current = match ready.take().filter(|_| !loaded.is_read_by_view()) {
                Some(ready) => ready,
                None => {
                    let steps = &mut Steps::default();
                    let ready = drawing::ready(
                        headless,
                        &mut loaded,
                        (&camera, settings),
                        hierarchies,
                        (steps, bars),
                    )?;
                    if !loaded.is_read_by_view() {
                        // The device has it all.
                        loaded.scene = Default::default();
                    }
                    ready
                }
            };
            let whole = (&current.scene, shot);
            let settings = &picture.smoothed(current.settings.clone(), part, whole, &headless.renderer);
            let view = View { scene: &current.scene, camera: &camera, settings };
            let pixels = drawing::draw(headless, &encoding, view, crop, *format)?;
            let transparent = settings.background.is_none();
            pictures::save_picture(&place, *format, pixels.size_px, transparent, pixels.colors(*format))?;
            journal.note(number, made_of, &place)?;
            // Once: pictures of a film have much the same to tell.
            if !is_told {
                let explanation = headless.renderer.explain(view.scene, view.camera, settings, &pixels.plan);
                let notes = explanation.beyond_f32.iter();
                notes.for_each(|note| bars.note(&format!("{}: {note}", place.display())));
                is_told = !explanation.beyond_f32.is_empty();
            }
            ready = Some(current);
            drawn += 1;
        }
        bars.step("pictures", number + 1, total);
    }
    bars.clear();
    let pattern = &names.pattern();
    let pictures = encode::Pictures { pattern, count: total, fps: *fps };
    console::say(&format!(
        "{}: {total} pictures, {drawn} drawn, {} there before",
        pattern.display(),
        total - drawn
    ));
    match film {
        Some((film, folder)) => {
            encode::encode(&pictures, film)?;
            // A film is all that was asked for. What else somebody has in the folder stays.
            let entries = fs::read_dir(folder).into_iter().flatten().flatten();
            let ours = |path: &PathBuf| names.has(path) || *path == names.journal();
            entries.map(|entry| entry.path()).filter(ours).for_each(|file| {
                let _ = fs::remove_file(file);
            });
            let _ = fs::remove_dir(folder);
            console::say(&format!("wrote {}, {total} pictures", film.display()));
        }
        None if *format == PictureFormat::Png => {
            let film = Path::new("film.mp4");
            console::say(&format!("as a film: {}", encode::command_line(&pictures, film)));
        }
        None => {}
    }
    Ok(())
}

/// What all pictures of a job have in common.
fn job(
    headless: &Headless,
    loaded: &Loaded,
    settings: &Settings,
    making: &Making<'_>,
) -> Result<Fingerprint> {
    let mut job = Fingerprint::new();
    let facts = headless.device().facts();
    job.add(&(&facts.name, &facts.driver, settings.as_options()));
    let encoding = making.picture.encoding();
    let words: Vec<String> =
        surfel::scene::Encoding::OPTIONS.iter().map(|option| (option.get)(&encoding)).collect();
    let crop = making.picture.crop.map(|crop| crop.word());
    job.add(&(words, crop, making.part.whole_px, making.hierarchies.budget_memory));
    job.add_scene(&loaded.scene);
    for file in &loaded.hierarchies {
        job.add(&file.placed());
        job.add_file(file.path()).map_err(|e| Error::file(file.path(), "read", e))?;
    }
    for file in loaded.octrees.files.iter().flat_map(PointOctree::files) {
        job.add_file(file).map_err(|e| Error::file(file, "read", e))?;
    }
    Ok(job)
}
