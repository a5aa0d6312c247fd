//! How far what clip curves leave of splats reaches: of splats as large as the faces of a part, far less than their ellipses.

use std::f64::consts::TAU;

use glam::{DVec2, DVec3};

use super::{Bounds, Clip, ClipCurve, Shapes, Splats};

/// Places on the arc of a rim that is left, and on a curve. Between two of the arc's it is a thousandth of a radius farther out.
const STEPS: u32 = 64;

impl Splats {
    /// The box around what is left of a splat: of a surface that clip curves cut somewhere; else around the ball of its major radius.
    pub(super) fn bounds_of(&self, i: usize) -> Bounds {
        let center = self.positions[i];
        let Some([s, t]) = self.axes_of_cut(i) else {
            return Bounds::of_ball(center, self.major_radius(i));
        };
        let of_curve = |curve: &ClipCurve| {
            let places = left_of(curve).map(|at| center + at.x * s + at.y * t);
            places.map(|at| Bounds { min: at, max: at }).reduce(Bounds::union)
        };
        let half = (s * s + t * t).map(f64::sqrt);
        let whole = Bounds { min: center - half, max: center + half };
        let left = match self.clips.get(i) {
            Clip::None => None,
            Clip::One(curve) => of_curve(&curve),
            // What is left is left by both.
            Clip::Either(first, second) => of_curve(&first)
                .zip(of_curve(&second))
                .map(|(a, b)| Bounds { min: a.min.max(b.min), max: a.max.min(b.max) }),
            Clip::Both(first, second) => of_curve(&first).zip(of_curve(&second)).map(|(a, b)| a.union(b)),
        };
        left.filter(|left| left.min.cmple(left.max).all()).unwrap_or(whole)
    }

    /// How far what is left of a splat is from a place, at the most; of one that nothing cuts no more than its center and its major radius together.
    pub(super) fn reach_from(&self, i: usize, place: DVec3) -> f64 {
        let center = self.positions[i];
        let whole = center.distance(place) + self.major_radius(i);
        let Some([s, t]) = self.axes_of_cut(i) else { return whole };
        let of_curve = |curve: &ClipCurve| {
            let places = left_of(curve).map(|at| center + at.x * s + at.y * t);
            places.map(|at| at.distance(place)).fold(0.0, f64::max)
        };
        let left = match self.clips.get(i) {
            Clip::None => whole,
            Clip::One(curve) => of_curve(&curve),
            // The corners of the box that both leave are another bound, which is less where each leaves much.
            Clip::Either(first, second) => {
                let Bounds { min, max } = self.bounds_of(i);
                let corner = (min - place).abs().max((max - place).abs()).length();
                of_curve(&first).min(of_curve(&second)).min(corner)
            }
            Clip::Both(first, second) => of_curve(&first).max(of_curve(&second)),
        };
        left.min(whole)
    }

    /// The axes of an ellipse of a surface that clip curves cut somewhere.
    fn axes_of_cut(&self, i: usize) -> Option<[DVec3; 2]> {
        match &self.shapes {
            Shapes::Ellipses { s, t } if !self.clips.is_empty() => Some([s[i].as_dvec3(), t[i].as_dvec3()]),
            _ => None,
        }
    }
}

/// Places around what a curve leaves of the disk: on the rim's other arc, and on the curve, or on the rim where it is beyond.
fn left_of(curve: &ClipCurve) -> impl Iterator<Item = DVec2> {
    let [start, end] = [curve.start_rad, curve.end_rad].map(f64::from);
    let arc = match (start - end).rem_euclid(TAU) {
        0.0 => TAU,
        arc => arc,
    };
    let [first, middle, last] = [DVec2::from_angle(start), curve.middle.as_dvec2(), DVec2::from_angle(end)];
    let weight = f64::from(curve.weight);
    let of_curve = move |part: f64| {
        let [a, b, c] = [(1.0 - part).powi(2), 2.0 * part * (1.0 - part) * weight, part.powi(2)];
        let at = (a * first + b * middle + c * last) / (a + b + c);
        at.clamp_length_max(1.0)
    };
    let parts = || (0..=STEPS).map(|step| f64::from(step) / f64::from(STEPS));
    parts().map(move |part| DVec2::from_angle(end + arc * part)).chain(parts().map(of_curve))
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;
    use crate::scene::{Clips, Colors};

    /// Half of an ellipse of 2 by 1, a quarter, and three quarters.
    #[test]
    fn bounds_are_around_what_is_left() {
        let quarter = std::f32::consts::FRAC_PI_2;
        // To the right of the way up the middle, and of the way to the left along it.
        let [right, above] = [ClipCurve::line(-quarter, quarter), ClipCurve::line(0.0, 2.0 * quarter)];
        let clips = [Clip::None, Clip::One(right), Clip::Either(right, above), Clip::Both(right, above)];
        let count = clips.len();
        let shapes = Shapes::Ellipses { s: vec![2.0 * Vec3::X; count], t: vec![Vec3::Y; count] };
        let positions = vec![DVec3::Z; count];
        let splats =
            Splats { clips: Clips::of(clips.to_vec()), ..Splats::new(positions, shapes, Colors::unknown()) };
        let expected =
            [[-2.0, 2.0, -1.0, 1.0], [-2.0, 0.0, -1.0, 1.0], [-2.0, 0.0, -1.0, 0.0], [-2.0, 2.0, -1.0, 1.0]];
        for (i, [left, right, bottom, top]) in expected.into_iter().enumerate() {
            let Bounds { min, max } = splats.bounds_of(i);
            let (from, to) = (DVec3::new(left, bottom, 1.0), DVec3::new(right, top, 1.0));
            assert!(min.distance(from) < 2e-3 && max.distance(to) < 2e-3, "{i}: {min} {max}");
            let reach = splats.reach_from(i, DVec3::ZERO);
            // The end of the longer axis, at (±2, 0, 1); of what nothing cuts that is not looked for.
            let expected = if i == 0 { 3.0 } else { 5.0_f64.sqrt() };
            assert!((reach - expected).abs() < 2e-3, "{i}: {reach}");
        }
    }

    /// A sliver between two corners of its box, as the faces of a cone are, from a third one, from which the fourth is farther than both.
    #[test]
    fn slivers_reach_no_farther_than_their_ends() {
        let half = ClipCurve::line(-std::f32::consts::FRAC_PI_2, std::f32::consts::FRAC_PI_2);
        let shapes =
            Shapes::Ellipses { s: vec![Vec3::new(1.0, 1.0, 0.0)], t: vec![Vec3::new(-0.05, 0.05, 0.0)] };
        let splats = Splats {
            clips: Clips::of(vec![Clip::One(half)]),
            ..Splats::new(vec![DVec3::ZERO], shapes, Colors::unknown())
        };
        let reach = splats.reach_from(0, DVec3::new(1.0, -1.0, 0.0));
        assert!((2.0..2.01).contains(&reach), "{reach}");
    }

    /// A curve that bulges beyond the rim cuts nothing there, and one without an arc nothing at all.
    #[test]
    fn what_a_curve_does_not_reach_is_left() {
        let bulging =
            ClipCurve { start_rad: -0.5, end_rad: 0.5, middle: glam::Vec2::new(9.0, 0.0), weight: 1.0 };
        for curve in [bulging, ClipCurve::line(1.0, 1.0)] {
            let most = left_of(&curve).map(|at| at.x).fold(f64::NEG_INFINITY, f64::max);
            assert!(most > 0.998, "{most}");
        }
    }
}
