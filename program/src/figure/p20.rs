//! Pajarola et al. 2003, figure 20: models as they are, and in levels of detail.

use surfel::{
    Error, Result,
    load::{builtin::relief, file_name},
    scene::{Accumulate, Camera, Lod, Rasterizer, Scene, Settings},
};

use super::{
    context::FigureContext,
    sheet::{Panel, Sheet},
};
use crate::{inputs::Inputs, scene::load_scene};

/// Splats of the built-in model.
const SPLATS: usize = 400_000;

/// So often the size is halved for which there are half as many splats.
const HALVINGS: u32 = 16;

/// The paper's tolerance, in percent of the window.
const PAPERS_PERCENT: f64 = 0.01;

/// Draws the figure.
///
/// # Errors
/// As those of [`FigureContext`]; a model that can't be loaded.
pub fn draw(context: &mut FigureContext<'_>) -> Result<Sheet> {
    let (mut scene, what) = match context.model {
        Some(path) => {
            let loaded = load_scene(&Inputs::splats_of(vec![path.to_owned()]), context.bars)?;
            (loaded.scene, file_name(path))
        }
        None => {
            let scene = Scene::from(relief(SPLATS));
            (scene, format!("the built-in relief with {SPLATS} splats"))
        }
    };
    let ball = scene.ball().ok_or_else(|| Error::input("scene", "", "has no splat"))?;
    let camera = Camera::fit(&ball, context.size_px, Camera::DEFAULT_FOV_Y_RAD);
    scene.levels = true;
    let prepared = context.prepare(&scene)?;
    let size_px = context.size_px;
    let settings = |lod: Lod| Settings {
        size_px,
        rasterizer: Rasterizer::Compute,
        accumulate: Accumulate::F32,
        lod,
        ..Settings::default()
    };
    let count = |context: &FigureContext<'_>, lod: Lod| {
        context.headless.count_listed(&prepared, &camera, &settings(lod))
    };
    let all = count(context, Lod::Px(0.0))?;
    // Fewer are drawn the larger the size is.
    let [mut more, mut fewer] = [0.0, f64::from(context.size_px[0])];
    for _ in 0..HALVINGS {
        let between = 0.5 * (more + fewer);
        match 2 * count(context, Lod::Px(between))? > all {
            true => more = between,
            false => fewer = between,
        }
    }
    let ways = [
        ("a) tau = 0", Lod::Px(0.0)),
        ("b) the paper's tau", Lod::Percent(PAPERS_PERCENT)),
        ("c) half as many splats", Lod::Px(fewer)),
    ];
    let mut panels = Vec::new();
    for (name, lod) in ways {
        let settings = settings(lod);
        let drawn = count(context, lod)?;
        let caption = format!("tau = {:.2} px, {drawn} splats", settings.tau_px());
        panels.push(Panel::new(name, caption, context.picture(&prepared, &camera, &settings)?));
    }
    let notes = [
        format!("Model: {what}; not the paper's."),
        format!(
            "The paper's is {PAPERS_PERCENT}% of the window, at which its David takes half as many splats as at 0."
        ),
    ];
    Ok(Sheet::new(
        "Levels of detail (Pajarola et al. 2003, figure 20)",
        3,
        panels,
        &notes.each_ref().map(String::as_str),
    ))
}
