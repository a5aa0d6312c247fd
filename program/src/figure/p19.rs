//! Pajarola et al. 2003, figure 19: a narrow kernel and one with a plateau on a model.

use surfel::{
    Result,
    scene::{Accumulate, Filter, KernelEval, Rasterizer, Settings},
};

use super::{
    coarse::CoarseModel,
    context::FigureContext,
    kernels::PsiE,
    sheet::{Panel, Sheet},
};

/// Draws the figure.
///
/// # Errors
/// As those of [`FigureContext`]; a model that can't be loaded.
pub fn draw(context: &mut FigureContext<'_>) -> Result<Sheet> {
    let CoarseModel { scene, what, camera } = CoarseModel::of(context)?;
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
