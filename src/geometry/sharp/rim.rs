//! Curves and lines in the plane of a splat, and its rim, the unit circle.

use glam::{DVec2, DVec3};

use super::conic::Conic;

/// What lies less inside of the rim, in radii, is not cut off.
pub(super) const SHALLOW: f64 = 1e-3;

/// In how many steps a curve is looked along.
pub(super) const STEPS: u32 = 32;

/// The longest part of a curve that is seen within the rim, as its first and last parameter there.
pub(super) fn inside(curve: &Conic) -> Option<[f64; 2]> {
    let depth = |t: f64| 1.0 - curve.point(t).length();
    let at = |i: u32| f64::from(i) / f64::from(STEPS);
    let depths: Vec<f64> = (0..=STEPS).map(|i| depth(at(i))).collect();
    let (mut best, mut start) = (None::<[u32; 2]>, 0);
    for i in 0..=STEPS {
        if depths[i as usize] <= 1e-9 {
            start = i + 1;
        } else if best.is_none_or(|[a, b]| i - start > b - a) {
            best = Some([start, i]);
        }
    }
    let deepest = (0..=STEPS).max_by(|a, b| depths[*a as usize].total_cmp(&depths[*b as usize]))?;
    if best.is_some() && depths[deepest as usize] > SHALLOW {
        return best.map(|ends| ends.map(at));
    }
    // Between two steps.
    let (mut low, mut high) = (at(deepest.max(1) - 1), at((deepest + 1).min(STEPS)));
    for _ in 0..40 {
        let [a, b] = [low + 0.382 * (high - low), low + 0.618 * (high - low)];
        if depth(a) >= depth(b) { high = b } else { low = a }
    }
    let t = 0.5 * (low + high);
    (depth(t) > SHALLOW).then_some([t, t])
}

/// The part of a curve within the rim, gone on beyond its ends where these are inside.
pub(super) fn part_inside(curve: &Conic) -> Option<Conic> {
    let [first, last] = inside(curve)?;
    curve.part(rim(curve, first, -1.0)?, rim(curve, last, 1.0)?)
}

/// Where a curve leaves the disk, from a parameter inside in a direction: at the next step, or beyond the end.
fn rim(curve: &Conic, start: f64, direction: f64) -> Option<f64> {
    let step = direction / f64::from(STEPS);
    let mut within = start;
    for _ in 0..4 * STEPS {
        let next = within + step;
        // A way to infinity, and beyond.
        curve.part(start.min(next), start.max(next))?;
        if curve.point(next).length() >= 1.0 {
            let (mut low, mut high) = (within, next);
            for _ in 0..50 {
                let middle = 0.5 * (low + high);
                if curve.point(middle).length() < 1.0 { low = middle } else { high = middle }
            }
            return Some(0.5 * (low + high));
        }
        within = next;
    }
    None
}

/// The longest part of a polyline within the disk, from rim to rim; gone on straight where it ends inside.
pub(super) fn cut_at_rim(line: &[DVec3]) -> Option<Vec<DVec3>> {
    let (first, last) = (line.first()?, line.last()?);
    let [before, after] = [first - line.get(1)?, last - line.get(line.len().checked_sub(2)?)?];
    let mut long = vec![*first + 4.0 * before.normalize_or_zero()];
    long.extend(line);
    long.push(*last + 4.0 * after.normalize_or_zero());
    let mut parts: Vec<Vec<DVec3>> = Vec::new();
    let mut open = false;
    for pair in long.windows(2) {
        let (a, d) = (pair[0], pair[1] - pair[0]);
        // |a + x d| = 1.
        let (aa, ad, dd) = (a.length_squared() - 1.0, a.dot(d), d.length_squared());
        let root = (ad * ad - aa * dd).sqrt();
        let (enter, leave) = ((-ad - root) / dd, (-ad + root) / dd);
        if !(root > 0.0 && enter < 1.0 && leave > 0.0) {
            open = false;
            continue;
        }
        if enter > 0.0 || !open {
            parts.push(vec![a + enter.max(0.0) * d]);
        }
        open = leave >= 1.0;
        parts.last_mut()?.push(if open { pair[1] } else { a + leave * d });
    }
    let length = |part: &Vec<DVec3>| part.windows(2).map(|pair| pair[0].distance(pair[1])).sum::<f64>();
    parts.into_iter().max_by(|a, b| length(a).total_cmp(&length(b)))
}

/// From the origin.
pub(super) fn distance_to_side(from: DVec2, to: DVec2) -> f64 {
    let side = to - from;
    let share = (-from.dot(side) / side.length_squared()).clamp(0.0, 1.0);
    (from + share * side).length()
}
