//! Radii from 1e-12 to 1e12: of the whole scene, and all in one object.

use glam::DVec3;

use super::{
    looking::{Draws as _, Looking},
    ordinary,
    put::{Made, Put},
};
use crate::common::builder::Random;

/// An ordinary scene in another unit.
pub fn units(random: &mut Random) -> Made {
    let unit = random.log(1e-12, 1e12);
    ordinary::of_unit(random, unit)
}

/// Radii from `1 / most` to `most` in one object, with the camera at the scale of some of them.
pub fn mixed(random: &mut Random, most: f64) -> Made {
    let mut put = Put::new(random);
    let own = random.log(most.recip(), most);
    let eye = random.direction() * own * random.between(0.0, 3.0);
    let (distance, fov_deg) = (own * 3.0, random.between(20.0, 70.0));
    let looking = Looking::from(random, eye, distance, fov_deg);
    for _ in 0..random.count(4, 14) {
        let place = looking.place(random, 1.0);
        let at = looking.point(place, own * random.between(2.0, 5.0));
        let (normal, radius) = (random.direction(), own * random.between(0.1, 0.6));
        put.splat(random, at, normal, radius);
    }
    for _ in 0..random.count(1, 6) {
        larger(random, &mut put, &looking, own, most);
    }
    for _ in 0..random.count(2, 8) {
        let place = looking.place(random, 1.0);
        let at = looking.point(place, own * random.between(2.0, 5.0));
        let (normal, radius) = (random.direction(), random.log(most.recip(), own));
        put.splat(random, at, normal, radius);
    }
    put.made(looking.camera, own)
}

/// A splat that is larger than the others: a wall behind them, or something as far off as it is large.
fn larger(random: &mut Random, put: &mut Put, looking: &Looking, own: f64, most: f64) {
    let radius = random.log(own, most);
    let in_view = DVec3::new(random.between(-0.8, 0.8), random.between(-0.8, 0.8), -1.0).normalize();
    let normal = looking.vector(in_view);
    let place = looking.place(random, 1.0);
    let at = match random.is(0.5) {
        true => {
            // So near to its middle that the plane is where f32 has its normal: 3e-8 of a hundred times the distance.
            let aside = normal.any_orthonormal_vector() * (0.5 * radius).min(100.0 * own) * random.unit();
            looking.point(place, own * random.log(5.0, 50.0)) + aside
        }
        false => looking.point(place, radius * random.log(1.5, 8.0)),
    };
    put.splat(random, at, normal, radius);
}
