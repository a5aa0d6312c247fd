//! Directions from which a scene is seen, by name and by angles.

use std::f64::consts::{FRAC_PI_2, PI};

use glam::DVec3;

use super::option::named;

named! {
    /// A side of the scene that the eye is on; which one depends on the direction that is up.
    View {
        /// From +z; where z is up from −y, and where −z is up from +y.
        Front = "front",
        /// From the other side.
        Back = "back",
        /// From the left of whoever stands in front.
        Left = "left",
        /// From the right of whoever stands in front.
        Right = "right",
        /// From above, the front below in the picture.
        Top = "top",
        /// From below, the front above in the picture.
        Bottom = "bottom",
        /// From the front, right and above, so that three orthogonal edges look alike long; an isometric picture with parallel rays.
        Iso = "iso",
    }
}

impl View {
    /// Azimuth and elevation in radians, see [`toward_eye`].
    pub fn angles_rad(self) -> [f64; 2] {
        match self {
            Self::Front => [0.0, 0.0],
            Self::Back => [PI, 0.0],
            Self::Left => [-FRAC_PI_2, 0.0],
            Self::Right => [FRAC_PI_2, 0.0],
            Self::Top => [0.0, FRAC_PI_2],
            Self::Bottom => [0.0, -FRAC_PI_2],
            // Alike far from three orthogonal axes, one of which is up.
            Self::Iso => [0.25 * PI, 0.5_f64.sqrt().atan()],
        }
    }
}

/// The directions that have a name, such as `z` and `-x`.
pub const AXES: [(&str, DVec3); 6] = [
    ("x", DVec3::X),
    ("y", DVec3::Y),
    ("z", DVec3::Z),
    ("-x", DVec3::NEG_X),
    ("-y", DVec3::NEG_Y),
    ("-z", DVec3::NEG_Z),
];

/// The direction from the target to an eye of which nothing is said: +z, but where up is along it so turned about x that it is not.
pub(super) fn front(up: Option<DVec3>) -> DVec3 {
    match up.filter(|up| are_parallel(*up, DVec3::Z)) {
        Some(up) => DVec3::NEG_Y * up.z.signum(),
        None => DVec3::Z,
    }
}

/// The unit direction from the target to an eye at an azimuth about `up`, 0 in front and counterclockwise from above, so that 90° is to the
/// right, and an elevation above the horizon, −90° to 90°; and the unit direction that is up in the picture, orthogonal to it.
pub fn toward_eye(up: Option<DVec3>, [azimuth_rad, elevation_rad]: [f64; 2]) -> [DVec3; 2] {
    let front = front(up);
    let up = up.and_then(DVec3::try_normalize).unwrap_or(DVec3::Y);
    let right = up.cross(front).normalize();
    let front = right.cross(up);
    let ([sin, cos], [sin_up, cos_up]) = (turn(azimuth_rad), turn(elevation_rad));
    let level = cos * front + sin * right;
    [cos_up * level + sin_up * up, cos_up * up - sin_up * level]
}

/// Sine and cosine, exact at right angles.
fn turn(angle_rad: f64) -> [f64; 2] {
    let (sin, cos) = angle_rad.sin_cos();
    [sin, cos].map(|part| if part.abs() < f64::EPSILON { 0.0 } else { part })
}

/// Within half a degree, where the picture would turn by any angle. A vector without length or direction is parallel to none.
pub(super) fn are_parallel(a: DVec3, b: DVec3) -> bool {
    const LARGEST_SINE: f64 = 0.0087;
    match (a.try_normalize(), b.try_normalize()) {
        (Some(a), Some(b)) => a.cross(b).length() < LARGEST_SINE,
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn seen(up: DVec3, view: View) -> [DVec3; 2] {
        toward_eye(Some(up), view.angles_rad()).map(|direction| (1e9 * direction).round() / 1e9 + 0.0)
    }

    #[test]
    fn names_are_sides_of_what_stands_upright() {
        let (x, y, z) = (DVec3::X, DVec3::Y, DVec3::Z);
        assert_eq!(seen(y, View::Front), [z, y]);
        assert_eq!(seen(y, View::Right), [x, y]);
        assert_eq!(seen(y, View::Left), [-x, y]);
        assert_eq!(seen(y, View::Back), [-z, y]);
        assert_eq!(seen(y, View::Top), [y, -z]);
        assert_eq!(seen(y, View::Bottom), [-y, z]);
        assert_eq!(seen(z, View::Front), [-y, z]);
        assert_eq!(seen(z, View::Right), [x, z]);
        assert_eq!(seen(z, View::Top), [z, y]);
        assert_eq!(seen(-z, View::Front), [y, -z]);
        assert_eq!(seen(-z, View::Right), [x, -z]);
        assert_eq!(seen(x, View::Front), [z, x]);
        assert_eq!(seen(x, View::Right), [-y, x]);
        assert_eq!(toward_eye(None, View::Top.angles_rad()), toward_eye(Some(y), View::Top.angles_rad()));
        let [eye, up] = toward_eye(Some(2.0 * z), View::Iso.angles_rad());
        assert!(eye.distance(DVec3::new(1.0, -1.0, 1.0).normalize()) < 1e-15 && eye.dot(up).abs() < 1e-15);
        // A direction that leans: the front is made level.
        let leaning = DVec3::new(0.0, 0.5, 1.0);
        let [eye, up] = toward_eye(Some(leaning), [0.3, 0.0]);
        assert!(eye.dot(leaning).abs() < 1e-15 && up.distance(leaning.normalize()) < 1e-15);
    }
}
