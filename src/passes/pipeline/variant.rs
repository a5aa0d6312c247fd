//! What differs between pipelines of the same shader: the host's mirror of `glsl/inc/variant.glsl`.

use std::f64::consts::LOG2_E;

use crate::{
    inline_vec::InlineVec,
    math::kernel::{gaussian_coverage_r2, gaussian_mean, psi_e_coverage_r2, psi_e_mean},
    scene::{Filter, FilterWeight, Kernel, Outlines, Rasterizer, Settings, Shading, Transition},
    shaders::config::*,
};

/// Specialization constants: number and 32-bit pattern. No pipeline has as many as there is room for.
pub type Constants = InlineVec<(u32, u32), 48>;

/// Where a kernel is as steep as f32 lets it be: infinity times a radius of 0 would be NaN.
const STEEPEST: f64 = 1e30;

/// Whether splats that face away are left out.
pub fn culls(constants: &Constants) -> bool {
    constants.contains(&(SPEC_CULL_BACKFACES, 1))
}

/// The constants of the splat passes for one kind of chunk, in an image that is a part of a whole picture of that size.
pub fn splat_constants(settings: &Settings, whole_px: [u32; 2], ellipses: bool, closed: bool) -> Constants {
    let cull = settings.culls(closed);
    let filter = match settings.filter {
        Filter::None => FILTER_NONE,
        Filter::Adjust => FILTER_ADJUST,
        Filter::AdjustPaper => FILTER_ADJUST_PAPER,
        Filter::Max => FILTER_MAX,
        Filter::Ewa => FILTER_EWA,
    };
    let rasterizer = match settings.rasterizer {
        Rasterizer::Auto | Rasterizer::Perspective | Rasterizer::Quad | Rasterizer::Compute => {
            RASTERIZER_PERSPECTIVE
        }
        Rasterizer::PerspectivePaper => RASTERIZER_PERSPECTIVE_PAPER,
        Rasterizer::Raycast => RASTERIZER_RAYCAST,
        Rasterizer::RaycastApproximate => RASTERIZER_RAYCAST_APPROXIMATE,
        Rasterizer::AffineCenter => RASTERIZER_AFFINE_CENTER,
        Rasterizer::AffineContour => RASTERIZER_AFFINE_CONTOUR,
        Rasterizer::Triangle => RASTERIZER_TRIANGLE,
    };
    let mut constants = kernel_constants(settings.kernel);
    constants.extend([
        (SPEC_ELLIPSES, u32::from(ellipses)),
        (SPEC_CULL_BACKFACES, u32::from(cull)),
        (SPEC_FILTER, filter),
        (SPEC_RASTERIZER, rasterizer),
        (
            SPEC_WEIGHT_BY_AREA,
            u32::from(settings.filter.adjusts() && settings.filter_weight == FilterWeight::Area),
        ),
        (SPEC_FROM_CORNER, u32::from(may_count_from_corner(settings, whole_px))),
        (SPEC_COVERAGE_R2, (coverage_r2(settings.kernel) as f32).to_bits()),
    ]);
    constants
}

/// Whether splats are so wide, and the image so small, that a place's rounding is nothing to them; see
/// `glsl/inc/places.glsl`.
fn may_count_from_corner(settings: &Settings, whole_px: [u32; 2]) -> bool {
    const LARGEST_PX: u32 = 8192;
    // Samples are filtered less.
    let wide = matches!(settings.filter, Filter::Adjust | Filter::Ewa) && settings.samples.0 == 1;
    wide && whole_px.iter().all(|side| *side <= LARGEST_PX)
}

/// What splats sum to on a surface, over what they sum to under the default kernel: in the mean, as much as their kernels are.
pub(crate) fn sums_under(kernel: Kernel) -> f64 {
    let end = coverage_r2(kernel);
    let mean = match kernel {
        Kernel::Gaussian { sigma } => gaussian_mean(sigma.into(), end),
        Kernel::PsiE { a, n, .. } => psi_e_mean(a.into(), n.into(), end),
    };
    mean / gaussian_mean(0.5, 1.0)
}

/// The constant of what sums splats with their outlines, if it does.
pub(crate) fn outline_constant(settings: &Settings) -> Option<(u32, u32)> {
    (settings.outlines == Outlines::Splats).then_some((SPEC_OUTLINES, 1))
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
        Kernel::Gaussian { sigma } => (KERNEL_GAUSSIAN, LOG2_E * 0.5 / f64::from(sigma).powi(2), 1.0),
        Kernel::PsiE { a, n, .. } => (KERNEL_PSI_E, LOG2_E * f64::from(a), n),
    };
    [(SPEC_KERNEL, kernel), (SPEC_KERNEL_A, (a.min(STEEPEST) as f32).to_bits()), (SPEC_KERNEL_N, n.to_bits())]
        .into()
}

/// The constant of where splats and polygons meet.
fn transition_constant(transition: Transition) -> (u32, u32) {
    let number = match transition {
        Transition::Color | Transition::Paper => TRANSITION_COLOR,
        Transition::Attributes => TRANSITION_ATTRIBUTES,
        Transition::None => TRANSITION_NONE,
    };
    (SPEC_TRANSITION, number)
}

/// The constants of what shades, under so many lights of the scene's own.
pub fn shading_constants(shading: Shading, lights: u32) -> Constants {
    let number = match shading {
        Shading::Phong => SHADING_PHONG,
        Shading::Lambert => SHADING_LAMBERT,
        Shading::Normals => SHADING_NORMALS,
        // What eye-dome lighting makes darker.
        Shading::Albedo | Shading::EyeDome => SHADING_ALBEDO,
    };
    [(SPEC_SHADING, number), (SPEC_LIGHTS, lights)].into()
}

/// The specialization constants of what shades sums of splats, polygons, or both (`glsl/inc/resolve.glsl`).
pub fn resolve_constants(settings: &Settings, splats: bool, polygons: bool, lights: u32) -> Constants {
    let mut constants = shading_constants(settings.shading, lights);
    constants.extend([
        transition_constant(settings.transition),
        (SPEC_SPLATS, splats.into()),
        (SPEC_POLYGONS, polygons.into()),
    ]);
    constants
}
