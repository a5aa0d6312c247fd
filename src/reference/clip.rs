//! What clip curves remove (Ivo et al. 2012, section 3.2), by two tests that must agree.

use glam::DVec2;

use crate::scene::{Clip, ClipCurve, ClipTest};

/// Below this weight [`ClipTest::Ivo`] takes the chord for the curve, above its inverse the control polygon (section 3.3).
const LIGHT: f64 = 1e-4;

/// Whether a clip removes a place (u, v) of its splat.
pub fn removes(clip: &Clip, place: DVec2, test: ClipTest) -> bool {
    let removed = |curve: &ClipCurve| {
        let curve = Curve::of(curve);
        match test {
            ClipTest::Conic => curve.removes(place),
            ClipTest::Ivo => curve.removes_by_crossings(place),
        }
    };
    match clip {
        Clip::None => false,
        Clip::One(curve) => removed(curve),
        Clip::Either(first, second) => removed(first) || removed(second),
        Clip::Both(first, second) => removed(first) && removed(second),
    }
}

/// A curve by its control points.
pub(super) struct Curve {
    pub start: DVec2,
    middle: DVec2,
    pub end: DVec2,
    weight: f64,
}

/// Positive where `c` is to the left of the way from `a` to `b`.
fn left(a: DVec2, b: DVec2, c: DVec2) -> f64 {
    (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)
}

impl Curve {
    pub fn of(curve: &ClipCurve) -> Self {
        let rim = |rad: f32| DVec2::new(f64::from(rad).cos(), f64::from(rad).sin());
        Self {
            start: rim(curve.start_rad),
            middle: curve.middle.as_dvec2(),
            end: rim(curve.end_rad),
            weight: curve.weight.into(),
        }
    }

    /// The areas of the triangles that `q` makes with the sides opposite to start, middle and end: twice, with the sign of the control
    /// triangle where `q` is in it.
    fn areas(&self, q: DVec2) -> [f64; 3] {
        [left(q, self.middle, self.end), left(q, self.end, self.start), left(q, self.start, self.middle)]
    }

    /// By how much a place is on the side that is kept: 0 on the curve, negative where it is removed, and as steep as the distance from the
    /// chord. `over_depth`: times what distances of the plane have in the image; negative beyond the plane's horizon, where what is seen
    /// through a filter has the lines of the image.
    ///
    /// Lines through the middle control point meet the curve once between it and the chord, or the chord.
    pub fn kept_side(&self, q: DVec2, over_depth: f64) -> f64 {
        let [at_start, at_middle, at_end] = self.areas(q).map(|area| over_depth * area);
        let turn = left(self.start, self.middle, self.end);
        if !(at_start * turn > 0.0 && at_end * turn > 0.0) {
            return -at_middle;
        }
        // In barycentric coordinates the curve is ((1 − t)², 2 t (1 − t) w, t²): so is t, and then the share of the second.
        let t = 1.0 / (1.0 + (at_start / at_end).sqrt());
        let [first, second, third] = [(1.0 - t) * (1.0 - t), 2.0 * t * (1.0 - t) * self.weight, t * t];
        let share = second / (first + second + third);
        share * (at_start + at_middle + at_end) - at_middle
    }

    fn is_inside(&self, areas: [f64; 3]) -> bool {
        let turn = left(self.start, self.middle, self.end);
        turn != 0.0 && areas.iter().all(|area| area * turn.signum() > 0.0)
    }

    /// By the implicit form. In barycentric coordinates the curve is ((1 − t)², 2 t (1 − t) w, t²), so that the square of the second is 4 w²
    /// times the product of the others; nearer to the chord it is less. There a place is on the other side than the chord tells.
    fn removes(&self, q: DVec2) -> bool {
        let areas = self.areas(q);
        let [at_start, at_middle, at_end] = areas;
        let right_of_chord = left(self.start, self.end, q) < 0.0;
        let between = self.is_inside(areas)
            && at_middle * at_middle < 4.0 * self.weight * self.weight * at_start * at_end;
        right_of_chord != between
    }

    /// By the paper: outside of the control triangle by the lines through the middle control point, inside by equation 7.
    fn removes_by_crossings(&self, q: DVec2) -> bool {
        let turn = left(self.start, self.middle, self.end);
        if self.weight < LIGHT || turn == 0.0 {
            return left(self.start, self.end, q) < 0.0;
        }
        let is_right = [(self.start, self.middle), (self.middle, self.end)].map(|(a, b)| left(a, b, q) < 0.0);
        let by_lines = if turn > 0.0 { is_right[0] || is_right[1] } else { is_right[0] && is_right[1] };
        match self.is_inside(self.areas(q)) && self.weight <= 1.0 / LIGHT {
            // What is external is removed where the polygon turns left, else what is internal.
            true => self.is_external(q) == (turn > 0.0),
            false => by_lines,
        }
    }

    /// Whether the curve crosses the line from `q` to the middle of the chord (equations 6 to 8).
    fn is_external(&self, q: DVec2) -> bool {
        let (p1, p2, p3, w) = (self.start, self.middle, self.end, self.weight);
        let chord_middle = 0.5 * (p1 + p3);
        let d = chord_middle - q;
        let d2 = DVec2::new(d.y, -d.x);
        let a = d2.dot(p1 - q + w * (q - p2));
        let b = d2.dot(p1 - q);
        let c = d2.dot(p1 + p3 + 2.0 * (w * q - q - w * p2));
        // Equation 7, with the root that would cancel by the product of both.
        let larger = a + (a * a - b * c).sqrt().copysign(a);
        [larger / c, b / larger].into_iter().any(|t| {
            let point = self.point(t);
            // The line's parameter, along its longer part.
            let along = if d.x.abs() > d.y.abs() { (point.x - q.x) / d.x } else { (point.y - q.y) / d.y };
            (0.0..=1.0).contains(&t) && (0.0..=1.0).contains(&along)
        })
    }

    /// Equation 3.
    fn point(&self, t: f64) -> DVec2 {
        let weights = [(1.0 - t) * (1.0 - t), 2.0 * t * (1.0 - t) * self.weight, t * t];
        let sum = weights[0] * self.start + weights[1] * self.middle + weights[2] * self.end;
        sum / (weights[0] + weights[1] + weights[2])
    }
}
