//! How far an ellipse reaches from the origin of its plane.
//!
//! Its points are `d + A u`, `|u| ≤ 1`. With `B = A Aᵀ` and any λ above the largest eigenvalue σ² of B
//!
//! ```text
//! |d + A u|² ≤ g(λ) = λ + λ dᵀ (λ I − B)⁻¹ d
//! ```
//!
//! with equality for the best λ (Lagrangian duality), which is where `g' = 1 − rᵀ B r` passes 0, `r = (λ I − B)⁻¹ d`. It lies between
//! σ² and `σ² + σ |d|`; at the latter g is at most `(σ + |d|)²`, and exact for circles. So every bound found on the way is conservative.

/// Halvings of the interval of λ: g is flat at its least, so that an error of 2⁻⁸ in λ is one of some 2⁻¹⁶ in g.
const HALVINGS: usize = 8;

/// An ellipse in a plane.
pub(super) struct Projected {
    /// Its center.
    d: [f64; 2],
    /// `A Aᵀ`: the entries xx, xy, yy.
    b: [f64; 3],
}

impl Projected {
    /// With center (`x`, `y`) and tangent vectors `s` and `t`.
    pub fn new(x: f64, y: f64, s: [f64; 2], t: [f64; 2]) -> Self {
        let b = [s[0] * s[0] + t[0] * t[0], s[0] * s[1] + t[0] * t[1], s[1] * s[1] + t[1] * t[1]];
        Self { d: [x, y], b }
    }

    /// The square of the largest distance of its points from the origin, or `least` where that is larger: an ellipse that can't exceed
    /// it costs little.
    pub fn farthest_square(&self, least: f64) -> f64 {
        let [xx, xy, yy] = self.b;
        let sigma_square = 0.5 * (xx + yy + ((xx - yy) * (xx - yy) + 4.0 * xy * xy).sqrt());
        let d_square = self.d[0] * self.d[0] + self.d[1] * self.d[1];
        let product = (sigma_square * d_square).sqrt();
        let (mut low, mut high) = (sigma_square, sigma_square + product);
        let mut bound = (sigma_square + 2.0 * product + d_square).min(self.dual(high).bound);
        for _ in 0..HALVINGS {
            if bound <= least {
                return least;
            }
            let middle = 0.5 * (low + high);
            let dual = self.dual(middle);
            bound = bound.min(dual.bound);
            if dual.falls { low = middle } else { high = middle }
        }
        bound.max(least)
    }

    fn dual(&self, lambda: f64) -> Dual {
        let ([x, y], [xx, xy, yy]) = (self.d, self.b);
        // The adjugate over the determinant.
        let determinant = (lambda - xx) * (lambda - yy) - xy * xy;
        // Of a center next to the origin it is, for all that f64 can tell, none.
        if determinant <= 0.0 {
            return Dual { bound: f64::INFINITY, falls: true };
        }
        let rx = (x * (lambda - yy) + y * xy) / determinant;
        let ry = (x * xy + y * (lambda - xx)) / determinant;
        let slope = 1.0 - (rx * rx * xx + 2.0 * rx * ry * xy + ry * ry * yy);
        Dual { bound: lambda + lambda * (x * rx + y * ry), falls: slope < 0.0 }
    }
}

/// g at some λ.
struct Dual {
    bound: f64,
    falls: bool,
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::Projected;
    use crate::math::random::SplitMix;

    #[test]
    fn the_bound_is_that_of_the_rim_but_for_a_thousandth() {
        let mut random = SplitMix(11);
        let mut unit = || 2.0 * random.unit() - 1.0;
        for i in 0..2000 {
            // Centers from far off to next to the origin, and at it; ellipses down to lines.
            let scale = [1.0, 1e-3, 1e-8, 1e-17, 0.0, 1e3][i % 6];
            let thin = [1.0, 1e-2, 1e-9, 0.0][i % 4];
            let (x, y, s, t) =
                (scale * unit(), scale * unit(), [unit(), unit()], [thin * unit(), thin * unit()]);
            let at = |angle: f64| {
                let (sin, cos) = angle.sin_cos();
                (x + cos * s[0] + sin * t[0]).powi(2) + (y + cos * s[1] + sin * t[1]).powi(2)
            };
            let rim = (0..2000).map(|k| at(TAU * f64::from(k) / 2000.0)).fold(0.0, f64::max);
            let bound = Projected::new(x, y, s, t).farthest_square(0.0);
            assert!(bound >= rim * (1.0 - 1e-12), "{x} {y} {s:?} {t:?}: {bound} below {rim}");
            assert!(bound <= rim * 1.002, "{x} {y} {s:?} {t:?}: {bound} above {rim}");
            assert_eq!(Projected::new(x, y, s, t).farthest_square(2.0 * bound), 2.0 * bound);
        }
    }
}
