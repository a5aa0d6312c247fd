//! How far each method may be from its oracle, and why: one place for the tests and the self-test.

use super::agreement::{Errors, F32, SMALL_WEIGHT};
use crate::{
    hard_scenes::Hard,
    scene::{Filter, Kernel, KernelEval, Rasterizer},
};

/// The tolerances of a hard scene with its settings, for 32-bit sums.
pub fn of(hard: &Hard) -> Errors {
    let exact = F32.times(factor(hard)).of_at_least(fewest_px(hard));
    match hard.settings.kernel_eval {
        KernelEval::Analytic => exact,
        KernelEval::Texture => of_kernel_texture(hard.settings.kernel, &exact),
    }
}

/// How much larger than [`F32`] errors may be.
///
/// Disks seen within 1° of grazing are 0.02 px thin where nothing widens them. A triangle's corners are made of tangent vectors
/// rounded to f32, whose plane is not quite the splat's, and each is placed to half a step of f32 in pixels, 3.8e-6 at 64 px,
/// which is 2e-4 of such an axis: 1.03e-3 of the weight. (Ray casting had the same figure before it took the splat's exact
/// determinant; whether that helps a triangle is not tried. A device that snaps vertices to 1/256 px will be wrong by more.)
fn factor(hard: &Hard) -> f64 {
    let thin = hard.name == "edge-on disks" && !matches!(hard.settings.filter, Filter::Adjust | Filter::Ewa);
    if thin && hard.settings.rasterizer == Rasterizer::Triangle { 1.1 } else { 1.0 }
}

/// Scenes whose splats are mostly too small for a picture without filter have few pixels.
fn fewest_px(hard: &Hard) -> usize {
    if hard.name.starts_with("subpixel") { 100 } else { 300 }
}

/// The same for kernels from a texture.
///
/// Bilinear interpolation between 256 texels over a diameter is wrong by at most `h²/8 · (|k_uu| + |k_vv|)`, h = 2/255, and
/// half floats hold weights to 2⁻¹² of themselves. Second derivatives along u and v together: 2/σ² for a Gaussian (at the
/// middle), below 60 for ψ_E(6, 1.5, 3) (by numerical search).
fn of_kernel_texture(kernel: Kernel, exact: &Errors) -> Errors {
    let texel = 2.0 / 255.0_f64;
    let curvature = match kernel {
        Kernel::Gaussian { sigma } => 2.0 / f64::from(sigma).powi(2),
        Kernel::PsiE { .. } => 60.0,
    };
    let interpolation = texel * texel / 8.0 * curvature;
    // Errors are relative to the weight or to this, whichever is larger; a device may filter with 8 bits of fraction.
    let weight =
        (interpolation + 1.0 / 256.0 * texel * curvature.sqrt()) / SMALL_WEIGHT + 1.0 / 4096.0 + exact.weight;
    // Albedo and the like are means: their errors follow the weights' by at most the spread of the values, 1. The sum of
    // normals is off by as much of the sum of weights, which turns it the more the shorter it is: disks seen at grazing
    // angles nearly cancel.
    Errors {
        weight,
        albedo: weight,
        color: 2.0 * weight,
        normal_deg: f64::INFINITY,
        normal_sum_deg: (2.0 * weight).to_degrees(),
        depth: weight,
        ..*exact
    }
}
