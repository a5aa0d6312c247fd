//! Clip curves as shaders have them: three lines of the splat's plane a curve (`glsl/inc/clip.glsl`).

use glam::{DMat2, DVec2, DVec3, Vec4};

use crate::{
    scene::{Clip, ClipCurve},
    shaders::config::CLIP_VECTORS,
};

/// What is cut off a splat: C, A and B of both curves, linear in (u, v, 1). The last number of C is the curve's turn: 1, or −1 where it
/// turns left; doubled of the second curve where only what both remove is cut off.
pub type ClipVectors = [[f32; 4]; CLIP_VECTORS as usize];

/// From this weight on a curve is its control polygon, within f32.
const HEAVIEST: f64 = 1e15;

/// Removes nothing.
const NOTHING: [[f32; 4]; 3] = [[0.0, 0.0, 1.0, 0.0], [0.0; 4], [0.0; 4]];

/// Those of a splat whose tangent vectors were turned by an angle within its plane.
pub fn clip_vectors(clip: &Clip, turn_rad: f64) -> ClipVectors {
    let both = matches!(clip, Clip::Both(..));
    let [first, second] = clip.curves().map(|curve| curve.map_or(NOTHING, |curve| lines(curve, turn_rad)));
    let mut vectors = [[0.0; 4]; CLIP_VECTORS as usize];
    vectors[..3].copy_from_slice(&first);
    vectors[3..].copy_from_slice(&second);
    if both {
        vectors[3][3] *= 2.0;
    }
    vectors
}

fn lines(curve: &ClipCurve, turn_rad: f64) -> [[f32; 4]; 3] {
    // What is at an angle to the old vectors is at so much less to the turned ones.
    let [start, end] = [curve.start_rad, curve.end_rad].map(|rad| DVec2::from_angle(f64::from(rad) - turn_rad));
    let middle = DMat2::from_angle(-turn_rad) * curve.middle.as_dvec2();
    let chord = line_between(start, end);
    if chord == DVec3::ZERO {
        // From a place to itself: nothing is removed.
        return NOTHING;
    }
    // Twice the area of the control triangle, positive where it lies to the right of the chord.
    let area = -chord.dot(middle.extend(1.0));
    let turn = if area < 0.0 { -1.0 } else { 1.0 };
    let weight = if area == 0.0 { 0.0 } else { f64::from(curve.weight).min(HEAVIEST) };
    let sides = [line_between(middle, end), line_between(start, middle)].map(|line| 2.0 * weight * turn * line);
    let vector = |line: DVec3, last: f64| line.extend(last).as_vec4();
    [vector(chord, turn), vector(sides[0], 0.0), vector(sides[1], 0.0)].map(|line: Vec4| line.to_array())
}

/// Positive to the left of the way from `a` to `b`: twice the area of the triangle that a place makes with them.
fn line_between(a: DVec2, b: DVec2) -> DVec3 {
    let d = b - a;
    DVec3::new(-d.y, d.x, a.perp_dot(b))
}
