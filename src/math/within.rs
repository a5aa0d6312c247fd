//! Whether images of splats are small, told by a few products.

use super::size::{SizeBound, all_regular};

/// Whether the bound of the largest is told to be no more than so many pixels without a root or a quotient: nearly always where nothing is large, and a frame may show hundreds of things. If not, it may be so all the same.
pub fn is_within_px(bound: &SizeBound, most_x: f64, px: f64) -> bool {
    let (radius, z) = (bound.largest_radius, bound.nearest_z);
    // Both sides times the depth; a length is no more than the sum of its parts.
    let splat = 2.0 * radius * (1.0 + most_x) * bound.focal_px;
    let around = 2.0 * (z + radius) * (bound.filter_px + bound.reach_px);
    !bound.is_orthographic && all_regular(bound) && 1.0101 * (splat + around) < (px - 3.01) * z
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::size::{half_image, largest_box_px};

    /// What is told without a root or a quotient is so, and is told of most that is small.
    #[test]
    fn what_is_told_to_be_within_some_pixels_is_and_most_that_is_small_is_told_to_be() {
        let mut random = crate::math::random::SplitMix(11);
        let mut between = |lo: f64, hi: f64| lo + (hi - lo) * random.unit();
        let (mut small, mut told) = (0, 0);
        for _ in 0..20_000 {
            let largest_radius = between(0.0, 1.0).powi(6);
            let bound = SizeBound {
                nearest_z: between(-0.1, 2.0),
                largest_radius,
                near: 0.01,
                focal_px: between(10.0, 2000.0),
                is_orthographic: between(0.0, 1.0) < 0.1,
                size_px: [200.0, 100.0],
                middle_px: [100.0, 50.0],
                sides: [[between(0.1, 2.0); 2], [0.5; 2]],
                filter_px: between(0.0, 1.5),
                reach_px: between(0.0, 1.0),
            };
            let px = between(4.0, 256.0);
            let is_told = is_within_px(&bound, half_image(&bound), px);
            assert!(!is_told || largest_box_px(&bound) <= px, "{bound:?}: {px}");
            let is_small = !bound.is_orthographic && 1.5 * largest_box_px(&bound) < px;
            (small, told) = (small + i32::from(is_small), told + i32::from(is_small && is_told));
        }
        assert!(small > 1000 && told * 100 > small * 95, "{told} of {small}");
    }
}
