//! Cameras turned at random, and places as they see them; and random numbers of more kinds.

use std::f64::consts::LN_10;

use glam::DVec3;
use surfel::scene::Camera;

use crate::common::builder::Random;

/// Width and height of every picture.
pub const SIZE_PX: [u32; 2] = [64, 48];

/// More kinds of random numbers.
pub trait Draws {
    /// From `lo` to below `hi`, even in the logarithm.
    fn log(&mut self, lo: f64, hi: f64) -> f64;
    /// From `lo` to `hi`.
    fn count(&mut self, lo: usize, hi: usize) -> usize;
    /// One of these.
    fn one_of<T: Copy>(&mut self, of: &[T]) -> T;
    /// True in this share of all cases.
    fn is(&mut self, share: f64) -> bool;
}

impl Draws for Random {
    fn log(&mut self, lo: f64, hi: f64) -> f64 {
        (LN_10 * self.between(lo.log10(), hi.log10())).exp()
    }

    fn count(&mut self, lo: usize, hi: usize) -> usize {
        lo + (self.unit() * (hi - lo + 1) as f64) as usize
    }

    fn one_of<T: Copy>(&mut self, of: &[T]) -> T {
        of[self.count(0, of.len() - 1)]
    }

    fn is(&mut self, share: f64) -> bool {
        self.unit() < share
    }
}

/// A camera, and what is where in its picture.
pub struct Looking {
    pub camera: Camera,
    /// Half the height of the image plane at z = 1.
    half: f64,
}

impl Looking {
    /// From an eye, in a random direction.
    pub fn from(random: &mut Random, eye: DVec3, distance: f64, fov_deg: f64) -> Self {
        let target = eye + random.direction() * distance;
        Self::of(random, eye, target, fov_deg)
    }

    /// To a target from a random direction.
    pub fn to(random: &mut Random, target: DVec3, distance: f64, fov_deg: f64) -> Self {
        let eye = target + random.direction() * distance;
        Self::of(random, eye, target, fov_deg)
    }

    fn of(random: &mut Random, eye: DVec3, target: DVec3, fov_deg: f64) -> Self {
        let fov_y_rad = fov_deg.to_radians();
        let camera = Camera { eye, target, up: random.direction(), fov_y_rad, ..Camera::default() };
        Self { camera, half: (0.5 * fov_y_rad).tan() }
    }

    /// A vector of view space (right, down, forward) in the world.
    pub fn vector(&self, in_view: DVec3) -> DVec3 {
        self.camera.view_from_world().rotation.transpose() * in_view
    }

    /// The point at a place of the image, in half heights from its middle, at a depth.
    pub fn point(&self, [x, y]: [f64; 2], z: f64) -> DVec3 {
        self.camera.eye + self.vector(DVec3::new(x * self.half, y * self.half, 1.0) * z)
    }

    /// A place of the image: so many half heights around the middle, a little more to the sides.
    pub fn place(&self, random: &mut Random, most: f64) -> [f64; 2] {
        [random.between(-1.3 * most, 1.3 * most), random.between(-most, most)]
    }

    /// The side of a pixel at a depth.
    pub fn pixel(&self, z: f64) -> f64 {
        2.0 * self.half * z / f64::from(SIZE_PX[1])
    }
}

/// The field of view in which a radius at a distance is so many pixels.
pub fn fov_deg_of(radius: f64, distance: f64, px: f64) -> f64 {
    let half = 0.5 * f64::from(SIZE_PX[1]) * radius / (px * distance);
    2.0 * half.atan().to_degrees()
}
