//! Pajarola et al. 2003, figure 19: a narrow kernel and one with a plateau on a model.

use surfel::{
    Error, Result,
    load::{builtin::relief, file_name},
    scene::{Accumulate, Camera, Filter, KernelEval, Rasterizer, Scene, Settings},
};

use super::{
    context::FigureContext,
    kernels::PsiE,
    sheet::{Panel, Sheet},
};
use crate::{inputs::Inputs, scene::load_scene};

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
            let inputs = Inputs::splats_of(vec![path.to_owned()]);
            let loaded = load_scene(&inputs, context.bars)?;
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
    let prepared = context.prepare(&scene)?;
    let mut panel = |name: &str, kernel: PsiE| -> Result<Panel> {
        let settings = Settings {
            size_px: context.size_px,
            rasterizer: Rasterizer::Triangle,
            filter: Filter::None,
            kernel: kernel.kernel(),
            kernel_eval: KernelEval::Texture,
            accumulate: Accumulate::F32,
            ..Settings::default()
        };
        let picture = context.picture(&prepared, &camera, &settings)?;
        Ok(Panel::new(name, kernel.text(), picture))
    };
    let panels = vec![
        panel("a) round and narrow: looks faceted", PsiE { a: 6.0, b: 1.5, n: 3.0 })?,
        panel("b) a wide plateau: smooth and sharp", PsiE { a: 4.0, b: 1.5, n: 5.0 })?,
    ];
    let notes = [
        &format!("Model: {what}; not the paper's. Shaded with one light at the eye."),
        "As in the paper, a textured triangle for each splat, no screen-space filter, every point drawn (tau = 0).",
    ];
    Ok(Sheet::new("Blending kernels on a model (Pajarola et al. 2003, figure 19)", 2, panels, &notes))
}
