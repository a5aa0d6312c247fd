//! From the fragments of the nearest surface to one normalized surface point, and its color.

use glam::DVec3;

use super::fragment::Fragment;
use super::shade::Shader;
use super::splat::DrawnSplat;

/// The shifted depth that a fragment must not exceed, and whose it is.
#[derive(Clone, Copy)]
pub(super) struct Nearest {
    pub z_shifted: f64,
    pub splat: usize,
}

impl Nearest {
    /// The nearest thing of a pixel without a splat.
    pub const NONE: Self = Self { z_shifted: f64::INFINITY, splat: usize::MAX };
}

/// The weighted sums of a pixel.
#[derive(Clone, Copy, Default)]
pub(super) struct Sums {
    pub weight: f64,
    pub fragments: u32,
    albedo: DVec3,
    pub normal: DVec3,
    z: f64,
    alpha: f64,
}

/// The surface that a pixel sees.
pub(super) struct Surface {
    /// Linear.
    pub albedo: DVec3,
    /// Unit.
    pub normal: DVec3,
    /// The length of the mean of the normals.
    pub normal_length: f64,
    pub depth: f64,
    /// Straight.
    pub alpha: f64,
    /// Linear and shaded.
    pub color: DVec3,
}

/// The attributes of a surface point that are shaded and blended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Attributes {
    /// Linear.
    pub albedo: DVec3,
    /// Unit, in view space.
    pub normal: DVec3,
    /// Straight.
    pub alpha: f64,
}

impl Surface {
    pub fn attributes(&self) -> Attributes {
        Attributes { albedo: self.albedo, normal: self.normal, alpha: self.alpha }
    }
}

/// A sum of normals shorter than this share of the sum of weights is rounding noise and has no direction.
const VANISHING: f64 = 1e-12;

impl Sums {
    /// A fragment of a transparent layer.
    pub fn add_in_layer(&mut self, fragment: Fragment, splat: &DrawnSplat) {
        self.add(fragment, &DrawnSplat { normal: splat.normal_in_layer, ..*splat });
    }

    pub fn add(&mut self, fragment: Fragment, splat: &DrawnSplat) {
        self.weight += fragment.weight;
        self.fragments += 1;
        self.albedo += fragment.weight * splat.albedo;
        self.normal += fragment.weight * splat.normal;
        self.z += fragment.weight * fragment.z;
        self.alpha += fragment.weight * splat.alpha;
    }

    /// Guennebaud et al. 2006, eq. 1, then the shading; `None` where nothing was added.
    pub fn surface(&self, shader: &Shader, ray: DVec3) -> Option<Surface> {
        if self.weight <= 0.0 {
            return None;
        }
        let albedo = self.albedo / self.weight;
        let normal = direction(self.normal, self.weight);
        Some(Surface {
            albedo,
            normal,
            normal_length: self.normal.length() / self.weight,
            depth: self.z / self.weight,
            alpha: self.alpha / self.weight,
            color: shader.shade(albedo, normal, ray),
        })
    }
}

/// The direction of a sum of unit normals whose weights sum to `weight`; toward the eye where they cancel.
pub(super) fn direction(sum: DVec3, weight: f64) -> DVec3 {
    if sum.length() <= VANISHING * weight { DVec3::NEG_Z } else { sum.normalize() }
}
