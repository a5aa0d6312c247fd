//! The oracle: the picture that every other rasterizer is measured against.
//!
//! In `f64` on the CPU, one pixel at a time, from the equations of the papers (Guennebaud, Barthe, Paulin 2006;
//! Pajarola, Sainz, Guidotti 2003). Slow and obvious on purpose, and it shares no formula with the GPU path: not
//! even the `math` folder.
//!
//! A splat is looked for in a box that is far larger than it (`search_box`). In each pixel the ray meets the
//! splat's plane (`intersect`), the kernel gives a weight (`kernel`, `fragment`); the nearest shifted depth is found
//! first, then the fragments at or before it are summed, normalized and shaded (`band`, `shade`).
//!
//! The rasterizers are two kinds: the affine ones have a map of their own (`affine`), all the others draw the same
//! picture, which one of them cuts off (`low_pass`). The filters change the tangent vectors (`filter`,
//! `paper_filter`), add a disk in the image (`low_pass`) or replace the map (`ewa`). A splat that reaches the near
//! plane, or whose depth radius is above 0.9 of its center's depth, has no affine map worth the name: the affine
//! rasterizers draw it by its rays, and `ewa` leaves it as it is.
//!
//! Polygons are drawn by rays too (`triangle`, `polygons`); one that is in front of the splats, or within ε behind them,
//! is blended with them by their sum of weights (`front`, `transition`). Transparent fragments are all kept, a pixel at
//! a time, and grouped into layers by ε (`layers`): nothing is peeled.
//!
//! What a clip curve removes of a splat is left out of each of its fragments (`clip`), by the (u, v) where the ray meets the plane of the
//! splat as the scene has it: no filter moves a curve. Where edges cover pixels in part, it leaves a part of each (`drawn_clip`).
//!
//! Planes that cut what is seen leave out of all fragments, of polygons too, those that are on their other side (`planes`).
//!
//! Which levels of detail a view has is found by walking down from the root (`selection`); of a mesh, which of its cells are polygons (`hybrid_selection`).
//!
//! **Spaces.** View space: eye at the origin, x right, y down, z forward. Image plane `z = 1`:
//! `x = (column + ½ − width/2) / focal`, y alike with rows, from the top.
//!
//! Of [`crate::scene::Accumulate`] only the floors are modelled that 16-bit sums ask for ([`Settings::floors`]): the sums are `f64` whatever
//! it says. Eye-dome lighting is a step behind all others (`eye_dome`). Not modelled, because they are to change nothing: [`crate::scene::KernelEval`] (the kernel is arithmetic) and [`crate::scene::TileInvocations`].

mod affine;
mod among;
mod band;
mod bands;
mod borders;
mod clip;
mod covering;
mod creases;
mod decision;
mod drawn_clip;
mod edges;
mod epsilon;
mod ewa;
mod eye_dome;
mod filter;
mod fragment;
mod front;
mod ground_truth;
mod hybrid_selection;
mod intersect;
mod kernel;
mod layers;
mod low_pass;
mod low_pass_taps;
mod mesh;
mod near_surfaces;
mod outline;
mod overlap;
mod paper_filter;
mod pick;
mod picture;
mod planes;
mod polygons;
mod reach;
mod row_span;
mod samples;
mod search_box;
mod selection;
mod shade;
mod splat;
mod stack;
mod surface;
mod surfaces;
mod tangents;
mod thickness;
mod transition;
mod triangle;
mod true_pixel;
mod view;

#[cfg(test)]
mod tests;

use std::sync::atomic::{AtomicU64, Ordering};

pub use clip::removes;
pub use edges::Edge;
pub use ground_truth::{MOST_SAMPLES_PER_SIDE, ground_truth};
pub use hybrid_selection::{HybridChoice, hybrid_choice};
pub use pick::{Candidate, Picker};
pub use picture::{Picture, Pixel};
pub use selection::{Culling, Walk};
pub use true_pixel::{GroundTruth, TruePixel};

use self::band::{Drawn, Frame};
use self::search_box::SearchBox;
use self::shade::Shader;
use self::splat::DrawnSplat;
use self::triangle::DrawnTriangle;
use self::view::View;
use crate::error::{Error, Result};
use crate::scene::{Camera, Opacity, Scene, Settings, Shading};

/// Rows that a thread takes at a time: enough that the boxes of all splats are not walked too often, few enough
/// that every thread stays busy.
const BAND_ROWS: usize = 16;

/// Renders `scene` seen by `camera`, with every setting but `kernel_eval` and `tile_invocations`; of `accumulate` only the floors.
///
/// Splats with a [`crate::scene::Defect`] are left out and counted. Uses all cores; the picture does not depend on
/// how many. `progress(done, total)` is called from several threads, with rows.
///
/// # Errors
/// [`crate::error::ErrorKind::Option`] for settings or a camera out of range, for a filter that the scene's splats
/// rule out, and for a size that memory can't hold.
pub fn render(
    scene: &Scene,
    camera: &Camera,
    settings: &Settings,
    progress: &(dyn Fn(u64, u64) + Sync),
) -> Result<Picture> {
    settings.validate()?;
    camera.validate()?;
    settings.check_camera(camera)?;
    settings.check_scene(scene)?;
    if settings.samples.0 > 1 {
        return samples::render(scene, camera, settings, progress);
    }
    render_view(
        scene,
        View::of(scene, camera, settings.size_px).cut_by(scene, settings),
        settings,
        true,
        progress,
    )
}

/// One sample of each pixel; `alone`: of no others.
fn render_view(
    scene: &Scene,
    view: View,
    settings: &Settings,
    alone: bool,
    progress: &(dyn Fn(u64, u64) + Sync),
) -> Result<Picture> {
    let [width, height] = settings.size_px;
    let (splats, defects) = splat::prepare(scene, &view, settings);
    let frame = Frame {
        polygon_offsets_px: polygons::offsets_px(scene, settings, alone),
        ..frame(scene, view, settings, splats)
    };

    let mut pixels = empty_pixels(settings)?;
    let rows_done = AtomicU64::new(0);
    progress(0, u64::from(height));
    bands::for_each(&mut pixels, width as usize * BAND_ROWS, |i, pixels| {
        let first = (i * BAND_ROWS) as u32;
        let rows = (pixels.len() / width as usize) as u32;
        band::render(&frame, first..first + rows, pixels);
        let done = rows_done.fetch_add(u64::from(rows), Ordering::Relaxed) + u64::from(rows);
        progress(done, u64::from(height));
    });
    if settings.shading == Shading::EyeDome {
        eye_dome::shade(&view, &mut pixels);
    }
    for pixel in &mut pixels {
        pixel.depth -= view.moved_back;
        pixel.epsilon_margin /= view.depth_share;
    }
    Ok(Picture { size_px: settings.size_px, pixels, defects })
}

/// The scene as all bands read it.
fn frame<'a>(scene: &Scene, view: View, settings: &'a Settings, splats: Vec<DrawnSplat>) -> Frame<'a> {
    // Without anything transparent nothing is moved.
    let (transparent, opaque) = match splats.iter().any(|splat| splat.transparent) {
        true => splats.into_iter().partition(|splat| splat.transparent),
        false => (Vec::new(), splats),
    };
    let limit_r2 = kernel::limit_r2(settings.kernel);
    let drawn_splats = |things: Vec<DrawnSplat>| Drawn {
        boxes: things.iter().map(|splat| SearchBox::of(splat, limit_r2, &view)).collect(),
        things,
    };
    let drawn_triangles = |things: Vec<DrawnTriangle>| Drawn {
        boxes: things.iter().map(|triangle| SearchBox::of_triangle(&triangle.corners, &view)).collect(),
        things,
    };
    let triangles = mesh::prepare(scene, &view, settings);
    Frame {
        view,
        settings,
        shader: Shader::new(settings.shading, scene, view.from_world.rotation),
        splats: drawn_splats(opaque),
        triangles: drawn_triangles(triangles.opaque),
        transparent_splats: drawn_splats(transparent),
        transparent_triangles: drawn_triangles(triangles.transparent),
        has_opaque_polygons: triangles.has_opaque,
        polygon_offsets_px: &polygons::CENTER,
        polygon_epsilon: epsilon::mean_epsilon(scene, settings.epsilon),
        layers_cover_in_part: covering::covers_in_part(scene, settings, Opacity::Transparent),
        background: background(settings),
    }
}

/// A picture of background only.
fn empty_pixels(settings: &Settings) -> Result<Vec<Pixel>> {
    let [width, height] = settings.size_px;
    let too_large = || Error::option("--size", format!("{width}x{height}: memory can't hold the picture"));
    let count = usize::try_from(u64::from(width) * u64::from(height)).map_err(|_| too_large())?;
    let mut pixels = Vec::new();
    pixels.try_reserve_exact(count).map_err(|_| too_large())?;
    pixels.resize(count, Pixel::empty(background(settings)));
    Ok(pixels)
}

/// Its linear color and alpha.
fn background(settings: &Settings) -> [f64; 4] {
    settings.background.map_or([0.0; 4], |srgb| {
        let [red, green, blue] = srgb.map(|c| shade::linear_from_srgb(f64::from(c)));
        [red, green, blue, 1.0]
    })
}
