//! Pajarola et al. 2003, figure 9: Gaussian kernels.

use surfel::{Result, report::curves::CurvePlot, scene::Kernel};

use super::{
    easel::Easel,
    kernels::{Bench, SUPPORT},
};

/// The paper's σ, in the units of its r.
const SIGMAS: [f32; 6] = [0.2, 0.3, 0.5, 0.6, 0.8, 1.0];

/// Draws the figure.
///
/// # Errors
/// As the easel's.
pub fn draw(easel: &mut Easel<'_>) -> Result<CurvePlot> {
    let bench = Bench::new(easel)?;
    let curves = SIGMAS.iter().map(|&sigma| {
        // In the settings σ is in radii.
        let kernel = Kernel::Gaussian { sigma: sigma / SUPPORT as f32 };
        bench.curve(easel, format!("σ = {sigma}"), kernel)
    });
    Ok(CurvePlot {
        title: vec![
            "Gaussian blending kernels (Pajarola et al. 2003, figure 9)".to_owned(),
            "ψ_G(r) = exp(−r²/2σ²), cut off where the splat ends, at r = 1.5".to_owned(),
            "Weights of one splat as the device draws it; the paper has a plot for each σ.".to_owned(),
        ],
        x_label: "r (the paper's: the splat's rim is at 1.5)".to_owned(),
        y_label: "weight".to_owned(),
        x: 0.0..SUPPORT,
        y: 0.0..1.0,
        curves: curves.collect::<Result<_>>()?,
    })
}
