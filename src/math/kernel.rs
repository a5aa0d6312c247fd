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
}
