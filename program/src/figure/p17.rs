//! Pajarola et al. 2003, figure 17: sums of weights and weighted colors, and what their quotient shows.

use surfel::{
    Result,
    scene::{Accumulate, Edges, Settings},
};

use super::{
    coarse::CoarseModel,
    context::FigureContext,
    raster::Raster,
    sheet::{Panel, Sheet},
};
use crate::pictures::encode;

/// Draws the figure.
///
/// # Errors
/// As those of [`FigureContext`]; a model that can't be loaded.
pub fn draw(context: &mut FigureContext<'_>) -> Result<Sheet> {
    let CoarseModel { scene, what, camera } = CoarseModel::of(context)?;
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
