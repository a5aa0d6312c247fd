//! Tangent vectors that keep their digits: nearly parallel ones are replaced by the axes of their ellipse.

use glam::DVec3;

/// The least sine between two tangent vectors on a device.
const LEAST_SINE: f64 = 0.25;

/// Tangent vectors of the same ellipse with more than 14° between them: where these have less, its axes, since a vector's rounding, 6e-8
/// of it, is divided by the sine in all that is found of both.
pub(super) fn far_apart(s: DVec3, t: DVec3) -> [DVec3; 2] {
    let angle_rad = turn_rad(s, t);
    if angle_rad == 0.0 {
        return [s, t];
    }
    let unit = s.length().max(t.length());
    let [a, b] = [s / unit, t / unit];
    let (sin, cos) = angle_rad.sin_cos();
    let major = a * cos + b * sin;
    // The shorter one by area and direction: of the difference little would be left.
    let normal = a.cross(b);
    let minor = normal.cross(major) / major.length_squared();
    [major * unit, minor * unit]
}

/// By how much [`far_apart`] turns tangent vectors, from the first toward the second within their ellipse; 0 where they stay.
pub(super) fn turn_rad(s: DVec3, t: DVec3) -> f64 {
    let [length_s, length_t] = [s.length(), t.length()];
    if s.cross(t).length() >= LEAST_SINE * length_s * length_t {
        return 0.0;
    }
    // Rotating the parametrization moves the rim along itself: tan 2θ = 2 s·t / (s·s − t·t). In units of the longer one.
    let unit = length_s.max(length_t);
    let [a, b] = [s / unit, t / unit];
    0.5 * (2.0 * a.dot(b)).atan2(a.length_squared() - b.length_squared())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::SplitMix;

    /// The same ellipse, on the same side: cos a s + sin a t for all a has the same sums of squares along each direction, which
    /// are the entries of s sᵀ + t tᵀ, and the same s × t.
    #[test]
    fn the_ellipse_and_its_side_stay_and_its_vectors_are_apart() {
        let mut random = SplitMix(9);
        let mut direction = || DVec3::from([(); 3].map(|()| 2.0 * random.unit() - 1.0)).normalize();
        for k in 0..20_000 {
            let sine = 10.0_f64.powf(-7.0 * (f64::from(k) / 20_000.0));
            let s = direction();
            let t = 10.0_f64.powi(k % 7 - 3)
                * ((1.0 - sine * sine).sqrt() * s + sine * s.cross(direction()).normalize());
            let [a, b] = far_apart(s, t);
            assert!(a.cross(b).length() >= 0.99 * LEAST_SINE * a.length() * b.length(), "sine {sine}");
            let size = s.length_squared() + t.length_squared();
            for axis in [DVec3::X, DVec3::Y, DVec3::Z, direction()] {
                let sum = |s: DVec3, t: DVec3| s.dot(axis) * s + t.dot(axis) * t;
                assert!(sum(a, b).distance(sum(s, t)) <= 1e-14 * size, "sine {sine}");
            }
            // What f64 leaves of the product of nearly parallel vectors.
            let (before, after) = (s.cross(t), a.cross(b));
            assert!(before.distance(after) <= 1e-9 * before.length() + 1e-14 * size, "sine {sine}");
            assert!(before.dot(after) > 0.0, "sine {sine}");
        }
    }
}
