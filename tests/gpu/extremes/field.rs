//! Fields of view from 0.001 degrees to 179.99, with the camera turned at random.

use glam::DVec3;

use super::{
    looking::{Draws as _, Looking},
    put::{Made, Put},
};
use crate::common::builder::Random;

/// A scene as deep as it is far, and as wide, through a telephoto lens of so many degrees.
pub fn telephoto(random: &mut Random, narrowest_deg: f64, widest_deg: f64) -> Made {
    let mut put = Put::new(random);
    let distance = random.log(1.0, 1e3);
    let eye = random.direction() * distance * random.between(0.0, 2.0);
    let fov_deg = random.log(narrowest_deg, widest_deg);
    let looking = Looking::from(random, eye, distance, fov_deg);
    let mut seen_radius = 0.0;
    for _ in 0..random.count(8, 30) {
        let (place, z) = (looking.place(random, 1.1), distance * random.between(0.5, 1.5));
        let radius = looking.pixel(z) * random.log(1.5, 10.0);
        let (at, normal) = (looking.point(place, z), random.direction());
        put.splat(random, at, normal, radius);
        seen_radius = radius;
    }
    // Out of sight.
    for _ in 0..random.count(0, 20) {
        let at = looking.camera.target + random.direction() * distance * random.between(0.1, 0.5);
        let normal = random.direction();
        put.splat(random, at, normal, seen_radius);
    }
    put.made(looking.camera, seen_radius)
}

/// Nearly half of the world in one picture.
pub fn wide(random: &mut Random) -> Made {
    let mut put = Put::new(random);
    let distance = random.log(0.1, 100.0);
    let eye = random.direction() * distance * random.between(0.0, 10.0);
    let fov_deg = 180.0 - random.log(0.01, 60.0);
    let looking = Looking::from(random, eye, distance, fov_deg);
    for _ in 0..random.count(3, 15) {
        let normal = random.direction();
        let (at, radius) = match random.is(0.5) {
            // Some pixels large, wherever that is.
            true => {
                let (place, z) = (looking.place(random, 1.0), distance * random.log(0.1, 1.0));
                (looking.point(place, z), looking.pixel(z) * random.log(1.5, 15.0))
            }
            // In any direction.
            false => {
                let far = distance * random.log(0.3, 3.0);
                let toward = random.direction();
                let ahead = looking.vector(DVec3::new(toward.x, toward.y, toward.z.abs()));
                (looking.camera.eye + ahead * far, far * random.log(0.05, 20.0))
            }
        };
        put.splat(random, at, normal, radius);
    }
    put.made(looking.camera, distance)
}
