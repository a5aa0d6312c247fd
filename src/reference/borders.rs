//! Which splats lie at a border of their surface, by looking at each pair of splats.

use std::f64::consts::TAU;

use glam::DVec3;

use super::tangents::tangents;
use crate::scene::Splats;

/// A splat among others.
struct Among {
    number: usize,
    center: DVec3,
    s: DVec3,
    t: DVec3,
    normal: DVec3,
    radius: f64,
}

/// Of each splat whether at three places in a row, of 32 of its rim that are evenly around in angle, there is no other splat, and no center of another that touches it lies that way, within the angle of cosine
/// 0.49. Others count that are no smaller than half of it, with normals whose cosine to its own is at least 0.7. Places begin in the way of the first of the axes x, y and z whose
/// cosine to the normal is below 0.59. None is at a border where there are fewer than 2√n of n in all, nor of more than 100 thousand splats.
pub(super) fn at_border(splats: &Splats) -> Vec<bool> {
    if splats.len() > 100_000 {
        return vec![false; splats.len()];
    }
    let mut all: Vec<Among> = (0..splats.len())
        .filter(|&i| splats.defect(i).is_none())
        .map(|i| {
            let (s, t) = tangents(&splats.shapes, i);
            let normal = s.normalize().cross(t.normalize()).normalize();
            let (center, radius) = (splats.positions[i], splats.major_radius(i));
            Among { number: i, center, s, t, normal, radius }
        })
        .collect();
    // Along x, so that only a slab of them is looked at.
    all.sort_by(|a, b| a.center.x.total_cmp(&b.center.x));
    let largest = all.iter().map(|splat| splat.radius).fold(0.0, f64::max);
    let mut found = vec![false; splats.len()];
    for of in &all {
        let reach = of.radius + largest;
        let first = all.partition_point(|other| other.center.x < of.center.x - reach);
        let slab = all[first..].iter().take_while(|other| other.center.x <= of.center.x + reach);
        let counts = |other: &&Among| {
            other.number != of.number
                && other.radius >= 0.5 * of.radius
                && other.center.distance(of.center) <= of.radius + other.radius
                && other.normal.dot(of.normal) >= 0.7
        };
        let touching: Vec<&Among> = slab.filter(counts).collect();
        let axis = [DVec3::X, DVec3::Y, DVec3::Z].into_iter().find(|axis| axis.dot(of.normal).abs() < 0.59);
        let axis = axis.expect("no normal has three components that large");
        let right = (axis - axis.dot(of.normal) * of.normal).normalize();
        let up = of.normal.cross(right);
        let is_empty = |place: usize| {
            let (sin, cos) = (TAU * place as f64 / 32.0).sin_cos();
            let way = cos * right + sin * up;
            let (u, v) = uv(of, way);
            let rim = of.center + way / u.hypot(v);
            !touching.iter().any(|other| is_on(other, rim) || lies_toward(of, way, other))
        };
        let empty: Vec<bool> = (0..34).map(|place| is_empty(place % 32)).collect();
        found[of.number] = empty.windows(3).any(|three| three.iter().all(|empty| *empty));
    }
    let count = found.iter().filter(|at| **at).count() as f64;
    if count >= 2.0 * (all.len() as f64).sqrt() { found } else { vec![false; splats.len()] }
}

/// (u, v) of a place counted from a splat's center, seen along its normal.
fn uv(splat: &Among, from_center: DVec3) -> (f64, f64) {
    let area = splat.s.cross(splat.t).dot(splat.normal);
    let u = from_center.cross(splat.t).dot(splat.normal) / area;
    let v = splat.s.cross(from_center).dot(splat.normal) / area;
    (u, v)
}

/// A millionth beyond its rim is on a splat, too: rims of regular grids cross at places.
fn is_on(splat: &Among, place: DVec3) -> bool {
    let from_center = place - splat.center;
    let (u, v) = uv(splat, from_center);
    let most = 1.0 + 1e-6;
    from_center.length_squared() <= most * splat.radius.powi(2) && u * u + v * v <= most
}

fn lies_toward(of: &Among, way: DVec3, other: &Among) -> bool {
    let to = other.center - of.center;
    let along = to - to.dot(of.normal) * of.normal;
    along.length() > 0.0 && way.dot(along) >= 0.49 * along.length()
}
