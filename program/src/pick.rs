//! What is seen in pixels of a picture, and where it is.

use clap::Args;
use glam::DVec3;
use serde::Serialize;
use surfel::{
    Error, Result,
    passes::{Picked, PickedPart},
    renderer::Headless,
    scene::CropView,
};

use crate::{measure::View, parse};

/// What is picked.
#[derive(Args)]
pub struct PickArguments {
    /// Print as JSON what is seen in a pixel of the picture, counted from its top left corner: the place (in 64 bits, the files' unit), the
    /// normal, the object and the splat; given twice or more, also the distances from each to the next. No picture is written then, unless
    /// --output or --dump asks for it
    #[arg(long = "pick", value_name = "X,Y", value_parser = parse::pixel, allow_hyphen_values = true, help_heading = "Results")]
    pub pixels: Vec<[u32; 2]>,
}

/// What is seen in some pixels.
#[derive(Serialize)]
pub struct PickReport {
    /// Width and height of the picture.
    size: [u32; 2],
    /// In the order in which they were asked for.
    picks: Vec<Pick>,
    /// From each place to the next, in the files' unit; `null` where one of the two is empty.
    distances: Vec<Option<f64>>,
}

/// What is seen in a pixel.
#[derive(Serialize)]
struct Pick {
    pixel: [u32; 2],
    /// `null` where nothing is.
    seen: Option<Seen>,
}

/// Something, and where it is: world space, the files' unit.
#[derive(Serialize)]
struct Seen {
    position: [f64; 3],
    /// Toward the eye.
    normal: [f64; 3],
    /// From the eye.
    distance: f64,
    /// Along the view's axis.
    depth: f64,
    object: String,
    /// What of the object: `splat`, `triangle`, or `node`, which stands for splats below it.
    part: &'static str,
    /// Its number among those of the object that are drawn, from 0 on; `null` of nodes and of files of levels of detail.
    number: Option<u32>,
}

impl PickReport {
    /// Asks the device.
    ///
    /// # Errors
    /// A pixel that is not in the picture; as [`Headless::pick`].
    pub fn gather(
        headless: &mut Headless,
        view: View<'_>,
        crop: Option<CropView>,
        pixels: &[[u32; 2]],
    ) -> Result<Self> {
        let size = crop.map_or(view.settings.size_px, |crop| crop.size_px());
        let mut picks = Vec::new();
        for &pixel in pixels {
            if pixel[0] >= size[0] || pixel[1] >= size[1] {
                let ([x, y], [width, height]) = (pixel, size);
                return Err(Error::option(
                    "--pick",
                    format!("{x},{y}: expected a pixel of {width}x{height}"),
                ));
            }
            let drawn = crop.map_or(pixel, |crop| crop.drawn_pixel(pixel));
            let picked = headless.pick(view.scene, view.camera, view.settings, drawn)?;
            picks.push(Pick { pixel, seen: picked.map(|picked| Seen::of(&picked, &view.scene.objects)) });
        }
        let place = |pick: &Pick| pick.seen.as_ref().map(|seen| DVec3::from(seen.position));
        let distance = |pair: &[Pick]| Some(place(&pair[0])?.distance(place(&pair[1])?));
        let distances = picks.windows(2).map(distance).collect();
        Ok(Self { size, picks, distances })
    }
}

impl Seen {
    fn of(picked: &Picked, objects: &[String]) -> Self {
        let (part, number) = match picked.part {
            PickedPart::Splat(number) => ("splat", number),
            PickedPart::Triangle(number) => ("triangle", number),
            PickedPart::Node => ("node", None),
        };
        Self {
            position: picked.position.into(),
            normal: picked.normal.into(),
            distance: picked.distance,
            depth: picked.depth,
            object: objects.get(picked.object).cloned().unwrap_or_default(),
            part,
            number,
        }
    }
}
