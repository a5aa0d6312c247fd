//! Kernels with the papers' parameters, and their curves as the device draws them.

use glam::{DVec3, Vec3};
use surfel::{
    Result,
    prepare::PreparedScene,
    report::curves::Curve,
    scene::{Accumulate, Camera, Colors, Filter, Kernel, Object, Scene, Settings, Shapes, Splats},
};

use super::easel::Easel;

/// The largest radius in Pajarola's figures, in the units of his r: where all kernels end.
pub const SUPPORT: f64 = 1.5;

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

/// One disk seen straight on, so large that its weights along a row of pixels are the kernel's curve.
pub struct Bench {
    scene: PreparedScene,
    camera: Camera,
}

impl Bench {
    /// Uploads the disk.
    ///
    /// # Errors
    /// As the easel's.
    pub fn new(easel: &Easel<'_>) -> Result<Self> {
        let splats = Splats {
            positions: vec![DVec3::ZERO],
            shapes: Shapes::Disks { normals: vec![Vec3::Z], radii: vec![1.0] },
            colors: Colors::Uniform([1.0; 4]),
        };
        let object = Object { name: "disk".to_owned(), splats, closed: false };
        let distance = 10.0;
        // In a picture one pixel high.
        let fov_y_rad = 2.0 * (0.5 / (RADIUS_PX * distance)).atan();
        let camera =
            Camera { eye: DVec3::Z * distance, target: DVec3::ZERO, up: DVec3::Y, fov_y_rad, near: None };
        Ok(Self { scene: easel.prepare(&Scene { objects: vec![object], ..Scene::default() })?, camera })
    }

    /// The weights over r, in units in which the disk's rim is at [`SUPPORT`].
    ///
    /// # Errors
    /// As the easel's.
    pub fn curve(&self, easel: &mut Easel<'_>, name: String, kernel: Kernel) -> Result<Curve> {
        let settings = Settings {
            // The middle pixel's center is the disk's.
            size_px: [2 * u32::from(POINTS) + 1, 1],
            filter: Filter::None,
            accumulate: Accumulate::F32,
            kernel,
            ..Settings::default()
        };
        let weights = easel.weights(&self.scene, &self.camera, &settings)?;
        let right = weights.iter().skip(POINTS.into());
        let point = |(i, weight): (u16, &f32)| (SUPPORT * f64::from(i) / RADIUS_PX, f64::from(*weight));
        Ok(Curve { name, points: (0..=POINTS).zip(right).map(point).collect() })
    }
}
