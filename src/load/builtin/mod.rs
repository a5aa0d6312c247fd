//! The built-in models: pictures without any file.

mod checkerboard;
mod relief;
mod sphere;

pub use checkerboard::{CHECKERBOARD_FIELD, CHECKERBOARD_RADIUS, checkerboard};
pub use sphere::{
    DEFAULT_SPHERE_SPLATS, DEFAULT_SPHERE_TRIANGLES, MOST_SPHERE_TRIANGLES, sphere, sphere_mesh,
};

use std::{num::NonZero, thread};

use glam::{DVec3, Vec3};

use crate::scene::{Colors, Mesh, Object, Shapes, Splats};
use relief::{Relief, SurfacePoint};

/// How many splats the built-in model has where nothing else is asked for.
pub const DEFAULT_RELIEF_SPLATS: usize = 150_000;

/// The memory that the built-in models take for each splat while they are made: a point of the surface, and the splat.
pub const BYTES_PER_SPLAT: usize = 64 + 56;

/// A radius in units of the square root of a splat's share of the area. The lattice leaves no hole down to 0.7 (measured
/// in the tests); at 1 a point is in π disks on the unrelieved sphere, about as in a mesh's splats.
const RADIUS_PER_SPACING: f64 = 1.0;

/// A closed surface with fine relief and color: a ball carved like agate, of about unit radius, around the origin.
///
/// `count` splats on a spherical Fibonacci lattice, which spreads them evenly and has no poles to speak of; normals are
/// analytic. The same count gives the same splats. Below some thousand splats the relief is finer than they are.
pub fn relief(count: usize) -> Object {
    let relief = Relief::new();
    let threads = thread::available_parallelism().map_or(1, NonZero::get).min(count.div_ceil(4096)).max(1);
    let chunk = count.div_ceil(threads).max(1);
    let mut points = vec![SurfacePoint::default(); count];
    thread::scope(|scope| {
        for (i, part) in points.chunks_mut(chunk).enumerate() {
            let relief = &relief;
            scope.spawn(move || {
                for (j, point) in part.iter_mut().enumerate() {
                    *point = relief.point(fibonacci_direction(i * chunk + j, count));
                }
            });
        }
    });
    let splats = Splats::new(
        points.iter().map(|p| p.position).collect(),
        Shapes::Disks {
            normals: points.iter().map(|p| p.normal.as_vec3()).collect::<Vec<Vec3>>(),
            radii: points.iter().map(|p| radius(p, count)).collect(),
        },
        Colors::Each(points.iter().map(|p| p.color).collect()),
    );
    Object { name: "built-in relief".to_owned(), splats, closed: true }
}

/// The surface as a mesh: [`sphere_mesh`] of so many triangles with the relief's heights, normals and colors at its
/// vertices. Below some hundred thousand triangles the relief is finer than they are.
pub fn relief_mesh(triangles: u64) -> Mesh {
    let relief = Relief::new();
    let ball = sphere_mesh(triangles);
    let points: Vec<SurfacePoint> = ball.positions.iter().map(|position| relief.point(*position)).collect();
    Mesh {
        positions: points.iter().map(|point| point.position).collect(),
        normals: Some(points.iter().map(|point| point.normal.as_vec3()).collect()),
        colors: Colors::Each(points.iter().map(|point| point.color).collect()),
        triangles: ball.triangles,
    }
}

/// Direction `i` of `count` on the unit sphere (González, "Measurement of areas on a sphere using Fibonacci and
/// latitude–longitude lattices", 2010; offset ½, so that no direction is a pole).
fn fibonacci_direction(i: usize, count: usize) -> DVec3 {
    let golden_angle = std::f64::consts::PI * (3.0 - 5.0_f64.sqrt());
    let z = 1.0 - (2.0 * i as f64 + 1.0) / count as f64;
    let (sin, cos) = (golden_angle * i as f64).sin_cos();
    let ring = (1.0 - z * z).sqrt();
    DVec3::new(ring * cos, z, ring * sin)
}

/// The lattice's spacing on the unit sphere, grown by the distance from the center, and along a slope by its steepness.
fn radius(point: &SurfacePoint, count: usize) -> f32 {
    let distance = point.position.length();
    let cos_slope = point.normal.dot(point.position) / distance;
    (RADIUS_PER_SPACING * spacing(count) * distance / cos_slope) as f32
}

/// The radius of `count` disks on the unit sphere.
fn radius_on_unit_sphere(count: usize) -> f32 {
    (RADIUS_PER_SPACING * spacing(count)) as f32
}

/// The square root of the share that each of `count` points has of the unit sphere's area.
fn spacing(count: usize) -> f64 {
    (4.0 * std::f64::consts::PI / count as f64).sqrt()
}

#[cfg(test)]
mod tests;
