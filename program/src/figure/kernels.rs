//! Figures of kernels with the papers' parameters: their curves as the device draws them.

use glam::{DVec3, Vec3};
use surfel::{
    Result,
    prepare::PreparedScene,
    report::{Axis, Plot},
    scene::{Accumulate, Camera, Colors, Filter, Kernel, Object, Scene, Settings, Shapes, Splats},
};

use super::context::FigureContext;

/// A curve: its name and its points, from left to right.
type Curve = (String, Vec<(f64, f64)>);

/// The largest radius in Pajarola's figures, in the units of his r: where all kernels end.
const SUPPORT: f64 = 1.5;

/// Parameters of ψ_E, in the paper's own units.
#[derive(Clone, Copy, Debug)]
pub struct PsiE {
    /// Fall-off.
    pub a: f32,
    /// The radius of the support.
    pub b: f32,
    /// Flatness of the top.
    pub n: f32,
}

impl PsiE {
    /// The kernel of the settings.
    pub fn kernel(self) -> Kernel {
        let Self { a, b, n } = self;
        Kernel::PsiE { a, b, n }
    }

    /// For a label.
    pub fn text(self) -> String {
        let Self { a, b, n } = self;
        format!("psi_E: a = {a}, b = {b}, n = {n}")
    }
}

/// Points of a curve after the one at r = 0, a pixel each. The disk's rim is half a pixel beyond the last: whether a pixel
/// exactly on the rim is covered is a matter of rounding.
const POINTS: u16 = 250;
const RADIUS_PX: f64 = POINTS as f64 + 0.5;

/// A plot of kernels over r, whose axis is so named.
fn plot(title: [&str; 3], r: &str, curves: Vec<Curve>) -> Plot {
    let axes = [Axis::linear(r, 0.0..SUPPORT), Axis::linear("weight", 0.0..1.0)];
    Plot::of_curves(title.map(str::to_owned).to_vec(), axes, curves)
}

/// One disk seen straight on, so large that its weights along a row of pixels are the kernel's curve.
struct KernelBench {
    scene: PreparedScene,
    camera: Camera,
}

impl KernelBench {
    /// Uploads the disk.
    pub fn new(context: &FigureContext<'_>) -> Result<Self> {
        let splats = Splats::new(
            vec![DVec3::ZERO],
            Shapes::Disks { normals: vec![Vec3::Z], radii: vec![1.0] },
            Colors::Uniform([1.0; 4]),
        );
        let object = Object { name: "disk".to_owned(), splats, closed: false };
        let distance = 10.0;
        // In a picture one pixel high.
        let fov_y_rad = 2.0 * (0.5 / (RADIUS_PX * distance)).atan();
        let camera = Camera {
            eye: DVec3::Z * distance,
            target: DVec3::ZERO,
            up: DVec3::Y,
            fov_y_rad,
            ..Camera::default()
        };
        Ok(Self { scene: context.prepare(&Scene::from(object))?, camera })
    }

    /// The weights over r, in units in which the disk's rim is at [`SUPPORT`].
    pub fn curve(&self, context: &mut FigureContext<'_>, name: String, kernel: Kernel) -> Result<Curve> {
        let settings = Settings {
            // The middle pixel's center is the disk's.
            size_px: [2 * u32::from(POINTS) + 1, 1],
            filter: Filter::None,
            accumulate: Accumulate::F32,
            kernel,
            ..Settings::default()
        };
        let weights = context.weights(&self.scene, &self.camera, &settings)?;
        let right = weights.iter().skip(POINTS.into());
        let point = |(i, weight): (u16, &f32)| (SUPPORT * f64::from(i) / RADIUS_PX, f64::from(*weight));
        Ok((name, (0..=POINTS).zip(right).map(point).collect()))
    }
}

/// The paper's σ, in the units of its r.
const SIGMAS: [f32; 6] = [0.2, 0.3, 0.5, 0.6, 0.8, 1.0];

/// Pajarola et al. 2003, figure 9: Gaussian kernels.
pub fn p9(context: &mut FigureContext<'_>) -> Result<Plot> {
    let bench = KernelBench::new(context)?;
    let curves = SIGMAS.iter().map(|&sigma| {
        // In the settings σ is in radii.
        let kernel = Kernel::Gaussian { sigma: sigma / SUPPORT as f32 };
        bench.curve(context, format!("σ = {sigma}"), kernel)
    });
    let title = [
        "Gaussian blending kernels (Pajarola et al. 2003, figure 9)",
        "ψ_G(r) = exp(−r²/2σ²), cut off where the splat ends, at r = 1.5",
        "Weights of one splat as the device draws it; the paper has a plot for each σ.",
    ];
    Ok(plot(title, "r (the paper's: the splat's rim is at 1.5)", curves.collect::<Result<_>>()?))
}

/// The paper's pairs of n and a.
const PAIRS: [[f32; 2]; 6] = [[2.0, 8.0], [2.0, 1.0], [3.0, 20.0], [3.0, 5.0], [5.0, 50.0], [5.0, 4.0]];

/// Pajarola et al. 2003, figure 10: the kernels ψ_E.
pub fn p10(context: &mut FigureContext<'_>) -> Result<Plot> {
    let bench = KernelBench::new(context)?;
    let curves = PAIRS.iter().map(|&[n, a]| {
        let kernel = PsiE { a, b: SUPPORT as f32, n };
        bench.curve(context, format!("n = {n}, a = {a}"), kernel.kernel())
    });
    let title = [
        "Blending kernels with plateaus (Pajarola et al. 2003, figure 10)",
        "ψ_E(r) = exp(−a q/(1−q)), q = (r/b)ⁿ, b = 1.5: a narrows the kernel, n flattens its top",
        "Weights of one splat as the device draws it; the paper has a plot for each pair.",
    ];
    Ok(plot(title, "r (the paper's: the splat's rim is at b = 1.5)", curves.collect::<Result<_>>()?))
}
