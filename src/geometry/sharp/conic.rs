//! Rational Bézier curves of degree 2 in space: conic sections, each in a plane of its own.

use glam::DVec3;

/// The weights of the control points are 1, `weight` and 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Conic {
    pub start: DVec3,
    pub middle: DVec3,
    pub end: DVec3,
    pub weight: f64,
}

impl Conic {
    /// A straight line, at even speed.
    pub fn line(start: DVec3, end: DVec3) -> Self {
        Self { start, middle: 0.5 * (start + end), end, weight: 1.0 }
    }

    /// The arc of a circle from `start` to `end` through `on_it`: its weight is the cosine of half its angle. `None` of a line, and of
    /// more than `most_half_angle_rad`.
    pub fn arc(start: DVec3, on_it: DVec3, end: DVec3, most_half_angle_rad: f64) -> Option<Self> {
        let (to_start, to_end) = (start - on_it, end - on_it);
        // The angle on the circle over the chord, from any place of the arc, is π less half the arc's.
        let sin = to_start.cross(to_end).length();
        let half_angle = sin.atan2(-to_start.dot(to_end));
        if half_angle.is_nan() || sin <= 0.0 || half_angle > most_half_angle_rad {
            return None;
        }
        let chord = end - start;
        let away = on_it - start;
        let outward = (away - chord * (away.dot(chord) / chord.length_squared())).try_normalize()?;
        let middle = 0.5 * (start + end) + outward * (0.5 * chord.length() * half_angle.tan());
        Some(Self { start, middle, end, weight: half_angle.cos() })
    }

    /// The place at `t`, from 0 at the start to 1 at the end.
    pub fn point(&self, t: f64) -> DVec3 {
        let (place, weight) = self.polar(t, t);
        place / weight
    }

    /// The blossom of the curve, with its weight multiplied in, and that weight.
    fn polar(&self, a: f64, b: f64) -> (DVec3, f64) {
        let shares = [(1.0 - a) * (1.0 - b), (a * (1.0 - b) + b * (1.0 - a)) * self.weight, a * b];
        let place = shares[0] * self.start + shares[1] * self.middle + shares[2] * self.end;
        (place, shares[0] + shares[1] + shares[2])
    }

    /// The same curve from `from` to `to`, which may lie beyond its ends; `None` where it passes through infinity on the way.
    pub fn part(&self, from: f64, to: f64) -> Option<Self> {
        if (from, to) == (0.0, 1.0) {
            return Some(*self);
        }
        let [(start, at_start), (middle, at_middle), (end, at_end)] =
            [self.polar(from, from), self.polar(from, to), self.polar(to, to)];
        if !(at_start > 0.0 && at_middle > 0.0 && at_end > 0.0) {
            return None;
        }
        let weight = at_middle / (at_start * at_end).sqrt();
        Some(Self { start: start / at_start, middle: middle / at_middle, end: end / at_end, weight })
    }

    /// The other way.
    pub fn reversed(&self) -> Self {
        Self { start: self.end, end: self.start, ..*self }
    }

    /// The image under an affine map of the control points, which is that of the curve.
    pub fn map(&self, of: impl Fn(DVec3) -> DVec3) -> Self {
        Self { start: of(self.start), middle: of(self.middle), end: of(self.end), weight: self.weight }
    }

    /// How far it is from its chord at the most, about: at t = ½.
    pub fn height(&self) -> f64 {
        let chord = self.end - self.start;
        let away = self.point(0.5) - self.start;
        (away - chord * (away.dot(chord) / chord.length_squared())).length()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_arc_is_that_of_the_circle_and_parts_are_of_the_same_curve() {
        let at = |angle: f64| DVec3::new(3.0 + 2.0 * angle.cos(), 2.0 * angle.sin(), 1.0);
        let arc = Conic::arc(at(0.2), at(0.9), at(2.0), 1.4).unwrap();
        assert!((arc.weight - 0.9_f64.cos()).abs() < 1e-12);
        for i in -3..=13 {
            let point = arc.point(f64::from(i) / 10.0);
            assert!((point.distance(DVec3::new(3.0, 0.0, 1.0)) - 2.0).abs() < 1e-12, "{point}");
        }
        let part = arc.part(0.25, 1.125).unwrap();
        assert_eq!([part.point(0.0), part.point(1.0)], [arc.point(0.25), arc.point(1.125)]);
        for i in 1..10 {
            let point = part.point(f64::from(i) / 10.0);
            assert!((point.distance(DVec3::new(3.0, 0.0, 1.0)) - 2.0).abs() < 1e-12, "{point}");
        }
        assert!((arc.height() - 2.0 * (1.0 - 0.9_f64.cos())).abs() < 1e-12);
        assert!(arc.reversed().point(0.3).distance(arc.point(0.7)) < 1e-12);
        // A line, a half circle, and a way through infinity.
        assert_eq!(Conic::arc(DVec3::ZERO, DVec3::X, 3.0 * DVec3::X, 1.4), None);
        assert_eq!(Conic::arc(at(0.0), at(1.0), at(3.0), 1.4), None);
        assert_eq!(Conic { weight: 2.0, ..arc }.part(-1.0, 1.0), None);
    }
}
