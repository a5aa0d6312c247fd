//! Where a kernel ends.

use crate::scene::Kernel;

/// `−ln 2⁻²⁴`: a fragment whose weight is below 2⁻²⁴ does not cover.
const CUTOFF_EXPONENT: f64 = 24.0 * std::f64::consts::LN_2;

/// The largest `r² = u² + v²` that covers, at most 1: where the weight falls to 2⁻²⁴, or the disk's rim.
///
/// Gaussian: `r²/2σ² = 24 ln 2`. ψ_E: `a q/(1−q) = 24 ln 2`, `q = rⁿ`, which is always inside the rim.
pub fn coverage_r2(kernel: Kernel) -> f64 {
    match kernel {
        Kernel::Gaussian { sigma } => (CUTOFF_EXPONENT * 2.0 * f64::from(sigma).powi(2)).min(1.0),
        Kernel::PsiE { a, n, .. } => {
            let q = CUTOFF_EXPONENT / (f64::from(a) + CUTOFF_EXPONENT);
            q.powf(2.0 / f64::from(n))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_weight_at_the_end_is_two_to_the_minus_24_or_the_rim_is_reached() {
        assert_eq!(coverage_r2(Kernel::Gaussian { sigma: 0.5 }), 1.0);
        let sigma = 0.1;
        let r2 = coverage_r2(Kernel::Gaussian { sigma });
        let weight = (-r2 / (2.0 * f64::from(sigma).powi(2))).exp();
        assert!((weight / 2.0_f64.powi(-24) - 1.0).abs() < 1e-6);
        for (a, n) in [(6.0, 3.0), (1.0, 1.0), (0.5, 8.0)] {
            let r2 = coverage_r2(Kernel::PsiE { a, b: 1.5, n });
            let q = r2.powf(f64::from(n) / 2.0);
            let weight = (-f64::from(a) * q / (1.0 - q)).exp();
            assert!((weight / 2.0_f64.powi(-24) - 1.0).abs() < 1e-6, "{a} {n}: {weight}");
            assert!(r2 < 1.0);
        }
    }
}
