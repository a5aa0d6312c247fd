//! What clip curves leave of splats, as ellipses: what a node above has to cover.
//!
//! A node has no curve. Were it to cover clipped splats as if they were whole, it would stick out at sharp edges by what the curves cut off, which is up
//! to a splat's length. So it covers for each the ellipse of what is left of it: with the axes of that part's covariance, as large as holds it.

use glam::{DMat2, DVec2, DVec3, Vec3};
use rayon::prelude::*;

use super::disks::tangents;
use crate::{
    geometry::clip::removes,
    scene::{Clip, Shapes, Splats},
};

/// Places along a radius and around the rim at which it is asked what is left.
const RINGS: u32 = 12;
const TURNS: u32 = 48;

/// The same splats without clips: for each that is clipped the ellipse of what is left; whole where nothing is.
pub fn left_by_clips(splats: &Splats) -> Splats {
    let left = |i: usize| {
        let (s, t) = tangents(&splats.shapes, i);
        let clip = splats.clips.get(i);
        let [center, a, b] = match clip {
            Clip::None => [DVec2::ZERO, DVec2::X, DVec2::Y],
            _ => ellipse_of(&clip),
        };
        let along = |v: DVec2| v.x * s.as_dvec3() + v.y * t.as_dvec3();
        (splats.positions[i] + along(center), along(a).as_vec3(), along(b).as_vec3())
    };
    let all: Vec<(DVec3, Vec3, Vec3)> = (0..splats.len()).into_par_iter().map(left).collect();
    let axes = Shapes::Ellipses {
        s: all.iter().map(|(_, s, _)| *s).collect(),
        t: all.iter().map(|(.., t)| *t).collect(),
    };
    Splats::new(all.iter().map(|(center, ..)| *center).collect(), axes, splats.colors.clone())
}

/// Around what a clip leaves of the unit disk: center and two half axes, counterclockwise.
fn ellipse_of(clip: &Clip) -> [DVec2; 3] {
    let place = |ring: u32, turn: u32| {
        let radius = f64::from(ring) / f64::from(RINGS);
        radius * DVec2::from_angle(std::f64::consts::TAU * f64::from(turn) / f64::from(TURNS))
    };
    let all = (0..=RINGS).flat_map(|ring| (0..TURNS).map(move |turn| (ring, place(ring, turn))));
    let left: Vec<(u32, DVec2)> = all.filter(|(_, place)| !removes(clip, *place)).collect();
    // By area, which is as the radius.
    let area: f64 = left.iter().map(|(ring, _)| f64::from(*ring)).sum();
    if area <= 0.0 {
        return [DVec2::ZERO, DVec2::X, DVec2::Y];
    }
    let mean = left.iter().map(|(ring, place)| f64::from(*ring) * *place).sum::<DVec2>() / area;
    // Each place stands for as much of the disk as lies around it; without that a sliver in which one place is would have no extent.
    let of_place = (0.5 / f64::from(RINGS)).powi(2);
    let (mut xx, mut xy, mut yy) = (of_place, 0.0, of_place);
    for (ring, place) in &left {
        let from = *place - mean;
        let weight = f64::from(*ring) / area;
        (xx, xy, yy) =
            (xx + weight * from.x * from.x, xy + weight * from.x * from.y, yy + weight * from.y * from.y);
    }
    // Principal axes of the covariance.
    let turn = 0.5 * (2.0 * xy).atan2(xx - yy);
    let (half, apart) = (0.5 * (xx + yy), 0.5 * (xx - yy).hypot(2.0 * xy));
    let lengths = [half + apart, (half - apart).max(1e-6 * half)].map(f64::sqrt);
    let first = DVec2::from_angle(turn);
    let [a, b] = [lengths[0] * first, lengths[1] * first.perp()];
    let into = DMat2::from_cols(a, b).inverse();
    let largest = left.iter().map(|(_, place)| (into * (*place - mean)).length()).fold(0.0, f64::max);
    // And reaches so far.
    let largest = largest.max(1.0);
    [mean, largest * a, largest * b]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{ClipCurve, Clips, Colors};

    /// Of a disk that a line cuts in two: the half that is left is held, and little else.
    #[test]
    fn what_is_left_is_held_and_little_else() {
        let half = |clip: Clip| {
            let axes = Shapes::Ellipses { s: vec![Vec3::X], t: vec![Vec3::Y] };
            let mut splats = Splats::new(vec![DVec3::ZERO], axes, Colors::unknown());
            splats.clips = Clips::of(vec![clip]);
            left_by_clips(&splats)
        };
        let right_angle = std::f32::consts::FRAC_PI_2;
        // From the top down to the bottom: what is to the right of the way, the left half, is removed.
        let line = Clip::One(ClipCurve::line(right_angle, -right_angle));
        let left = half(line);
        let Shapes::Ellipses { s, t } = &left.shapes else { panic!("ellipses") };
        let [s, t] = [s[0], t[0]].map(|v| v.as_dvec3().truncate());
        let into = DMat2::from_cols(s, t).inverse();
        for turn in 0..360 {
            let place = DVec2::from_angle(f64::from(turn).to_radians());
            let from = into * (place - left.positions[0].truncate());
            assert!(removes(&line, place) || from.length() < 1.01, "{turn}°: {}", from.length());
            assert!(place.x > -0.5 || from.length() > 1.2, "{turn}°: {}", from.length());
        }
        assert!(s.perp_dot(t) > 0.0 && s.perp_dot(t) < 0.9, "{}", s.perp_dot(t));
        assert!(left.clips.is_empty());
        // Whatever sliver is left has an extent: here a cap of a few degrees, in which one of the places is, or none.
        for (middle, half_angle) in [(0.0, 0.05_f32), (1.0, 0.06), (2.0, 0.02), (0.3, 0.1)] {
            let cap = half(Clip::One(ClipCurve::line(middle + half_angle, middle - half_angle)));
            let rest = half(Clip::One(ClipCurve::line(middle - half_angle, middle + half_angle)));
            for left in [cap, rest] {
                assert_eq!(left.defect(0), None, "{middle} {half_angle}");
            }
        }
        let whole = half(Clip::None);
        assert_eq!(whole.positions, [DVec3::ZERO]);
    }
}
