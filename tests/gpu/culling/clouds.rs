//! Random scenes that are hard to bound: splats of every shape in blocks of every form, seen from where a bound is reached.

use std::f64::consts::TAU;

use glam::{DQuat, DVec3};
use surfel::{Camera, hard_scenes::Hard};

use crate::common::builder::{Builder, Random, settings};

/// What the filter can draw.
#[derive(Clone, Copy, PartialEq)]
pub enum Shapes {
    Disks,
    Ellipses,
}

/// A splat, before it has a shape.
#[derive(Clone, Copy)]
pub struct Place {
    pub at: DVec3,
    pub normal: DVec3,
    pub radius: f64,
}

/// A power of ten between two.
fn power(random: &mut Random, lo: f64, hi: f64) -> f64 {
    10.0_f64.powf(random.between(lo, hi))
}

fn one_of<T: Copy>(random: &mut Random, all: &[T]) -> T {
    all[random.bits() as usize % all.len()]
}

fn across(random: &mut Random, v: DVec3) -> DVec3 {
    DQuat::from_axis_angle(v, random.between(0.0, TAU)) * v.any_orthonormal_vector()
}

/// Tangent vectors: round, a needle, skew (points reach √2 times as far as either vector), nearly parallel.
fn tangents(random: &mut Random, normal: DVec3, radius: f64) -> [DVec3; 2] {
    let s = across(random, normal);
    let t = normal.cross(s);
    let thin = power(random, -5.5, 0.0);
    let vectors = match random.bits() % 4 {
        0 => [s, t],
        1 => [s, thin * t],
        2 => [s, s + thin * t],
        _ => [s + thin * t, -s],
    };
    vectors.map(|v| radius * v)
}

/// Puts splats of all sizes within about 1 of the origin: along a line, in a ball, on a plane or a sphere, as a wall, at two places.
fn cloud(random: &mut Random, count: usize) -> (Vec<Place>, &'static str) {
    let (axis, kind) = (random.direction(), random.bits() % 6);
    let [side, up] = [across(random, axis), across(random, axis)];
    let spread = power(random, -2.5, 0.3);
    let size = power(random, -3.0, -0.5);
    let mixed = random.unit() < 0.5;
    let place = |random: &mut Random| {
        let [a, b, c] = [(); 3].map(|()| random.between(-1.0, 1.0));
        let jitter = spread * random.unit() * random.direction();
        let (at, normal) = match kind {
            0 => (a * side, axis + jitter),
            1 => (random.direction() * random.unit().cbrt(), axis + jitter),
            2 => (a * side + b * up, axis + jitter),
            3 => {
                let at = random.direction();
                (at, at + jitter)
            }
            4 => (a * side + b * axis.cross(side) + 1e-5 * c * axis, axis + 1e-3 * jitter),
            _ => (30.0 * a.signum() * side + 0.1 * b * up, axis + jitter),
        };
        let own = match (mixed, random.unit() < 0.01) {
            (true, true) => 10.0,
            (true, false) => power(random, -3.0, 0.0),
            (false, _) => 1.0,
        };
        Place { at, normal: normal.normalize(), radius: size * own }
    };
    let names = ["a line", "a ball", "a plane", "a sphere", "a wall", "two places"];
    ((0..count).map(|_| place(random)).collect(), names[kind as usize])
}

/// A camera that sees one of the bounds reached: of some splat at least, by about as much as others may be off.
fn view(random: &mut Random, places: &[Place], kind: usize) -> (Camera, &'static str) {
    let chosen = one_of(random, places);
    let mut eye = random.direction() * power(random, -0.5, 1.5);
    let mut target = if random.unit() < 0.5 { DVec3::ZERO } else { chosen.at };
    let fov_deg = match random.bits() % 5 {
        0 => power(random, -2.0, 0.5),
        1 => random.between(150.0, 179.5),
        _ => random.between(5.0, 90.0),
    };
    let (mut up, mut near, mut fov_y_rad) = (random.direction(), None, fov_deg.to_radians());
    let what = match kind % 6 {
        0 => {
            // From the side to which most normals point: of planes and walls, all of one depth.
            let mean = places.iter().map(|place| place.normal).sum::<DVec3>().normalize_or_zero();
            if random.unit() < 0.7 && mean != DVec3::ZERO {
                eye = mean * eye.length();
                (target, fov_y_rad) = (DVec3::ZERO, random.between(0.02, 0.7));
            }
            "in view"
        }
        1 => {
            // The outermost splat along some direction, a few pixels within or beyond a side of the image.
            let forward = -eye.normalize();
            let side = across(random, forward);
            let slope = |place: &Place| (place.at - eye).dot(side) / (place.at - eye).dot(forward).max(1e-9);
            let most = places.iter().copied().max_by(|a, b| slope(a).total_cmp(&slope(b))).unwrap_or(chosen);
            fov_y_rad = random.between(0.3, 20.0).to_radians();
            let half = 0.5 * fov_y_rad * random.between(0.9, 1.02);
            let to = (most.at - eye).normalize();
            let horizontal = random.unit() < 0.5;
            let half = if horizontal { (half.tan() * 64.0 / 48.0).atan() } else { half };
            let turn = DQuat::from_axis_angle(to.cross(side).normalize(), half);
            target = eye + turn * to;
            up = if horizontal { to.cross(side) } else { side };
            "the outermost at the image's side"
        }
        2 => {
            // The normal that is farthest from the others, hardly turned to the eye.
            let mean: DVec3 = places.iter().map(|place| place.normal).sum();
            let turned = |place: &Place| -place.normal.dot(mean);
            let most =
                places.iter().copied().max_by(|a, b| turned(a).total_cmp(&turned(b))).unwrap_or(chosen);
            let along = mean - mean.dot(most.normal) * most.normal;
            let along = along.try_normalize().unwrap_or(across(random, most.normal));
            let from = along - power(random, -4.0, -1.5) * most.normal;
            let away = power(random, 0.7, 3.0);
            eye = most.at - away * from.normalize();
            target = most.at;
            fov_y_rad = (30.0 * most.radius / away).min(1.0);
            "the outermost normal hardly turned to the eye"
        }
        3 => {
            // The near plane through a splat: its center, its nearest or farthest point.
            let forward = (target - eye).normalize();
            let far = places.iter().map(|place| (place.at - eye).dot(forward)).fold(0.0, f64::max);
            let own = (chosen.at - eye).dot(forward);
            let depth = if random.unit() < 0.5 { far } else { own };
            let deep = chosen.radius * chosen.normal.cross(forward).length();
            let part = one_of(random, &[-1.0, -0.99, 0.0, 0.99, 1.0]);
            near = Some(depth + part * deep).filter(|near| *near > 1e-3);
            "the near plane through a splat"
        }
        4 => {
            eye = chosen.at + power(random, -4.0, -1.0) * random.direction();
            target = if random.unit() < 0.5 { eye + random.direction() } else { DVec3::ZERO };
            "the eye among the splats"
        }
        _ => {
            // In the plane of a splat.
            let away = across(random, chosen.normal) + power(random, -7.0, -2.0) * chosen.normal;
            eye = chosen.at + away * power(random, -1.0, 1.0);
            target = chosen.at;
            "edge-on"
        }
    };
    (Camera { eye, target, up, fov_y_rad, near, ..Camera::default() }, what)
}

/// A scene of one to six blocks, and its view; what is hard about it.
pub fn hard_to_bound(random: &mut Random, kind: usize, shapes: Shapes) -> (Hard, String) {
    let count = one_of(random, &[3, 40, 250, 256, 257, 700, 1500]);
    let (mut places, form) = cloud(random, count);
    let (mut camera, view) = view(random, &places, kind);
    // Elsewhere and of another unit, as files are.
    let unit = one_of(random, &[1.0, 1.0, 1024.0, 1e-6]);
    let offset = one_of(random, &[DVec3::ZERO, DVec3::ZERO, DVec3::new(3e4, -5e5, 7.0)]) * unit;
    let moved = |at: DVec3| at * unit + offset;
    (camera.eye, camera.target) = (moved(camera.eye), moved(camera.target));
    camera.near = camera.near.map(|near| near * unit);
    let mut builder = Builder::default();
    for place in &mut places {
        place.at = moved(place.at);
        place.radius *= unit;
        let color = random.color();
        match shapes {
            Shapes::Disks => builder.disk(place.at, place.normal, place.radius, color),
            Shapes::Ellipses => {
                let [s, t] = tangents(random, place.normal, place.radius);
                builder.ellipse(place.at, s, t, color);
            }
        }
    }
    let closed = random.unit() < 0.5;
    let hard = Hard { name: "hard to bound", scene: builder.scene(closed), camera, settings: settings() };
    (hard, format!("{form} of {count}, {view}"))
}
