//! The local space of a chunk, and its view space in a frame.

use glam::{DMat3, DVec3};

use crate::scene::{Camera, Splats, ViewFromWorld};

/// `local = (world − origin) · scale`.
///
/// The origin is where most splats are, not the middle of their box: one stray point a thousand kilometres off, as
/// scanners leave them at (0, 0, 0), must not cost all others their digits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rebase {
    /// A world point in the thick of the chunk.
    pub origin: DVec3,
    /// A power of two, such that half of the splats are within about 1 of the origin in local space.
    pub scale: f64,
}

/// The motion from local to view space in a frame. View space has a unit of its own for each chunk, a power of two times
/// the world's, such that the eye's distance (or the chunk's size, if that is larger) is about 1: products of lengths stay
/// far from over- and underflow whatever the file's unit is. Nothing that chunks share depends on the unit: `near / z`
/// and pixels are ratios.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ViewFromLocal {
    /// The rotation.
    pub rotation: DMat3,
    /// The local origin in the view's unit.
    pub translation: DVec3,
    /// The factor of local lengths.
    pub view_from_local_scale: f64,
    /// The factor of world lengths.
    pub view_from_world_scale: f64,
    /// The local origin seen from the eye, not rotated, in the view's unit.
    pub origin_from_eye: DVec3,
}

/// The origin is a multiple of this part of the local unit, so that a scene and its copy at a representable offset have
/// the same local coordinates, bit by bit.
const ORIGIN_STEP: f64 = 1.0 / 1024.0;

/// At most so many splats are looked at, evenly spread over the sequence in which they are given.
pub(super) const SAMPLES: usize = 1 << 16;

impl Rebase {
    /// The local space of some splats; the world itself where none can be drawn.
    pub fn of(splats: &Splats, which: impl ExactSizeIterator<Item = usize>) -> Self {
        let stride = which.len().div_ceil(SAMPLES).max(1);
        let sampled: Vec<usize> = which.step_by(stride).filter(|&i| splats.defect(i).is_none()).collect();
        Self::of_balls(&sampled, |i| (splats.positions[i], splats.major_radius(i)))
    }

    /// The local space of some points, all finite; the world itself where there is none.
    pub fn of_points(points: &[DVec3]) -> Self {
        let sampled: Vec<usize> = (0..points.len()).step_by(points.len().div_ceil(SAMPLES).max(1)).collect();
        Self::of_balls(&sampled, |i| (points[i], 0.0))
    }

    /// The local space of balls, each a center and a radius.
    fn of_balls(sampled: &[usize], ball: impl Fn(usize) -> (DVec3, f64)) -> Self {
        let median = |value: &dyn Fn(usize) -> f64| {
            let mut values: Vec<f64> = sampled.iter().map(|&i| value(i)).collect();
            let middle = values.len() / 2;
            (!values.is_empty()).then(|| *values.select_nth_unstable_by(middle, f64::total_cmp).1)
        };
        let axis = |axis: usize| median(&|i| ball(i).0[axis]);
        let (Some(x), Some(y), Some(z)) = (axis(0), axis(1), axis(2)) else {
            return Self { origin: DVec3::ZERO, scale: 1.0 };
        };
        let middle = DVec3::new(x, y, z);
        // For splats at one place the radius is the only length there is.
        let size = median(&|i| ball(i).0.distance(middle).max(ball(i).1));
        let unit = power_of_two_above(size.unwrap_or(1.0));
        let step = unit * ORIGIN_STEP;
        let rounded = (middle / step).round() * step;
        Self { origin: if rounded.is_finite() { rounded } else { middle }, scale: unit.recip() }
    }

    /// A world point in local space.
    pub fn point(&self, world: DVec3) -> DVec3 {
        (world - self.origin) * self.scale
    }

    /// The motion into the view space of a camera.
    pub fn view_from_local(&self, camera: &Camera) -> ViewFromLocal {
        self.view_from(&camera.view_from_world())
    }

    /// The same, by that camera's own motion.
    #[inline]
    pub(crate) fn view_from(&self, view: &ViewFromWorld) -> ViewFromLocal {
        let origin_in_view = view.point(self.origin);
        let view_from_world_scale = one_over(self.unit_of_view(origin_in_view.length()));
        ViewFromLocal {
            rotation: view.rotation,
            translation: origin_in_view * view_from_world_scale,
            view_from_local_scale: view_from_world_scale / self.scale,
            view_from_world_scale,
            origin_from_eye: (self.origin - view.eye) * view_from_world_scale,
        }
    }

    /// The unit of view space in the world's, for an eye that is so far from the origin.
    pub(crate) fn unit_of_view(&self, distance: f64) -> f64 {
        power_of_two_above(distance.max(self.scale.recip()))
    }
}

impl ViewFromLocal {
    /// The rows of the rotation in f32, each with its component of the translation.
    pub fn rows(&self) -> [[f32; 4]; 3] {
        [0, 1, 2].map(|i| self.rotation.row(i).as_vec3().extend(self.translation[i] as f32).into())
    }

    /// For fine splats, which are moved by where the eye is (`glsl/inc/splat.glsl`): behind each row what f32 leaves of it, along the
    /// view's axis.
    pub fn fine_rows(&self) -> [[f32; 4]; 3] {
        let axis = self.rotation.row(2);
        [0, 1, 2].map(|i| {
            let row = self.rotation.row(i);
            let left = row - row.as_vec3().as_dvec3();
            row.as_vec3().extend(left.dot(axis) as f32).into()
        })
    }
}

/// The smallest power of two that is not below a length, within f64's own exponents, also for its reciprocal. By its bits: logarithms would be a tenth of what a small object costs a frame.
fn power_of_two_above(length: f64) -> f64 {
    const FRACTION_BITS: u32 = f64::MANTISSA_DIGITS - 1;
    const BIAS: u64 = f64::MAX_EXP as u64 - 1;
    if length > 0.0 {
        let bits = length.to_bits();
        let fraction = bits & ((1 << FRACTION_BITS) - 1);
        let exponent = (bits >> FRACTION_BITS) + u64::from(fraction != 0);
        f64::from_bits(exponent.clamp(BIAS - 1000, BIAS + 1000) << FRACTION_BITS)
    } else {
        1.0
    }
}

/// One over such a power of two, by its bits, too.
fn one_over(power_of_two: f64) -> f64 {
    f64::from_bits(2 * 1.0_f64.to_bits() - power_of_two.to_bits())
}

#[cfg(test)]
mod tests {
    #[test]
    fn one_over_a_power_of_two_is_its_quotient() {
        for length in [1e-320, 1e-301, 1e-9, 0.7, 1.0, 3.0, 1e9, 1e300, f64::INFINITY] {
            let unit = super::power_of_two_above(length);
            assert_eq!(super::one_over(unit), unit.recip(), "{length}");
        }
    }

    use super::*;
    use crate::scene::{Colors, Shapes};

    fn splats(positions: Vec<DVec3>, radius: f64) -> Splats {
        let count = positions.len();
        let shapes = Shapes::Disks { normals: vec![glam::Vec3::Z; count], radii: vec![radius as f32; count] };
        Splats::new(positions, shapes, Colors::Uniform([1.0; 4]))
    }

    fn three_at(offset: DVec3, size: f64) -> Splats {
        let places = [DVec3::ZERO, DVec3::new(0.75, 0.125, -0.5), DVec3::new(-0.5, 0.25, 0.5)];
        splats(places.map(|p| p * size + offset).to_vec(), 0.25 * size)
    }

    #[test]
    fn far_from_the_origin_local_coordinates_are_the_same_bit_by_bit() {
        let local = |offset: DVec3| {
            let splats = three_at(offset, 1.0);
            let rebase = Rebase::of(&splats, 0..3);
            splats.positions.iter().map(|p| rebase.point(*p).as_vec3()).collect::<Vec<_>>()
        };
        assert_eq!(local(DVec3::ZERO), local(DVec3::new(500_000.0, 4_600_000.0, 300.0)));
    }

    #[test]
    fn a_stray_point_costs_the_others_nothing() {
        let place = DVec3::new(500_000.0, 4_600_000.0, 300.0);
        let mut positions: Vec<DVec3> = (0..101).map(|i| place + 1e-5 * f64::from(i) * DVec3::X).collect();
        positions.push(DVec3::ZERO);
        let rebase = Rebase::of(&splats(positions.clone(), 1e-5), 0..102);
        for pair in positions[..101].windows(2) {
            let step = rebase.point(pair[1]).as_vec3() - rebase.point(pair[0]).as_vec3();
            // One part in a million of a step: f64 at 5e5 holds 6e-11, which is the rest.
            assert!((f64::from(step.x) / (1e-5 * rebase.scale) - 1.0).abs() < 2e-5, "{step}");
        }
    }

    #[test]
    fn units_are_the_next_powers_of_two() {
        for (length, expected) in
            [(1.0, 1.0), (1.0 + f64::EPSILON, 2.0), (0.75, 1.0), (1e-12, 2_f64.powi(-39))]
        {
            assert_eq!(power_of_two_above(length), expected, "{length}");
        }
        for length in [0.0, -1.0, f64::NAN] {
            assert_eq!(power_of_two_above(length), 1.0, "{length}");
        }
        let ends = [2_f64.powi(-1000), 2_f64.powi(1000)];
        for (length, end) in
            [(5e-324, 0), (1e-310, 0), (1e-302, 0), (1e302, 1), (f64::MAX, 1), (f64::INFINITY, 1)]
        {
            assert_eq!(power_of_two_above(length), ends[end], "{length}");
        }
        for exponent in -999..1000 {
            let power = 2_f64.powi(exponent);
            for (length, expected) in [(power, power), (0.51 * power, power), (1.01 * power, 2.0 * power)] {
                assert_eq!(power_of_two_above(length), expected, "{length}");
            }
        }
    }

    #[test]
    fn lengths_are_about_one_in_every_unit_of_the_world_and_at_every_distance() {
        for size in [1e-30, 1e-3, 1.0, 1e6, 1e30] {
            let rebase = Rebase::of(&three_at(DVec3::ZERO, size), 0..3);
            assert!((0.25..=1.0).contains(&(0.6 * size * rebase.scale)), "{size}: {rebase:?}");
            for distance in [1e-3, 1.0, 1e15] {
                let eye = rebase.origin + DVec3::Z * distance * size;
                let camera =
                    Camera { eye, target: rebase.origin, up: DVec3::Y, fov_y_rad: 1.0, ..Camera::default() };
                let view = rebase.view_from_local(&camera);
                let z = view.translation.z;
                assert!((distance * size * view.view_from_world_scale / z - 1.0).abs() < 1e-6);
                assert!(z <= 1.0 && (z > 0.5 || view.view_from_local_scale >= 0.5), "{size} {distance}: {z}");
            }
        }
    }
}
