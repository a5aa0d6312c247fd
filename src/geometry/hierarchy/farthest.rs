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

use glam::DVec2;

/// Halvings of the interval of λ: g is flat at its least, so that an error of 2⁻⁸ in λ is one of some 2⁻¹⁶ in g.
const HALVINGS: usize = 8;

/// The square of the largest distance from the origin of an ellipse with this center and these tangent vectors that is moved to all points of
/// an ellipse around its center, whose half axes lie along the coordinates and are `moved` long; or `least`, where that is larger. Most
/// ellipses can't exceed it, which costs little to see.
///
/// What is moved is taken as an ellipse around it, which is exact for circles: the sum of ellipses of B and C lies in that of
/// `(1 + k) B + (1 + 1/k) C` for any k above 0, the smallest of which, by its trace, is at `k = √(tr C / tr B)`.
pub(super) fn farthest_square(least: f64, center: DVec2, s: DVec2, t: DVec2, moved: DVec2) -> f64 {
    let (own, more) = ((s.length_squared() + t.length_squared()).sqrt(), moved.length());
    let farther_than_all = center.length() + own + more;
    if farther_than_all * farther_than_all <= least {
        return least;
    }
    let mut b = [s.x * s.x + t.x * t.x, s.x * s.y + t.x * t.y, s.y * s.y + t.y * t.y];
    if more > 0.0 {
        let (own_share, more_share) = ((own + more) / own, (own + more) / more);
        b = [
            own_share * b[0] + more_share * moved.x * moved.x,
            own_share * b[1],
            own_share * b[2] + more_share * moved.y * moved.y,
        ];
    }
    Ellipse { d: center, b }.farthest_square(least)
}

/// An ellipse in a plane.
struct Ellipse {
    /// Its center.
    d: DVec2,
    /// `A Aᵀ`: the entries xx, xy, yy.
    b: [f64; 3],
}

impl Ellipse {
    fn farthest_square(&self, least: f64) -> f64 {
        let [xx, xy, yy] = self.b;
        let sigma_square = 0.5 * (xx + yy + ((xx - yy) * (xx - yy) + 4.0 * xy * xy).sqrt());
        let d_square = self.d.length_squared();
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
        let (DVec2 { x, y }, [xx, xy, yy]) = (self.d, self.b);
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

    use glam::DVec2;

    use super::farthest_square;
    use crate::math::random::SplitMix;

    /// Centers from far off to next to the origin, and at it; ellipses down to lines.
    fn random_ellipses() -> impl Iterator<Item = [DVec2; 3]> {
        let mut random = SplitMix(11);
        (0..2000).map(move |i| {
            let mut vector = || 2.0 * DVec2::new(random.unit(), random.unit()) - 1.0;
            let scale = [1.0, 1e-3, 1e-8, 1e-17, 0.0, 1e3][i % 6];
            let thin = [1.0, 1e-2, 1e-9, 0.0][i % 4];
            [scale * vector(), vector(), thin * vector()]
        })
    }

    fn rim([center, s, t]: [DVec2; 3], count: u32) -> impl Iterator<Item = DVec2> {
        (0..count).map(move |k| {
            let (sin, cos) = (TAU * f64::from(k) / f64::from(count)).sin_cos();
            center + cos * s + sin * t
        })
    }

    #[test]
    fn the_bound_is_that_of_the_rim_but_for_a_thousandth() {
        for ellipse in random_ellipses() {
            let truth = rim(ellipse, 2000).map(DVec2::length_squared).fold(0.0, f64::max);
            let [center, s, t] = ellipse;
            let bound_above = |least| farthest_square(least, center, s, t, DVec2::ZERO);
            let bound = bound_above(0.0);
            assert!(bound >= truth * (1.0 - 1e-12), "{ellipse:?}: {bound} below {truth}");
            assert!(bound <= truth * 1.002, "{ellipse:?}: {bound} above {truth}");
            assert_eq!(bound_above(2.0 * bound), 2.0 * bound);
        }
    }

    #[test]
    fn what_is_moved_around_is_inside() {
        for (i, ellipse) in random_ellipses().enumerate() {
            let moved = DVec2::new([0.1, 1.0, 1e-9][i % 3], [1.0, 0.2][i % 2]);
            let around = [DVec2::ZERO, moved.with_y(0.0), moved.with_x(0.0)];
            let points = rim(ellipse, 64).flat_map(|point| rim(around, 64).map(move |by| point + by));
            let truth = points.map(DVec2::length_squared).fold(0.0, f64::max);
            let [center, s, t] = ellipse;
            let bound = farthest_square(0.0, center, s, t, moved);
            assert!(bound >= truth && bound <= 2.01 * truth, "{ellipse:?} {moved}: {bound}, {truth}");
        }
    }
}
