//! Scenes that are large beside their splats: scans of centimetres over kilometres, sites far apart, places far from the origin.
//! What is seen shares its chunk with what is far off.

use glam::DVec3;
use surfel::scene::Camera;

use super::{
    looking::{Draws as _, Looking, fov_deg_of},
    put::{Made, Put},
};
use crate::common::builder::Random;

/// Splats of a centimetre or two over a square of this side, in metres, or in a strip of this length; the eye is a metre from one.
pub fn wide(random: &mut Random, side: f64) -> Made {
    let mut put = Put::new(random);
    let anywhere = |random: &mut Random| {
        DVec3::new(random.between(-0.5, 0.5), random.between(-0.5, 0.5), random.between(-0.005, 0.005)) * side
    };
    let target = anywhere(random);
    let radius = random.one_of(&[0.01, 0.02]);
    let strip = random.is(0.5).then(|| random.direction() * side);
    for _ in 0..random.count(20, 46) {
        let at = match strip {
            Some(strip) => target + strip * random.between(-1.0, 1.0).powi(3),
            None => anywhere(random),
        };
        let normal = random.direction();
        put.splat(random, at, normal, radius);
    }
    let looking = around(random, &mut put, target, 1.0, radius);
    put.made(looking, radius)
}

/// Sites of a few splats of 2 cm each, this far apart in metres; the eye is at one of them.
pub fn sites(random: &mut Random, apart: f64, most_a_site: usize) -> Made {
    let mut put = Put::new(random);
    let first = random.direction() * apart * random.unit();
    let mut sites = vec![first];
    for _ in 0..random.count(1, if most_a_site > 100 { 2 } else { 4 }) {
        let at = random.one_of(&sites) + random.direction() * apart * random.between(0.5, 1.0);
        sites.push(at);
    }
    let radius = 0.02;
    for site in &sites {
        for _ in 0..random.count(most_a_site / 2, most_a_site) {
            let at = *site + random.direction() * random.unit() * 0.3;
            let normal = random.direction();
            put.splat(random, at, normal, radius);
        }
    }
    let site = random.one_of(&sites);
    let looking = around(random, &mut put, site, 1.0, radius);
    put.made(looking, radius)
}

/// A scan in coordinates of a country's grid: splats of millimetres over some metres, and a point that a scanner has left at (0, 0, 0).
pub fn far_scan(random: &mut Random) -> Made {
    let mut put = Put::new(random);
    let origin = DVec3::new(5e5, 4.6e6, 3e2) * DVec3::new(1.0, random.one_of(&[1.0, -1.0]), 1.0);
    let radius = random.log(1e-3, 1e-2);
    let side = random.log(1.0, 100.0);
    let anywhere = |random: &mut Random| {
        origin + DVec3::new(random.between(-0.5, 0.5), random.between(-0.5, 0.5), random.unit() * 0.1) * side
    };
    for _ in 0..random.count(10, 40) {
        let (at, normal) = (anywhere(random), random.direction());
        put.splat(random, at, normal, radius);
    }
    if random.is(0.5) {
        put.splat(random, DVec3::ZERO, DVec3::Z, radius);
    }
    let (target, distance) = (anywhere(random), random.log(0.1, 3.0));
    let looking = around(random, &mut put, target, distance, radius);
    put.made(looking, radius)
}

/// Some splats more around a target, so that there is something to see, and the camera that sees them: some pixels each.
fn around(random: &mut Random, put: &mut Put, target: DVec3, distance: f64, radius: f64) -> Camera {
    let px = random.log(1.5, 8.0);
    let looking = Looking::to(random, target, distance, fov_deg_of(radius, distance, px));
    for _ in 0..random.count(4, 12) {
        let place = looking.place(random, 0.9);
        let at = looking.point(place, distance * random.between(0.9, 1.1));
        let normal = random.direction();
        let radius = radius * random.between(0.5, 1.0);
        put.splat(random, at, normal, radius);
    }
    looking.camera
}
