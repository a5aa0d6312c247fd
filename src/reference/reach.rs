//! Splats at the border of a surface, where it covers pixels in part.
//!
//! A half plane under a Gaussian of standard deviation h/2 covers Φ(2 d/h) of a pixel at distance d within its border. A splat at a border is drawn as far as 0.8 h beyond the rim of its
//! unfiltered ellipse, along both axes, in the plane in which it is drawn, and covers by itself what a half plane would that ends at its rim. A narrow one has two rims within the
//! filter, and covers less: a line that is 2 l wide covers 2 Φ(2 l/h) − 1 in its middle.

use std::f64::consts::PI;

use glam::{DVec2, DVec3};

use super::filter::{minor_axis, orthogonalized, projected};

/// How a splat at a border reaches. Vectors have what is of the first and of the second axis of its drawn ellipse.
#[derive(Clone, Copy, Debug)]
pub(super) struct Reach {
    /// How far it reaches over what the filter makes of it.
    pub over_filtered: DVec2,
    /// The same over its unfiltered half axes.
    over_own: DVec2,
    /// The geometric mean of these, over h.
    size: f64,
}

/// Beyond the rim, in h.
const BEYOND: f64 = 0.8;

/// The most by which any gets longer than what the filter makes of it, and a little: (l + b h) / √(l² + h²) is √(1 + b²) at l = h/b.
pub(super) const MOST_REACH: f64 = 1.2807;

/// In h; of what is smaller across sums tell what it covers.
const LEAST_MINOR: f64 = 0.25;

/// Splats that are deeper than this part of their depth are no ellipses.
const LARGEST_DEPTH_RATIO: f64 = 0.9;

impl Reach {
    /// Of a splat in view space, before and after the filter, whose half axes then are orthogonal in the image; `None` of what is too small, and where a splat that is longer by the most
    /// that any gets would come too near.
    pub fn of(
        center: DVec3,
        (s, t): (DVec3, DVec3),
        filtered: (DVec3, DVec3),
        h: f64,
        near: f64,
    ) -> Option<Self> {
        let depth = MOST_REACH * s.z.hypot(t.z);
        let own_minor = minor_axis(projected(center, s), projected(center, t));
        if own_minor < LEAST_MINOR * h || center.z - depth < near || depth > LARGEST_DEPTH_RATIO * center.z {
            return None;
        }
        let length = |v: DVec3| projected(center, v).length();
        let own = DVec2::new(length(orthogonalized(center, s, t).0), own_minor);
        let reached = own + DVec2::splat(BEYOND * h);
        let drawn = DVec2::new(length(filtered.0), length(filtered.1));
        let size = (own.x * own.y).sqrt() / h;
        Some(Self { over_filtered: reached / drawn, over_own: reached / own, size })
    }

    /// How far this place of it is within its rim, over the Gaussian's standard deviation, in units of how far it reaches.
    pub fn within_rim(&self, uv: DVec2) -> f64 {
        let r2 = (uv * self.over_own).length_squared();
        // To first order, where r is 1, for a circle as large: (1 − r²)/2 of its radius, over h/2.
        let distance = (1.0 - r2) * self.size;
        // So much less that a line of this width covers what it should in its middle, within 0.03.
        let narrow = (0.5 - self.size).max(0.0);
        distance - narrow * (2.0 + narrow)
    }
}

/// Φ, the part of a normal distribution below `x`: 1/2 + φ(x) (x + x³/3 + x⁵/(3·5) + …) (Marsaglia 2004, "Evaluating the normal distribution").
pub(super) fn normal_distribution(x: f64) -> f64 {
    if x.abs() > 8.0 {
        return if x > 0.0 { 1.0 } else { 0.0 };
    }
    let (mut sum, mut term, mut n) = (x, x, 1.0);
    while term.abs() > 1e-17 * sum.abs() {
        n += 2.0;
        term *= x * x / n;
        sum += term;
    }
    0.5 + sum * (-0.5 * x * x).exp() / (2.0 * PI).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_normal_distribution_is_that_of_tables() {
        for (x, expected) in [(0.0, 0.5), (1.0, 0.841_344_746_068_542_9), (-1.96, 0.024_997_895_148_220_4)] {
            assert!((normal_distribution(x) - expected).abs() < 1e-14, "{x}");
        }
        assert_eq!((normal_distribution(9.0), normal_distribution(-9.0)), (1.0, 0.0));
    }

    /// Of a wide splat, half of a pixel at the rim; of lines, what they cover in their middle.
    #[test]
    fn rims_cover_half_of_a_pixel_and_lines_what_is_of_them_in_it() {
        let of = |size: f64| {
            let center = DVec3::new(0.0, 0.0, 10.0);
            let (s, t) = (DVec3::X * size * 10.0, DVec3::Y * size * 10.0);
            let drawn = size.hypot(1.0) / size;
            Reach::of(center, (s, t), (drawn * s, drawn * t), 1.0, 1e-3)
        };
        for size in [0.6, 1.0, 5.0, 40.0] {
            let reach = of(size).unwrap();
            let at = |r: f64| reach.within_rim(DVec2::new(0.0, r * size / (size + BEYOND)));
            assert!(at(1.0).abs() < 1e-12, "{size}");
            // A tenth of h within and beyond.
            for off in [0.1, -0.1] {
                assert!((at(1.0 - off / size) - 2.0 * off).abs() < 0.2 * off.abs() / size, "{size}");
            }
        }
        for size in [0.25, 0.3, 0.4, 0.5] {
            let middle = normal_distribution(of(size).unwrap().within_rim(DVec2::ZERO));
            let of_line = 2.0 * normal_distribution(2.0 * size) - 1.0;
            assert!((middle - of_line).abs() < 0.03, "{size}: {middle} {of_line}");
        }
        assert!(of(0.24).is_none());
    }
}
