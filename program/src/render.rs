//! `surfel render`: a scene on a Vulkan device.

mod together;

use std::path::PathBuf;

use clap::Args;
use surfel::{
    Result,
    renderer::Headless,
    report::RunReport,
    scene::{Ball, Budget, CameraPath, CropView, Edges, Epsilon, Settings, Storage},
};

use crate::{
    camera::{self, CameraChoice},
    console::{self, Bars},
    device::DeviceArguments,
    drawing, emptiness, explain,
    film::{self, FilmArguments},
    hierarchies::{HierarchyArguments, load_scene_by_view},
    inputs::INPUTS,
    json::{to_json, write_json},
    measure::{self, View},
    oddities, origin,
    outputs::{self, PictureFormat},
    parse,
    pick::{PickArguments, PickReport},
    picture::{Drawn, PictureArguments},
    pictures, ranks,
    reports::{device_report, scene_report},
    scene::Loaded,
    scene_file_keys::KEYS,
    settings::{Given, Taken},
    steps::Steps,
    unused::{self, Asked},
};
use together::refuse_beside_a_film;
pub use together::refuse_what_is_of_films;

const EXAMPLES: &str = "Examples:
  surfel render
  surfel render igea.ply -o igea.png --size 1920x1080
  surfel render a.ply b.obj --eye 0,1,4 --target 0,0,0 --fov 60
  surfel render scene.toml              all keys of scene files: surfel render --help
  surfel render igea.ply --shading normals --background none -o normals.exr
  surfel render igea.ply --light direction=1,-1,-1 --light eye,intensity=0.2 --tonemap agx --exposure 1
  surfel render igea.ply --pick 512,300 --pick 600,300      what is seen there, and how far the two are apart
  surfel render igea.ply --frames 20 --timings igea.json
  surfel render igea.ply --accumulate f32 --dump buffers --validate
  mpirun -n 4 surfel render huge.surfel   by four processes, each with a part of it (built with --features mpi)

  surfel render igea.ply --turntable 6 -o out%04d.png       180 pictures around it; go on where it stopped by the same line
  surfel render igea.ply --path path.json --frames 300 -o film.mp4

A path: {\"version\":1, \"interpolation\":\"smooth\", \"cameras\":[{\"time\":0, ... as in a camera file}, {\"time\":2.5, ...}]}; times in seconds; linear is straight from camera to camera, smooth (the default) without a jolt, by cubics in time; the field of view goes by the logarithm of its half's tangent. A file of the pictures' name in .frames.txt tells which are whole and of which job.

A camera file: {\"eye\":[0,1,4], \"target\":[0,0,0], \"up\":[0,1,0], \"fov_deg\":45, \"near\":0.01}; near may be left out, and orthographic, the picture's height, may stand for fov_deg.";

/// Draw a scene on a Vulkan device
#[derive(Args)]
#[command(long_about = format!("Draw a scene on a Vulkan device.\n\n{INPUTS}"))]
#[command(after_help = EXAMPLES, after_long_help = format!("{EXAMPLES}\n\n{KEYS}"))]
pub struct RenderArguments {
    #[command(flatten)]
    pub picture: PictureArguments,

    #[command(flatten, next_help_heading = "Device and measurement")]
    pub device: DeviceArguments,

    #[command(flatten)]
    pub storage: Given<Storage>,

    #[command(flatten)]
    pub hierarchies: HierarchyArguments,

    #[command(flatten)]
    pub pick: PickArguments,

    #[command(flatten)]
    pub film: FilmArguments,

    /// Time that many frames, after two to warm up, and the passes of as many more, and print a table [default: 10 with
    /// --timings, else none]. With --path or --turntable: so many pictures [default: as many as --fps has in their time]
    #[arg(long, value_name = "N", value_parser = parse::whole::<u32>(1..=100_000), allow_hyphen_values = true)]
    pub frames: Option<u32>,

    /// Write what the passes cost, in milliseconds, and all that explains it, as JSON
    #[arg(long, value_name = "FILE.json")]
    pub timings: Option<PathBuf>,

    /// Print why this scene got the passes, pipelines and bytes that it got
    #[arg(long)]
    pub explain: bool,
}

impl Taken for Storage {
    type Table = Self;
}

/// Frames timed where only `--timings` is given.
const DEFAULT_TIMED_FRAMES: u32 = 10;

/// Runs the subcommand.
///
/// # Errors
/// Whatever goes wrong; what can be known before the long work is found before it.
pub fn run(arguments: &RenderArguments) -> Result<()> {
    if let Some(done) = ranks::run(arguments) {
        return done;
    }
    let part = arguments.picture.drawn(arguments.picture.settings())?;
    let camera = CameraChoice::of(&arguments.picture.camera)?;
    if arguments.film.is_given() {
        refuse_beside_a_film(arguments)?;
        let output = film::Output::of(&arguments.picture, &arguments.film)?;
        let path = film::path(&arguments.film)?;
        let headless = arguments.device.open()?;
        return arguments.device.watch(headless, |headless| {
            headless.renderer.check_settings(&part.settings)?;
            draw_film(headless, arguments, &part, (&camera, path.as_ref()), &output)
        });
    }
    refuse_what_is_of_films(arguments)?;
    let output = outputs::check(&arguments.picture, "surfel.png", &arguments.timings)?;
    let mut steps = Steps::default();
    let headless = steps.time("open the device", || arguments.device.open())?;
    arguments.device.watch(headless, |headless| {
        headless.renderer.check_settings(&part.settings)?;
        draw(headless, arguments, &part, &camera, &output, steps)
    })
}

/// What `--explain` says of pictures that have several samples for this.
const HARD: &str = "8 samples a pixel, with hard edges: in one, splats do not all cover pixels in part so (--samples 1 draws that)";
const CUT: &str =
    "8 samples a pixel: in one, splats that curves cut leave dots at ridges (--samples 1 draws that)";

fn draw(
    headless: &mut Headless,
    arguments: &RenderArguments,
    part: &Drawn,
    camera: &CameraChoice,
    output: &(PathBuf, PictureFormat),
    mut steps: Steps,
) -> Result<()> {
    let picture = &arguments.picture;
    let bars = Bars::new();
    let (mut loaded, settings) = load(headless, arguments, part, &bars)?;
    let camera = camera.camera(&loaded, part.whole_px)?;
    if picture.print_camera {
        console::print(&camera::words(&camera))?;
    }
    let (whole, (camera, crop)) = (camera, part.view(camera)?);
    steps.0.append(&mut loaded.steps);
    let seen = (&camera, &settings);
    let drawing::Ready { settings, scene: prepared } =
        drawing::ready(headless, &mut loaded, seen, &arguments.hierarchies, (&mut steps, &bars))?;
    let frames = arguments.frames.or(arguments.timings.is_some().then_some(DEFAULT_TIMED_FRAMES));
    let said = settings.samples;
    // What is timed is a frame.
    let settings = &match frames {
        None => picture.smoothed(settings, part, (&prepared, &whole), &headless.renderer),
        Some(_) => settings,
    };
    if arguments.explain && settings.samples != said {
        console::print(if settings.edges == Edges::Hard { HARD } else { CUT })?;
    }
    if arguments.is_written() {
        picture.tell_of_edges(settings, (&prepared, &camera), &headless.renderer)?;
    }
    let Loaded { inputs, ball, scene, .. } = loaded;
    // The device has it all: what the host had is free for what a software driver needs to draw.
    drop(scene);
    let view = View { scene: &prepared, camera: &camera, settings };

    if let Some(frames) = frames {
        let (times, transient_bytes) = measure::frame_times(headless, view, frames, &mut steps)?;
        let report = RunReport {
            surfel: env!("CARGO_PKG_VERSION").to_owned(),
            device: device_report(headless.device().facts()),
            settings: settings.as_options(),
            camera: (&camera).into(),
            scene: scene_report(inputs, &prepared, transient_bytes),
            steps: steps.0,
            frames: times,
        };
        console::print(&report.to_string())?;
        write_json(arguments.timings.as_deref(), &report)?;
    }
    if !arguments.pick.pixels.is_empty() {
        let report = PickReport::gather(headless, view, crop, &arguments.pick.pixels)?;
        console::print(&to_json(&report)?)?;
        if !arguments.is_written() {
            return Ok(());
        }
    }
    write(headless, arguments, view, crop, &ball, output)
}

/// All inputs, and the settings that they are drawn with.
fn load(
    headless: &Headless,
    arguments: &RenderArguments,
    part: &Drawn,
    bars: &Bars,
) -> Result<(Loaded, Settings)> {
    let picture = &arguments.picture;
    let inputs = picture.input.inputs();
    let mut loaded = load_scene_by_view(&inputs, bars)?;
    let said = arguments.said();
    unused::tell(said.iter().copied(), &inputs, &loaded);
    oddities::tell(&loaded.scene, &loaded.ball);
    origin::tell(&loaded.scene, &loaded.ball);
    picture.light(&mut loaded.scene);
    // What belongs to no scene was checked before it was loaded.
    let settings =
        Settings { size_px: part.settings.size_px, ..picture.settings_of(&loaded, &headless.renderer) };
    let storage = arguments.storage.over(Storage::default());
    let (is_drawn, is_written) = (arguments.is_drawn(), arguments.is_written());
    let asked = Asked { settings: &settings, storage, loaded: &loaded, is_drawn, is_written };
    unused::tell_of_picture(&said, &asked);
    let scene = &mut loaded.scene;
    scene.numbered = !arguments.pick.pixels.is_empty();
    scene.storage = storage;
    scene.without_auto_epsilon = settings.epsilon != Epsilon::Auto;
    scene.levels = settings.wants_levels();
    scene.budget = settings.budget != Budget::Unlimited;
    Ok((loaded, settings))
}

/// Draws a film.
fn draw_film(
    headless: &mut Headless,
    arguments: &RenderArguments,
    part: &Drawn,
    (camera, path): (&CameraChoice, Option<&CameraPath>),
    output: &film::Output,
) -> Result<()> {
    let bars = Bars::new();
    let (loaded, settings) = load(headless, arguments, part, &bars)?;
    let base = || camera.camera(&loaded, part.whole_px);
    let shots = film::shots(&arguments.film, path, arguments.frames, base)?;
    if arguments.picture.print_camera {
        shots.iter().try_for_each(|camera| console::print(&camera::words(camera)))?;
    }
    let fps = film::fps(&arguments.film, path, arguments.frames);
    let making =
        film::Making { picture: &arguments.picture, hierarchies: &arguments.hierarchies, part, output, fps };
    film::make(headless, loaded, &settings, &shots, &making, &bars)
}

/// Draws and writes the picture, and the surface where it is asked for.
fn write(
    headless: &mut Headless,
    arguments: &RenderArguments,
    view: View<'_>,
    crop: Option<CropView>,
    ball: &Ball,
    (output, format): &(PathBuf, PictureFormat),
) -> Result<()> {
    let picture = &arguments.picture;
    let background = view.settings.background;
    let drawn = drawing::draw(headless, &picture.encoding(), view, crop, *format)?;
    let transparent = background.is_none();
    pictures::write_picture(output, *format, drawn.size_px, transparent, drawn.colors(*format))?;
    let hint = || emptiness::hint(&drawn.bytes, view.settings, view.camera, ball);
    if let Some(hint) = crop.is_none().then(hint).flatten() {
        console::say(&hint);
    }
    if let Some(folder) = &picture.dump {
        let mut draw =
            |settings: &Settings, wanted| headless.render(view.scene, view.camera, settings, wanted);
        drawing::dump(view.settings, &mut draw)?.cut(crop).write(folder)?;
    }
    let explanation = headless.renderer.explain(view.scene, view.camera, view.settings, &drawn.plan);
    if arguments.explain {
        let has_levels = explanation.levels.is_some();
        let count = || headless.count_listed(view.scene, view.camera, view.settings);
        let listed = has_levels.then(count).transpose()?;
        let heaps = explain::heaps(headless.device().memory_heaps().heaps());
        return console::print(&(explain::text(&explanation, listed) + &heaps));
    }
    explanation.beyond_f32.iter().for_each(|note| console::say(note));
    Ok(())
}
