//! How far each method may be from its oracle, and why: one place for the tests and the self-test.

use super::{
    agreement::{Errors, F32, SMALL_WEIGHT},
    light::LightErrors,
};
use crate::{
    hard_scenes::Hard,
    scene::{Accumulate, Kernel, KernelEval},
};

/// The tolerances of a hard scene with its settings, for 32-bit sums.
pub fn of(hard: &Hard) -> Errors {
    let exact = F32.of_at_least(fewest_px(hard));
    match hard.settings.kernel_eval {
        KernelEval::Analytic => exact,
        KernelEval::Texture => of_kernel_texture(hard.settings.kernel, &exact),
    }
}

/// How far a component of the picture may be off with 32-bit sums: the color's tolerance of [`F32`]. Alphas and albedos are
/// means of the splats', so that only differences of weights enter, 1e-3 of a weight at most; a layer's contribution is at
/// most 1 minus what those before it hide, so that errors of all layers together are no more than of one.
pub const LIGHT: f64 = F32.color;

/// The root mean square over all pixels, also those that rounding may turn, two steps of 8 bits: all that 16-bit sums are
/// held to, and what 32-bit ones are where [`LIGHT`] says nothing, such as polygons at the very place of others.
pub const LIGHT_RMS_OF_ALL: f64 = 2.0 / 255.0;

/// The tolerances of a picture of layers, polygons and lights. Of a tenth of its pixels there has to be something to see, and
/// two thirds have to be such that rounding can't turn them: else it shows nothing.
pub fn of_light(hard: &Hard) -> LightErrors {
    let pixels = hard.settings.size_px.iter().map(|side| *side as usize).product::<usize>();
    LightErrors {
        seen: pixels / 10,
        compared: 2 * pixels / 3,
        worst: match hard.settings.accumulate {
            Accumulate::F32 | Accumulate::Auto => LIGHT,
            Accumulate::F16 => f64::INFINITY,
        },
        rms_of_all: LIGHT_RMS_OF_ALL,
        ..LightErrors::default()
    }
}

/// Scenes whose splats are mostly too small for a picture without filter have few pixels.
fn fewest_px(hard: &Hard) -> usize {
    if hard.name.starts_with("subpixel") { 100 } else { 300 }
}

/// The tolerances for kernels from a texture.
///
/// Bilinear interpolation between 257 texels over a diameter is wrong by at most `h²/8 · (|k_uu| + |k_vv|)`, h = 2/256, and
/// half floats hold weights to 2⁻¹² of themselves. Second derivatives along u and v together: 2/σ² for a Gaussian (at the
/// middle), below 60 for ψ_E(6, 1.5, 3) (by numerical search).
fn of_kernel_texture(kernel: Kernel, exact: &Errors) -> Errors {
    let texel = 2.0 / 256.0_f64;
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
