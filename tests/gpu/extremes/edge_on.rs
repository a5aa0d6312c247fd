//! A large disk that the eye is all but in the plane of: ground under a camera that lies on it.
//!
//! So near to a plane its normal decides where it is: 3e-8 of the distance to the center is what rounding a normal to f32 moves it by. So
//! the normal is along an axis, and the center on a grid that f32 has, relative to all else in the scene.

use glam::DVec3;

use super::{
    looking::{Draws as _, Looking},
    put::{Made, Put},
};
use crate::common::builder::Random;

/// The eye is from `least` to `most` of the distance to the center above the plane.
pub fn ground(random: &mut Random, least: f64, most: f64) -> Made {
    let mut put = Put::disks();
    let axis = random.count(0, 2);
    let up = DVec3::AXES[axis] * random.one_of(&[1.0, -1.0]);
    let center = grid(random, 4.0);
    let aside = loop {
        let aside = grid(random, 4.0);
        let aside = aside - up * aside.dot(up);
        if aside.length() > 0.5 {
            break aside;
        }
    };
    let height = aside.length() * random.log(least, most);
    let eye = center + aside + up * height;
    let radius = aside.length() * random.between(1.2, 4.0);
    let normal = if random.is(0.5) { up } else { -up };
    put.splat(random, center, normal, radius);

    let along = up.cross(random.direction()).normalize();
    let forward = (along + up * random.between(-0.6, 0.2)).normalize();
    let fov_deg = random.between(30.0, 80.0);
    let mut looking = Looking::from(random, eye, 1.0, fov_deg);
    looking.camera.target = eye + forward;
    looking.camera.near = Some(height * 1e-4);
    // What stands on it.
    for _ in 0..random.count(0, 6) {
        let at = eye
            + forward * random.between(1.0, 4.0)
            + up * random.between(0.0, 1.0)
            + along.cross(up) * random.between(-1.0, 1.0);
        let (normal, radius) = (random.direction(), random.between(0.1, 0.5));
        put.splat(random, (at * 64.0).round() / 64.0, normal, radius);
    }
    Made { exact_planes: true, ..put.made(looking.camera, 0.3) }
}

/// A point of a grid of 64ths.
fn grid(random: &mut Random, most: f64) -> DVec3 {
    (DVec3::from([0; 3].map(|_| random.between(-most, most))) * 64.0).round() / 64.0
}
