//! How a scene is rendered. The default of each setting is the first value of its option in the manual.

use super::{
    Layers, Light, MOST_LIGHTS, Object, Scene, Shapes, TileMemory,
    methods::{
        Accumulate, Cull, Filter, FilterWeight, KernelEval, LastLayer, Rasterizer, TileInvocations,
        Transition,
    },
};
use crate::error::{Error, Result};

/// Every choice that changes the picture, apart from scene and camera.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// Width and height in pixels.
    pub size_px: [u32; 2],
    /// How a splat becomes fragments.
    pub rasterizer: Rasterizer,
    /// What an invocation draws of a tile.
    pub tile_invocations: TileInvocations,
    /// The most that lists of splats by tile take.
    pub tile_memory: TileMemory,
    /// The screen-space low-pass filter.
    pub filter: Filter,
    /// What a splat weighs that the filter has enlarged.
    pub filter_weight: FilterWeight,
    /// The reconstruction kernel.
    pub kernel: Kernel,
    /// How the kernel is evaluated.
    pub kernel_eval: KernelEval,
    /// Where splats are left out that are not seen.
    pub cull: Cull,
    /// The precision of the sums.
    pub accumulate: Accumulate,
    /// The depth within which splats are one surface.
    pub epsilon: Epsilon,
    /// What happens to splats that face away.
    pub backfaces: Backfaces,
    /// How many transparent surfaces of a pixel are told apart.
    pub layers: Layers,
    /// What becomes of those behind them.
    pub last_layer: LastLayer,
    /// How splats and polygons of one surface meet.
    pub transition: Transition,
    /// How a surface becomes a color.
    pub shading: Shading,
    /// The color of empty pixels as sRGB values 0–1; `None` leaves them transparent (and black).
    pub background: Option<[f32; 3]>,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            size_px: [1024, 1024],
            rasterizer: Rasterizer::default(),
            tile_invocations: TileInvocations::default(),
            tile_memory: TileMemory::default(),
            filter: Filter::default(),
            filter_weight: FilterWeight::default(),
            kernel: Kernel::default(),
            kernel_eval: KernelEval::default(),
            cull: Cull::default(),
            accumulate: Accumulate::default(),
            epsilon: Epsilon::Radii(1.0),
            backfaces: Backfaces::Auto,
            layers: Layers::default(),
            last_layer: LastLayer::default(),
            transition: Transition::default(),
            shading: Shading::Phong,
            background: Some([1.0; 3]),
        }
    }
}

/// The most pixels along a side.
const MAX_SIDE_PX: u32 = 65_536;

impl Settings {
    /// Refuses settings that have no picture.
    ///
    /// # Errors
    /// [`crate::error::ErrorKind::Option`] for a side outside 1–65536 pixels, kernel parameters that are not finite and
    /// above 0, an ε that is not finite and at least 0, a background outside 0–1; for a filter that the rasterizer or
    /// the kernel rules out, and a weight by area without an adjusting filter.
    pub fn validate(&self) -> Result<()> {
        let [width, height] = self.size_px;
        if !self.size_px.iter().all(|side| (1..=MAX_SIDE_PX).contains(side)) {
            let problem = format!("{width}x{height}: expected 1 to {MAX_SIDE_PX} pixels a side");
            return Err(Error::option("--size", problem));
        }
        self.kernel.validate()?;
        self.filter.check(self.rasterizer)?;
        if self.rasterizer == Rasterizer::Compute && self.kernel_eval == KernelEval::Texture {
            let problem =
                "texture: compute finds kernels by arithmetic; expected analytic or another rasterizer";
            return Err(Error::option("--kernel-eval", problem));
        }
        if self.filter == Filter::Ewa && !matches!(self.kernel, Kernel::Gaussian { .. }) {
            let problem = "ewa: adds covariances, which psi_e has none of; expected --kernel gaussian:S";
            return Err(Error::option("--filter", problem));
        }
        let (Epsilon::Radii(epsilon) | Epsilon::Length(epsilon)) = self.epsilon;
        if !(epsilon >= 0.0 && epsilon.is_finite()) {
            return Err(Error::option(
                "--epsilon",
                format!("{epsilon}: expected a finite number, at least 0"),
            ));
        }
        self.layers.validate()?;
        if let Some(color) = self.background
            && !color.iter().all(|component| (0.0..=1.0).contains(component))
        {
            let [red, green, blue] = color;
            let problem = format!("{red},{green},{blue}: expected three numbers from 0 to 1");
            return Err(Error::option("--background", problem));
        }
        Ok(())
    }

    /// Refuses a filter that the splats of an object rule out.
    ///
    /// # Errors
    /// [`crate::error::ErrorKind::Option`] for `adjust-paper` where an object has elliptic splats; for lights that are
    /// none, or too many.
    pub fn check_scene(&self, scene: &Scene) -> Result<()> {
        scene.lights.iter().try_for_each(Light::validate)?;
        if scene.lights.len() > MOST_LIGHTS {
            let problem = format!("{}: expected at most {MOST_LIGHTS}", scene.lights.len());
            return Err(Error::option("lights", problem));
        }
        let is_elliptic = |object: &Object| matches!(object.splats.shapes, Shapes::Ellipses { .. });
        scene.objects.iter().try_for_each(|object| self.check_object(&object.name, is_elliptic(object)))
    }

    /// Whether an object of this name, whose splats are ellipses or not, can be drawn so.
    ///
    /// # Errors
    /// As [`Self::check_scene`].
    pub fn check_object(&self, object: &str, ellipses: bool) -> Result<()> {
        if self.filter == Filter::AdjustPaper && ellipses {
            let problem =
                format!("adjust-paper: {object} has elliptic splats, it holds for disks; use adjust");
            return Err(Error::option("--filter", problem));
        }
        Ok(())
    }
}

/// The reconstruction kernel over the splat's own `r = √(u²+v²)`; zero beyond `r = 1`.
///
/// A fragment whose weight is below 2⁻²⁴ does not cover its pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kernel {
    /// `exp(−r²/2σ²)`.
    Gaussian {
        /// σ in radii, above 0.
        sigma: f32,
    },
    /// `exp(−a q/(1−q))`, `q = rⁿ` (Pajarola, Sainz, Guidotti 2003, section 4). The paper's `b` scales its own r
    /// and the support alike, so that it cancels here.
    PsiE {
        /// Fall-off, above 0.
        a: f32,
        /// The paper's support radius, above 0; without effect on the unit disk.
        b: f32,
        /// Flatness of the top, above 0.
        n: f32,
    },
}

impl Kernel {
    fn validate(&self) -> Result<()> {
        let parameters: &[(&str, f32)] = match *self {
            Self::Gaussian { sigma } => &[("gaussian: σ", sigma)],
            Self::PsiE { a, b, n } => &[("psi_e: a", a), ("psi_e: b", b), ("psi_e: n", n)],
        };
        for (name, value) in parameters {
            if !(*value > 0.0 && value.is_finite()) {
                let problem = format!("{name} is {value}: expected a finite number above 0");
                return Err(Error::option("--kernel", problem));
            }
        }
        Ok(())
    }
}

impl Default for Kernel {
    fn default() -> Self {
        Self::Gaussian { sigma: 0.5 }
    }
}

/// The depth ε within which a fragment belongs to the nearest surface of its pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Epsilon {
    /// A multiple of the splat's larger radius, at least 0.
    Radii(f64),
    /// A length in world units, at least 0.
    Length(f64),
}

/// What happens to splats whose normal points away from the eye.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Backfaces {
    /// `Cull` for objects that are closed and opaque, `Flip` for the others.
    #[default]
    Auto,
    /// Their normal is turned to the eye.
    Flip,
    /// They are not drawn.
    Cull,
}

/// How a surface becomes a color: one white light at the eye, no attenuation.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Shading {
    /// Lambert plus `0.2 max(r·v, 0)³²`.
    #[default]
    Phong,
    /// `albedo (0.1 + 0.9 n·l)`.
    Lambert,
    /// The normal as a color: `(n_x, −n_y, −n_z)/2 + ½` of the view-space normal.
    Normals,
    /// The albedo itself.
    Albedo,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_defaults_and_the_ends_of_the_ranges_are_accepted() {
        Settings::default().validate().unwrap();
        let ends = Settings {
            size_px: [1, 65_536],
            epsilon: Epsilon::Length(0.0),
            kernel: Kernel::PsiE { a: 1e-30, b: 1e30, n: 1.0 },
            background: Some([0.0, 0.5, 1.0]),
            ..Settings::default()
        };
        ends.validate().unwrap();
        Settings { background: None, ..ends }.validate().unwrap();
    }

    #[test]
    fn each_value_out_of_range_is_refused_under_its_options_name() {
        let good = Settings::default;
        let gaussian = |sigma| Settings { kernel: Kernel::Gaussian { sigma }, ..good() };
        let psi_e = |a, b, n| Settings { kernel: Kernel::PsiE { a, b, n }, ..good() };
        let background = |blue| Settings { background: Some([0.0, 1.0, blue]), ..good() };
        let cases = [
            ("--size", Settings { size_px: [0, 5], ..good() }),
            ("--size", Settings { size_px: [5, 65_537], ..good() }),
            ("--kernel", gaussian(0.0)),
            ("--kernel", gaussian(-1.0)),
            ("--kernel", gaussian(f32::NAN)),
            ("--kernel", psi_e(f32::INFINITY, 1.0, 1.0)),
            ("--kernel", psi_e(1.0, 0.0, 1.0)),
            ("--kernel", psi_e(1.0, 1.0, f32::NAN)),
            ("--filter", Settings { filter: Filter::Ewa, ..psi_e(6.0, 1.5, 3.0) }),
            ("--filter", Settings { filter: Filter::Ewa, rasterizer: Rasterizer::Raycast, ..good() }),
            ("--epsilon", Settings { epsilon: Epsilon::Radii(-1e-9), ..good() }),
            ("--epsilon", Settings { epsilon: Epsilon::Length(f64::NAN), ..good() }),
            ("--epsilon", Settings { epsilon: Epsilon::Length(f64::INFINITY), ..good() }),
            ("--layers", Settings { layers: Layers::Fixed(0), ..good() }),
            ("--layers", Settings { layers: Layers::Auto(257), ..good() }),
            ("--background", background(1.1)),
            ("--background", background(-0.1)),
            ("--background", background(f32::NAN)),
        ];
        for (option, settings) in cases {
            let error = settings.validate().expect_err(option);
            assert_eq!(error.exit_code(), 1);
            assert!(error.to_string().starts_with(option), "{error}");
        }
    }
}
