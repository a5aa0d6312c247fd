//! Tilted disks through the eye plane or beside it, and near planes from a tenth of the distance to 1e-20 of it.

use glam::DVec3;

use super::{
    looking::{Draws as _, Looking},
    put::{Made, Put},
};
use crate::common::builder::Random;

/// Disks whose centers have one of these depths, in radii, with the eye beside their planes: a twentieth of a radius at least.
pub fn eye_plane(random: &mut Random, depths: &[f64]) -> Made {
    let near = random.log(1e-20, 1e-6);
    made(random, depths, near, 3)
}

/// The same with near planes that cut them.
pub fn near_plane(random: &mut Random) -> Made {
    let near = random.log(1e-6, 1e-1);
    made(random, &[1.0, 0.3, 0.1, 1e-2, 1e-4, 0.0, -0.1, -0.5], near, 6)
}

fn made(random: &mut Random, depths: &[f64], near: f64, most: usize) -> Made {
    let mut put = Put::new(random);
    let radius = random.log(0.01, 100.0);
    let eye = random.direction() * radius * random.between(0.0, 5.0);
    let fov_deg = random.between(40.0, 110.0);
    let looking = Looking::from(random, eye, radius, fov_deg);
    for _ in 0..random.count(1, most) {
        let depth = random.one_of(depths);
        let (p, normal) = loop {
            // Not beyond what a cut-off by the size at the center's depth would leave.
            let p = DVec3::new(random.between(-0.6, 0.6), random.between(-0.6, 0.6), depth);
            let normal = random.direction();
            // Seen aslant, and from a place beside its plane.
            if (0.1..0.97).contains(&normal.z.abs()) && normal.dot(p).abs() > 0.05 {
                break (p * radius, normal);
            }
        };
        let (at, normal) = (looking.camera.eye + looking.vector(p), looking.vector(normal));
        put.splat(random, at, normal, radius);
    }
    for _ in 0..random.count(0, 8) {
        let place = looking.place(random, 1.0);
        let at = looking.point(place, radius * random.between(2.0, 6.0));
        let (normal, radius) = (random.direction(), radius * random.between(0.1, 1.0));
        put.splat(random, at, normal, radius);
    }
    let mut made = put.made(looking.camera, radius);
    made.camera.near = Some(near * radius);
    made
}
