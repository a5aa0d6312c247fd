//! Where a kernel ends: the largest `r² = u² + v²` that covers, at most 1.

/// `−ln 2⁻²⁴`: a fragment whose weight is below 2⁻²⁴ does not cover.
const CUTOFF_EXPONENT: f64 = 24.0 * std::f64::consts::LN_2;

/// The end of `exp(−r²/2σ²)`: `r²/2σ² = 24 ln 2`, or the disk's rim.
pub fn gaussian_coverage_r2(sigma: f64) -> f64 {
    (CUTOFF_EXPONENT * 2.0 * sigma * sigma).min(1.0)
}

/// The end of ψ_E, `exp(−a q/(1−q))` with `q = rⁿ`: `a q/(1−q) = 24 ln 2`, which is always inside the rim.
pub fn psi_e_coverage_r2(a: f64, n: f64) -> f64 {
    let q = CUTOFF_EXPONENT / (a + CUTOFF_EXPONENT);
    q.powf(2.0 / n)
}

/// The mean over the unit disk of `exp(−r²/2σ²)`, which ends at `coverage_r2`.
pub fn gaussian_mean(sigma: f64, coverage_r2: f64) -> f64 {
    let twice_variance = 2.0 * sigma * sigma;
    twice_variance * -(-coverage_r2 / twice_variance).exp_m1()
}

/// The same of ψ_E.
pub fn psi_e_mean(a: f64, n: f64, coverage_r2: f64) -> f64 {
    const STEPS: u32 = 256;
    let step = coverage_r2 / f64::from(STEPS);
    let weight = |i| {
        let q = (step * (f64::from(i) + 0.5)).powf(n / 2.0);
        (-a * q / (1.0 - q)).exp()
    };
    step * (0..STEPS).map(weight).sum::<f64>()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_weight_at_the_end_is_two_to_the_minus_24_or_the_rim_is_reached() {
        let smallest = 2.0_f64.powi(-24);
        assert_eq!(gaussian_coverage_r2(0.5), 1.0);
        let r2 = gaussian_coverage_r2(0.1);
        assert!(((-r2 / (2.0 * 0.01)).exp() / smallest - 1.0).abs() < 1e-9);
        for (a, n) in [(6.0, 3.0), (1.0, 1.0), (0.5, 8.0)] {
            let r2 = psi_e_coverage_r2(a, n);
            let q = r2.powf(n / 2.0);
            assert!(((-a * q / (1.0 - q)).exp() / smallest - 1.0).abs() < 1e-9, "{a} {n}");
            assert!(r2 < 1.0);
        }
    }

    #[test]
    fn means_are_those_of_a_sum_over_the_disk() {
        let mean = |coverage_r2: f64, weight: &dyn Fn(f64) -> f64| {
            let steps = 100_000;
            let r2 = |i| (f64::from(i) + 0.5) / f64::from(steps);
            (0..steps).map(r2).filter(|r2| *r2 <= coverage_r2).map(weight).sum::<f64>() / f64::from(steps)
        };
        for sigma in [0.1, 0.5, 2.0] {
            let end = gaussian_coverage_r2(sigma);
            let expected = mean(end, &|r2: f64| (-r2 / (2.0 * sigma * sigma)).exp());
            assert!((gaussian_mean(sigma, end) - expected).abs() < 1e-4, "{sigma}");
        }
        for (a, n) in [(6.0_f64, 3.0_f64), (1.0, 1.0), (0.5, 8.0)] {
            let end = psi_e_coverage_r2(a, n);
            let expected = mean(end, &|r2: f64| {
                let q = r2.powf(n / 2.0);
                (-a * q / (1.0 - q)).exp()
            });
            assert!((psi_e_mean(a, n, end) - expected).abs() < 1e-3, "{a} {n}");
        }
    }
}
