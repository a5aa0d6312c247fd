//! What differs between pipelines of the same shader: the host's mirror of `glsl/inc/variant.glsl`.

use std::f64::consts::LOG2_E;

use crate::{
    math::kernel::{gaussian_coverage_r2, psi_e_coverage_r2},
    scene::{Backfaces, Filter, FilterWeight, Kernel, Rasterizer, Settings, Shading, Transition},
};

/// Specialization constants: number and 32-bit pattern.
pub type Constants = Vec<(u32, u32)>;

/// Where a kernel is as steep as f32 lets it be: infinity times a radius of 0 would be NaN.
const STEEPEST: f64 = 1e30;

/// The number of the rasterizer's constant, which all that sets splats up or draws them has.
pub const RASTERIZER: u32 = 7;

/// The number of the constant that tells closed transparent things.
pub const OUTWARD: u32 = 13;

/// The number of the constant that tells transparent splats.
pub const IN_LAYERS: u32 = 14;

/// The number of the constant that tells packed splats.
pub const PACKED: u32 = 15;

/// The number of the constant that leaves splats out which face away.
const CULL_BACKFACES: u32 = 1;

/// Whether splats that face away are left out.
pub fn culls(constants: &Constants) -> bool {
    constants.contains(&(CULL_BACKFACES, 1))
}

/// The constants of the splat passes for one kind of chunk.
pub fn splat_constants(settings: &Settings, ellipses: bool, closed: bool) -> Constants {
    let cull = match settings.backfaces {
        Backfaces::Auto => closed,
        Backfaces::Flip => false,
        Backfaces::Cull => true,
    };
    let filter = match settings.filter {
        Filter::None => 0,
        Filter::Adjust => 1,
        Filter::AdjustPaper => 2,
        Filter::Max => 3,
        Filter::Ewa => 4,
    };
    let rasterizer = match settings.rasterizer {
        Rasterizer::Auto | Rasterizer::Perspective | Rasterizer::Quad | Rasterizer::Compute => 0,
        Rasterizer::PerspectivePaper => 1,
        Rasterizer::Raycast => 2,
        Rasterizer::RaycastApproximate => 3,
        Rasterizer::AffineCenter => 4,
        Rasterizer::AffineContour => 5,
        Rasterizer::Triangle => 6,
    };
    let mut constants = kernel_constants(settings.kernel);
    constants.extend([
        (0, u32::from(ellipses)),
        (CULL_BACKFACES, u32::from(cull)),
        (2, filter),
        (RASTERIZER, rasterizer),
        (8, u32::from(settings.filter.adjusts() && settings.filter_weight == FilterWeight::Area)),
        (9, u32::from(settings.early_depth)),
        (11, u32::from(may_count_from_corner(settings))),
        (10, (coverage_r2(settings.kernel) as f32).to_bits()),
    ]);
    constants
}

/// Whether splats are so wide, and the image so small, that a place's rounding is nothing to them; see
/// `glsl/inc/places.glsl`.
fn may_count_from_corner(settings: &Settings) -> bool {
    const LARGEST_PX: u32 = 8192;
    matches!(settings.filter, Filter::Adjust | Filter::Ewa)
        && settings.size_px.iter().all(|side| *side <= LARGEST_PX)
}

/// The largest u² + v² that covers.
fn coverage_r2(kernel: Kernel) -> f64 {
    match kernel {
        Kernel::Gaussian { sigma } => gaussian_coverage_r2(sigma.into()),
        Kernel::PsiE { a, n, .. } => psi_e_coverage_r2(a.into(), n.into()),
    }
}

/// The constants of what evaluates the kernel.
pub fn kernel_constants(kernel: Kernel) -> Constants {
    let (kernel, a, n) = match kernel {
        Kernel::Gaussian { sigma } => (0, LOG2_E * 0.5 / f64::from(sigma).powi(2), 1.0),
        Kernel::PsiE { a, n, .. } => (1, LOG2_E * f64::from(a), n),
    };
    vec![(3, kernel), (4, (a.min(STEEPEST) as f32).to_bits()), (5, n.to_bits())]
}

/// The constant of where splats and polygons meet.
pub fn transition_constant(transition: Transition) -> (u32, u32) {
    let number = match transition {
        Transition::Color | Transition::Paper => 0,
        Transition::Attributes => 1,
        Transition::None => 2,
    };
    (12, number)
}

/// The constants of what shades, under so many lights of the scene's own.
pub fn shading_constants(shading: Shading, lights: u32) -> Constants {
    let number = match shading {
        Shading::Phong => 0,
        Shading::Lambert => 1,
        Shading::Normals => 2,
        Shading::Albedo => 3,
    };
    let mut constants = vec![(6, number)];
    if lights > 0 {
        constants.push((21, lights));
    }
    constants
}
