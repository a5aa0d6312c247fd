//! How much room ε has near each splat, beside another surface that faces the other way, by looking at each pair of splats.

use glam::DVec3;

use super::tangents::tangents;
use crate::scene::{Shapes, Splats};

/// A splat among others.
struct Oriented {
    number: usize,
    center: DVec3,
    normal: DVec3,
    radius: f64,
}

/// The share of ε, which is so many radii, for each splat. With g, the least distance from its plane of the centers that are within 2ε and
/// face the other way (normals beyond 120°), and d, the largest of those that are within 1.5 radii and face the same way (within 60°): the
/// larger of g/2 and 2d, at most ε; all of ε where there is none, and where g is less than 3d, less than thrice the range in which those lie
/// that are within 1.5 radii and face the other way, or less than a 20th of the radius.
///
/// Where clip curves cut the splats: 2d, at least a 20th of the radius and at most ε, with d of those alone whose distance from the plane is at most the sine
/// between both normals of that from the center.
pub(super) fn shares(splats: &Splats, radii: f64) -> Vec<f64> {
    let mut all: Vec<Oriented> = (0..splats.len())
        .filter(|&i| splats.defect(i).is_none())
        .map(|i| {
            let (s, t) = tangents(&splats.shapes, i);
            let normal = s.normalize().cross(t.normalize()).normalize();
            Oriented { number: i, center: splats.positions[i], normal, radius: splats.major_radius(i) }
        })
        .collect();
    // Along x, so that only a slab of them is looked at.
    all.sort_by(|a, b| a.center.x.total_cmp(&b.center.x));
    let mut shares = vec![1.0; splats.len()];
    for of in &all {
        let epsilon = radii * of.radius;
        let first = all.partition_point(|other| other.center.x < of.center.x - 2.0 * epsilon);
        let slab = all[first..].iter().take_while(|other| other.center.x <= of.center.x + 2.0 * epsilon);
        let others = slab.filter(|other| other.number != of.number);
        if !splats.clips.is_empty() {
            let mut farthest = 0.0_f64;
            for other in others {
                let to = other.center - of.center;
                let from_plane = to.dot(of.normal);
                let same_way = other.normal.dot(of.normal) >= 0.5 && to.length() <= 1.5 * of.radius;
                let sine = (1.0 - other.normal.dot(of.normal).powi(2)).max(0.0).sqrt();
                if same_way && from_plane.abs() <= sine * to.length() {
                    farthest = farthest.max(from_plane.abs());
                }
            }
            shares[of.number] = ((2.0 * farthest).max(0.05 * of.radius) / epsilon).min(1.0);
            continue;
        }
        let (mut spread, mut gap) = (0.0_f64, f64::INFINITY);
        let mut close_others = Vec::new();
        for other in others {
            let distance = other.center.distance(of.center);
            let from_plane = (other.center - of.center).dot(of.normal);
            let cosine = other.normal.dot(of.normal);
            if cosine >= 0.5 && distance <= 1.5 * of.radius {
                spread = spread.max(from_plane.abs());
            }
            if cosine <= -0.5 && distance <= 2.0 * epsilon {
                gap = gap.min(from_plane.abs());
                if distance <= 1.5 * of.radius {
                    close_others.push(from_plane);
                }
            }
        }
        let highest = close_others.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let lowest = close_others.iter().copied().fold(f64::INFINITY, f64::min);
        if gap >= 3.0 * spread.max(highest - lowest) && gap >= 0.05 * of.radius {
            shares[of.number] = ((gap / 2.0).max(2.0 * spread) / epsilon).min(1.0);
        }
    }
    shares
}

/// How a surface that curves end goes on around a splat.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bend {
    /// By how much it turns away over what the splat reaches toward there, of 8 significant bits.
    pub turn: f64,
    /// The minor axis over that reach, in 255 parts; up from 0.37 of one.
    pub minor_part: f64,
    /// Half of how wide it is across the splat, in minor axes, in eighths, up from 0.37 of one and below 32.
    pub width: f64,
}

/// That of each splat; of disks, which have no room to tell it, all are 1.
///
/// The turn is the largest of a sin θ / d over those whose centers are within 1.5 radii, d away, whose normals are θ, at most 60°, off, and that lie behind the plane, by d sin θ / 4 at
/// least and by d sin θ at most; with a how far the splat reaches toward where that normal leans. The minor part is the largest with the minor axis for a, over that. The width is the largest of how far such splats reach across, and those off the plane by no more than d sin θ or a thousandth of a radius.
pub(super) fn bends(splats: &Splats) -> Vec<Bend> {
    let mut bends = vec![Bend { turn: 1.0, minor_part: 1.0, width: 1.0 }; splats.len()];
    if let Shapes::Disks { .. } = splats.shapes {
        return bends;
    }
    let drawn: Vec<usize> = (0..splats.len()).filter(|&i| splats.defect(i).is_none()).collect();
    let frame = |i: usize| {
        let (s, t) = tangents(&splats.shapes, i);
        (splats.positions[i], s.normalize().cross(t.normalize()).normalize())
    };
    let reach = |i: usize, toward: DVec3| {
        let (s, t) = tangents(&splats.shapes, i);
        (s.dot(toward).powi(2) + t.dot(toward).powi(2)).sqrt()
    };
    for &i in &drawn {
        let (center, normal) = frame(i);
        let (s, t) = tangents(&splats.shapes, i);
        let radius = splats.major_radius(i);
        let longest = if t.length() > s.length() { t } else { s };
        let across = normal.cross(longest).normalize();
        let minor = s.cross(t).length() / longest.length();
        let (mut turn, mut of_minor, mut widest) = (0.0_f64, 0.0_f64, minor);
        for &other in drawn.iter().filter(|other| **other != i) {
            let (at, its_normal) = frame(other);
            let (to, cosine) = (at - center, its_normal.dot(normal));
            let sine = normal.cross(its_normal).length();
            let most = to.length() * sine;
            let behind = -to.dot(normal);
            if cosine < 0.5 || to.length() > 1.5 * radius {
                continue;
            }
            if behind > 0.25 * most && behind <= most {
                turn = turn.max(reach(i, its_normal - cosine * normal) / to.length());
                of_minor = of_minor.max(minor * sine / to.length());
            }
            if behind.abs() <= most.max(1e-3 * radius) {
                widest = widest.max(to.dot(across).abs() + reach(other, across));
            }
        }
        let (bit, minor_part) = match turn > 0.0 {
            true => (2.0_f64.powf(turn.log2().floor() - 7.0), of_minor / turn),
            false => (1.0, 1.0),
        };
        bends[i] = Bend {
            turn: (turn / bit).round() * bit,
            minor_part: (255.0 * minor_part + 0.63).floor().clamp(1.0, 255.0) / 255.0,
            width: (8.0 * widest / minor + 0.63).floor().min(255.0) / 8.0,
        };
    }
    bends
}
