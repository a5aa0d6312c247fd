//! How a scene is rendered. The default of each setting is the first value of its option in the manual.

/// Every choice that changes the picture, apart from scene and camera.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// Width and height in pixels.
    pub size_px: [u32; 2],
    /// The screen-space low-pass filter.
    pub filter: Filter,
    /// The reconstruction kernel.
    pub kernel: Kernel,
    /// The precision of the sums.
    pub accumulate: Accumulate,
    /// The depth within which splats are one surface.
    pub epsilon: Epsilon,
    /// What happens to splats that face away.
    pub backfaces: Backfaces,
    /// How a surface becomes a color.
    pub shading: Shading,
    /// The color of empty pixels as sRGB values 0–1; `None` leaves them transparent (and black).
    pub background: Option<[f32; 3]>,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            size_px: [1024, 1024],
            filter: Filter::Adjust,
            kernel: Kernel::default(),
            accumulate: Accumulate::F16,
            epsilon: Epsilon::Radii(1.0),
            backfaces: Backfaces::Auto,
            shading: Shading::Phong,
            background: Some([1.0; 3]),
        }
    }
}

/// The screen-space low-pass filter (Guennebaud et al. 2006, section 4). Its radius is √2 pixels.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Filter {
    /// Tangent adjustment after a rotation of the parametrization that makes the projected axes orthogonal, so
    /// that it is exact for ellipses too.
    #[default]
    Adjust,
    /// No filter: a splat that misses every pixel center is not seen.
    None,
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

impl Default for Kernel {
    fn default() -> Self {
        Self::Gaussian { sigma: 0.5 }
    }
}

/// The precision of the sums of weights, colors and normals.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Accumulate {
    /// 16-bit floats: a sum of unit weights stalls at 2048.
    #[default]
    F16,
    /// 32-bit floats.
    F32,
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
    /// `Cull` for objects that are closed, `Flip` for the others.
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
