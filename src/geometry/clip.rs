//! What a clip curve removes, on the host: the implicit form of a rational Bézier curve of degree 2.
//!
//! With `b` the signed areas that a point q has with the sides of the control triangle (its barycentric coordinates, not normalized), the
//! curve is `b2² = 4 w² b1 b3`, and between chord and curve b2² is less. Elsewhere the chord decides.

use glam::DVec2;

use crate::scene::{Clip, ClipCurve};

/// Whether a clip removes a place (u, v) of its splat.
pub fn removes(clip: &Clip, place: DVec2) -> bool {
    match clip {
        Clip::None => false,
        Clip::One(curve) => curve_removes(curve, place),
        Clip::Either(first, second) => curve_removes(first, place) || curve_removes(second, place),
        Clip::Both(first, second) => curve_removes(first, place) && curve_removes(second, place),
    }
}

/// Whether a curve removes a place.
pub fn curve_removes(curve: &ClipCurve, place: DVec2) -> bool {
    let [start, end] = [curve.start_rad, curve.end_rad].map(|rad| DVec2::from_angle(rad.into()) - place);
    let middle = curve.middle.as_dvec2() - place;
    let [b1, b2, b3] = [middle.perp_dot(end), end.perp_dot(start), start.perp_dot(middle)];
    let (right_of_chord, bulges_right) = (b2 > 0.0, b1 + b2 + b3 > 0.0);
    let inside = if bulges_right { b1.min(b2).min(b3) > 0.0 } else { b1.max(b2).max(b3) < 0.0 };
    right_of_chord != (inside && b2 * b2 < 4.0 * f64::from(curve.weight).powi(2) * b1 * b3)
}
