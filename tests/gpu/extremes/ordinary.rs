//! Scenes without anything hard about them: clouds, balls and patches.

use super::{
    looking::{Draws as _, Looking},
    put::{Made, Put},
};
use crate::common::builder::Random;

/// One in the world's own unit.
pub fn any(random: &mut Random) -> Made {
    of_unit(random, 1.0)
}

/// One in this unit.
pub fn of_unit(random: &mut Random, unit: f64) -> Made {
    let mut put = Put::new(random);
    let center = random.direction() * unit * random.between(0.0, 3.0);
    let kind = random.count(0, 2);
    let plane = random.direction();
    for _ in 0..random.count(5, 60) {
        let toward = random.direction();
        let (offset, normal) = match kind {
            0 => (toward * random.unit(), random.direction()),
            1 => (toward, toward),
            _ => (toward - plane * plane.dot(toward), (plane + random.direction() * 0.1).normalize()),
        };
        let at = center + offset * unit;
        let radius = unit * random.log(0.05, 0.6);
        put.splat(random, at, normal, radius);
    }
    let (distance, fov_deg) = (unit * random.between(1.8, 6.0), random.between(15.0, 70.0));
    let looking = Looking::to(random, center, distance, fov_deg);
    put.made_of(looking.camera, 0.2 * unit, kind == 1 && random.is(0.5))
}
