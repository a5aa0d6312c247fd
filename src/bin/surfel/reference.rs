//! `surfel reference`: the same scene with the oracle.

use clap::Args;
use surfel::{
    Progress as _, Result,
    reference::{self, Picture, Pixel},
};

use crate::{
    camera::CameraChoice,
    console::{self, Bars},
    emptiness,
    inputs::INPUTS,
    outputs,
    picture::PictureArguments,
    pictures::{self, Colors, Dump},
    scene::load_scene,
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
    let settings = &part.settings;
    let camera = CameraChoice::of(&picture.camera)?;
    let (output, format) = outputs::check(picture, "reference.png", &None)?;
    let bars = Bars::new();
    let loaded = load_scene(&picture.input.inputs(), &bars)?;
    let (camera, crop) = part.view(camera.camera(&loaded, part.whole_px)?)?;
    let progress = |done, total| bars.step("reference, row by row", done, total);
    let drawn = reference::render(&loaded.scene, &camera, settings, &progress);
    bars.clear();
    let dump = dump(&drawn?).cut(crop);
    let transparent = settings.background.is_none();
    pictures::write_picture(&output, format, dump.size_px, transparent, Colors::Linear(&dump.color))?;
    let srgb: Vec<[u8; 4]> = dump.color.iter().map(|color| pictures::encode(*color)).collect();
    let hint = || emptiness::hint(&srgb, settings.background, &camera, &loaded.ball);
    if let Some(hint) = crop.is_none().then(hint).flatten() {
        console::say(&hint);
    }
    match &picture.dump {
        Some(folder) => dump.write(folder),
        None => Ok(()),
    }
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
