//! Points far from all others that are near each other alone, as birds above a scan, or what a scanner saw of dust: no surface goes through them.
//!
//! A point is *sparse* whose neighbors are many times as far away as those of most points. Sparse points that are neighbors, of about the same spread, are a group. It is of
//! a surface if most of it lies in planes: as a wall far behind a window does, or the ground far from a scanner. Else they are strays: all of them where no point of
//! the rest is a neighbor of about their own spread; and where one is, as near to a surface some strays are by chance, if they are many together, and yet few
//! against the rest.

use std::collections::HashMap;

use super::{fit::Plane, outliers::ISOLATED, plane::NEIGHBORS};
use crate::geometry::neighbors::Tree;

/// Thickness over width above which a group of points is no surface. Points in a volume have 0.7 to 0.9.
const NO_SURFACE: f64 = 0.4;

/// A group that is joined to the rest has strays if it is no more than one of so many points.
const MOST_SHARE: usize = 50;

/// Marks strays; `isolated` are those that are left out without them.
pub(super) fn mark(tree: &Tree, neighbors: &[[u32; NEIGHBORS]], spreads: &[f64], isolated: &mut [bool]) {
    let Some(limit) = median(spreads).map(|median| ISOLATED * median) else { return };
    // By their places, each with the first of its group.
    let sparse = |place: usize| spreads[place] > limit && !isolated[place];
    let mut groups: HashMap<u32, u32> = (0..)
        .zip(0..spreads.len())
        .filter(|(_, place)| sparse(*place))
        .map(|(place, _)| (place, place))
        .collect();
    let mut places: Vec<u32> = groups.keys().copied().collect();
    places.sort_unstable();
    // Places that are there, of about the same spread.
    let alike = |place: u32| {
        let like = move |j: &&u32| {
            let [own, other] = [place, **j].map(|place| spreads[place as usize]);
            own < ISOLATED * other && other < ISOLATED * own
        };
        neighbors[place as usize].iter().filter(|j| **j != u32::MAX && !isolated[**j as usize]).filter(like)
    };
    for &place in &places {
        for &other in alike(place) {
            if groups.contains_key(&other) {
                let [a, b] = [first_of(&mut groups, place), first_of(&mut groups, other)];
                groups.insert(a.max(b), a.min(b));
            }
        }
    }
    let mut members: HashMap<u32, (Vec<u32>, bool)> = HashMap::new();
    for &place in &places {
        let is_joined = alike(place).any(|other| !groups.contains_key(other));
        let (group, joined) = members.entry(first_of(&mut groups, place)).or_default();
        group.push(place);
        *joined |= is_joined;
    }
    let few = spreads.len() / MOST_SHARE;
    let strays = members.into_values().filter(|(group, joined)| match joined {
        true => (NEIGHBORS + 1..=few).contains(&group.len()) && !is_flat(tree, neighbors, group),
        false => group.len() <= NEIGHBORS || !is_flat(tree, neighbors, group),
    });
    let strays: Vec<u32> = strays.flat_map(|(group, _)| group).collect();
    strays.into_iter().for_each(|place| isolated[place as usize] = true);
}

/// The lower one; none of nothing.
fn median(spreads: &[f64]) -> Option<f64> {
    let mut all = spreads.to_vec();
    let middle = all.len().checked_sub(1)? / 2;
    Some(*all.select_nth_unstable_by(middle, f64::total_cmp).1)
}

fn first_of(groups: &mut HashMap<u32, u32>, place: u32) -> u32 {
    let mut first = place;
    while let Some(next) = groups.get(&first).copied().filter(|next| *next != first) {
        first = next;
    }
    groups.insert(place, first);
    first
}

/// Whether most of a group lie in planes with their neighbors.
fn is_flat(tree: &Tree, neighbors: &[[u32; NEIGHBORS]], group: &[u32]) -> bool {
    let at = |place: u32| tree.points()[place as usize].position;
    let is_flat = |place: &&u32| {
        let near = neighbors[**place as usize].iter().filter(|j| **j != u32::MAX);
        let offsets: Vec<_> = near.map(|j| at(*j) - at(**place)).collect();
        Plane::fit(&offsets, |_| true).thickness < NO_SURFACE
    };
    2 * group.iter().filter(is_flat).count() > group.len()
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use crate::{
        geometry::cloud::splats_from_points,
        math::random::SplitMix,
        scene::{Points, Shapes},
    };

    fn in_cube(random: &mut SplitMix, side: f64) -> DVec3 {
        DVec3::from([(); 3].map(|()| side * (random.unit() - 0.5)))
    }

    /// How many are left, and the largest radius.
    fn left(positions: Vec<DVec3>) -> (usize, f32) {
        let (splats, _) = splats_from_points(Points { positions, ..Points::default() }, &());
        let Shapes::Disks { radii, .. } = &splats.shapes else { panic!("disks") };
        (splats.len(), radii.iter().copied().fold(0.0, f32::max))
    }

    #[test]
    fn strays_around_a_surface_are_left_out_and_a_sparse_wall_behind_it_stays() {
        let mut random = SplitMix(21);
        let ball: Vec<DVec3> = std::iter::from_fn(|| Some(in_cube(&mut random, 2.0)))
            .filter(|p| (0.1..1.0).contains(&p.length()))
            .take(30_000)
            .map(DVec3::normalize)
            .collect();
        let (whole, radius) = left(ball.clone());
        assert_eq!(whole, ball.len());
        for count in [20, 300, 600] {
            let strays = (0..count).map(|_| in_cube(&mut random, 6.0));
            let (kept, largest) = left(ball.iter().copied().chain(strays).collect());
            // Of the cube 3% is so near to the ball that a point there is not isolated.
            assert!(kept < ball.len() + 3 + count / 20, "{count}: {kept}");
            assert!(largest < 3.0 * radius, "{count}: {largest}, {radius} without");
        }
        let wall = (0..400).map(|i| DVec3::new(f64::from(i % 20) - 9.5, f64::from(i / 20) - 9.5, 12.0));
        let (kept, _) = left(ball.iter().copied().chain(wall).collect());
        assert_eq!(kept, ball.len() + 400);
    }
}
