//! From a loaded scene to a picture's pixels.

use std::sync::Arc;

use surfel::{
    Result,
    graph::Plan,
    prepare::PreparedScene,
    renderer::{Frame, Headless, Wanted},
    scene::{Camera, CropView, Encoding, Lod, Settings},
};

use crate::{
    console::Bars,
    hierarchies::{self, HierarchyArguments, Readers},
    measure::View,
    outputs::PictureFormat,
    pictures::{self, Colors, Dump},
    scene::{Loaded, upload},
    steps::Steps,
};

/// A scene on the device, with the settings that it can be drawn with.
pub struct Ready {
    pub scene: PreparedScene,
    pub settings: Settings,
}

/// Brings a scene to the device: of files of levels of detail what a view needs.
///
/// # Errors
/// Settings that rule the scene out; whatever files and device answer.
pub fn ready(
    headless: &Headless,
    loaded: &mut Loaded,
    (camera, settings): (&Camera, &Settings),
    arguments: &HierarchyArguments,
    (steps, bars): (&mut Steps, &Bars),
) -> Result<Ready> {
    let Loaded { scene, hierarchies: files, octrees, inputs, .. } = loaded;
    let mut arguments = *arguments;
    if !octrees.files.is_empty() {
        // By the number of what they hold.
        let splats: u64 = files.iter().map(|file| file.header().splats).sum();
        let share = octrees.points() as f64 / (octrees.points() + splats) as f64;
        let most = arguments.budget_memory.map(|most| (most as f64 * share) as u64);
        let taken = steps.time("read nodes", || {
            bars.held(|| octrees.read(scene, inputs, (camera, settings), most, bars))
        })?;
        // What they leave is for the others.
        arguments.budget_memory = arguments.budget_memory.map(|all| all.saturating_sub(taken));
    }
    let arguments = &arguments;
    let mut asked = settings.clone();
    loop {
        let settings = steps.time("read pages", || {
            hierarchies::load(files, scene, (camera, &asked), arguments, Readers::ONE, bars)
        })?;
        settings.check_scene(scene)?; // names the object, which the renderer does not know
        let prepared = steps.time("upload", || upload(headless, scene, bars))?;
        let checked = match files.is_empty() {
            true => Ok(()),
            false => headless.renderer.check_levels(&prepared, camera, &settings),
        };
        match checked {
            // Where nobody asked for a level, what draws none draws all splats.
            Err(_) if settings.lod == Lod::Auto => asked.lod = Lod::Px(0.0),
            checked => return checked.map(|()| Ready { scene: prepared, settings }),
        }
    }
}

/// The pixels of a picture.
pub struct Pixels {
    pub size_px: [u32; 2],
    /// 8-bit sRGB, alpha linear.
    pub bytes: Vec<[u8; 4]>,
    /// Linear; empty unless it was needed.
    pub linear: Vec<[f32; 4]>,
    /// How they were drawn.
    pub plan: Arc<Plan>,
}

impl Pixels {
    /// What is written in a format.
    pub fn colors(&self, format: PictureFormat) -> Colors<'_> {
        match format {
            PictureFormat::Png => Colors::Srgb(&self.bytes),
            PictureFormat::Exr => Colors::Linear(&self.linear),
        }
    }
}

/// Draws a picture.
///
/// # Errors
/// Whatever the device answers.
pub fn draw(
    headless: &mut Headless,
    encoding: &Encoding,
    view: View<'_>,
    crop: Option<CropView>,
    format: PictureFormat,
) -> Result<Pixels> {
    let mut frame = |settings: &Settings, wanted| headless.render(view.scene, view.camera, settings, wanted);
    draw_by(&mut frame, encoding, view.settings, crop, format)
}

/// What draws a frame.
pub type Draw<'d> = &'d mut dyn FnMut(&Settings, Wanted) -> Result<Frame>;

/// The same of frames that anything draws.
///
/// # Errors
/// As those.
pub fn draw_by(
    draw: Draw<'_>,
    encoding: &Encoding,
    settings: &Settings,
    crop: Option<CropView>,
    format: PictureFormat,
) -> Result<Pixels> {
    let background = settings.background;
    let linear = format == PictureFormat::Exr || !encoding.is_plain();
    let wanted = Wanted { picture: true, linear, ..Wanted::default() };
    // A curve is of what is drawn alone; the background is put under it after that.
    let without = (!encoding.is_plain()).then(|| Settings { background: None, ..settings.clone() });
    let mut frame = draw(without.as_ref().unwrap_or(settings), wanted)?;
    if let Some(crop) = crop {
        frame.size_px = crop.size_px();
        (frame.srgb, frame.linear) = (crop.cut(&frame.srgb), crop.cut(&frame.linear));
    }
    let bytes = match linear {
        true => pictures::encode_shown(encoding, &frame.linear, without.and(background)),
        false => frame.srgb,
    };
    Ok(Pixels { size_px: frame.size_px, bytes, linear: frame.linear, plan: frame.plan })
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
