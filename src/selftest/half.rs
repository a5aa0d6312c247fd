//! Sums of 16 bits against the oracle: what rounding alone may do to them, pixel by pixel.

use std::collections::BTreeMap;

use super::agreement::{Errors, SMALL_WEIGHT, is_compared};
use crate::{
    reference::{Picture, Pixel},
    renderer::Frame,
};

/// The most that rounding does to a sum of positive values in binary16 (11 significant bits, least number 2⁻²⁴): each blend
/// rounds the source and the sum, each by at most 2⁻¹⁰ of the sum (drivers may truncate), or 2⁻²⁴ where it is subnormal.
#[derive(Clone, Copy, Debug)]
pub struct Rounding {
    relative: f64,
    absolute: f64,
}

impl Rounding {
    /// The rounding of a sum of so many values.
    pub fn of(count: f64) -> Self {
        Self { relative: count * 2.0 / 1024.0, absolute: count * 2.0 / 16_777_216.0 }
    }

    /// Whether the bound says something of a pixel of this weight. Beyond some hundred fragments it does not: sums stall.
    pub fn holds(&self, weight: f64) -> bool {
        weight > self.absolute && self.relative + self.absolute / weight <= 0.25
    }

    /// How far a sum may be off.
    pub fn of_sum(&self, sum: f64) -> f64 {
        self.relative * sum + self.absolute
    }

    /// How far the quotient of a sum and the sum of weights may be off, relative.
    pub fn of_quotient(&self, weight: f64) -> f64 {
        let part = self.relative + self.absolute / weight;
        2.0 * part / (1.0 - part)
    }

    /// How far a mean that is `mean` may be off.
    pub fn of_mean(&self, mean: f64, weight: f64) -> f64 {
        self.of_quotient(weight) * mean + 2.0 * self.absolute / weight
    }
}

/// How far 16-bit sums are from the oracle. Normals, whose sums cancel, and shaded colors have no bound: they are only
/// asked to be finite.
#[derive(Clone, Copy, Debug, Default)]
pub struct HalfErrors {
    /// Compared pixels.
    pub compared: usize,
    /// Compared pixels with so few fragments that the bound says something.
    pub bounded: usize,
    /// Compared pixels covered in one and empty in the other.
    pub coverage: usize,
    /// NaN or infinite values in covered pixels.
    pub not_finite: usize,
    /// Σw: the largest error over its bound.
    pub weight: f64,
    /// Linear albedo: the largest error over its bound.
    pub albedo: f64,
    /// Depth: the largest error over its bound.
    pub depth: f64,
}

/// Compares a frame that has its surface with the oracle's picture; `exact` is what 32-bit sums may be off.
///
/// # Panics
/// Where they differ in size.
pub fn compare(frame: &Frame, oracle: &Picture, exact: &Errors) -> HalfErrors {
    assert_eq!(frame.size_px, oracle.size_px);
    let mut errors = HalfErrors::default();
    for (i, expected) in oracle.pixels.iter().enumerate() {
        let covered = frame.weight[i] > 0.0;
        if !covered && !expected.is_covered() {
            continue;
        }
        errors.not_finite += super::agreement::not_finite(frame, i);
        if !is_compared(expected) {
            continue;
        }
        errors.compared += 1;
        if covered != expected.is_covered() {
            errors.coverage += 1;
            continue;
        }
        let rounding = Rounding::of(expected.fragments.into());
        if rounding.holds(expected.weight) {
            errors.bounded += 1;
            errors.add(frame, i, expected, rounding, exact);
        }
    }
    errors
}

impl HalfErrors {
    fn add(&mut self, frame: &Frame, i: usize, expected: &Pixel, rounding: Rounding, exact: &Errors) {
        let worst = |worst: &mut f64, got: f32, expected: f64, bound: f64| {
            let share = (f64::from(got) - expected).abs() / bound;
            // A NaN is the worst of all.
            *worst = if share.is_nan() { f64::INFINITY } else { worst.max(share) };
        };
        let weight = expected.weight;
        let of_weight = rounding.of_sum(weight) + exact.weight * weight.max(SMALL_WEIGHT);
        worst(&mut self.weight, frame.weight[i], weight, of_weight);
        for (got, expected) in frame.albedo[i].iter().zip(expected.albedo) {
            worst(&mut self.albedo, *got, expected, rounding.of_mean(expected, weight) + exact.albedo);
        }
        let of_depth = (rounding.of_quotient(weight) + exact.depth) * expected.depth;
        worst(&mut self.depth, frame.depth[i], expected.depth, of_depth);
    }

    /// The errors that exceed their bounds, in words; empty where nothing does. A picture of fewer pixels than `fewest_px` shows nothing.
    pub fn beyond(&self, fewest_px: usize) -> Vec<String> {
        let mut beyond = Vec::new();
        for (name, share) in [("weight", self.weight), ("albedo", self.albedo), ("depth", self.depth)] {
            if share > 1.0 {
                beyond.push(format!("{name} {share:.2} times the bound of 16-bit sums"));
            }
        }
        if self.coverage > 0 {
            beyond.push(format!("{} pixels covered in one only", self.coverage));
        }
        if self.not_finite > 0 {
            beyond.push(format!("{} values not finite", self.not_finite));
        }
        if self.compared < fewest_px {
            beyond.push(format!("{} pixels compared, expected {fewest_px}", self.compared));
        }
        beyond
    }

    /// The errors by name, for reports.
    pub fn figures(&self) -> BTreeMap<&'static str, f64> {
        BTreeMap::from([
            ("compared_px", self.compared as f64),
            ("bounded_px", self.bounded as f64),
            ("coverage_px", self.coverage as f64),
            ("not_finite_values", self.not_finite as f64),
            ("weight_of_bound", self.weight),
            ("albedo_of_bound", self.albedo),
            ("depth_of_bound", self.depth),
        ])
    }
}
