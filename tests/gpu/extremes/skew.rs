//! Tangent vectors that are nearly parallel: the sine between them is down to 1e-7, below which they are a defect.

use glam::DVec3;
use surfel::scene::{Backfaces, Filter};

use super::{
    looking::{Draws as _, Looking},
    put::{EVERY_FILTER, Made, Put},
};
use crate::common::builder::Random;

/// Needles of some pixels' length, which only a filter shows.
pub fn needles(random: &mut Random, least_sine: f64, most_sine: f64) -> Made {
    let made = made(random, least_sine, most_sine, |random, pixel, _| pixel * random.log(3.0, 40.0));
    Made { filters: &[Filter::Adjust, Filter::Ewa], ..made }
}

/// Needles among splats that face away, in one block with them, where back faces are culled: the needles are all that is seen.
pub fn needles_among_back_faces(random: &mut Random) -> Made {
    let mut put = Put::ellipses();
    let eye = random.direction() * random.between(0.0, 3.0);
    let looking = Looking::from(random, eye, 10.0, 15.0);
    let away = looking.vector(DVec3::Z);
    for i in 0..random.count(10, 30) {
        let (place, z) = (looking.place(random, 0.9), random.between(9.0, 11.0));
        let at = looking.point(place, z);
        if i >= 3 {
            let normal = (away + random.direction() * 0.05).normalize();
            let radius = looking.pixel(z) * random.log(1.5, 8.0);
            put.splat(random, at, normal, radius);
            continue;
        }
        let normal = (random.direction() * 0.5 - away).normalize();
        let s = normal.any_orthonormal_vector() * looking.pixel(z) * random.log(3.0, 40.0);
        let t = s + normal.cross(s) * random.log(1e-6, 1e-3);
        put.ellipse(random, at, s, t);
    }
    let made = put.made(looking.camera, looking.pixel(10.0));
    Made { filters: &[Filter::Adjust, Filter::Ewa], backfaces: Some(Backfaces::Cull), ..made }
}

/// Strips that are some pixels wide, and longer than anything.
pub fn strips(random: &mut Random, least_sine: f64, most_sine: f64) -> Made {
    let made = made(random, least_sine, most_sine, |random, pixel, sine| pixel * random.log(0.7, 6.0) / sine);
    Made { filters: EVERY_FILTER, ..made }
}

/// `length`: of the longer tangent vector, by the side of a pixel and the sine.
fn made(
    random: &mut Random,
    least_sine: f64,
    most_sine: f64,
    length: fn(&mut Random, f64, f64) -> f64,
) -> Made {
    let mut put = Put::ellipses();
    let distance = random.log(0.1, 10.0);
    let eye = random.direction() * distance * random.between(0.0, 3.0);
    let fov_deg = random.between(15.0, 70.0);
    let looking = Looking::from(random, eye, distance, fov_deg);
    for _ in 0..random.count(2, 14) {
        let (place, z) = (looking.place(random, 0.9), distance * random.between(0.7, 1.5));
        let sine = random.log(least_sine, most_sine);
        let long = length(random, looking.pixel(z), sine);
        // Facing the eye within some 70 degrees, so that the width is seen.
        let in_view = DVec3::new(random.between(-1.0, 1.0), random.between(-1.0, 1.0), -0.5).normalize();
        let normal = looking.vector(in_view);
        let first = normal.any_orthonormal_vector();
        let angle = random.between(0.0, std::f64::consts::TAU);
        let along = first * angle.cos() + normal.cross(first) * angle.sin();
        let sign = random.one_of(&[1.0, -1.0]);
        let beside = along * (1.0 - sine * sine).sqrt() * sign + normal.cross(along) * sine;
        let (s, t) = (along * long, beside * long * random.log(0.3, 1.0));
        let at = looking.point(place, z);
        let (s, t) = if random.is(0.5) { (s, t) } else { (t, s) };
        put.ellipse(random, at, s, t);
    }
    put.made(looking.camera, looking.pixel(distance))
}
