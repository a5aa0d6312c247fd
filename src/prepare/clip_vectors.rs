//! Clip curves as shaders have them: three lines of the splat's plane a curve (`glsl/inc/clip.glsl`).

use glam::{DMat2, DVec2, DVec3, Vec4};

use crate::{
    scene::{Clip, ClipCurve},
    shaders::config::{CLIP_VECTORS, CURVE_BOTH, CURVE_IS, CURVE_LEFT},
};

/// What is cut off a splat: C, A and B of both curves, linear in (u, v, 1). The last number of C is the sum of what is known of the curve,
/// `CURVE_*`; that of A twice its weight.
pub type ClipVectors = [[f32; 4]; CLIP_VECTORS as usize];

/// From this weight on a curve is its control polygon, within f32.
const HEAVIEST: f64 = 1e8;

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
        vectors[3][3] += CURVE_BOTH as f32;
    }
    vectors
}

fn lines(curve: &ClipCurve, turn_rad: f64) -> [[f32; 4]; 3] {
    // What is at an angle to the old vectors is at so much less to the turned ones.
    let [start, end] =
        [curve.start_rad, curve.end_rad].map(|rad| DVec2::from_angle(f64::from(rad) - turn_rad));
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
    let sides = [line_between(middle, end), line_between(start, middle)].map(|line| turn * line);
    let vector = |line: DVec3, last: f64| line.extend(last).as_vec4();
    let known = CURVE_IS + if area < 0.0 { CURVE_LEFT } else { 0 };
    [vector(chord, known.into()), vector(sides[0], 2.0 * weight), vector(sides[1], 0.0)]
        .map(|line: Vec4| line.to_array())
}

/// Positive to the left of the way from `a` to `b`: twice the area of the triangle that a place makes with them.
fn line_between(a: DVec2, b: DVec2) -> DVec3 {
    let d = b - a;
    DVec3::new(-d.y, d.x, a.perp_dot(b))
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{PI, TAU};

    use glam::Vec2;

    use super::*;
    use crate::{math::random::SplitMix, reference::removes, scene::ClipTest};

    /// As `glsl/inc/clip.glsl` has it, in f32.
    fn kept_side([c, a, b]: [[f32; 4]; 3], [u, v]: [f32; 2]) -> f32 {
        let at = |line: [f32; 4]| line[0] * u + line[1] * v + line[2];
        let turn = if c[3] as u32 & CURVE_LEFT != 0 { -1.0 } else { 1.0 };
        at(c) + turn * a[3] * (at(a).max(0.0) * at(b).max(0.0)).sqrt()
    }

    fn shader_removes(vectors: ClipVectors, place: [f32; 2]) -> bool {
        let curves = [[vectors[0], vectors[1], vectors[2]], [vectors[3], vectors[4], vectors[5]]];
        let removed = curves.map(|curve| curve[0][3] as u32 & CURVE_IS != 0 && kept_side(curve, place) < 0.0);
        let both = curves[1][0][3] as u32 & CURVE_BOTH != 0;
        if both { removed[0] && removed[1] } else { removed[0] || removed[1] }
    }

    /// A curve whose degenerate case is a number: of a line, of one point, of a middle on the chord, of nearly no chord, without and with all
    /// of the weight there is.
    fn curve(random: &mut SplitMix, case: u32) -> ClipCurve {
        let mut number = |lo: f64, hi: f64| (lo + (hi - lo) * random.unit()) as f32;
        let start_rad = number(-PI, PI);
        let end_rad = match case % 8 {
            0 => start_rad,
            1 => start_rad + 1e-4,
            _ => start_rad + number(0.05, TAU - 0.05),
        };
        let middle = match case / 8 % 3 {
            0 => 0.5 * (Vec2::from_angle(start_rad) + Vec2::from_angle(end_rad)),
            _ => Vec2::new(number(-1.5, 1.5), number(-1.5, 1.5)),
        };
        let weight = [0.0, 1e-30, 1e30, 1.0, number(0.0, 3.0)][(case / 24 % 5) as usize];
        ClipCurve { start_rad, end_rad, middle, weight }
    }

    /// Where they disagree, the place moved by some roundings of f32 is one where the oracle disagrees with itself.
    #[test]
    fn a_million_places_are_removed_as_by_the_oracle_but_beside_the_curve() {
        let mut random = SplitMix(4);
        let (mut disagree, mut removed) = (0, 0);
        for i in 0..20_000 {
            let [first, second] = [curve(&mut random, i), curve(&mut random, i / 7)];
            let clip =
                [Clip::One(first), Clip::Either(first, second), Clip::Both(first, second)][i as usize % 3];
            let vectors = clip_vectors(&clip, 0.0);
            for _ in 0..50 {
                let place = [(); 2].map(|()| (2.0 * random.unit() - 1.0) as f32);
                let wide = DVec2::from(place.map(f64::from));
                let expected = removes(&clip, wide, ClipTest::Conic);
                removed += usize::from(expected);
                if shader_removes(vectors, place) == expected {
                    continue;
                }
                disagree += 1;
                let near = (0..16).map(|k| wide + 2e-6 * DVec2::from_angle(f64::from(k) * TAU / 16.0));
                let is_beside = near.map(|at| removes(&clip, at, ClipTest::Conic)).any(|at| at != expected);
                assert!(is_beside, "{clip:?} at {wide}");
            }
        }
        println!("{disagree} of a million disagree, {removed} are removed");
        assert!(disagree < 20 && removed > 300_000 && removed < 700_000, "{disagree}, {removed}");
    }

    #[test]
    fn turned_tangent_vectors_have_the_curve_where_it_was() {
        let mut random = SplitMix(5);
        for i in 0..2_000 {
            let clip = Clip::Either(curve(&mut random, 3 + 8 * i), curve(&mut random, 4 + 8 * i));
            let turn_rad = PI * (2.0 * random.unit() - 1.0);
            let vectors = clip_vectors(&clip, turn_rad);
            let mut wrong = 0;
            for _ in 0..50 {
                let place = DVec2::new(2.0 * random.unit() - 1.0, 2.0 * random.unit() - 1.0);
                let turned = DMat2::from_angle(-turn_rad) * place;
                let expected = removes(&clip, place, ClipTest::Conic);
                wrong += usize::from(shader_removes(vectors, [turned.x as f32, turned.y as f32]) != expected);
            }
            assert!(wrong <= 1, "{clip:?} turned by {turn_rad}");
        }
    }
}
