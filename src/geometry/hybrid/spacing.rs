//! How far apart splats may be along an edge that their weights are to saturate.
//!
//! **The condition.** Splats of equal radius have their centers `h` radii apart along a line. A point of the line at `x`
//! from the one and `h − x` from the next must get `w(x) + w(h − x) ≥ 1`. The others only add, and need not be there: so
//! it holds up to the ends of a line that has splats on both of them. Along an edge path that bends, centers are nearer
//! in a straight line than along it, and in the plane of a disk that is tilted nearer again; kernels fall with the
//! distance, so that there the sum is larger still.
//!
//! **Gaussian, σ = ½, cut at 1:** `w(r) = exp(−2r²)`. Halfway `2 exp(−h²/2) ≥ 1` would allow `h = √(2 ln 2) = 1.177`. But
//! for `h > 1` a point nearer than `h − 1` to a center gets that one's weight alone, which is below 1. With `h ≤ 1` the
//! derivative's zeros leave the ends (`1 + exp(−2h²)`) and the middle as extremes: the largest spacing is **1**.
//!
//! **ψ_E, a = 6, n = 3:** `w(r) = exp(−6r³/(1−r³))` is ½ at r³ = ln 2/(6 + ln 2), `r = 0.4696`, so that the middle would
//! allow 0.939. Near a center the sum is `1 − 6x³ + w(h − x)` and the neighbor must make up for `6x³`; that is the
//! stronger condition. No closed form: by bisection the largest spacing is **0.8669**.

/// Between neighboring splats on a transition edge, along it, at most, in their radii: 2% below the largest that
/// saturates under both default kernels, because radii are kept as f32 and weights as halves. The least sum of weights
/// is then 1.00007 with ψ_E and 1.24 with the Gaussian.
pub const EDGE_SPACING: f64 = 0.85;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::hybrid::tests::weights::{gaussian, psi_e};

    /// The least of w(x) + w(h − x).
    fn least(w: fn(f64) -> f64, h: f64) -> f64 {
        let steps = 20_000;
        let at = |i: i32| h * f64::from(i) / f64::from(steps);
        (0..=steps).map(|i| w(at(i)) + w(h - at(i))).fold(f64::INFINITY, f64::min)
    }

    fn largest(w: fn(f64) -> f64) -> f64 {
        let (mut low, mut high) = (0.5, 1.5);
        for _ in 0..40 {
            let middle = 0.5 * (low + high);
            if least(w, middle) >= 1.0 { low = middle } else { high = middle }
        }
        low
    }

    #[test]
    fn the_largest_spacings_are_those_derived_and_the_chosen_one_is_below() {
        assert!((largest(gaussian) - 1.0).abs() < 1e-4, "{}", largest(gaussian));
        assert!((largest(psi_e) - 0.8669).abs() < 1e-4, "{}", largest(psi_e));
        let found = [gaussian, psi_e].map(|w| least(w, EDGE_SPACING));
        assert!((found[0] - 1.2357).abs() < 1e-3 && (found[1] - 1.00007).abs() < 1e-5, "{found:?}");
    }
}
