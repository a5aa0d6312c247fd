//! How far what was drawn is from the truth.

use glam::{DVec3, Vec3};
use surfel::{math::srgb::linear_from_srgb, scene::Kernel};

use super::truth::Truth;

/// What a method shows of each pixel; empty where it does not show that.
#[derive(Default)]
pub struct Seen {
    pub covered: Vec<bool>,
    pub weight: Vec<f32>,
    /// Linear.
    pub albedo: Vec<Vec3>,
    /// 8-bit sRGB.
    pub srgb: Vec<[u8; 4]>,
    pub normal: Vec<Vec3>,
    pub depth: Vec<f32>,
}

/// Pictures of one kind, the worst of their compared pixels.
#[derive(Clone, Copy, Debug, Default)]
pub struct Errors {
    pub pictures: usize,
    /// Covered pixels that were compared.
    pub compared: usize,
    /// Covered pixels that rounding may turn: a rim, the ε-threshold or the near plane is at their centers.
    pub exempt: usize,
    /// Pixels that the oracle has covered, and the device has not.
    pub missed: usize,
    /// Pixels that the device has covered, and the oracle has not.
    pub surplus: usize,
    /// Σw, relative; of kernels that fall to nothing, relative to e⁻² at least.
    pub weight: f64,
    /// Linear, absolute.
    pub albedo: f64,
    /// Degrees, times the length of the mean of the normals.
    pub normal_deg: f64,
    /// Relative.
    pub depth: f64,
    /// Pictures with something beyond its bound.
    pub beyond: usize,
}

/// What rounding to f32 may do to a scene whose numbers are as good as f32 has them, beyond what [`super::truth::Change`] says of a place
/// that is off by 4e-5 px.
///
/// Weights: tangent vectors, their products and the determinant are some dozen roundings of 2⁻²⁴, 1e-6 together, of r² where the splat
/// is seen at an angle; seen nearly edge-on they are divided by the cosine of it, of which the hundredth part of a radian costs two
/// digits: 1e-4 of r². The default's d ln w / d r² is −2, and −10 that of ψ_E where its weight counts: 1e-3. A sum is no worse.
/// Albedos and normals are means: weights that are off by 1e-3 move them by less than 1e-3 of what they differ by; normals of f32
/// are 1e-5 degrees off by themselves. 1/1024 and 0.1°, times the length of the mean.
/// Depths: 1e-4, because a plane's depth is as steep as the plane is tilted. These are the self-test's own bounds
/// ([`surfel::selftest::agreement::F32`]).
pub const F32: Errors = Errors {
    pictures: 0,
    compared: 0,
    exempt: 0,
    missed: 0,
    surplus: 0,
    weight: 1e-3,
    albedo: 1.0 / 1024.0,
    normal_deg: 0.1,
    depth: 1e-4,
    beyond: 0,
};

impl Errors {
    /// Of one picture.
    pub fn of(seen: &Seen, truth: &Truth, kernel: Kernel) -> Self {
        let mut errors = Self { pictures: 1, ..Self::default() };
        for (i, expected) in truth.picture.pixels.iter().enumerate() {
            let (covered, covers) = (seen.covered[i], expected.is_covered());
            if !covered && !covers {
                continue;
            }
            if truth.undecided[i] {
                errors.exempt += 1;
                continue;
            }
            errors.compared += 1;
            errors.missed += usize::from(covers && !covered);
            errors.surplus += usize::from(covered && !covers);
            if covered && covers {
                errors.add(seen, i, truth, kernel);
            }
        }
        errors
    }

    fn add(&mut self, seen: &Seen, i: usize, truth: &Truth, kernel: Kernel) {
        let (expected, change) = (&truth.picture.pixels[i], &truth.changes[i]);
        // A NaN is the worst of all.
        let worst = |worst: &mut f64, error: f64, change: f64, scale: f64| {
            let value = ((error - change) / scale).max(0.0);
            *worst = if error.is_nan() { f64::INFINITY } else { worst.max(value) };
        };
        if let Some(weight) = seen.weight.get(i) {
            // The default's least weight, at the rim of a splat of which a filter left the least.
            let least = if matches!(kernel, Kernel::Gaussian { .. }) { 0.135 / 16.0 } else { 0.135 };
            let error = (f64::from(*weight) - expected.weight).abs();
            worst(&mut self.weight, error, change.weight, expected.weight.max(least));
        }
        if let Some(albedo) = seen.albedo.get(i) {
            let error = (albedo.as_dvec3() - DVec3::from(expected.albedo)).abs();
            worst(&mut self.albedo, error.max_element(), change.albedo, 1.0);
        }
        if let Some(srgb) = seen.srgb.get(i) {
            for (srgb, expected) in srgb.iter().zip(expected.albedo) {
                // Anything that rounds to this level, and a tenth of a level more for 16-bit colors before it.
                let linear = |level: f64| f64::from(linear_from_srgb((level / 255.0) as f32));
                let (lo, hi) = (linear(f64::from(*srgb) - 0.6), linear(f64::from(*srgb) + 0.6));
                let error = (lo - expected).max(expected - hi).max(0.0);
                worst(&mut self.albedo, error, change.albedo, 1.0);
            }
        }
        if let Some(normal) = seen.normal.get(i) {
            let (a, b) = (normal.as_dvec3(), DVec3::from(expected.normal));
            let degrees = a.cross(b).length().atan2(a.dot(b)).to_degrees();
            let length = expected.normal_length;
            worst(&mut self.normal_deg, degrees * length, change.normal.to_degrees() * length, 1.0);
        }
        if let Some(depth) = seen.depth.get(i) {
            let error = (f64::from(*depth) - expected.depth).abs();
            worst(&mut self.depth, error, change.depth, expected.depth);
        }
    }

    /// Together with others.
    pub fn and(self, other: Self) -> Self {
        Self {
            pictures: self.pictures + other.pictures,
            compared: self.compared + other.compared,
            exempt: self.exempt + other.exempt,
            missed: self.missed + other.missed,
            surplus: self.surplus + other.surplus,
            weight: self.weight.max(other.weight),
            albedo: self.albedo.max(other.albedo),
            normal_deg: self.normal_deg.max(other.normal_deg),
            depth: self.depth.max(other.depth),
            beyond: self.beyond + other.beyond,
        }
    }

    /// What is beyond the bounds, in words; empty where nothing is.
    pub fn words_beyond(&self, limit: &Self) -> String {
        let figures = [
            ("missed", self.missed as f64, limit.missed as f64),
            ("surplus", self.surplus as f64, limit.surplus as f64),
            ("weight", self.weight, limit.weight),
            ("albedo", self.albedo, limit.albedo),
            ("normal", self.normal_deg, limit.normal_deg),
            ("depth", self.depth, limit.depth),
        ];
        let words = figures.iter().filter(|(_, value, limit)| value > limit);
        words.map(|(name, value, _)| format!("{name} {value:.1e}")).collect::<Vec<_>>().join(", ")
    }
}
