//! How much thicker a surface is in a pixel than ε, where a filter lengthens its splats.

use glam::DVec3;

use super::filter::{lengthened, orthogonalized};

/// How much more than by itself ε grows, where edges are not hard, as a filter lengthens a splat that is as deep as it is large: near a
/// silhouette a surface bends away from the plane of its nearest splat within the filter's reach. Then the ratio to which it lengthens it at most. A surface with sharp edges bends more.
const EDGE_LENGTHENING: [f64; 2] = [4.0, 52.0];
const SHARP_LENGTHENING: [f64; 2] = [16.0, MOST_LENGTHENED];
const MOST_LENGTHENED: f64 = 16.0;

/// Of an opaque splat, `slant` by its larger radius deeper than its center, where edges are not hard: a factor of ε.
pub(super) fn thickened(center: DVec3, (s, t): (DVec3, DVec3), h: f64, slant: f64, is_sharp: bool) -> f64 {
    let [by_slant, most] = if is_sharp { SHARP_LENGTHENING } else { EDGE_LENGTHENING };
    1.0 + (lengthened(center, s, t, h, most) - 1.0) * (1.0 + by_slant * slant)
}

/// Of a transparent one: a factor of ε, and a length that comes upon it. Of what has sharp edges ε is not a radius, and what a filter adds to it is by how much
/// the minor axis is deeper than the center.
pub(super) fn of_layers(center: DVec3, (s, t): (DVec3, DVec3), h: f64, is_sharp: bool) -> (f64, f64) {
    let more = 2.0 * (lengthened(center, s, t, h, MOST_LENGTHENED) - 1.0);
    match is_sharp {
        true => (1.0, more * orthogonalized(center, s, t).1.z.abs()),
        false => (1.0 + more, 0.0),
    }
}
