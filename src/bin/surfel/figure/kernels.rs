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

/// Pixels from the middle of the disk to its rim: as many points has a curve.
const RADIUS_PX: u16 = 750;

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
        let fov_y_rad = 2.0 * (0.5 / (f64::from(RADIUS_PX) * distance)).atan();
        let camera =
            Camera { eye: DVec3::Z * distance, target: DVec3::ZERO, up: DVec3::Y, fov_y_rad, near: None };
        Ok(Self { scene: easel.prepare(&Scene { objects: vec![object] })?, camera })
    }

    /// The weights over r, in units in which the disk's rim is at [`SUPPORT`].
    ///
    /// # Errors
    /// As the easel's.
    pub fn curve(&self, easel: &mut Easel<'_>, name: String, kernel: Kernel) -> Result<Curve> {
        let settings = Settings {
            // The middle pixel's center is the disk's.
            size_px: [2 * u32::from(RADIUS_PX) + 1, 1],
            filter: Filter::None,
            accumulate: Accumulate::F32,
            kernel,
            ..Settings::default()
        };
        let weights = easel.weights(&self.scene, &self.camera, &settings)?;
        let right = weights.iter().skip(RADIUS_PX.into());
        let point =
            |(i, weight): (u16, &f32)| (SUPPORT * f64::from(i) / f64::from(RADIUS_PX), f64::from(*weight));
        Ok(Curve { name, points: (0..=RADIUS_PX).zip(right).map(point).collect() })
    }
}
