//! Disks in 16 bytes instead of 32, for `--splat-format packed`; its mirror is `glsl/inc/packed.glsl`.
//!
//! Four words. The lower 25 bits of the first three are the center's coordinates, as signed multiples of 2⁻²⁴ of the chunk's
//! own half side: f32 has them exactly. The upper 7 bits of each are a radius of 21 bits, an exponent of 5 and a fraction
//! of 16, *rounded up*, so that no hole opens: at most 1.6e-5 too large, down to 2⁻³² of that side. (A half float would be 1e-3 too
//! large; steps of the largest radius would be coarse for all that are much smaller.) The last word is the
//! normal: octahedral (Meyer, Süßmuth, Sußner, Stamminger, Greiner, "On Floating-Point Normal Vectors", 2010; Cigolle et
//! al., "A Survey of Efficient Representations for Independent Unit Vectors", JCGT 3(2), 2014), 16 bits a coordinate.
//! Both are off by half a step h = 1/65534 at most, which moves a point of the octahedron by √6 h, and the direction by √6 h over
//! the least distance of the octahedron from its center, 1/√3: by [`LARGEST_TURN_RAD`], 0.0037°.
//!
//! Colors, where each splat has its own: 8 bits a channel; the square roots of red, green, blue, which are off by 1/510 at
//! most: by 0.73 of a level of sRGB, where dark, and half a level where light; and alpha.

use glam::{DVec2, DVec3};

use super::rebase::Rebase;

/// Bytes of a disk.
pub const DISK_BYTES: usize = 16;

/// Bytes of a color.
pub const COLOR_BYTES: usize = 4;

/// The largest angle between a normal and what is left of it: √18/65534, and the rounding of f32.
pub const LARGEST_TURN_RAD: f64 = 6.5e-5;

/// The farthest that anything of a chunk may be from its origin, in units within which half of its splats are, if the chunk is to be
/// packed. A coordinate is then off by 5e-7 units at most, 1/4000 of a pixel where those two units fill 1024.
const REACH: f64 = 16.0;

/// A coordinate's steps a half side: 24 bits and a sign.
const STEPS: f64 = (1 << 24) as f64;

/// One of them, of a half side of 1.
pub const STEP: f64 = 1.0 / STEPS;

/// The number that is added to a radius's code to make it the upper 25 bits of an f32: the largest code is the radius 1.
const RADIUS_BASE: u32 = (1.0_f32.to_bits() >> 7) - RADIUS_MAX;

/// The largest code of a radius.
const RADIUS_MAX: u32 = (1 << 21) - 1;

/// The steps of a signed 16-bit fraction.
const NORMAL_STEPS: f64 = 32767.0;

/// The local space of a chunk that is to be packed: centers and radii within 1. `None` where something is so far off that the others
/// would be seen to move: such a chunk stays exact.
///
/// `largest` is the largest coordinate or radius in the local space `rebase`.
pub fn rebase(rebase: Rebase, largest: f64) -> Option<Rebase> {
    let side = if largest > 0.0 { largest.log2().ceil().exp2() } else { 1.0 };
    let smaller = Rebase { scale: rebase.scale / side, ..rebase };
    (side <= REACH && smaller.scale.is_normal()).then_some(smaller)
}

/// A disk as words: center and radius in a space of [`rebase`], the normal of unit length.
pub fn disk(center: DVec3, normal: DVec3, radius: f64) -> [u32; 4] {
    let coordinates = (center * STEPS).round().clamp(DVec3::splat(-STEPS), DVec3::splat(STEPS - 1.0));
    let code = radius_code(radius);
    let word =
        |coordinate: f64, part: u32| coordinate as i32 as u32 & 0x1ff_ffff | (code >> part & 0x7f) << 25;
    [word(coordinates.x, 0), word(coordinates.y, 7), word(coordinates.z, 14), normal_word(normal)]
}

/// Center, normal and radius of words, as a device has them.
pub fn unpacked_disk(words: [u32; 4]) -> (DVec3, DVec3, f64) {
    let coordinate = |word: u32| f64::from((word << 7) as i32) / (128.0 * STEPS);
    let code = words[0] >> 25 | words[1] >> 25 << 7 | words[2] >> 25 << 14;
    let center = DVec3::new(coordinate(words[0]), coordinate(words[1]), coordinate(words[2]));
    (center, unpacked_normal(words[3]), unpacked_radius(code))
}

/// The least code whose radius is not below this one.
fn radius_code(radius: f64) -> u32 {
    let near = radius as f32;
    let above = if f64::from(near) < radius { near.next_up() } else { near };
    let upper = above.to_bits().div_ceil(1 << 7);
    upper.saturating_sub(RADIUS_BASE).min(RADIUS_MAX)
}

fn unpacked_radius(code: u32) -> f64 {
    f32::from_bits((code + RADIUS_BASE) << 7).into()
}

/// The radius that a packed disk has: no less than this one.
pub fn widened(radius: f64) -> f64 {
    unpacked_radius(radius_code(radius))
}

fn normal_word(normal: DVec3) -> u32 {
    let on_octahedron = normal / normal.abs().element_sum();
    let upper = on_octahedron.truncate();
    let square = if normal.z < 0.0 { folded(upper) } else { upper };
    let [x, y] = (square * NORMAL_STEPS).round().to_array().map(|step| u32::from(step as i16 as u16));
    x | y << 16
}

fn unpacked_normal(word: u32) -> DVec3 {
    let [x, y] = [word, word >> 16].map(|half| (f64::from(half as u16 as i16) / NORMAL_STEPS).max(-1.0));
    let square = DVec2::new(x, y);
    let z = 1.0 - x.abs() - y.abs();
    if z < 0.0 { folded(square) } else { square }.extend(z).normalize()
}

/// The lower half of the octahedron outside of the square's inner diamond, and back.
fn folded(v: DVec2) -> DVec2 {
    let sign = |x: f64| if x < 0.0 { -1.0 } else { 1.0 };
    DVec2::new((1.0 - v.y.abs()) * sign(v.x), (1.0 - v.x.abs()) * sign(v.y))
}

/// A color as a word; what is no number is 0.
pub fn color([red, green, blue, alpha]: [f32; 4]) -> u32 {
    let root = |c: f32| c.clamp(0.0, 1.0).sqrt();
    let channels = [root(red), root(green), root(blue), alpha.clamp(0.0, 1.0)];
    u32::from_le_bytes(channels.map(|c| (c * 255.0).round() as u8))
}

/// The color of a word.
pub fn unpacked_color(word: u32) -> [f32; 4] {
    let [red, green, blue, alpha] = word.to_le_bytes().map(|c| f32::from(c) / 255.0);
    [red * red, green * green, blue * blue, alpha]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::SplitMix;

    fn directions() -> impl Iterator<Item = DVec3> {
        let mut random = SplitMix(3);
        let spread = (0..100_000).map(move |_| {
            DVec3::new(random.unit() - 0.5, random.unit() - 0.5, random.unit() - 0.5).normalize()
        });
        let corners =
            (0..27).map(|i| DVec3::new(f64::from(i % 3), f64::from(i / 3 % 3), f64::from(i / 9)) - 1.0);
        spread.chain(corners.filter(|corner| *corner != DVec3::ZERO).map(DVec3::normalize))
    }

    #[test]
    fn normals_turn_by_no_more_than_the_bound_and_nearly_as_much() {
        let turn = |n: DVec3| n.cross(unpacked_normal(normal_word(n))).length();
        let worst = directions().map(turn).fold(0.0, f64::max);
        assert!((0.9 * LARGEST_TURN_RAD..=LARGEST_TURN_RAD).contains(&worst), "{worst:e}");
        // Not turned around: a cross product does not see that.
        assert!(directions().all(|n| n.dot(unpacked_normal(normal_word(n))) > 0.99));
        for axis in [DVec3::X, DVec3::Y, DVec3::Z] {
            assert_eq!([axis, -axis].map(|n| unpacked_normal(normal_word(n))), [axis, -axis]);
        }
    }

    #[test]
    fn radii_are_never_less_and_hardly_more() {
        let mut random = SplitMix(5);
        for _ in 0..100_000 {
            let radius = (-32.0 * random.unit()).exp2();
            let ratio = widened(radius) / radius;
            assert!(
                (1.0..=1.0 + 1.0 / 65536.0 + 1e-7).contains(&ratio) || radius < 2.4e-10,
                "{radius:e}: {ratio}"
            );
        }
        assert_eq!([1.0, 0.5, 0.25].map(widened), [1.0, 0.5, 0.25]);
        assert!(widened(1e-30) >= 1e-30);
    }

    #[test]
    fn centers_stay_within_half_a_step_up_to_the_corners() {
        let mut random = SplitMix(7);
        let mut number = || 2.0 * random.unit() - 1.0;
        let corners = [DVec3::ONE, -DVec3::ONE, DVec3::ZERO];
        for center in (0..10_000).map(|_| DVec3::new(number(), number(), number())).chain(corners) {
            let (got, normal, radius) = unpacked_disk(disk(center, DVec3::Z, 0.75));
            // 1 itself is a step beyond the last number.
            let steps = if center == DVec3::ONE { 1.0 } else { 0.5 };
            assert!((got - center).abs().max_element() <= steps / STEPS, "{center}: {got}");
            assert_eq!(got, got.as_vec3().as_dvec3(), "f32 has it exactly");
            assert_eq!((normal, radius), (DVec3::Z, 0.75), "the others' bits");
        }
    }

    #[test]
    fn colors_are_off_by_half_a_level_of_their_roots() {
        for i in 0..=1000_u16 {
            let c = f32::from(i) / 1000.0;
            let [red, green, blue, alpha] = unpacked_color(color([c, 1.0 - c, 0.25 * c, c]));
            for (got, expected) in [(red, c), (green, 1.0 - c), (blue, 0.25 * c)] {
                assert!((got.sqrt() - expected.sqrt()).abs() <= 1.0 / 509.9, "{expected}: {got}");
            }
            assert!((alpha - c).abs() <= 1.0 / 509.9);
        }
        assert_eq!(unpacked_color(color([0.0, 1.0, f32::NAN, 2.0])), [0.0, 1.0, 0.0, 1.0]);
    }

    #[test]
    fn what_has_something_far_off_stays_exact() {
        let one = Rebase { origin: DVec3::ONE, scale: 2.0 };
        assert_eq!(rebase(one, 0.75), Some(one));
        assert_eq!(rebase(one, 16.0), Some(Rebase { scale: 0.125, ..one }));
        assert_eq!(rebase(one, 16.1), None);
    }
}
