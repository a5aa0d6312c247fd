//! Far sheets, apart by more than ε, in steps that f32 can tell apart still.

use surfel::scene::Epsilon;

use super::{
    looking::{Draws as _, Looking},
    put::{Made, Put},
};
use crate::common::builder::Random;

/// Three steps of f32: what a depth may be off after a rounded center, a rounded transform and a rounded depth.
const DEPTH_STEPS: f64 = 3.0 / 16_777_216.0;

/// Two to four parallel sheets at this distance at least; the gap between ε and the next sheet is `least` to `most` of it.
pub fn far(random: &mut Random, least: f64, most: f64) -> Made {
    let mut put = Put::disks();
    let distance = random.log(1e3, 1e6);
    let eye = random.direction() * distance * random.between(0.0, 1.0);
    let fov_deg = random.log(0.1, 50.0);
    let looking = Looking::from(random, eye, distance, fov_deg);
    let gap = distance * random.log(least, most);
    // From a little less than the distance between the sheets to nothing of it.
    let apart = gap * random.log(1.0, 4.0);
    let epsilon = apart - gap;
    for sheet in 0..random.count(2, 4) {
        let place = looking.place(random, 0.5);
        let at = looking.point(place, distance + apart * sheet as f64);
        let normal = -looking.vector(glam::DVec3::Z);
        let radius = looking.pixel(distance) * random.between(8.0, 30.0);
        put.splat(random, at, normal, radius);
    }
    let made = put.made(looking.camera, 0.0);
    Made { epsilon: Some(Epsilon::Length(epsilon)), depth_steps: DEPTH_STEPS, ..made }
}
