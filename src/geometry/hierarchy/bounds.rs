//! What bounds a node and all below it: a ball, a length and a cone, each of which holds those of the children. So what one of them
//! proves of a node it proves of all below: that it is outside the view, faces away, or is no larger on the screen than so many pixels.
//!
//! They hold one another as they are stored, in f32, and with room to spare: sizes on the screen then fall along every path of the tree
//! also where a device computes them in f32. Let u be the relative error of a computed distance, some 2⁻²², and d and r those of a node,
//! D and R of its parent, as stored. Then `D − R ≤ d − r − m R` and `D + d ≤ 3 (d − r + R)`, for an eye outside the ball: the computed
//! `D − R` is above the computed `d − r` by at most `u (D + d) − m R`, which is below m times `d − r` if `m ≥ 3 u`. The parent's length is
//! larger than the node's by the factor 1 + m, which makes up for it: m is [`ROOM`].

use glam::{DVec3, Vec3};

use super::{contrast::Contrast, disks::Disk};
use crate::scene::ErrorBall;

/// By which parts of itself each bound is larger than it must be.
const ROOM: f64 = 1.0 / (1 << 20) as f64;

/// No node's longer half axis is more times its spread: it has to be no wider than what it stands for.
const LONGEST: f64 = 4.0;

/// More than f32 loses of the angle between two unit vectors.
const ROOM_RAD: f64 = 1e-6;

/// A cone of directions around an axis: all normals of the disks below, and the children's cones.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NormalCone {
    /// The normal of the node's ellipse, unit.
    pub axis: Vec3,
    /// The cosine of the angle between the axis and the cone's surface, rounded down; −1 where all directions are in it.
    pub cos: f32,
}

/// What bounds a node and all below it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// By what it is drawn, and the ball that bounds it.
    pub error: ErrorBall,
    /// Of the normals below.
    pub cone: NormalCone,
}

impl Bounds {
    /// None yet, before a node's own are found.
    pub(super) const NONE: Self =
        Self { error: ErrorBall::LEAF, cone: NormalCone { axis: Vec3::Z, cos: -1.0 } };

    /// Around an ellipse with this center (from the origin), unit normal, longer half axis, spread and contrast, the children's bounds, and disks.
    pub(super) fn around<'a>(
        (center, normal, half_axis): (DVec3, DVec3, f64),
        (spread, contrast): (f64, Contrast),
        children: &[Self],
        origin: DVec3,
        disks: impl Iterator<Item = &'a Disk>,
    ) -> Self {
        let (ball_center, axis) = (center.as_vec3(), normal.as_vec3());
        let middle = ball_center.as_dvec3();
        let mut radius = middle.distance(center) + half_axis;
        let mut spread = (contrast.size_factor() * spread).max(half_axis / LONGEST);
        let (mut angle_rad, mut chord_square) = (0.0_f64, 0.0_f32);
        for Self { error, cone } in children {
            radius = radius.max(middle.distance(error.center.as_dvec3()) + f64::from(error.radius));
            spread = spread.max(f64::from(error.spread));
            angle_rad = angle_rad.max(angle_between(axis, cone.axis) + f64::from(cone.cos).acos());
        }
        for disk in disks {
            radius = radius.max(middle.distance(disk.center - origin) + disk.radius());
            let normal = disk.area_normal().normalize().as_vec3();
            chord_square = chord_square.max(axis.distance_squared(normal));
        }
        angle_rad = angle_rad.max(angle_over(chord_square));
        let up = |length: f64| rounded_up(length * (1.0 + ROOM));
        let cos = -rounded_up(-(angle_rad + ROOM_RAD).min(std::f64::consts::PI).cos());
        Self {
            error: ErrorBall { center: ball_center, radius: up(radius), spread: up(spread) },
            cone: NormalCone { axis, cos },
        }
    }
}

/// Of two vectors of equal length; not by sine or cosine, which do not tell angles near 180° or 0° from one another (Kahan).
fn angle_between(a: Vec3, b: Vec3) -> f64 {
    let (a, b) = (a.as_dvec3(), b.as_dvec3());
    2.0 * (a - b).length().atan2((a + b).length())
}

/// Of two unit vectors whose difference has this square; any angle near 180°, where the difference does not tell.
fn angle_over(chord_square: f32) -> f64 {
    let half_chord = 0.5 * f64::from(chord_square).sqrt();
    if half_chord < 0.99 { 2.0 * half_chord.asin() } else { std::f64::consts::PI }
}

/// The next f32 that is no less.
pub fn rounded_up(value: f64) -> f32 {
    let nearest = value as f32;
    if f64::from(nearest) < value { nearest.next_up() } else { nearest }
}
