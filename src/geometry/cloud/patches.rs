//! Normals of a noisy cloud, from patches of the surface: planes at a part of the points, and how they turn from one to the next.
//!
//! **A patch** has the plane through the 48 nearest points about its middle, or the sheet among them. Its normal has less noise than
//! theirs, but as much as 48 points leave. Those of the 12 nearest patches on the same face are fitted once more, by least squares, as
//! n(x) = n₀ + A (x − x₀) with the mean normal n₀ at the mean place x₀: a constant would be off by the turn of the surface from
//! a point to the middle of what it has neighbors of, which on a torus is more than the noise. A direction along which patches do not lie, across the
//! surface, says nothing of A: a ridge of [`RIDGE`] keeps it zero.
//!
//! A point takes the mean of what the patches about it and its neighbors tell at its place, weighted by how near they are; in space and along their
//! normals, so that beside an edge they are rather those of the face on which the point lies. Of the nearest alone, normals would change at
//! once somewhere beside an edge, where 60 of 2 million places of a noisy cube were in no disk then.

use std::{iter, ops::Range};

use glam::{DMat3, DVec3};
use rayon::prelude::*;

use super::{
    fit::Plane,
    orient::orient,
    plane::{MOST_NEIGHBORS, NEIGHBORS},
    sheets,
};
use crate::geometry::neighbors::{Many, Point, Tree};

/// Every so manieth of the points that planes are fitted to is the middle of a patch. With 2 clouds take half as long again, with 8 edges have
/// normals farther off.
const EVERY: usize = 4;

/// Cosine of the angle between normals up to which patches are of one face.
const SAME_FACE: f64 = 0.8;

/// What is added to each axis of the patches' covariance, as a part of all.
const RIDGE: f64 = 0.03;

/// Patches whose squared distance is so many times the nearest's tell nothing.
const FARTHEST: f64 = 6.0;

/// About so many points look for patches together: the 12 nearest to their middle. A point that is far from all of these, as some in a corner of a
/// room where a group has points of two walls, looks for its own.
const GROUP: usize = 32;

/// The tree of every so manieth point.
pub(super) fn every(tree: &Tree, stride: usize) -> Tree {
    Tree::new(tree.points().iter().step_by(stride).copied().collect())
}

/// The plane through the 48 points nearest to a place, or the sheet among them if it is thicker than `mixed`.
pub(super) fn plane_or_sheet(tree: &Tree, place: DVec3, mixed: f64, near: &mut Many) -> Plane {
    let whole = Plane::fit(near.nearest(tree, place, MOST_NEIGHBORS), |_| true);
    let sheet = (whole.thickness > mixed).then(|| sheets::wide(near.sorted(tree, place)));
    sheet.flatten().unwrap_or(whole)
}

/// A plane of the surface.
#[derive(Clone, Copy)]
struct Facet {
    /// The mean of the points on it.
    mean: DVec3,
    /// Unit.
    normal: DVec3,
}

/// Normals about a facet: `normal + turn * (x − mean)` at x, no farther than `reach` from `mean`.
#[derive(Clone, Copy)]
struct Patch {
    facet: Facet,
    mean: DVec3,
    normal: DVec3,
    turn: DMat3,
    reach: f64,
}

/// The normals at all points of a tree, of patches through the points of a coarser one or of itself, on one side of each surface. Planes thicker than
/// `mixed` may be of two sheets.
pub(super) fn normals(tree: &Tree, coarse: &Tree, mixed: f64) -> Vec<DVec3> {
    let middles = every(coarse, EVERY);
    let facet = |near: &mut Many, middle: &Point| Facet::at(middle.position, coarse, mixed, near);
    let mut facets: Vec<Facet> = middles.points().par_iter().map_init(Many::default, facet).collect();
    let neighbors: Vec<[u32; NEIGHBORS]> =
        (0..facets.len()).into_par_iter().map(|place| middles.nearest_places(place)).collect();
    turn_to_one_side(&mut facets, &middles, &neighbors);
    let with_nearest =
        |(facet, near): (&Facet, &[u32; NEIGHBORS])| Patch::new(facet, of(&near[..NEIGHBORS - 1], &facets));
    let patches: Vec<Patch> = facets.par_iter().zip(&neighbors).map(with_nearest).collect();
    let of_group = |group: Range<usize>| {
        let points = &tree.points()[group];
        let middle = points.iter().map(|point| point.position).sum::<DVec3>() / points.len() as f64;
        let near =
            |place: DVec3| of(&middles.nearest_places_to::<NEIGHBORS>(place), &patches).collect::<Vec<_>>();
        let of_group = near(middle);
        let alone = |place: DVec3| normal(place, &near(place), f64::INFINITY);
        let one = |point: &Point| normal(point.position, &of_group, 1.0).or_else(|| alone(point.position));
        points.iter().map(|point| one(point).unwrap_or(DVec3::Z)).collect::<Vec<_>>()
    };
    tree.groups(GROUP).into_par_iter().flat_map_iter(of_group).collect()
}

/// Turns the normals of facets about the points of a tree, whose neighbors are given.
fn turn_to_one_side(facets: &mut [Facet], middles: &Tree, neighbors: &[[u32; NEIGHBORS]]) {
    // Means of points of two sheets would lie between these.
    let places = middles.positions();
    let mut normals: Vec<DVec3> = facets.iter().map(|facet| facet.normal).collect();
    let area = |place: usize| -> f64 {
        let six = neighbors[place].iter().take(6).filter_map(|j| places.get(*j as usize));
        six.map(|other| other.distance_squared(places[place])).sum::<f64>() / 6.0
    };
    let areas: Vec<f64> = (0..places.len()).map(area).collect();
    orient(&places, neighbors, &areas, &mut normals);
    facets.iter_mut().zip(normals).for_each(|(facet, normal)| facet.normal = normal);
}

/// What belongs to places that were found.
fn of<'a, T>(found: &[u32], all: &'a [T]) -> impl Iterator<Item = &'a T> + Clone {
    found.iter().filter_map(|at| all.get(*at as usize))
}

/// What the patches near a place tell; `None` where none is so near, in parts of its reach, that it knows the place.
fn normal(place: DVec3, patches: &[&Patch], farthest: f64) -> Option<DVec3> {
    let mut away = [f64::INFINITY; NEIGHBORS];
    away.iter_mut().zip(patches).for_each(|(away, patch)| *away = patch.facet.away(place));
    let nearest = (0..patches.len()).min_by(|&a, &b| away[a].total_cmp(&away[b]))?;
    if away[nearest] > (farthest * patches[nearest].reach).powi(2) {
        return None;
    }
    let side = patches[nearest].normal_at(place);
    let mut sum = side;
    for (i, patch) in patches.iter().enumerate().filter(|(i, _)| *i != nearest) {
        let weight = (1.0 - (away[i] - away[nearest]) / ((FARTHEST - 1.0) * away[nearest])).max(0.0).powi(2);
        if weight > 0.0 {
            let normal = patch.normal_at(place);
            sum += normal * weight.copysign(normal.dot(side));
        }
    }
    Some(sum.try_normalize().unwrap_or(side))
}

impl Facet {
    /// Of the points about a place.
    fn at(place: DVec3, points: &Tree, mixed: f64, near: &mut Many) -> Self {
        let plane = plane_or_sheet(points, place, mixed, near);
        Self { mean: place + plane.mean, normal: plane.normal }
    }

    /// How far a place is from it, squared; what is along the normal counts twice.
    fn away(&self, place: DVec3) -> f64 {
        let offset = place - self.mean;
        offset.length_squared() + self.normal.dot(offset).powi(2)
    }
}

impl Patch {
    /// Of a facet with those nearest to it.
    fn new<'a>(facet: &'a Facet, near: impl Iterator<Item = &'a Facet> + Clone) -> Self {
        let of_face = iter::once(facet).chain(near).filter_map(|other| {
            let dot = other.normal.dot(facet.normal);
            (dot.abs() > SAME_FACE).then_some((other.mean, dot.signum() * other.normal))
        });
        let count = of_face.clone().count() as f64;
        let sum = |[at, normal]: [DVec3; 2], of: (DVec3, DVec3)| [at + of.0, normal + of.1];
        let [mean, normal] = of_face.clone().fold([DVec3::ZERO; 2], sum).map(|sum| sum / count);
        let reach = of_face.clone().map(|(at, _)| at.distance(mean)).fold(0.0, f64::max);
        // By lengths of about 1, of which no square underflows.
        let (mut places, mut turns) = (DMat3::from_diagonal(DVec3::splat(f64::MIN_POSITIVE)), DMat3::ZERO);
        for (at, other) in of_face {
            let offset = (at - mean) / reach;
            places += outer(offset, offset);
            turns += outer(other - normal, offset);
        }
        let ridge = RIDGE * (places.x_axis.x + places.y_axis.y + places.z_axis.z);
        let turn = turns * (places + DMat3::from_diagonal(DVec3::splat(ridge))).inverse() * reach.recip();
        Self { facet: *facet, mean, normal, turn, reach }
    }

    /// That of the facet where there is no other.
    fn normal_at(&self, place: DVec3) -> DVec3 {
        let offset = (place - self.mean).clamp_length_max(self.reach);
        (self.normal + self.turn * offset).try_normalize().unwrap_or(self.facet.normal)
    }
}

fn outer(a: DVec3, b: DVec3) -> DMat3 {
    DMat3::from_cols(a * b.x, a * b.y, a * b.z)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::SplitMix;

    fn tree(positions: impl IntoIterator<Item = DVec3>) -> Tree {
        Tree::new((0..).zip(positions).map(|(number, position)| Point { position, number }).collect())
    }

    /// A part of a pipe along y, of which each 48 points look from 12° to one side to 12° to the other.
    #[test]
    fn normals_turn_with_the_surface_and_no_farther_than_patches_tell() {
        let mut random = SplitMix(4);
        let mut on_pipe = |_| {
            let (sin, cos) = (random.unit() - 0.5).sin_cos();
            DVec3::new(sin, random.unit(), cos)
        };
        let mut positions: Vec<DVec3> = (0..1000).map(&mut on_pipe).collect();
        positions.push(DVec3::new(100.0, 0.5, 0.8));
        let tree = tree(positions);
        for (point, normal) in tree.points().iter().zip(normals(&tree, &tree, 0.25)) {
            let truth = DVec3::new(point.position.x, 0.0, point.position.z).normalize();
            let angle = normal.dot(truth).abs().min(1.0).acos().to_degrees();
            match point.number {
                1000 => assert!(normal.dot(DVec3::new(0.5, 0.0, 0.866)).abs() > 0.9, "{normal}"),
                _ => assert!(angle < 6.0, "{angle}° at {point:?}"),
            }
        }
    }

    /// A floor of 6 by 5 and two walls that meet in a corner: some groups have points of more than one of them.
    #[test]
    fn no_point_of_a_wall_has_the_normal_of_the_floor() {
        let mut random = SplitMix(8);
        let on_walls = |i: u32| {
            let [along, up, noise] = [0; 3].map(|_| random.unit());
            match i % 4 {
                0 | 1 => DVec3::new(6.0 * along, 5.0 * up, 0.02 * noise),
                2 => DVec3::new(6.0 * along, 0.02 * noise, 2.8 * up),
                _ => DVec3::new(0.02 * noise, 5.0 * along, 2.8 * up),
            }
        };
        let tree = tree((0..60_000).map(on_walls));
        let mut walls = 0;
        for (point, normal) in tree.points().iter().zip(normals(&tree, &tree, 0.25)) {
            let inside = [0, 1, 2].map(|axis| point.position[axis] > 0.3);
            let Some(wall) = inside.iter().position(|inside| !inside) else { continue };
            if inside.iter().filter(|inside| **inside).count() == 2 {
                walls += 1;
                assert!(normal[wall].abs() > 0.95, "{normal} at {}", point.position);
            }
        }
        assert!(walls > 40_000);
    }

    #[test]
    fn points_that_are_one_place_or_lie_on_a_line_have_normals_all_the_same() {
        let line = tree((0..300).map(|i| DVec3::X * f64::from(i)));
        assert!(normals(&line, &line, 0.25).iter().all(|n| n.is_normalized() && n.x.abs() < 1e-9));
        for one in [tree([DVec3::ONE; 300]), tree([1e-180; 300].map(DVec3::splat)), tree([DVec3::NAN; 5])] {
            assert!(normals(&one, &one, 0.25).iter().all(|n| n.is_normalized()));
        }
    }
}
