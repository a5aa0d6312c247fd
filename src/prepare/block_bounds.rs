//! Bounds of blocks as a device has them, in 16 bytes each, behind the colors of a chunk: by these it leaves out blocks that the host has not looked at (`glsl/mark_visible.comp.glsl`).
//!
//! Eight halves: the middle of a ball around all centers, local space; its radius; the axis of a cone around all normals; the sine of the angle that none of them exceeds. What halves leave of a middle and an axis is in the
//! radius and the angle, which are rounded up. An axis is rounded toward 0, so that it is no longer than 1: where its product with a vector exceeds something, that of the whole axis does, too.

use glam::DVec3;

use super::blocks::Block;

/// Bytes of a block.
pub(super) const BOUNDS_BYTES: usize = 16;

/// The sine of angles of 90° and more, of which nothing is known.
const UNKNOWN: f64 = 2.0;

/// Halves end at 65504, and are normal from 2⁻¹⁴ on.
const MOST: f64 = 6e4;
const LEAST_NORMAL: f64 = 1.0 / 16_384.0;

/// What a device finds of a unit vector may differ from what is found here by so much of an angle (`passes/plan/blocks/balls.rs`).
const ANGLE_RESERVE_RAD: f64 = 1e-3;

/// The bits of the half next to a number toward 0, and that number; what is less than a normal one is 0.
fn toward_zero(number: f64) -> (u32, f64) {
    let single = number as f32;
    // What is rounded to f32 may be larger by a bit.
    let single =
        if f64::from(single).abs() > number.abs() { f32::from_bits(single.to_bits() - 1) } else { single };
    if f64::from(single).abs() < LEAST_NORMAL {
        return (0, 0.0);
    }
    let bits = single.to_bits() & 0xffff_e000;
    let half = bits >> 16 & 0x8000 | ((bits >> 13 & 0x3_ffff) - (112 << 10));
    (half, f64::from(f32::from_bits(bits)))
}

/// The bits of a half that is no less than a number that is not negative.
fn upward(number: f64) -> u32 {
    let (half, below) = toward_zero(number);
    match (half, number > below) {
        (0, true) => 1 << 10,
        (half, more) => half + u32::from(more),
    }
}

/// The words of a block's bounds.
fn words_of(block: &Block) -> [u32; 4] {
    let [x, y, z] = block.center.to_array().map(toward_zero);
    let middle = DVec3::new(x.1, y.1, z.1);
    let radius = (block.radius + middle.distance(block.center)) * (1.0 + 1e-6);
    let [u, v, w] = block.axis.to_array().map(toward_zero);
    let axis = DVec3::new(u.1, v.1, w.1);
    let angle = block.spread_rad + axis.angle_between(block.axis) + ANGLE_RESERVE_RAD;
    let is_known = angle < std::f64::consts::FRAC_PI_2 && block.center.length() + radius < MOST; // NaN is not
    if !is_known {
        return [0, 0, 0, upward(UNKNOWN) << 16];
    }
    let pair = |low: u32, high: u32| low | high << 16;
    [pair(x.0, y.0), pair(z.0, upward(radius)), pair(u.0, v.0), pair(w.0, upward(angle.sin()))]
}

/// Those of some blocks.
pub(super) fn words(blocks: &[Block]) -> Vec<[u32; 4]> {
    blocks.iter().map(words_of).collect()
}

#[cfg(test)]
mod tests;
