//! Which splats lie at a border of their surface, by looking at each pair of splats.

use std::f64::consts::TAU;

use glam::DVec3;

use super::among::{Among, all_along_x};
use crate::scene::Splats;

/// Of each splat whether at three places in a row, of 32 of its rim that are evenly around in angle, there is no other splat, and no center of another that touches it lies that way, within the angle of cosine
/// 0.49. Others count that are no smaller than half of it, with normals whose cosine to its own is at least 0.7. Places begin in the way of the first of the axes x, y and z whose
/// cosine to the normal is below 0.59. None is at a border where there are fewer than 2√n of n in all, nor of more than 100 thousand splats.
pub(super) fn at_border(splats: &Splats) -> Vec<bool> {
    if splats.len() > 100_000 {
        return vec![false; splats.len()];
    }
    let all = all_along_x(splats);
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
        // No normal has three components that large.
        let axis = axis.unwrap_or(DVec3::X);
        let right = (axis - axis.dot(of.normal) * of.normal).normalize();
        let up = of.normal.cross(right);
        let is_empty = |place: usize| {
            let (sin, cos) = (TAU * place as f64 / 32.0).sin_cos();
            let way = cos * right + sin * up;
            let rim = of.center + way / of.seen_at(of.center + way).length();
            !touching.iter().any(|other| is_on(other, rim) || lies_toward(of, way, other))
        };
        let empty: Vec<bool> = (0..34).map(|place| is_empty(place % 32)).collect();
        found[of.number] = empty.windows(3).any(|three| three.iter().all(|empty| *empty));
    }
    let count = found.iter().filter(|at| **at).count() as f64;
    if count >= 2.0 * (all.len() as f64).sqrt() { found } else { vec![false; splats.len()] }
}

/// A millionth beyond its rim is on a splat, too: rims of regular grids cross at places.
fn is_on(splat: &Among, place: DVec3) -> bool {
    let most = 1.0 + 1e-6;
    place.distance_squared(splat.center) <= most * splat.radius.powi(2)
        && splat.seen_at(place).length_squared() <= most
}

fn lies_toward(of: &Among, way: DVec3, other: &Among) -> bool {
    let to = other.center - of.center;
    let along = to - to.dot(of.normal) * of.normal;
    along.length() > 0.0 && way.dot(along) >= 0.49 * along.length()
}
