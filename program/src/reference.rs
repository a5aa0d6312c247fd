//! `surfel reference`: the same scene with the oracle.

use clap::Args;
use surfel::{
    Progress as _, Result,
    reference::{self, Picture, Pixel},
    scene::{Edges, Settings, Storage},
};

use crate::{
    camera::{self, CameraChoice},
    console::{self, Bars},
    emptiness,
    inputs::INPUTS,
    outputs::{self, PictureFormat},
    picture::PictureArguments,
    pictures::{self, Colors, Dump},
    scene::load_scene,
    unused::{self, Asked},
};

const EXAMPLES: &str = "Examples:
  surfel reference igea.ply -o igea.png --size 256x256
  surfel reference igea.ply --size 256x256 --dump oracle     to compare with: surfel render ... --dump buffers";

/// Draw the same with the reference: in 64 bits on the processor, slow and obvious
#[derive(Args)]
#[command(long_about = format!(
    "Draw the same with the reference. It computes in 64 bits on the processor, slow and obvious, and needs no Vulkan.\n\n{INPUTS}"
))]
#[command(after_help = EXAMPLES)]
pub struct ReferenceArguments {
    #[command(flatten)]
    picture: PictureArguments,
}

/// Runs the subcommand.
///
/// # Errors
/// Whatever goes wrong; what can be known before the long work is found before it.
pub fn run(arguments: &ReferenceArguments) -> Result<()> {
    let picture = &arguments.picture;
    let part = picture.drawn(picture.settings())?;
    let camera = CameraChoice::of(&picture.camera)?;
    let (output, format) = outputs::check(picture, "reference.png", &None)?;
    let bars = Bars::new();
    let inputs = picture.input.inputs();
    let mut loaded = load_scene(&inputs, &bars)?;
    let settings = Settings { size_px: part.settings.size_px, ..picture.settings_in(&loaded.picture) };
    let said: Vec<_> = picture.said().collect();
    unused::tell(said.iter().copied(), &inputs, &loaded);
    let storage = Storage::default();
    let asked = Asked { settings: &settings, storage, loaded: &loaded, is_drawn: true, is_written: true };
    unused::tell_of_reference(&said, &asked);
    picture.light(&mut loaded.scene);
    let camera = camera.camera(&loaded, part.whole_px)?;
    if picture.print_camera {
        console::print(&camera::words(&camera))?;
    }
    let (camera, crop) = part.view(camera)?;
    let progress = |done, total| bars.step("reference, row by row", done, total);
    let (encoding, background) = (picture.encoding(), settings.background);
    // A curve is of what is drawn alone; the background is put under it after that.
    let drawn_over = if encoding.is_plain() { background } else { None };
    let settings = Settings { background: drawn_over, ..settings };
    let drawn = reference::render(&loaded.scene, &camera, &settings, &progress);
    bars.clear();
    let mut dump = dump(&drawn?).cut(crop);
    let under = background.filter(|_| drawn_over.is_none());
    let bytes = pictures::encode_shown(&encoding, &dump.color, under);
    dump.color.iter_mut().for_each(|color| *color = pictures::over(*color, under));
    let colors = match format {
        PictureFormat::Png => Colors::Srgb(&bytes),
        PictureFormat::Exr => Colors::Linear(&dump.color),
    };
    pictures::write_picture(&output, format, dump.size_px, background.is_none(), colors)?;
    let shown = Settings { background, ..settings.clone() };
    let hint = || emptiness::hint(&bytes, &shown, &camera, &loaded.ball);
    if let Some(hint) = crop.is_none().then(hint).flatten() {
        console::say(&hint);
    }
    let Some(folder) = &picture.dump else { return Ok(()) };
    if settings.covers_in_part() {
        // The surface as data has hard edges.
        let hard = Settings { edges: Edges::Hard, ..settings };
        let surface = reference::render(&loaded.scene, &camera, &hard, &progress);
        bars.clear();
        dump = Dump { color: dump.color, ..self::dump(&surface?).cut(crop) };
    }
    dump.write(folder)
}

fn dump(picture: &Picture) -> Dump {
    let pixels = &picture.pixels;
    let one = |value: fn(&Pixel) -> f64| pixels.iter().map(|pixel| value(pixel) as f32).collect();
    let three = |value: fn(&Pixel) -> [f64; 3]| {
        pixels.iter().map(|pixel| value(pixel).map(|component| component as f32)).collect()
    };
    Dump {
        size_px: picture.size_px,
        weight: one(|pixel| pixel.weight),
        albedo: three(|pixel| pixel.albedo),
        normal: three(|pixel| pixel.normal),
        depth: one(|pixel| pixel.depth),
        color: pixels.iter().map(|pixel| pixel.color.map(|component| component as f32)).collect(),
    }
}
