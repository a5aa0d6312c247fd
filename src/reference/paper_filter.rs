//! The low-pass filter by tangent adjustment as the paper has it (Guennebaud, Barthe, Paulin 2006, section 4.1).
//! Each tangent vector is adjusted by itself, along a basis whose projections are orthogonal only in places: 60° to
//! 90° apart, so that a splat may end up thinner than the filter.

use glam::DVec3;

use super::filter::projected;

/// The tangent vectors that are drawn in place of a disk's `s` and `t`, which may be any two orthogonal ones of its
/// radius. `h` is the filter's radius in the image plane. All in view space; `center.z` must be above 0.
pub(super) fn adjust_paper(center: DVec3, s: DVec3, t: DVec3, h: f64) -> (DVec3, DVec3) {
    let radius = s.length();
    let normal = s.cross(t).normalize();
    // eq. 10. A disk that faces the eye has no such basis; there every one will do.
    let Some(first) = center.cross(normal).try_normalize() else {
        return (adjusted(center, s, s, h), adjusted(center, t, t, h));
    };
    let second = normal.cross(first);
    // n × (p × n) = p − n (n·p), and p itself projects to nothing: the second tangent's projection points along
    // that of the normal, which it still has where the disk is seen from its edge and its own projection vanishes.
    (adjusted(center, radius * first, first, h), adjusted(center, radius * second, normal, h))
}

/// One tangent vector by itself; `along` has its projection's direction.
fn adjusted(center: DVec3, tangent: DVec3, along: DVec3, h: f64) -> DVec3 {
    if projected_diameter(center, tangent) < h {
        // eq. 9: parallel to the screen, of projected length h.
        projected(center, along).normalize_or_zero().extend(0.0) * (center.z * h)
    } else {
        tangent
    }
}

/// eq. 8: half the length of the projection of the diameter from `center − tangent` to `center + tangent`.
fn projected_diameter(center: DVec3, tangent: DVec3) -> f64 {
    let numerator = tangent.truncate() * center.z - center.truncate() * tangent.z;
    (numerator / (center.z * center.z - tangent.z * tangent.z)).length()
}
