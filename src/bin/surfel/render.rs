//! `surfel render`: a scene on a Vulkan device.

use std::{path::PathBuf, sync::Arc};

use clap::Args;
use surfel::{
    Result,
    graph::Plan,
    renderer::{Frame, Headless, Wanted},
    report::RunReport,
    scene::{Ball, Budget, CropView, Epsilon, Lod, Settings, Storage},
};

use crate::{
    camera::CameraChoice,
    console::{self, Bars},
    device::DeviceArguments,
    emptiness, explain,
    hierarchies::{self, HierarchyArguments, Readers, load_scene_with_hierarchies},
    inputs::INPUTS,
    json::write_json,
    measure::{self, View},
    outputs::{self, PictureFormat},
    parse,
    picture::{Drawn, PictureArguments},
    pictures::{self, Colors, Dump},
    ranks,
    reports::{device_report, scene_report},
    scene::{Loaded, upload},
    scene_file_keys::KEYS,
    settings::{Given, Taken},
    steps::Steps,
};

const EXAMPLES: &str = "Examples:
  surfel render
  surfel render igea.ply -o igea.png --size 1920x1080
  surfel render a.ply b.obj --eye 0,1,4 --target 0,0,0 --fov 60
  surfel render scene.toml              all keys of scene files: surfel render --help
  surfel render igea.ply --shading normals --background none -o normals.exr
  surfel render igea.ply --light direction=1,-1,-1 --light eye,intensity=0.2 --tonemap agx --exposure 1
  surfel render igea.ply --frames 20 --timings igea.json
  surfel render igea.ply --accumulate f32 --dump buffers --validate
  mpirun -n 4 surfel render huge.surfel   by four processes, each with a part of it (built with --features mpi)

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

    /// Time that many frames, after two to warm up, and the passes of as many more, and print a table [default: 10 with
    /// --timings, else none]
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
    let output = outputs::check(&arguments.picture, "surfel.png", &arguments.timings)?;
    let mut steps = Steps::default();
    let headless = steps.time("open the device", || arguments.device.open())?;
    arguments.device.watch(headless, |headless| {
        headless.renderer.check_settings(&part.settings)?;
        draw(headless, arguments, &part, &camera, &output, steps)
    })
}

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
    let mut loaded = load_scene_with_hierarchies(&picture.input.inputs(), &bars)?;
    picture.light(&mut loaded.scene);
    // What belongs to no scene was checked before it was loaded.
    let settings = &Settings { size_px: part.settings.size_px, ..picture.settings_in(&loaded.picture) };
    let (camera, crop) = part.view(camera.camera(&loaded, part.whole_px)?)?;
    let Loaded { mut scene, inputs, steps: loading, ball, hierarchies: mut files, .. } = loaded;
    steps.0.extend(loading);
    scene.storage = arguments.storage.over(Storage::default());
    scene.without_auto_epsilon = settings.epsilon != Epsilon::Auto;
    scene.levels = settings.wants_levels();
    scene.budget = settings.budget != Budget::Unlimited;
    let mut asked = settings.clone();
    let (settings, prepared) = loop {
        let settings = steps.time("read pages", || {
            let view = (&camera, &asked);
            hierarchies::load(&mut files, &mut scene, view, &arguments.hierarchies, Readers::ONE, &bars)
        })?;
        settings.check_scene(&scene)?; // names the object, which the renderer does not know
        let prepared = steps.time("upload", || upload(headless, &scene, &bars))?;
        let checked = match files.is_empty() {
            true => Ok(()),
            false => headless.renderer.check_levels(&prepared, &camera, &settings),
        };
        match checked {
            // Where nobody asked for a level, what draws none draws all splats.
            Err(_) if settings.lod == Lod::Auto => asked.lod = Lod::Px(0.0),
            checked => break checked.map(|()| (settings, prepared))?,
        }
    };
    let settings = &settings;
    // The device has it all: what the host had is free for what a software driver needs to draw.
    drop(scene);
    let view = View { scene: &prepared, camera: &camera, settings };

    let frames = arguments.frames.or(arguments.timings.is_some().then_some(DEFAULT_TIMED_FRAMES));
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
    write(headless, arguments, view, crop, &ball, output)
}

/// Draws and writes the picture, and the surface where it is asked for.
fn write(
    headless: &mut Headless,
    arguments: &RenderArguments,
    view: View<'_>,
    crop: Option<CropView>,
    ball: &Ball,
    output: &(PathBuf, PictureFormat),
) -> Result<()> {
    let picture = &arguments.picture;
    let mut draw = |settings: &Settings, wanted| headless.render(view.scene, view.camera, settings, wanted);
    let (bytes, plan) = write_picture(picture, view.settings, crop, output, &mut draw)?;
    let hint = || emptiness::hint(&bytes, view.settings.background, view.camera, ball);
    if let Some(hint) = crop.is_none().then(hint).flatten() {
        console::say(&hint);
    }
    if let Some(folder) = &picture.dump {
        dump(view.settings, &mut draw)?.cut(crop).write(folder)?;
    }
    let explanation = headless.renderer.explain(view.scene, view.camera, view.settings, &plan);
    if arguments.explain {
        let has_levels = explanation.levels.is_some();
        let count = || headless.count_listed(view.scene, view.camera, view.settings);
        let listed = has_levels.then(count).transpose()?;
        return console::print(&explain::text(&explanation, listed));
    }
    explanation.beyond_f32.iter().for_each(|note| console::say(note));
    Ok(())
}

/// What draws a frame.
type Draw<'d> = &'d mut dyn FnMut(&Settings, Wanted) -> Result<Frame>;

/// Draws the picture and writes it; its bytes, and what was recorded.
pub fn write_picture(
    picture: &PictureArguments,
    settings: &Settings,
    crop: Option<CropView>,
    (output, format): &(PathBuf, PictureFormat),
    draw: Draw<'_>,
) -> Result<(Vec<[u8; 4]>, Arc<Plan>)> {
    let (encoding, background) = (picture.encoding(), settings.background);
    let linear = *format == PictureFormat::Exr || !encoding.is_plain();
    let wanted = Wanted { picture: true, linear, ..Wanted::default() };
    // A curve is of what is drawn alone; the background is put under it after that.
    let without = (!encoding.is_plain()).then(|| Settings { background: None, ..settings.clone() });
    let mut frame = draw(without.as_ref().unwrap_or(settings), wanted)?;
    if let Some(crop) = crop {
        frame.size_px = crop.size_px();
        (frame.srgb, frame.linear) = (crop.cut(&frame.srgb), crop.cut(&frame.linear));
    }
    let bytes = match linear {
        true => pictures::encode_shown(&encoding, &frame.linear, without.and(background)),
        false => frame.srgb,
    };
    let colors = match format {
        PictureFormat::Png => Colors::Srgb(&bytes),
        PictureFormat::Exr => Colors::Linear(&frame.linear),
    };
    pictures::write_picture(output, *format, frame.size_px, background.is_none(), colors)?;
    Ok((bytes, frame.plan))
}

/// The picture, and the surface in a frame of its own, whose edges are hard.
pub fn dump(settings: &Settings, draw: Draw<'_>) -> Result<Dump> {
    let picture = Wanted { picture: true, linear: true, surface: false, profile: None };
    let color = draw(settings, picture)?.linear;
    let frame = draw(settings, Wanted { surface: true, ..picture })?;
    let three = |values: &[[f32; 4]]| values.iter().map(|[x, y, z, _]| [*x, *y, *z]).collect();
    Ok(Dump {
        size_px: frame.size_px,
        albedo: three(&frame.albedo),
        normal: three(&frame.normal),
        weight: frame.weight,
        depth: frame.depth,
        color,
    })
}
