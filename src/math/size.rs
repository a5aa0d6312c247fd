//! How large a splat's image can get: the host's proof that no point exceeds the device's cap.

use glam::Vec4;

/// The bounds of the splats of a chunk, seen from a camera; lengths in one unit.
#[derive(Clone, Copy, Debug)]
pub struct SizeBound {
    /// The smallest view-space depth of any point of any splat, as a device may find it.
    pub nearest_z: f64,
    /// The largest radius of a splat.
    pub largest_radius: f64,
    /// The depth of the near plane.
    pub near: f64,
    /// Focal length in pixels; under parallel rays, pixels of a unit.
    pub focal_px: f64,
    /// Rays are parallel.
    pub is_orthographic: bool,
    /// Width and height of the image in pixels.
    pub size_px: [f64; 2],
    /// Where the view's axis meets the image.
    pub middle_px: [f64; 2],
    /// How far from there the image reaches, as [`sides`] has it.
    pub sides: [[f64; 2]; 2],
    /// Radius of the low-pass filter in pixels; 0 without.
    pub filter_px: f64,
    /// How much further than that splats reach, in pixels at their centers' depth.
    pub reach_px: f64,
}

/// Radius over the nearest depth, up to which all splats are known to be regular.
const LARGEST_RADIUS_RATIO: f64 = 2.0;

/// Whether every splat is regular as `glsl/inc/mapping.glsl` has it: wholly beyond the near plane, and its depth radius d at
/// most 0.9 of its center's depth p. Its nearest point is p − d deep, at least the nearest depth z, so that d ≤ r ≤ 2 z ≤ 2 (p − d) is
/// d ≤ 2/3 p, and rounding does not matter; of the near plane, the nearest
/// depth has a reserve for it. Under parallel rays how deep it is does not matter.
pub(super) fn all_regular(bound: &SizeBound) -> bool {
    bound.nearest_z > bound.near
        && (bound.is_orthographic || bound.largest_radius <= LARGEST_RADIUS_RATIO * bound.nearest_z)
}

/// An upper bound of the side of a splat's box within the image, in pixels; infinite where a splat may come
/// near the eye plane.
///
/// Two points of a splat at x₁, x₂ in the image plane with depths z₁, z₂: `x₁ − x₂ = ((X₁ − X₂) − x₂ (z₁ − z₂)) / z₁`,
/// so that `|x₁ − x₂| ≤ 2r (1 + |x₂|) / z₁`, and `|x₂|` is at most half the image (of one off-center, the farthest side) where the box is clamped to it: a splat is connected, so
/// that the clamped ends of its box are places of points of it. Nothing of that asks how the tangent vectors lie, if r is the larger
/// singular value of the two. A filter adds its covariance, or less: of half an axis l it makes √(l² + h²) at the center's depth p (1%
/// more here), h of which is up to `p / z ≤ 1 + r/z` as much where the disk is nearest, at z. (`adjust-paper` lengthens each vector by
/// itself, two to h in any directions, which together reach √2 h: that is its h here. `max` adds its own disk about the center: of the
/// splat's ends a and b from there, max(a, h) + max(b, h) ≤ √((a + b)² + 4 h²) where a ≤ 6 b, as of all with d ≤ 2/3 p: a ≤ 5 b.)
/// What lies at a border reaches a h further than its rim (`glsl/inc/reach.glsl`), which is up to a h more than the filter makes of it, at either end.
/// Three pixels for rounding. Under parallel rays, x is X, and all of that is without depths.
pub fn largest_box_px(bound: &SizeBound) -> f64 {
    box_px(bound, bound.largest_radius)
}

/// That bound for splats with smaller radii among them.
pub fn box_px(bound: &SizeBound, radius: f64) -> f64 {
    box_within_px(bound, radius, half_image(bound))
}

/// From the view's axis to the left and right side of an image, and to the upper and lower one, in the image plane: the same for all that is seen in perspective.
pub fn sides(size_px: [f64; 2], middle_px: [f64; 2], focal_px: f64) -> [[f64; 2]; 2] {
    [0, 1].map(|i| [middle_px[i] / focal_px, (size_px[i] - middle_px[i]) / focal_px])
}

/// From the view's axis to the farthest side, in the image plane.
pub fn half_image(bound: &SizeBound) -> f64 {
    farthest(bound.sides)
}

/// The same of [`sides`].
pub fn farthest(sides: [[f64; 2]; 2]) -> f64 {
    sides.iter().flatten().fold(0.0, |most, side| most.max(side.abs()))
}

/// That bound for splats all of whose images, as far as they are in the image, lie within ±`most_x` of the image plane.
#[inline]
pub fn box_within_px(bound: &SizeBound, radius: f64, most_x: f64) -> f64 {
    if !all_regular(bound) {
        return f64::INFINITY;
    }
    if bound.is_orthographic {
        let filtered_px = length(2.0 * radius * bound.focal_px, 2.0 * bound.filter_px);
        return 1.01 * (filtered_px + 2.0 * bound.reach_px) + 3.0;
    }
    let per_z = 1.0 / bound.nearest_z;
    let splat_px = 2.0 * radius * (1.0 + most_x) * per_z * bound.focal_px;
    let nearer = 2.0 * (1.0 + radius * per_z);
    1.01 * (length(splat_px, bound.filter_px * nearer) + bound.reach_px * nearer) + 3.0
}

/// That bound in f32, four times, each with a smallest depth and a largest radius of its own; what f32 rounds is within the bound's hundredth.
#[inline(always)]
pub fn boxes_within_px(bound: &SizeBound, [nearest_z, radius, most_x]: [Vec4; 3]) -> Vec4 {
    let (focal_px, filter_px) = (bound.focal_px as f32, bound.filter_px as f32);
    let (splat_px, nearer) = if bound.is_orthographic {
        (2.0 * radius * focal_px, Vec4::splat(2.0))
    } else {
        let per_z = 1.0 / nearest_z;
        (2.0 * radius * (1.0 + most_x) * per_z * focal_px, 2.0 * (1.0 + radius * per_z))
    };
    let (filter_px, reach_px) = (filter_px * nearer, bound.reach_px as f32 * nearer);
    let is_beyond = nearest_z.cmpgt(Vec4::splat(bound.near as f32));
    let is_small = radius.cmple(LARGEST_RADIUS_RATIO as f32 * nearest_z);
    let are_regular = if bound.is_orthographic { is_beyond } else { is_beyond & is_small };
    let length = (splat_px * splat_px + filter_px * filter_px).sqrt();
    Vec4::select(are_regular, 1.01 * (length + reach_px) + 3.0, Vec4::INFINITY)
}

/// √(x² + y²), in a tenth of the time of `hypot`: what is too small for squares does not matter beside whole pixels, and what is too large is infinite.
fn length(x: f64, y: f64) -> f64 {
    (x * x + y * y).sqrt()
}

/// Pixels along a side whose centers such a box holds: half of the rounding is for `BOX_MARGIN_PX` of `glsl/inc/box.glsl`, and one
/// is what a length has more than whole pixels. Not by `floor`, which is a call where a processor has no instruction for it. What is wider than any image, or NaN, has a billion.
pub fn pixels_along(box_px: f64) -> u64 {
    if box_px < 1e9 { (box_px - 1.5) as u64 } else { 1_000_000_000 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{DVec2, DVec3};
    use proptest::prelude::*;

    #[test]
    fn whole_pixels_of_a_box_are_its_floor_and_of_what_has_no_bound_there_are_many() {
        for box_px in [3.0, 3.4, 3.5, 4.49, 4.5, 17.0, 1e6 + 0.4, 9.9e8] {
            assert_eq!(pixels_along(box_px), (box_px - 1.5).floor() as u64, "{box_px}");
        }
        for box_px in [1e9, f64::INFINITY, f64::NAN] {
            assert_eq!(pixels_along(box_px), 1_000_000_000);
        }
    }

    proptest! {
        /// Points of random disks in front of the near plane never span more than the bound.
        #[test]
        fn no_disk_spans_more_than_the_bound(
            center in prop::array::uniform3(-3.0..3.0_f64),
            s in prop::array::uniform3(-1.0..1.0_f64),
            t in prop::array::uniform3(-1.0..1.0_f64),
        ) {
            let (p, s, t) = (glam::DVec3::from(center) + 4.5 * glam::DVec3::Z, glam::DVec3::from(s), glam::DVec3::from(t));
            let rim: Vec<_> = (0..360).map(|i| f64::from(i).to_radians()).map(|a| p + s * a.cos() + t * a.sin()).collect();
            let nearest_z = rim.iter().map(|q| q.z).fold(f64::MAX, f64::min) - 1e-3;
            prop_assume!(nearest_z > 0.1);
            let bound = SizeBound {
                nearest_z, largest_radius: s.length().hypot(t.length()), near: 0.01,
                focal_px: 100.0, is_orthographic: false, size_px: [200.0, 100.0], middle_px: [100.0, 50.0], sides: [[1.0; 2], [0.5; 2]], filter_px: 0.0, reach_px: 0.0,
            };
            let half = [1.0, 0.5];
            for axis in 0..2 {
                let inside = rim.iter().map(|q| [q.x / q.z, q.y / q.z]).filter(|x| x[0].abs() < half[0] && x[1].abs() < half[1]);
                let (lo, hi) = inside.map(|x| x[axis]).fold((f64::MAX, f64::MIN), |(lo, hi), x| (lo.min(x), hi.max(x)));
                if hi > lo {
                    prop_assert!((hi - lo) * 100.0 <= largest_box_px(&bound));
                }
            }
        }
    }

    /// Tangent vectors whose images are as long as under a convolution with a disk of radius h, and 0.2% longer: what a filter makes of a
    /// splat (`glsl/inc/adjust.glsl`), with depths of its own.
    fn widened(center: DVec3, s: DVec3, t: DVec3, h: f64) -> (DVec3, DVec3) {
        let image = |v: DVec3| (v.truncate() - center.truncate() / center.z * v.z) / center.z;
        let (a, b) = (image(s), image(t));
        let (sin, cos) = (0.5 * (2.0 * a.dot(b)).atan2(a.length_squared() - b.length_squared())).sin_cos();
        let long = image(cos * s + sin * t).try_normalize().unwrap_or(DVec2::X);
        let axis = |v: DVec3, direction: DVec2| {
            let length = image(v).length();
            let z = v.z * (16.0 * length / h).min(1.0);
            let ray = center.truncate() / center.z;
            (direction * (1.002 * length.hypot(h) * center.z) + ray * z).extend(z)
        };
        (axis(cos * s + sin * t, long), axis(cos * t - sin * s, long.perp()))
    }

    /// Lists of splats by tile have room for what the host's bound of a box allows, and no more.
    #[test]
    fn no_widened_disk_spans_more_than_the_bound_of_its_box() {
        let mut random = crate::math::random::SplitMix(5);
        let mut between = |lo: f64, hi: f64| lo + (hi - lo) * random.unit();
        let (focal_px, mut tightest) = (500.0, [0.0_f64; 2]);
        for round in 0..20_000 {
            let z = between(0.5, 4.0);
            let center = DVec3::new(between(-0.4, 0.4) * z, between(-0.4, 0.4) * z, z);
            let normal = DVec3::new(between(-1.0, 1.0), between(-1.0, 1.0), between(-1.0, 1.0)).normalize();
            // From a thousandth of a pixel to what is as deep as may be bounded.
            let radius = z / focal_px * 10.0_f64.powf(between(-3.0, 2.52));
            let s = radius * normal.any_orthonormal_vector();
            let t = between(0.01, 1.0) * normal.cross(s);
            let h = std::f64::consts::SQRT_2 / focal_px;
            let (s, t) = widened(center, s, t, h);
            let rim = (0..360).map(|i| f64::from(i).to_radians()).map(|a| center + s * a.cos() + t * a.sin());
            let image = rim.map(|p| p.truncate() / p.z * focal_px);
            let first = [DVec2::INFINITY, DVec2::NEG_INFINITY];
            let [lo, hi] = image.fold(first, |[lo, hi], x| [lo.min(x), hi.max(x)]);
            let [lo, hi] = [lo, hi].map(|x| x.clamp(DVec2::splat(-240.0), DVec2::splat(240.0)));
            let bound = SizeBound {
                nearest_z: z - radius,
                largest_radius: radius,
                near: 1e-3,
                focal_px,
                is_orthographic: false,
                size_px: [480.0; 2],
                middle_px: [240.0; 2],
                sides: sides([480.0; 2], [240.0; 2], focal_px),
                filter_px: std::f64::consts::SQRT_2,
                reach_px: 0.0,
            };
            // Three pixels of the bound are for rounding.
            let most_px = box_px(&bound, radius) - 3.0;
            assert!(most_px.is_infinite() || s.z.hypot(t.z) < 0.7 * z, "{round}: regular to 0.9 of {z}");
            let span_px = (hi - lo).max_element();
            assert!(span_px <= most_px, "{round}: {span_px} px, at most {most_px}");
            // Of the filter's own width, and of large ones, which slant.
            let large = usize::from(span_px > 50.0);
            tightest[large] = tightest[large].max(span_px / most_px);
        }
        assert!(tightest[0] > 0.9 && tightest[1] > 0.6, "{tightest:?}: the bound could be less");
    }

    #[test]
    fn a_splat_that_may_reach_the_near_plane_has_no_bound() {
        let bound = SizeBound {
            nearest_z: 0.1,
            largest_radius: 1.0,
            near: 0.1,
            focal_px: 100.0,
            is_orthographic: false,
            size_px: [100.0; 2],
            middle_px: [50.0; 2],
            sides: [[0.5; 2]; 2],
            filter_px: 0.0,
            reach_px: 0.0,
        };
        assert_eq!(largest_box_px(&bound), f64::INFINITY);
    }

    #[test]
    fn four_bounds_in_f32_are_as_one_in_f64() {
        let mut random = crate::math::random::SplitMix(6);
        let mut between = |lo: f64, hi: f64| lo + (hi - lo) * random.unit();
        for round in 0..1000 {
            let focal_px = between(10.0, 5000.0);
            let bound = SizeBound {
                nearest_z: 0.0,
                largest_radius: 0.0,
                near: 0.1,
                focal_px,
                is_orthographic: round % 3 == 0,
                size_px: [640.0, 480.0],
                middle_px: [320.0, 240.0],
                sides: sides([640.0, 480.0], [320.0, 240.0], focal_px),
                filter_px: between(0.0, 1.5),
                reach_px: 0.0,
            };
            let lanes = [0; 4].map(|_| [between(-0.1, 2.0), between(0.0, 1.0).powi(4), between(0.0, 3.0)]);
            let lane = |of: usize| Vec4::from_array(lanes.map(|lane| lane[of] as f32));
            let found = boxes_within_px(&bound, [lane(0), lane(1), lane(2)]);
            for (i, [nearest_z, radius, most_x]) in lanes.into_iter().enumerate() {
                let one =
                    box_within_px(&SizeBound { nearest_z, largest_radius: radius, ..bound }, radius, most_x);
                let four = f64::from(found[i]);
                assert!(four == one || (four - one).abs() <= 1e-6 * one, "{four} {one} of {bound:?}");
            }
        }
    }
}
