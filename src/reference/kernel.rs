//! The reconstruction kernels over `r² = u² + v²`, and where they stop to cover.

use crate::scene::Kernel;

/// A fragment with a smaller weight does not cover its pixel: 2⁻²⁴.
pub(super) const SMALLEST_WEIGHT: f64 = 1.0 / 16_777_216.0;

/// The weight at squared radius `r2`; 0 where the fragment does not cover.
///
/// Gaussian: `exp(−r²/2σ²)` (Pajarola, Sainz, Guidotti 2003, eq. 11), cut at 1. ψ_E: `exp(−a q/(1−q))` with
/// `q = (r_p/b)ⁿ` and `r_p = b r` (same paper, eq. 12 and section 4.2), so that b cancels.
pub(super) fn weight(kernel: Kernel, r2: f64) -> f64 {
    // Written so that NaN does not cover.
    if !(0.0..=1.0).contains(&r2) {
        return 0.0;
    }
    let weight = match kernel {
        Kernel::Gaussian { sigma } => {
            let sigma = f64::from(sigma);
            (-r2 / (2.0 * sigma * sigma)).exp()
        }
        Kernel::PsiE { a, b: _, n } => {
            let q = r2.sqrt().powf(f64::from(n));
            if q >= 1.0 { 0.0 } else { (-f64::from(a) * q / (1.0 - q)).exp() }
        }
    };
    if weight >= SMALLEST_WEIGHT { weight } else { 0.0 }
}

/// By how much the weight declines as `r2` grows, of what covers: the negative of its derivative.
pub(super) fn decline(kernel: Kernel, r2: f64) -> f64 {
    let of_logarithm = match kernel {
        Kernel::Gaussian { sigma } => 0.5 / f64::from(sigma).powi(2),
        Kernel::PsiE { a, b: _, n } => {
            // q/(1−q) grows by q'/(1−q)², and q = (r²)^(n/2) by n/2 · q/r².
            let (half_n, q) = (0.5 * f64::from(n), r2.sqrt().powf(f64::from(n)));
            f64::from(a) * half_n * r2.powf(half_n - 1.0) / (1.0 - q).powi(2)
        }
    };
    match weight(kernel, r2) {
        0.0 => 0.0,
        weight => weight * of_logarithm,
    }
}

/// The largest squared radius that covers: 1, or less where the weight reaches 2⁻²⁴ earlier.
pub(super) fn limit_r2(kernel: Kernel) -> f64 {
    // exp(−e) = 2⁻²⁴.
    let e = 24.0 * std::f64::consts::LN_2;
    match kernel {
        Kernel::Gaussian { sigma } => {
            let sigma = f64::from(sigma);
            (2.0 * sigma * sigma * e).min(1.0)
        }
        Kernel::PsiE { a, b: _, n } => {
            // a q/(1−q) = e.
            let q = e / (f64::from(a) + e);
            q.powf(2.0 / f64::from(n))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_worked_out_by_hand() {
        let gaussian = Kernel::Gaussian { sigma: 0.5 };
        assert_eq!(weight(gaussian, 0.0), 1.0);
        // exp(−0.25/0.5) and, at the rim, exp(−2).
        assert!((weight(gaussian, 0.25) - 0.606_530_659_712_633_4).abs() < 1e-15);
        assert!((weight(gaussian, 1.0) - 0.135_335_283_236_612_7).abs() < 1e-15);
        assert_eq!(weight(gaussian, 1.0 + 1e-15), 0.0);
        let psi_e = Kernel::PsiE { a: 6.0, b: 1.5, n: 3.0 };
        assert_eq!(weight(psi_e, 0.0), 1.0);
        // r = ½: q = 1/8, exp(−6 · (1/8)/(7/8)) = exp(−6/7).
        assert!((weight(psi_e, 0.25) - 0.424_372_845_676_95).abs() < 1e-14);
        assert_eq!(weight(psi_e, 1.0), 0.0);
        assert_eq!(weight(psi_e, f64::NAN), 0.0);
    }

    #[test]
    fn the_papers_two_kernels_that_look_alike_do() {
        // "ψ_E with n = 2 and a = 10 is very similar to ψ_σ with σ = 0.3" (section 4.2), over r_p at b = 1.5.
        for step in 0..=15 {
            let r_p = 0.1 * f64::from(step);
            let psi_e = weight(Kernel::PsiE { a: 10.0, b: 1.5, n: 2.0 }, (r_p / 1.5).powi(2));
            let gaussian = (-r_p * r_p / (2.0 * 0.3 * 0.3)).exp();
            assert!((psi_e - gaussian).abs() < 0.06, "r_p {r_p}: {psi_e} and {gaussian}");
        }
    }

    #[test]
    fn psi_e_ignores_b_and_grows_narrower_with_a() {
        let at = |a, b| weight(Kernel::PsiE { a, b, n: 3.0 }, 0.3);
        assert_eq!(at(6.0, 1.5), at(6.0, 0.7));
        assert!(at(20.0, 1.0) < at(5.0, 1.0));
    }

    #[test]
    fn the_limit_is_where_the_weight_falls_below_the_smallest() {
        let kernels = [
            Kernel::Gaussian { sigma: 0.1 },
            Kernel::PsiE { a: 6.0, b: 1.5, n: 3.0 },
            Kernel::PsiE { a: 0.5, b: 1.0, n: 0.7 },
        ];
        for kernel in kernels {
            let limit = limit_r2(kernel);
            assert!(limit < 1.0, "{kernel:?}");
            assert!(weight(kernel, limit * (1.0 - 1e-12)) >= SMALLEST_WEIGHT, "{kernel:?}");
            assert_eq!(weight(kernel, limit * (1.0 + 1e-12)), 0.0, "{kernel:?}");
        }
        assert_eq!(limit_r2(Kernel::Gaussian { sigma: 0.5 }), 1.0);
        // By hand: 2 · 0.01 · 24 ln 2.
        let sigma_squared = f64::from(0.1_f32) * f64::from(0.1_f32);
        let expected = 33.271_064_666_877_37 * sigma_squared;
        assert!((limit_r2(Kernel::Gaussian { sigma: 0.1 }) - expected).abs() < 1e-14);
    }
}
