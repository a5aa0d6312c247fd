//! Pajarola et al. 2003, figure 17: sums of weights and weighted colors, and what their quotient shows.

use surfel::{
    Error, Result,
    load::{builtin::relief, file_name},
    scene::{Accumulate, Camera, Edges, Scene, Settings},
};

use super::{
    context::FigureContext,
    raster::Raster,
    sheet::{Panel, Sheet},
};
use crate::{inputs::Inputs, pictures::encode, scene::load_scene};

/// Splats of the built-in model: so few that single ones are seen.
const FEW_SPLATS: usize = 12_000;

/// The field of view over that in which all of the model is seen.
const NEARER: f64 = 0.5;

/// Draws the figure.
///
/// # Errors
/// As those of [`FigureContext`]; a model that can't be loaded.
pub fn draw(context: &mut FigureContext<'_>) -> Result<Sheet> {
    let (scene, what) = match context.model {
        Some(path) => {
            let loaded = load_scene(&Inputs::splats_of(vec![path.to_owned()]), context.bars)?;
            let what = format!("{}, {} splats", file_name(path), loaded.scene.splat_count());
            (loaded.scene, what)
        }
        None => {
            let scene = Scene { objects: vec![relief(FEW_SPLATS)], ..Scene::default() };
            (scene, format!("the built-in relief with {FEW_SPLATS} splats"))
        }
    };
    let ball = scene.ball().ok_or_else(|| Error::input("scene", "", "has no splat"))?;
    let fit = Camera::fit(&ball, context.size_px, Camera::DEFAULT_FOV_Y_RAD);
    let camera = Camera { fov_y_rad: NEARER * fit.fov_y_rad, ..fit };
    let settings = Settings {
        size_px: context.size_px,
        accumulate: Accumulate::F32,
        edges: Edges::Hard,
        ..Settings::default()
    };
    let prepared = context.prepare(&scene)?;
    let depth = context.headless.see_part(&prepared, &camera, &settings)?;
    let colors = context.headless.sum_part(&prepared, &camera, &settings, &depth, false)?.colors;
    let (colors, _) = colors.as_chunks::<4>();
    let shown = |of: &dyn Fn(&[f32; 4]) -> [f32; 3]| Raster {
        size_px: context.size_px,
        pixels: colors
            .iter()
            .map(|sum| {
                let [red, green, blue] = if sum[3] > 0.0 { of(sum) } else { [1.0; 3] };
                let [red, green, blue, _] = encode([red, green, blue, 1.0]);
                [red, green, blue]
            })
            .collect(),
    };
    let mut weights: Vec<f32> = colors.iter().map(|sum| sum[3]).filter(|weight| *weight > 0.0).collect();
    weights.sort_by(f32::total_cmp);
    let at = |part: f64| weights.get((part * weights.len() as f64) as usize).copied().unwrap_or(0.0);
    let most = at(0.99).max(f32::MIN_POSITIVE);
    let spread =
        format!("{:.2}, {:.2}, {:.2} at the 5th, 50th and 95th percent", at(0.05), at(0.5), at(0.95));
    let panels = vec![
        Panel::new("a) sums of weights", spread, shown(&|sum| [sum[3] / most; 3])),
        Panel::new(
            "b) sums of weighted colors",
            "uneven, as the weights are",
            shown(&|[red, green, blue, _]| [*red, *green, *blue]),
        ),
        Panel::new(
            "c) colors over weights",
            "the surface's own colors",
            shown(&|[red, green, blue, weight]| [red / weight, green / weight, blue / weight]),
        ),
    ];
    let notes = [
        &format!("Model: {what}; not the paper's. Unlit colors."),
        "Weights are over how much the surface overlaps itself around each splat, and so vary less than the paper's.",
    ];
    Ok(Sheet::new("Per-pixel normalization (Pajarola et al. 2003, figure 17)", 3, panels, &notes))
}
