//! The picture: each process reads its pages, all draw, and the first one writes.

use std::path::{Path, PathBuf};

use surfel::{
    Error, Result,
    levels_file::is_levels_file,
    load::is_scene_file,
    prepare::PreparedScene,
    renderer::{Frame, Headless},
    scene::{
        Accumulate, Budget, Camera, CropView, Edges, Epsilon, OptionValue as _, Rasterizer, Settings,
        Shading, Storage,
    },
};

use super::{
    frame::{self, Also},
    world::Ranks,
};
use crate::{
    camera::CameraChoice,
    console::{self, Bars},
    drawing,
    hierarchies::{self, Readers, load_scene_with_hierarchies},
    measure::View,
    outputs::{self, PictureFormat},
    picture::Drawn,
    pictures,
    render::{RenderArguments, refuse_what_is_of_films},
    scene::{Loaded, upload},
    unused::{self, Asked},
};

/// What this process has of a picture.
struct Part {
    scene: PreparedScene,
    camera: Camera,
    crop: Option<CropView>,
    settings: Settings,
    /// Some file has transparent splats, which any process may have.
    layered: bool,
}

/// Draws a picture together with all others.
///
/// # Errors
/// As `surfel render`; what is not done by several processes, by its option or input.
pub fn run(arguments: &RenderArguments, ranks: &Ranks) -> Result<()> {
    if !ranks.is_first() {
        console::be_quiet();
    }
    let (drawn, camera, output) = ranks.agree(check(arguments))?;
    let headless = ranks.agree(arguments.device.open())?;
    arguments.device.watch(headless, |headless| {
        let part = ranks.agree(read(headless, arguments, &drawn, &camera, ranks))?;
        let view = View { scene: &part.scene, camera: &part.camera, settings: &part.settings };
        let by_depth = part.settings.shading == Shading::EyeDome;
        let also = Also { depth: by_depth || arguments.picture.dump.is_some(), layers: part.layered };
        if let Some(frames) = arguments.frames {
            let table = frame::measure(headless, view, also, frames, ranks)?;
            ranks.agree(if ranks.is_first() { console::print(&table) } else { Ok(()) })?;
        }
        let of_all = frame::draw(headless, view, also, ranks)?;
        let written = match ranks.is_first() {
            true => write(headless, arguments, view, &of_all, part.crop, &output),
            false => Ok(()),
        };
        ranks.agree(written)
    })
}

/// What can be refused before anything is read.
fn check(arguments: &RenderArguments) -> Result<(Drawn, CameraChoice, (PathBuf, PictureFormat))> {
    let drawn = arguments.picture.drawn(arguments.picture.settings())?;
    let camera = CameraChoice::of(&arguments.picture.camera)?;
    let output = outputs::check(&arguments.picture, "surfel.png", &arguments.timings)?;
    let refused = |option: &str| Err(Error::option(option, "not with several processes (mpirun)"));
    if arguments.timings.is_some() {
        return refused("--timings");
    }
    if arguments.explain {
        return refused("--explain");
    }
    if !arguments.pick.pixels.is_empty() {
        return refused("--pick");
    }
    if arguments.film.is_given() {
        return refused("--path and --turntable");
    }
    if drawn.settings.budget != Budget::Unlimited {
        return refused("--budget");
    }
    if drawn.settings.samples.0 > 1 {
        return refused("--samples");
    }
    if drawn.settings.accumulate == Accumulate::F16 {
        return refused("--accumulate f16");
    }
    refuse_what_is_of_films(arguments)?;
    let inputs = &arguments.picture.input.inputs;
    let other = inputs.iter().find(|input| !is_levels_file(input) && !is_scene_file(input));
    match (other, inputs.is_empty()) {
        (None, false) => Ok((drawn, camera, output)),
        (Some(other), _) => Err(no_hierarchy(other)),
        (None, true) => Err(no_hierarchy(Path::new("INPUT"))),
    }
}

fn no_hierarchy(place: impl Into<PathBuf>) -> Error {
    let problem = "expected a hierarchy (surfel convert MODEL FILE.surfel), of which each process (mpirun) reads a part";
    Error::input(place, "", problem)
}

/// Reads and uploads what this process has of the view.
fn read(
    headless: &mut Headless,
    arguments: &RenderArguments,
    drawn: &Drawn,
    camera: &CameraChoice,
    ranks: &Ranks,
) -> Result<Part> {
    let (picture, bars) = (&arguments.picture, Bars::new());
    let mut loaded = load_scene_with_hierarchies(&picture.input.inputs(), &bars)?;
    // Each process would draw what it reads whole. Hierarchies are told of behind all others.
    if loaded.inputs.len() > loaded.hierarchies.len() {
        return Err(no_hierarchy(&loaded.inputs[0].name));
    }
    picture.light(&mut loaded.scene);
    // One method for all, by which levels are drawn, whatever a process happens to have of them.
    let mut settings = Settings { edges: Edges::Hard, ..drawn.settings.clone() };
    if settings.rasterizer == Rasterizer::Auto {
        settings.rasterizer = Rasterizer::Compute;
    }
    headless.renderer.check_settings(&settings)?;
    let storage = arguments.storage.over(Storage::default());
    if ranks.is_first() {
        let said = arguments.said();
        unused::tell(said.iter().copied(), &picture.input.inputs(), &loaded);
        let asked = Asked { settings: &settings, storage, loaded: &loaded, is_drawn: true, is_written: true };
        unused::tell_of_picture(&said, &asked);
    }
    let (camera, crop) = drawn.view(camera.camera(&loaded, drawn.whole_px)?)?;
    if camera.is_orthographic() {
        let problem = "not with several processes (mpirun), whose depth would begin at different places";
        return Err(Error::option("--orthographic", problem));
    }
    let Loaded { mut scene, hierarchies: mut files, .. } = loaded;
    let layered = files.iter().any(|file| file.header().transparent);
    for file in &files {
        if settings.epsilon == Epsilon::Auto && !file.header().closed {
            let problem = format!(
                "{}: {} is an open surface, whose other side may be in another process (mpirun); expected a number of radii",
                settings.epsilon.word(),
                file.path().display()
            );
            return Err(Error::option("--epsilon", problem));
        }
    }
    scene.storage = storage;
    scene.without_auto_epsilon = settings.epsilon != Epsilon::Auto;
    scene.levels = settings.wants_levels();
    let readers = Readers { number: ranks.number(), count: ranks.count() };
    let asked = (&camera, &settings);
    let settings = hierarchies::load(&mut files, &mut scene, asked, &arguments.hierarchies, readers, &bars)?;
    settings.check_scene(&scene)?;
    let prepared = upload(headless, &scene, &bars)?;
    headless.renderer.check_levels(&prepared, &camera, &settings)?;
    Ok(Part { scene: prepared, camera, crop, settings, layered })
}

/// Shades what all have summed, and writes it.
fn write(
    headless: &mut Headless,
    arguments: &RenderArguments,
    view: View<'_>,
    of_all: &frame::OfAll,
    crop: Option<CropView>,
    output: &(PathBuf, PictureFormat),
) -> Result<()> {
    let sums = (&of_all.depth[..], &of_all.sums, of_all.layers.as_deref());
    let mut shade = |settings: &Settings, wanted| -> Result<Frame> {
        headless.shade_parts(view.scene, view.camera, settings, sums, wanted)
    };
    let (output, format) = output;
    let drawn = drawing::draw_by(&mut shade, &arguments.picture.encoding(), view.settings, crop, *format)?;
    let transparent = view.settings.background.is_none();
    pictures::write_picture(output, *format, drawn.size_px, transparent, drawn.colors(*format))?;
    if let Some(folder) = &arguments.picture.dump {
        drawing::dump(view.settings, &mut shade)?.cut(crop).write(folder)?;
    }
    Ok(())
}
