//! Pajarola et al. 2003, figure 10: the kernels ψ_E.

use surfel::{Result, report::curves::CurvePlot};

use super::{
    easel::Easel,
    kernels::{Bench, PsiE, SUPPORT},
};

/// The paper's pairs of n and a.
const PAIRS: [[f32; 2]; 6] = [[2.0, 8.0], [2.0, 1.0], [3.0, 20.0], [3.0, 5.0], [5.0, 50.0], [5.0, 4.0]];

/// Draws the figure.
///
/// # Errors
/// As the easel's.
pub fn draw(easel: &mut Easel<'_>) -> Result<CurvePlot> {
    let bench = Bench::new(easel)?;
    let curves = PAIRS.iter().map(|&[n, a]| {
        let kernel = PsiE { a, b: SUPPORT as f32, n };
        bench.curve(easel, format!("n = {n}, a = {a}"), kernel.kernel())
    });
    Ok(CurvePlot {
        title: vec![
            "Blending kernels with plateaus (Pajarola et al. 2003, figure 10)".to_owned(),
            "ψ_E(r) = exp(−a q/(1−q)), q = (r/b)ⁿ, b = 1.5: a narrows the kernel, n flattens its top"
                .to_owned(),
            "Weights of one splat as the device draws it; the paper has a plot for each pair.".to_owned(),
        ],
        x_label: "r (the paper's: the splat's rim is at b = 1.5)".to_owned(),
        y_label: "weight".to_owned(),
        x: 0.0..SUPPORT,
        y: 0.0..1.0,
        curves: curves.collect::<Result<_>>()?,
    })
}
