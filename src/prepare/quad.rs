//! Bounds side by side, as one look at several of them takes them.

use glam::Vec4;

use super::blocks::Block;

/// Bounds of up to four neighbors among blocks, or among runs of them: what [`Block`] has of each, one a component. They hold in f32 what is bounded in f64: lengths are rounded up, and of
/// middles a radius has what f32 leaves of them.
#[derive(Clone, Copy, Debug, Default)]
pub struct Quad {
    /// Middles of balls around all centers: x, y and z.
    pub center: [Vec4; 3],
    /// Their radii.
    pub radius: Vec4,
    /// The axes of cones around all normals.
    pub axis: [Vec4; 3],
    /// The sines and cosines of their angles.
    pub spread_sin_cos: [Vec4; 2],
    /// The largest major radii.
    pub largest_radius: Vec4,
    /// How many splats.
    pub counts: [u32; 4],
    /// A bit of each neighbor in which there are splats.
    pub filled: u32,
}

/// Lengths are larger by so much: more than all roundings of a sum of them in f32.
const LENGTHENED: f64 = 1.0 + 1e-6;

/// What is farther away has no bound: its square shall have room in f32.
const FARTHEST: f64 = 1e15;

impl Quad {
    /// Of the first four of some blocks, or of as many as there are.
    pub fn of(blocks: &[Block]) -> Self {
        let mut quad = Self::default();
        for (i, block) in blocks.iter().take(4).enumerate() {
            let center = block.center.as_vec3();
            let radius = block.radius + center.as_dvec3().distance(block.center);
            let is_bounded = block.center.length() + radius < FARTHEST; // NaN is not
            for axis in 0..3 {
                quad.center[axis][i] = if is_bounded { center[axis] } else { 0.0 };
                quad.axis[axis][i] = block.axis[axis] as f32;
            }
            quad.radius[i] = if is_bounded { (radius * LENGTHENED) as f32 } else { f32::INFINITY };
            quad.spread_sin_cos[0][i] = block.spread_sin_cos[0] as f32;
            quad.spread_sin_cos[1][i] = block.spread_sin_cos[1] as f32;
            quad.largest_radius[i] = (block.largest_radius * LENGTHENED) as f32;
            quad.counts[i] = block.count;
            quad.filled |= u32::from(block.count > 0) << i;
        }
        quad
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;
    use crate::math::random::SplitMix;

    #[test]
    fn a_quad_holds_its_blocks_though_it_has_half_their_digits() {
        let mut random = SplitMix(8);
        let mut between = |lo: f64, hi: f64| lo + (hi - lo) * random.unit();
        for round in 0..2000 {
            let size = 10_f64.powf(between(-12.0, 12.0));
            let blocks: Vec<Block> = (0..round % 4 + 1)
                .map(|_| Block {
                    count: 256,
                    center: size * DVec3::new(between(-1.0, 1.0), between(-1.0, 1.0), between(-1.0, 1.0)),
                    radius: size * between(0.0, 1.0).powi(12),
                    axis: DVec3::Z,
                    spread_rad: 0.5,
                    spread_sin_cos: 0.5_f64.sin_cos().into(),
                    largest_radius: size * between(0.0, 1.0),
                    levels: None,
                })
                .collect();
            let quad = Quad::of(&blocks);
            assert_eq!(quad.filled, (1 << blocks.len()) - 1);
            for (i, block) in blocks.iter().enumerate() {
                let center =
                    DVec3::new(quad.center[0][i].into(), quad.center[1][i].into(), quad.center[2][i].into());
                assert!(
                    center.distance(block.center) + block.radius <= f64::from(quad.radius[i]),
                    "{block:?}"
                );
                assert!(block.largest_radius <= f64::from(quad.largest_radius[i]), "{block:?}");
            }
        }
    }

    #[test]
    fn what_f32_has_no_room_for_is_without_bounds() {
        let far = |x: f64| Block {
            count: 1,
            center: DVec3::new(x, 0.0, 0.0),
            radius: 1.0,
            axis: DVec3::Z,
            spread_rad: 0.0,
            spread_sin_cos: [0.0, 1.0],
            largest_radius: 1.0,
            levels: None,
        };
        let quad = Quad::of(&[far(1e3), far(1e20), far(1e300), far(f64::NAN)]);
        assert!(quad.radius[0] < 1.1);
        for i in 1..4 {
            assert!(quad.center[0][i] == 0.0 && quad.radius[i] == f32::INFINITY);
        }
    }
}
