//! GPU against oracle, pixel by pixel.

use std::collections::BTreeMap;

use crate::{
    reference::{Picture, Pixel},
    renderer::Frame,
};

/// The largest errors over the compared pixels.
#[derive(Clone, Copy, Debug, Default)]
pub struct Errors {
    /// Pixels covered in the oracle or on the GPU.
    pub covered: usize,
    /// Covered pixels that are left out because a fragment lies within 1e-4 of the ε-threshold.
    pub exempt_epsilon: usize,
    /// Covered pixels that are left out because a splat's rim passes through the pixel's center.
    pub exempt_rim: usize,
    /// Compared pixels.
    pub compared: usize,
    /// Compared pixels covered in one and empty in the other.
    pub coverage: usize,
    /// Σw, relative to itself or to [`SMALL_WEIGHT`], whichever is larger.
    pub weight: f64,
    /// Linear albedo, absolute.
    pub albedo: f64,
    /// Depth, relative.
    pub depth: f64,
    /// Degrees between normals.
    pub normal_deg: f64,
    /// `normal_deg` times the length of the mean of the normals: where they nearly cancel, errors of weights turn it by so much
    /// more.
    pub normal_sum_deg: f64,
    /// Shaded color, linear, absolute, beyond what the error of the pixel's normal, which has a limit of its own, makes of it
    /// ([`HIGHLIGHT_SLOPE`]); only where the frame has it.
    pub color: f64,
    /// NaN or infinite values in covered pixels.
    pub not_finite: usize,
}

/// The tolerances of 32-bit accumulation. f32 carries 6e-8 a step; the setup's few dozen steps, magnified by the
/// kernel's slope (4 at the rim) and by a splat's small axis in pixels, stay within 1e-3 of the weight; see the rim
/// exemption for what is beyond. Albedo and normal are means of the splats', so that only differences of weights
/// enter: 1/1024 and 0.1°. Depth is linear on the screen: 1e-4. The shaded color is as good as the albedo for the normal that
/// the pixel has: where disks seen at grazing angles cancel to a hundredth, the last bits of weights turn it by 0.05°.
pub const F32: Errors = Errors {
    covered: 0,
    exempt_epsilon: 0,
    exempt_rim: 0,
    compared: 1000,
    coverage: 0,
    weight: 1e-3,
    albedo: 1.0 / 1024.0,
    depth: 1e-4,
    normal_deg: 0.1,
    normal_sum_deg: 0.1,
    color: 1.0 / 1024.0,
    not_finite: 0,
};

/// e⁻², the default kernel's smallest weight. Kernels that fall to 2⁻²⁴ are steep at their end: d ln w / d r² is 116 for
/// ψ_E(6, 1.5, 3) and 50 for a Gaussian of σ = 0.1, where the default has 2. The same rounding of r² is there a
/// larger part of a weight, but of a weight that counts for nothing beside any other; in absolute terms ψ_E is as steep
/// as the default, |dw / d r²| ≤ 2.7 against 2.
pub const SMALL_WEIGHT: f64 = 0.135;

/// How much a shaded color may change with its normal, a radian: the headlight's highlight, 0.2 cos³² 2θ, has a slope of 1.38.
pub const HIGHLIGHT_SLOPE: f64 = 1.4;

/// How near to the ε-threshold a fragment exempts its pixel, relative.
const EPSILON_MARGIN: f64 = 1e-4;

/// Compares a frame that has its surface with the oracle's picture.
///
/// # Panics
/// Where they differ in size.
pub fn compare(frame: &Frame, oracle: &Picture) -> Errors {
    assert_eq!(frame.size_px, oracle.size_px);
    let mut errors = Errors::default();
    for (i, expected) in oracle.pixels.iter().enumerate() {
        let covered = frame.weight[i] > 0.0;
        if !covered && !expected.is_covered() {
            continue;
        }
        errors.covered += 1;
        errors.not_finite += not_finite(frame, i);
        if expected.rim {
            errors.exempt_rim += 1;
            continue;
        }
        if expected.epsilon_margin < EPSILON_MARGIN {
            errors.exempt_epsilon += 1;
            continue;
        }
        errors.compared += 1;
        if covered != expected.is_covered() {
            errors.coverage += 1;
            continue;
        }
        let worst = |worst: &mut f64, value: f64| {
            // A NaN is the worst of all.
            *worst = if value.is_nan() { f64::INFINITY } else { worst.max(value) };
        };
        let weight_scale = expected.weight.max(SMALL_WEIGHT);
        worst(&mut errors.weight, (f64::from(frame.weight[i]) - expected.weight).abs() / weight_scale);
        for c in 0..3 {
            worst(&mut errors.albedo, (f64::from(frame.albedo[i][c]) - expected.albedo[c]).abs());
        }
        worst(&mut errors.depth, (f64::from(frame.depth[i]) / expected.depth - 1.0).abs());
        let normal_deg = degrees_between(frame.normal[i], expected.normal);
        if let Some(color) = frame.linear.get(i) {
            // Beyond that limit, it is the color's own error again.
            let by_normal = HIGHLIGHT_SLOPE * normal_deg.min(F32.normal_deg).to_radians();
            for (got, expected) in color.iter().zip(expected.color) {
                worst(&mut errors.color, (f64::from(*got) - expected).abs() - by_normal);
            }
        }
        worst(&mut errors.normal_deg, normal_deg);
        worst(&mut errors.normal_sum_deg, normal_deg * expected.normal_length);
    }
    errors
}

/// Whether rounding alone can't turn a pixel.
pub(super) fn is_compared(expected: &Pixel) -> bool {
    !expected.rim && expected.epsilon_margin >= EPSILON_MARGIN
}

/// Values of a pixel that are NaN or infinite; an empty pixel's depth may be.
pub(super) fn not_finite(frame: &Frame, i: usize) -> usize {
    let surface = frame.albedo[i].iter().chain(&frame.normal[i]).chain([&frame.weight[i]]);
    let values = surface.chain(frame.linear.get(i).into_iter().flatten());
    let depth = frame.weight[i] > 0.0 && !frame.depth[i].is_finite();
    values.filter(|value| !value.is_finite()).count() + usize::from(depth)
}

/// How many values differ in at least one bit, over all that two frames of one size have.
pub fn different_values(a: &Frame, b: &Frame) -> usize {
    values_apart(a, b, |a, b| a.to_bits() != b.to_bits())
}

/// How many values differ by more than sums of the same terms in another order do. f32 rounds each of n sums by 2⁻²⁴ of itself: with up to
/// 64 splats in a pixel, and a shaded color that turns with its normal ([`HIGHLIGHT_SLOPE`]), by 2⁻¹⁷.
pub(super) fn values_of_other_terms(a: &Frame, b: &Frame) -> usize {
    values_apart(a, b, |a, b| {
        let apart = (a - b).abs();
        a.to_bits() != b.to_bits() && (apart.is_nan() || apart > a.abs().max(1.0) / 131_072.0)
    })
}

fn values_apart(a: &Frame, b: &Frame, is_apart: impl Fn(f32, f32) -> bool) -> usize {
    let values = |frame: &Frame| -> Vec<f32> {
        let vectors = frame.albedo.iter().chain(&frame.normal).chain(&frame.linear).flatten();
        vectors.chain(&frame.weight).chain(&frame.depth).copied().collect()
    };
    let (a, b) = (values(a), values(b));
    a.iter().zip(&b).filter(|&(&a, &b)| is_apart(a, b)).count() + a.len().abs_diff(b.len())
}

fn degrees_between(a: [f32; 4], b: [f64; 3]) -> f64 {
    let a = glam::DVec3::new(a[0].into(), a[1].into(), a[2].into());
    let b = glam::DVec3::from(b);
    a.cross(b).length().atan2(a.dot(b)).to_degrees()
}

impl Errors {
    /// These limits times `factor`, for a reason that the caller states.
    pub fn times(self, factor: f64) -> Self {
        Self {
            weight: factor * self.weight,
            albedo: factor * self.albedo,
            depth: factor * self.depth,
            normal_deg: factor * self.normal_deg,
            normal_sum_deg: factor * self.normal_sum_deg,
            color: factor * self.color,
            ..self
        }
    }

    /// These limits for a picture with fewer pixels to compare.
    pub fn of_at_least(self, compared: usize) -> Self {
        Self { compared, ..self }
    }

    /// The errors that exceed the tolerances, in words; empty where nothing does.
    pub fn beyond(&self, limit: &Self) -> Vec<String> {
        let mut beyond = Vec::new();
        let mut check = |name: &str, value: f64, limit: f64| {
            if value > limit {
                beyond.push(format!("{name} {value:.3e} > {limit:.3e}"));
            }
        };
        check("weight", self.weight, limit.weight);
        check("albedo", self.albedo, limit.albedo);
        check("depth", self.depth, limit.depth);
        check("normal (degrees)", self.normal_deg, limit.normal_deg);
        check("sum of normals (degrees)", self.normal_sum_deg, limit.normal_sum_deg);
        check("color", self.color, limit.color);
        check("pixels covered in one only", self.coverage as f64, limit.coverage as f64);
        check("values not finite", self.not_finite as f64, limit.not_finite as f64);
        check("compared pixels missing", limit.compared as f64, self.compared as f64);
        beyond
    }

    /// The errors by name, for reports.
    pub fn figures(&self) -> BTreeMap<&'static str, f64> {
        BTreeMap::from([
            ("compared_px", self.compared as f64),
            ("coverage_px", self.coverage as f64),
            ("not_finite_values", self.not_finite as f64),
            ("weight", self.weight),
            ("albedo", self.albedo),
            ("depth", self.depth),
            ("normal_deg", self.normal_deg),
            ("normal_sum_deg", self.normal_sum_deg),
            ("color", self.color),
        ])
    }

    /// One row of the table that the tests print.
    pub fn row(&self, name: &str) -> String {
        let share = |part: usize| 100.0 * part as f64 / self.covered.max(1) as f64;
        format!(
            "{name:36} {:6} px, exempt {:5.2}% eps {:5.2}% rim | weight {:.1e} albedo {:.1e} depth {:.1e} \
             normal {:.1e} deg color {:.1e}, coverage {}",
            self.compared,
            share(self.exempt_epsilon),
            share(self.exempt_rim),
            self.weight,
            self.albedo,
            self.depth,
            self.normal_deg,
            self.color,
            self.coverage,
        )
    }
}
